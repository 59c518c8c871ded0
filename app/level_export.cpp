#include "app/level_export.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>

#include "app/common.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/result.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) scene::fail_unwritable(path, "cannot write", errno != 0 ? errno : EIO);
}

std::string scene_text(const scene::TriangleMesh& mesh) {
  std::string text = points_text(mesh.points);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

std::string flags_text(const scene::FlaggedMesh& scene) {
  std::string text = "# triangle blocks counts part\n";
  std::size_t part = 0;
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    while (part + 1 < scene.parts.size() && scene.parts[part + 1].first_triangle <= t) ++part;
    text += fmt::format("{} {:d} {:d} {}\n", t, scene.blocking(t), scene.counting(t),
                        scene::printable(scene.parts[part].name));
  }
  return text;
}

}  // namespace

void export_level(const fs::path& folder, const scene::BspFile& level, const scene::LevelScene& scene,
                  const std::vector<scene::LevelCell>& cells, const std::string& about) {
  make_empty_folder(folder);
  make_folder(folder / "cells");
  make_folder(folder / "pvs");
  write(folder / "scene.obj", scene_text(scene.scene.mesh));
  write(folder / "flags.txt", flags_text(scene.scene));
  std::string list = "# leaf cluster\n";
  for (const auto& cell : cells) {
    list += fmt::format("{} {}\n", cell.leaf, cell.cluster);
    if (!cell.inner.empty()) write(folder / "cells" / fmt::format("{}.in.obj", cell.leaf), points_text(cell.inner));
    if (!cell.outer.empty()) write(folder / "cells" / fmt::format("{}.out.obj", cell.leaf), points_text(cell.outer));
  }
  write(folder / "cells.txt", list);
  for (std::uint32_t cluster = 0; cluster < level.visibility.clusters; ++cluster) {
    write(folder / "pvs" / fmt::format("{}.txt", cluster),
          scene::to_pvs_text(scene::shipped_set(level, scene, cluster)));
  }
  scene::write_file_atomically(folder / "level.json", about);
}

}  // namespace clues::app
