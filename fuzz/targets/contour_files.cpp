// Files of contours and of lists (D26), without the hash in their end. What is accepted is decoded in a small scene, contours
// exactly and in doubles: a label that makes no point there is refused, and anything else is decoded to something. Lists
// lie in those around them.
#include <algorithm>
#include <array>
#include <functional>

#include "fastpath/contours/contour_decoder.h"
#include "fuzz/targets/promises.h"
#include "reference/contours/contour_code.h"
#include "reference/streams/list_store.h"
#include "scene/stream/contour_file.h"
#include "scene/stream/list_file.h"

namespace clues::fuzz {
namespace {

// A wall, a screen before it, a small triangle behind the screen, and one off to the side.
scene::TriangleMesh town() {
  scene::TriangleMesh mesh;
  mesh.points = {{-19, -19, 6},    {21, -19, 6},     {21, 21, 6},    {-19, 21, 6}, {-5, -3, 4}, {7, -3, 4}, {1, 9, 4},
                 {0.5, 0.5, 4.25}, {1.5, 0.5, 4.25}, {1, 1.5, 4.25}, {10, 1, 4},   {11, 1, 4},  {10, 2, 4}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 12, 11}};
  mesh.face_of = {0, 1, 2, 3, 4};
  return mesh;
}

// Arrangements of many lines take long and show no more.
bool is_small(const scene::ContourFile& file) {
  std::size_t drawn = 0, digits = 0;
  for (const auto& cell : file.cells) {
    drawn += cell.planes.size() + cell.seeds.size();
    for (const auto& side : cell.sides) {
      drawn += side.points.size() + side.segments.size() + side.bridges.size() + side.blocks.size();
      for (const auto& point : side.points) {
        for (const auto& x : point.at) digits += x.size();
      }
    }
  }
  return file.cells.size() <= 16 && drawn <= 200 && digits <= 1000;
}

void decode(const scene::ContourFile& file) {
  const auto mesh = town();
  const auto sides =
      reference::input_sides(mesh, file.mode == "solid" ? reference::Mode::solid : reference::Mode::sheet);
  const fastpath::ContourDecoder decoder(mesh);
  for (std::uint32_t c = 0; c < file.cells.size(); ++c) {
    accepted([&] {
      const auto sets = reference::decoded_map(sides, mesh, file, c);
      const auto list = reference::list_of(sides, sets, file.cells[c].besides);
      require(list.empty() || list.back() < mesh.triangles.size(), "every id is a triangle");
    });
    accepted([&] {
      const auto decoding = decoder.decode(file, c);
      require(decoding.list.empty() || decoding.list.back() < mesh.triangles.size(), "every id is a triangle");
      for (const auto& region : decoding.regions) region.may_hold({1, 1, 4});
    });
  }
}

}  // namespace

bool contour_files(std::string_view bytes) {
  return accepted([&] {
    const auto file = scene::parse_unsealed_contours(bytes, "file");
    const std::string sealed = scene::to_bytes(file);
    require(sealed.starts_with(bytes), "a file has one form");
    require(scene::parse_contours(sealed, "again") == file, "a file survives being written");
    if (file.scene_points == 13 && file.scene_triangles == 5 && is_small(file)) decode(file);
  });
}

bool list_files(std::string_view bytes) {
  return accepted([&] {
    const auto file = scene::parse_unsealed_lists(bytes, "file");
    const std::string sealed = scene::to_bytes(file);
    require(sealed.starts_with(bytes), "a file has one form");
    require(scene::parse_lists(sealed, "again") == file, "a file survives being written");
    const auto mesh = town();
    const auto decoded = reference::decoded_levels(reference::EdgeUsers(mesh), file.levels);
    for (std::size_t i = 0; i < decoded.size(); ++i) {
      for (std::size_t n = 0; n < decoded[i].size(); ++n) {
        const auto& list = decoded[i][n];
        require(std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end(), "ids ascend");
        require(list.empty() || list.back() < mesh.triangles.size(), "every id is a triangle");
        if (i == 0) continue;
        const auto& around = decoded[i - 1][file.levels[i][n].within];
        require(std::includes(around.begin(), around.end(), list.begin(), list.end()), "a list lies in that around it");
      }
    }
  });
}

}  // namespace clues::fuzz
