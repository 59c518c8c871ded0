#include "fuzz/campaign/given_files.h"

#include <algorithm>

#include "scene/levels/bsp_scene.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "validate/vectors/reader.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

constexpr std::size_t most_triangles = 40;

bool is_a_mesh(const fs::path& file) {
  const auto extension = scene::lower_case_extension(file);
  return extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl";
}

bool is_a_level(const fs::path& file) {
  const auto extension = scene::lower_case_extension(file);
  return extension == ".bsp" || extension == ".gltf" || extension == ".glb" || is_a_mesh(file);
}

std::vector<fs::path> sorted_files(std::vector<fs::path> files, const fs::path& folder,
                                   bool (*is_wanted)(const fs::path&), const char* wanted) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_wanted(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw Error(ErrorCode::bad_argument, folder.string() + ": holds neither " + wanted);
  return files;
}

std::vector<fs::path> files_of(const fs::path& folder) {
  return sorted_files(validate::vector_files(folder), folder, is_a_mesh,
                      "meshes (obj, off, ply, stl) nor vector files (json)");
}

GivenLevel level_of(const fs::path& file) {
  GivenLevel given;
  given.name = file.filename().string();
  const auto level = scene::read_level(file);
  if (!level) {
    given.scene = scene::read_scene(file);
    return given;
  }
  given.scene = scene::scene_of_level(*level).scene;
  for (auto& leaf : scene::cells_of_level(*level)) {
    for (auto* cell : {&leaf.outer, &leaf.inner}) {
      if (!cell->empty()) given.cells.push_back(std::move(*cell));
    }
  }
  return given;
}

}  // namespace

GivenScenes read_given_scenes(const std::vector<std::string>& paths) {
  GivenScenes out;
  out.paths = paths;
  const auto keep = [&](GivenScene scene) {
    (scene.mesh.triangles.size() > most_triangles ? out.meshes : out.small).push_back(std::move(scene));
  };
  for (const fs::path path : paths) {
    for (const auto& file : fs::is_directory(path) ? files_of(path) : std::vector<fs::path>{path}) {
      if (file.extension() == ".json") {
        for (auto& c : validate::read_vector_file(file).cases) keep({c.id, std::move(c.mesh), std::move(c.cell)});
      } else {
        keep({file.filename().string(), scene::read_mesh(file), {}});
      }
      out.hashes += scene::sha256_of_file(file);
    }
  }
  return out;
}

GivenScenes read_given_levels(const std::vector<std::string>& paths) {
  GivenScenes out;
  out.paths = paths;
  for (const fs::path path : paths) {
    const auto files = fs::is_directory(path) ? sorted_files({}, path, is_a_level,
                                                             "levels (bsp) nor scenes (gltf, glb, obj, off, ply, stl)")
                                              : std::vector<fs::path>{path};
    for (const auto& file : files) {
      if (file.extension() == ".json")
        throw Error(ErrorCode::bad_argument,
                    file.string() + ": is no level; this subject takes levels (bsp), glTF scenes and meshes");
      out.levels.push_back(level_of(file));
      out.hashes += scene::sha256_of_scene(file);
    }
  }
  return out;
}

}  // namespace clues::fuzz
