// The other implementations that bench/segment_queries.cpp is measured against: Embree and CGAL's AABB tree. Never part of the product.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fastpath/predicates/filter.h"

#ifdef CLUES_EMBREE
#include <embree3/rtcore.h>
#endif

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <chrono>
#include <memory>

namespace clues::bench {

struct NamedPeer {
  std::string name;
  std::function<bool(const fastpath::Segment&)> any_hit;
  double build_seconds = 0;
};

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Kernel>
NamedPeer cgal_peer(const scene::TriangleMesh& mesh, const std::string& name) {
  using Triangles = std::vector<typename Kernel::Triangle_3>;
  using Tree =
      CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, typename Triangles::iterator>>>;
  const auto point = [](const scene::Point& p) { return typename Kernel::Point_3(p[0], p[1], p[2]); };
  auto triangles = std::make_shared<Triangles>();
  for (const auto& t : mesh.triangles) {
    triangles->emplace_back(point(mesh.points[t[0]]), point(mesh.points[t[1]]), point(mesh.points[t[2]]));
  }
  const auto start = std::chrono::steady_clock::now();
  auto tree = std::make_shared<Tree>(triangles->begin(), triangles->end());
  tree->build();
  return {name,
          [triangles, tree, point](const fastpath::Segment& s) {
            return tree->do_intersect(typename Kernel::Segment_3(point(s.a), point(s.b)));
          },
          seconds_since(start)};
}

#ifdef CLUES_EMBREE
inline constexpr bool kHaveEmbree = true;

inline NamedPeer embree_peer(const scene::TriangleMesh& mesh, const std::string& name, RTCSceneFlags flags) {
  const auto start = std::chrono::steady_clock::now();
  std::shared_ptr<RTCDeviceTy> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  std::shared_ptr<RTCSceneTy> scene(rtcNewScene(device.get()), rtcReleaseScene);
  rtcSetSceneFlags(scene.get(), flags);
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), mesh.points.size()));
  for (const scene::Point& p : mesh.points) {
    for (const double x : p) *points++ = static_cast<float>(x);
  }
  auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const scene::Triangle& t : mesh.triangles) corners = std::copy(t.begin(), t.end(), corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  return {name,
          [device, scene](const fastpath::Segment& s) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRay ray{};
            ray.org_x = static_cast<float>(s.a[0]);
            ray.org_y = static_cast<float>(s.a[1]);
            ray.org_z = static_cast<float>(s.a[2]);
            ray.dir_x = static_cast<float>(s.b[0] - s.a[0]);
            ray.dir_y = static_cast<float>(s.b[1] - s.a[1]);
            ray.dir_z = static_cast<float>(s.b[2] - s.a[2]);
            ray.tnear = 0;
            ray.tfar = 1;
            ray.mask = 0xffffffffU;
            rtcOccluded1(scene.get(), &context, &ray);
            return ray.tfar < 0;
          },
          seconds_since(start)};
}
#else
inline constexpr bool kHaveEmbree = false;
#endif

inline std::vector<NamedPeer> make_peers(const scene::TriangleMesh& mesh) {
  std::vector<NamedPeer> peers;
#ifdef CLUES_EMBREE
  peers.push_back(embree_peer(mesh, "Embree 3", RTC_SCENE_FLAG_NONE));
  peers.push_back(embree_peer(mesh, "Embree 3, robust", RTC_SCENE_FLAG_ROBUST));
#endif
  peers.push_back(cgal_peer<CGAL::Simple_cartesian<double>>(mesh, "CGAL, doubles"));
  peers.push_back(cgal_peer<CGAL::Exact_predicates_inexact_constructions_kernel>(mesh, "CGAL, exact predicates"));
  return peers;
}

}  // namespace clues::bench
