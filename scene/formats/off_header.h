// What the text and the binary form of OFF have in common.
#pragma once

#include <string>
#include <string_view>

#include "scene/formats/place.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

// How many numbers of a vertex follow its coordinates (normal, colour, texture), by the keyword: 0 for OFF, 4 for COFF. Throws malformed, unsupported.
int off_extras(std::string_view keyword, const Place& place);

// "OFF BINARY" on the first line, or another variant of OFF.
bool is_binary_off(std::string_view bytes);
TriangleMesh read_binary_off(std::string_view bytes, const std::string& file);

}  // namespace clues::scene
