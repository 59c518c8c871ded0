// "clues-remesh 1": why a remesh is as near to its input as it is said to be (D34), as a text beside the mesh; docs/maps.md has every field. A common
// triangulation of input and remesh as that of D33 is of input and base domain, and for each piece an input triangle that its part of the
// remesh is near to.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::scene {

struct RemeshProof {
  double to_remesh = 0,
         to_input = 0;  // the bounds: no point of the input is farther from the remesh, none of that from the input
  std::vector<CarrierPoint> parameters;  // of each vertex of the remesh, on the base domain
  std::vector<Triangle> triangles;       // of the remesh, in the order of its file, over these vertices
  std::vector<OverlayVertex> points;     // sources on the input, images on the remesh
  std::vector<OverlayTriangle> pieces;   // oriented as both
  std::vector<std::uint32_t> near;       // of each piece: an input triangle
};

std::string to_text(const RemeshProof& proof);

// `input_vertices` and `input_triangles` are the sizes that indices are held against; those of the remesh are what the file says. Throws Error as
// parse_hierarchy.
RemeshProof parse_remesh_proof(std::string_view text, const std::string& file, std::size_t input_vertices,
                               std::size_t input_triangles);
RemeshProof read_remesh_proof(const std::filesystem::path& path, std::size_t input_vertices,
                              std::size_t input_triangles);

}  // namespace clues::scene
