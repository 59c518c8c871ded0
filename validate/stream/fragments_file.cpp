#include "validate/stream/fragments_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/delta/fragments.h"
#include "reference/visibility/map/sides.h"
#include "scene/messages/error.h"
#include "scene/ply_text.h"

namespace clues::validate {
namespace {

using nlohmann::json;

FileFragment fragment_of(const reference::VisibilityMap& map, const reference::Region& region,
                         const std::array<std::uint64_t, 3>& corners) {
  for (const exact::Origin& o : map.complex.pieces[region.piece].origins) {
    if (reference::counts(map.mode, o, region.front)) return {corners, o.triangle, o.same_side == region.front};
  }
  throw scene::Error(scene::ErrorCode::internal, "fragments: a region of no triangle");
}

const char* side_name(bool front) { return front ? "front" : "back"; }

}  // namespace

FragmentsRecord fragments_of(const reference::VisibilityMap& map) {
  const reference::FragmentMesh fragments = reference::visible_fragments(map);
  FragmentsRecord out;
  out.scene_triangles = map.complex.input_triangles;
  for (const exact::Point3& p : fragments.mesh.points) {
    out.exact.push_back(map.range.moved_back(p));
    out.rounded.push_back(map.range.estimate_moved_back(exact::to_double_estimate(p)));
  }
  for (const auto& t : fragments.mesh.triangles)
    out.fragments.push_back(fragment_of(map, map.regions[fragments.regions[t.region]], t.corners));
  // Those of one side of one triangle stand together.
  std::stable_sort(out.fragments.begin(), out.fragments.end(), [](const FileFragment& a, const FileFragment& b) {
    return std::pair(a.triangle, !a.front) < std::pair(b.triangle, !b.front);
  });
  return out;
}

FragmentsRecord fragments_of(const scene::TriangleMesh& mesh, const std::vector<reference::InputSide>& sides,
                             const std::vector<reference::FlatSet>& sets) {
  std::vector<reference::Rings3> regions;
  std::vector<std::size_t> side_of;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const reference::TriangleFrame frame = reference::frame_of(mesh, sides[s].triangle);
    for (const reference::Face2& face : sets[s].faces()) {
      reference::Rings3& rings = regions.emplace_back();
      for (const reference::Ring2& ring : face) {
        rings.emplace_back();
        for (const exact::Point2& q : ring) rings.back().push_back(frame.lift(q));
        if (!sides[s].front) std::reverse(rings.back().begin(), rings.back().end());
      }
      side_of.push_back(s);
    }
  }
  const reference::SewnMesh sewn = reference::sew(regions);
  FragmentsRecord out;
  out.scene_triangles = mesh.triangles.size();
  for (const exact::Point3& p : sewn.points) {
    out.exact.push_back(p);
    out.rounded.push_back(exact::to_double_estimate(p));
  }
  for (const auto& t : sewn.triangles) {
    const reference::InputSide& side = sides[side_of[t.region]];
    out.fragments.push_back({t.corners, side.triangle, side.front});
  }
  return out;
}

std::string to_obj_text(const FragmentsRecord& mesh) {
  std::string text = "# visible fragments; coordinates are rounded to doubles\n";
  for (const scene::Point& p : mesh.rounded) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  const FileFragment* last = nullptr;
  for (const FileFragment& f : mesh.fragments) {
    if (last == nullptr || last->triangle != f.triangle || last->front != f.front)
      text += fmt::format("g triangle_{}_{}\n", f.triangle, side_name(f.front));
    text += fmt::format("f {} {} {}\n", f.corners[0] + 1, f.corners[1] + 1, f.corners[2] + 1);
    last = &f;
  }
  return text;
}

std::string to_ply_text(const FragmentsRecord& mesh) {
  scene::PlyText text(mesh.rounded.size(), mesh.fragments.size(),
                      {.comment = "visible fragments; coordinates are rounded to doubles",
                       .of_face = "property uint triangle\nproperty uchar back\n"});
  for (const scene::Point& p : mesh.rounded) text.vertex(p);
  for (const FileFragment& f : mesh.fragments) text.face(f.corners, {f.triangle, f.front ? 0U : 1U});
  return text.take();
}

std::string to_json_text(const FragmentsRecord& mesh) {
  json exact = json::array(), fragments = json::array();
  for (const exact::Point3& p : mesh.exact) {
    exact.push_back({exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())});
  }
  for (const FileFragment& f : mesh.fragments)
    fragments.push_back({{"corners", f.corners}, {"triangle", f.triangle}, {"side", side_name(f.front)}});
  const json out = {
      {"format", "clues-fragments/1"},
      {"scene", {{"file", mesh.scene_file}, {"sha256", mesh.scene_sha256}, {"triangles", mesh.scene_triangles}}},
      {"vertices", mesh.rounded},
      {"vertices_exact", std::move(exact)},
      {"fragments", std::move(fragments)}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string to_bytes_of(const FragmentsRecord& record, const std::filesystem::path& file) {
  const auto extension = file.extension();
  return extension == ".obj"   ? to_obj_text(record)
         : extension == ".ply" ? to_ply_text(record)
         : extension == ".glb" ? to_glb_bytes(record)
                               : to_json_text(record);
}

}  // namespace clues::validate
