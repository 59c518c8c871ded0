// "clues-maps 1": a hierarchy as a text that any program can read and write, a list a line; docs/maps.md has every field. Doubles are written with as
// few digits as give the same double back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/multires/hierarchy.h"

namespace clues::scene {

std::string to_text(const Hierarchy& hierarchy);

// Whether a text begins as such a file does.
bool is_hierarchy_text(std::string_view text);

// Shapes and index ranges are checked, nothing else: whether it is right is for clues maps verify. Throws Error as read_file_bytes, malformed,
// non_finite, index_out_of_range with file and line. O(size).
Hierarchy parse_hierarchy(std::string_view text, const std::string& file);
Hierarchy read_hierarchy(const std::filesystem::path& path);

// A map of another program, one line for each vertex of its input: the number of a base triangle (from 0) and two or three
// coordinates in it, decimal, hex or p/q; the third, if left out, is what is missing to 1.
struct PlainMapLine {
  std::uint32_t triangle = 0;
  std::array<std::string, 3> weights;  // as written; the last may be empty
};
std::vector<PlainMapLine> read_plain_map(const std::filesystem::path& path);

}  // namespace clues::scene
