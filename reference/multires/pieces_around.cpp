#include "reference/multires/pieces_around.h"

#include "scene/messages/error.h"
#include "scene/multires/image_triangles.h"

namespace clues::reference {

std::vector<std::uint32_t> base_triangles(const scene::Hierarchy& hierarchy) {
  const scene::ImageTriangles image(hierarchy.base);
  std::vector<std::uint32_t> out;
  for (const auto& piece : hierarchy.pieces) {
    out.push_back(image.of(piece, hierarchy.points));
    if (out.back() == scene::no_vertex)
      throw scene::Error(scene::ErrorCode::bad_argument, "remesh: the hierarchy is not a verified one");
  }
  return out;
}

PiecesAround::PiecesAround(const scene::Hierarchy& hierarchy)
    : base(base_triangles(hierarchy)), pieces(hierarchy.points.size()) {
  for (std::uint32_t i = 0; i < hierarchy.pieces.size(); ++i) {
    for (const std::uint32_t p : hierarchy.pieces[i].corners) pieces[p].push_back(i);
  }
}

}  // namespace clues::reference
