// D31: what a hierarchy can be made of. A surface is a finite set of triangles, each of three different vertices, no two of the same
// three; an edge belongs to one triangle or to two that run through it in opposite directions; and the triangles at a vertex form
// one fan, open (a boundary vertex) or closed. It may have several components, any genus and any number of boundaries. Where its
// vertices lie is never asked: degenerate triangles and self-intersections are no obstacle to a map.
#pragma once

#include <cstdint>
#include <string>

#include "scene/mesh/mesh.h"

namespace clues::reference {

struct SurfaceCensus {
  std::uint64_t vertices = 0, edges = 0, triangles = 0, components = 0;
  std::uint64_t boundaries = 0;  // loops
  std::int64_t euler() const {
    return static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(edges) +
           static_cast<std::int64_t>(triangles);
  }
  // Handles, of all components together: chi = 2 components - 2 genus - boundaries.
  std::int64_t genus() const {
    return (2 * static_cast<std::int64_t>(components) - static_cast<std::int64_t>(boundaries) - euler()) / 2;
  }
};

// Throws Error unsupported with the first defect: triangles before edges before vertices, each by number. `name` begins the
// message. O(n log n).
SurfaceCensus checked_surface(const scene::TriangleMesh& mesh, const std::string& name);

}  // namespace clues::reference
