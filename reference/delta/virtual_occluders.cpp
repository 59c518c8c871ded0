#include "reference/delta/virtual_occluders.h"

#include "reference/visibility/hidden/umbra_slice.h"

namespace clues::reference {

using exact::FT;
using exact::Plane3;

namespace {

// A point of the rounded mesh: all its coordinates are doubles.
scene::Point doubles_of(const exact::Point3& p) {
  scene::Point out{};
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = CGAL::to_double(p[i].exact());
  return out;
}

scene::TriangleMesh mesh_of(const SewnMesh& sewn) {
  scene::TriangleMesh mesh;
  for (const exact::Point3& p : sewn.points) mesh.points.push_back(doubles_of(p));
  for (const SewnMesh::Triangle& t : sewn.triangles) {
    scene::Triangle corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = static_cast<std::uint32_t>(t.corners[i]);
    mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

FT area_of(const std::vector<Ring2>& face) {
  FT sum(0);
  for (const Ring2& ring : face) sum += twice_area(ring);
  return exact::collapsed(sum / FT(2));
}

}  // namespace

VirtualOccluder virtual_occluder(const Umbra& umbra, int axis, double at) {
  const Plane3 plane(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0, -FT(at));
  UmbraSlice slice = slice_of(umbra, plane, Approach::before);
  UmbraSlice other = slice_of(umbra, plane, Approach::behind);
  if (other.twice_area > slice.twice_area) std::swap(slice, other);

  VirtualOccluder out;
  out.axis = axis;
  out.at = at;
  std::vector<Rings3> exact_faces, rounded_faces;
  for (const auto& face : slice.faces) {
    exact_faces.push_back(in_space(plane, face));
    out.area += area_of(face);
    const auto rounded = rounded_inwards(face);
    if (!rounded) {
      ++out.faces_left_out;
      continue;
    }
    rounded_faces.push_back(in_space(plane, *rounded));
    out.rounded_area += area_of(*rounded);
  }
  out.exact = sew(exact_faces);
  out.rounded = mesh_of(sew(rounded_faces));
  return out;
}

scene::TriangleMesh with_occluders(const scene::TriangleMesh& mesh, const std::vector<VirtualOccluder>& occluders) {
  scene::TriangleMesh all = mesh;
  for (const VirtualOccluder& occluder : occluders) {
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), occluder.rounded.points.begin(), occluder.rounded.points.end());
    for (const scene::Triangle& t : occluder.rounded.triangles) {
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      all.face_of.push_back(all.face_of.empty() ? 0 : all.face_of.back() + 1);
    }
  }
  return all;
}

}  // namespace clues::reference
