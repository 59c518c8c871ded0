// The files of motion bounds: depth meshes, bounds, walks, ways of viewpoints. Which of them the bytes are is for their first line to say.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fuzz/targets/promises.h"
#include "scene/files/atomic_file.h"
#include "scene/files/temporary_folder.h"
#include "scene/motion/motion_files.h"
#include "scene/motion/view_path.h"
#include "scene/motion/walk_file.h"

namespace clues::fuzz {
namespace {

using scene::DepthMesh;

void check(const DepthMesh& mesh) {
  for (const auto& sample : mesh.samples) {
    for (const double x : sample.at) require(std::isfinite(x), "coordinates are finite");
  }
  for (const auto& t : mesh.triangles) {
    for (const auto corner : t) require(corner < mesh.samples.size(), "every corner is a sample");
    require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "a triangle has three samples");
  }
}

bool same(const DepthMesh& a, const DepthMesh& b) {
  return a.triangles == b.triangles && std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(),
                                                  b.samples.end(), [](const auto& x, const auto& y) {
                                                    return x.at == y.at && x.is_direction == y.is_direction &&
                                                           x.is_base == y.is_base;
                                                  });
}

void walk(const std::filesystem::path& file, const std::filesystem::path& again) {
  scene::WalkReader reader(file);
  scene::WalkWriter writer;
  scene::WalkFrame frame;
  std::vector<scene::WalkFrame> frames;
  std::string text = scene::WalkWriter::header();
  while (reader.next(frame)) {
    check(frame.mesh);
    text += writer.frame(frame.mesh, frame.viewpoint, frame.thresholds);
    frames.push_back(frame);
  }
  scene::write_file_atomically(again, text);
  scene::WalkReader second(again);
  for (const auto& first : frames) {
    require(second.next(frame) && same(frame.mesh, first.mesh) && frame.viewpoint == first.viewpoint,
            "a walk survives being written");
  }
  require(!second.next(frame), "no frame is added");
}

void way(const std::filesystem::path& file, const std::filesystem::path& again) {
  const auto points = scene::read_view_path(file.string(), std::nullopt);
  require(!points.empty(), "a way has a viewpoint");
  std::string text;
  for (const auto& p : points) {
    for (const double x : p) require(std::isfinite(x), "viewpoints are finite");
    text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  }
  scene::write_file_atomically(again, text);
  require(scene::read_view_path(again.string(), std::nullopt) == points, "a way survives being written");
}

}  // namespace

bool motion_files(std::string_view bytes) {
  const scene::TemporaryFolder folder;
  const auto file = folder.file("file"), again = folder.file("again");
  scene::write_file_atomically(file, bytes);
  const std::string_view first = bytes.substr(0, bytes.find('\n'));
  const auto names = [&](std::string_view format) { return first.find(format) != std::string_view::npos; };
  return accepted([&] {
    if (names("clues-motion-walk/")) {
      walk(file, again);
    } else if (names("clues-depth-mesh/")) {
      const auto mesh = scene::read_depth_mesh(file);
      check(mesh);
      scene::write_file_atomically(again, scene::to_json_text(mesh));
      require(same(scene::read_depth_mesh(again), mesh), "a depth mesh survives being written");
    } else if (names("clues-motion-bounds/")) {
      const auto bounds = scene::read_motion_bounds(file);
      for (const double b : bounds.bounds) require(b >= 0, "a bound is a distance");
      const auto text = scene::to_json_text(bounds);
      scene::write_file_atomically(again, text);
      require(scene::to_json_text(scene::read_motion_bounds(again)) == text, "bounds survive being written");
    } else {
      way(file, again);
    }
  });
}

}  // namespace clues::fuzz
