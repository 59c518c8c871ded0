#include "app/fragments_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/common.h"
#include "reference/delta/fragments.h"
#include "reference/visibility/map/sides.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

// A triangle of the file: where input triangles coincide it stands for the first that counts.
struct OneFragment {
  std::array<std::uint64_t, 3> corners{};
  std::uint32_t triangle = 0;
  bool front = true;
};

struct Sewn {
  std::vector<exact::Point3> exact;   // in the coordinates of the scene
  std::vector<scene::Point> rounded;  // to about the nearest doubles
  std::vector<OneFragment> fragments;
};

OneFragment fragment_of(const reference::VisibilityMap& map, const reference::Region& region,
                        const std::array<std::uint64_t, 3>& corners) {
  for (const exact::Origin& o : map.complex.pieces[region.piece].origins) {
    if (reference::counts(map.mode, o, region.front)) return {corners, o.triangle, o.same_side == region.front};
  }
  throw Error(ErrorCode::internal, "fragments: a region of no triangle");
}

Sewn sewn_fragments(const reference::VisibilityMap& map) {
  const reference::FragmentMesh fragments = reference::visible_fragments(map);
  Sewn out;
  for (const exact::Point3& p : fragments.mesh.points) {
    out.exact.push_back(map.range.moved_back(p));
    out.rounded.push_back(map.range.estimate_moved_back(exact::to_double_estimate(p)));
  }
  for (const auto& t : fragments.mesh.triangles)
    out.fragments.push_back(fragment_of(map, map.regions[fragments.regions[t.region]], t.corners));
  // Those of one side of one triangle stand together.
  std::stable_sort(out.fragments.begin(), out.fragments.end(), [](const OneFragment& a, const OneFragment& b) {
    return std::pair(a.triangle, !a.front) < std::pair(b.triangle, !b.front);
  });
  return out;
}

const char* side_name(bool front) { return front ? "front" : "back"; }

std::string to_obj(const Sewn& mesh) {
  std::string text = "# visible fragments; coordinates are rounded to doubles\n";
  for (const scene::Point& p : mesh.rounded) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  const OneFragment* last = nullptr;
  for (const OneFragment& f : mesh.fragments) {
    if (last == nullptr || last->triangle != f.triangle || last->front != f.front)
      text += fmt::format("g triangle_{}_{}\n", f.triangle, side_name(f.front));
    text += fmt::format("f {} {} {}\n", f.corners[0] + 1, f.corners[1] + 1, f.corners[2] + 1);
    last = &f;
  }
  return text;
}

std::string to_ply(const Sewn& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment visible fragments; coordinates are rounded to doubles\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\n"
      "property uint triangle\nproperty uchar back\nend_header\n",
      mesh.rounded.size(), mesh.fragments.size());
  for (const scene::Point& p : mesh.rounded) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const OneFragment& f : mesh.fragments) {
    text += fmt::format("3 {} {} {} {} {}\n", f.corners[0], f.corners[1], f.corners[2], f.triangle, f.front ? 0 : 1);
  }
  return text;
}

std::string to_json(const Sewn& mesh, const std::string& scene_file, const std::string& sha256,
                    std::uint64_t triangles) {
  json exact = json::array(), fragments = json::array();
  for (const exact::Point3& p : mesh.exact) {
    exact.push_back({exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())});
  }
  for (const OneFragment& f : mesh.fragments)
    fragments.push_back({{"corners", f.corners}, {"triangle", f.triangle}, {"side", side_name(f.front)}});
  const json out = {{"format", "clues-fragments/1"},
                    {"scene", {{"file", scene_file}, {"sha256", sha256}, {"triangles", triangles}}},
                    {"vertices", mesh.rounded},
                    {"vertices_exact", std::move(exact)},
                    {"fragments", std::move(fragments)}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace

void FragmentsRequest::add_to(CLI::App& command) {
  command
      .add_option("--fragments", file,
                  "With --cell: write the visible regions as triangles that share their corners: *.json (exact),\n"
                  "*.obj or *.ply (rounded)")
      ->type_name("FILE");
}

void require_good(const FragmentsRequest& request, bool many_cells) {
  if (request.file.empty()) return;
  if (many_cells) throw Error(ErrorCode::bad_argument, "--fragments is for one cell: use --cell, not --cells");
  const auto extension = fs::path(request.file).extension();
  if (extension != ".json" && extension != ".obj" && extension != ".ply")
    throw Error(ErrorCode::bad_argument, request.file + ": fragments are written as *.json, *.obj or *.ply");
  require_writable_parent(request.file);
}

FragmentsOutput make_fragments(const reference::VisibilityMap& map, const std::string& scene_path,
                               const std::string& scene_sha256, const FragmentsRequest& request) {
  const Sewn mesh = sewn_fragments(map);
  const auto extension = fs::path(request.file).extension();
  FragmentsOutput out;
  out.bytes = extension == ".obj" ? to_obj(mesh)
              : extension == ".ply"
                  ? to_ply(mesh)
                  : to_json(mesh, fs::path(scene_path).filename().string(), scene_sha256, map.complex.input_triangles);
  out.summary = fmt::format("fragments: {} triangles, {} corners\n", mesh.fragments.size(), mesh.exact.size());
  return out;
}

}  // namespace clues::app
