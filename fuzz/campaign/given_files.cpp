#include "fuzz/campaign/given_files.h"

#include <algorithm>

#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "validate/vectors/reader.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

constexpr std::size_t most_triangles = 40;

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files = validate::vector_files(folder);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw Error(ErrorCode::bad_argument,
                folder.string() + ": holds neither meshes (obj, off, ply, stl) nor vector files (json)");
  return files;
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

}  // namespace clues::fuzz
