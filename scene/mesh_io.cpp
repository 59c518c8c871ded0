// D1: a scene from a file; the format is chosen by the file's extension.
#include "scene/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/formats/file_bytes.h"
#include "scene/formats/readers.h"
#include "scene/messages/error.h"

namespace clues::scene {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

void require_triangles(const TriangleMesh& mesh, const std::filesystem::path& path) {
  if (mesh.triangles.empty())
    throw Error(ErrorCode::malformed, path.string() + ": no triangles; a scene needs at least one face");
}

TriangleMesh read_mesh_or_points(const std::filesystem::path& path) {
  const auto file = path.string();
  const auto bytes = read_file_bytes(path);
  const auto extension = lower_case_extension(path);
  const bool known = extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl";
  if (!known) {
    throw Error(ErrorCode::unsupported,
                file + ": the extension '" + extension + "' is not a known format; use .obj, .off, .ply or .stl");
  }
  if (bytes.empty()) throw Error(ErrorCode::malformed, file + ": the file is empty; export it again");
  if (extension == ".obj") return read_obj(bytes, file);
  if (extension == ".off") return read_off(bytes, file);
  if (extension == ".ply") return read_ply(bytes, file);
  return read_stl(bytes, file);
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  auto mesh = read_mesh_or_points(path);
  require_triangles(mesh, path);
  return mesh;
}

std::string to_off_text(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.points.size(), mesh.triangles.size());
  // fmt writes the shortest decimal that reads back as the same double.
  for (const auto& p : mesh.points) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

}  // namespace clues::scene
