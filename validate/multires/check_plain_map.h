// The judge of anybody's map: an input mesh, a base mesh, and for each vertex of the input a base triangle with coordinates in it. What such a
// file does not say is how edges that cross the base run. So single places are refuted (a flipped triangle, two vertices in one place, a
// boundary within the base), and a map is proved only where every input triangle lies in one base triangle; else it stays undecided, and
// the number of triangles says how much.
#pragma once

#include <string>
#include <vector>

#include "scene/multires/hierarchy_file.h"
#include "validate/multires/check_hierarchy.h"

namespace clues::validate {

enum class PlainVerdict : std::uint8_t { proved, refuted, undecided };

struct PlainMapReport {
  std::vector<MapFinding> findings;  // at most 20 of each check
  std::map<std::string, std::uint64_t> counts;
  std::uint64_t vertices = 0, triangles = 0, base_triangles = 0;
  std::uint64_t judged = 0, flipped = 0, spread = 0;  // spread: over several base triangles
  PlainVerdict verdict = PlainVerdict::undecided;
};

// Throws Error malformed where lines and vertices do not correspond or a coordinate is no number.
PlainMapReport check_plain_map(const scene::TriangleMesh& input, const scene::TriangleMesh& base,
                               const std::vector<scene::PlainMapLine>& lines, const std::string& file);

std::string to_text(const PlainMapReport& report);
std::string to_json_text(const PlainMapReport& report);  // "clues-plain-map-verdict/1"

}  // namespace clues::validate
