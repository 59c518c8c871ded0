// D1, D22 from glTF 2.0. Triangles get their ids in the order of a walk through the default scene (the first one where none is named; all nodes
// without a parent where the file has no scenes): a node, the primitives of its mesh, then its children. Lists, strips and fans, with
// indices or without. Positions are moved by the product of the matrices, in doubles; a mirror turns the triangles around, so that fronts stay fronts.
//
// A primitive counts, and blocks unless something says that it may be seen through, may move or may not be drawn: alphaMode MASK or BLEND, a
// transmission, in any of its variants (KHR_materials_variants); a skin, morph targets; an animation of its material, of its node or of one above it; such a node that
// is switched off (KHR_node_visibility) or has levels of detail (MSFT_lod). Whether a material has two sides says nothing: a triangle is a thin screen (D3).
#pragma once

#include <string>
#include <string_view>

#include "scene/gltf/gltf_document.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::scene {

// Names in FlaggedMesh::parts: "node 3 (wall) / mesh 1 (bricks) / primitive 0". Points and lines are left out with a warning. Throws Error. May have no
// triangles. O(size of the file and of what its instances make).
FlaggedMesh read_gltf(std::string_view bytes, const std::string& file, const BufferLoader& load);

}  // namespace clues::scene
