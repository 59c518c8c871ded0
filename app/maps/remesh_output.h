// Remeshes as files, with texture coordinates and colours where the input has them.
#pragma once

#include <string>

#include "reference/multires/carried.h"

namespace clues::app {

// By the name's extension: PLY, OBJ, OFF, glTF (.glb; .gltf with its bytes in it). Other extensions: Error unsupported.
void require_remesh_format(const std::string& file);
// Formats whose positions are floats: the remesh has to be made of such.
bool is_of_floats(const std::string& file);
// Throws Error unsupported where floats cannot hold a position of the mesh; then they may not hold one of its remesh.
void require_floats(const scene::TriangleMesh& mesh);

// PLY: colours of vertices, or else a colour for each base triangle; texture coordinates as the list texcoord of faces. OFF has neither. In glTF vertices
// are split where they have several texture coordinates, of which the second counts from above. Throws Error unsupported where floats cannot
// hold texture coordinates.
std::string remesh_to_file(const reference::Remesh& remesh, const scene::MeshAttributes& attributes,
                           const std::string& file);

}  // namespace clues::app
