// The judge of a hierarchy file (E1 to E6; E7 is in check_remesh.h): everything it says is recomputed from the file alone, in rationals or whole numbers of any length.
// Shares no code with what makes hierarchies.
//
//   E1 every level is a surface with boundary; Euler number and boundaries stay as they are (on OpenMesh's half-edge mesh)
//   E2 what a level removes is independent, below degree 12 and not fixed; who stays is blocked, or has a reason that holds; no other has one
//   E3 every flattened star is embedded, and its new triangles fill the same polygon
//   E4 weights are positive and sum to 1 exactly, over vertices of one triangle
//   E5 Pi of every vertex, recomputed step by step
//   E6 the overlay: every piece turned right on both sides, edges of pieces paired, areas 1 in every triangle of the input and of the base;
//      every point is a corner of a piece
//
// E6 alone proves that the overlay's map is a homeomorphism; E1 to E5 say how it came about.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::validate {

struct MapFinding {
  std::string check;  // "E1"
  std::string what;   // where, and what is wrong
};

struct LevelRow {
  std::int64_t vertices = 0, triangles = 0, euler = 0, boundaries = 0;  // before the level
  std::uint64_t removed = 0, blocked = 0, high = 0, fixed = 0;
  std::uint64_t kept_link = 0, kept_flat = 0, kept_numbers = 0;
};

struct RemeshRow {
  std::uint64_t vertices = 0, triangles = 0, pieces = 0;
  double to_remesh = 0, to_input = 0;  // the bounds that were judged
};

struct HierarchyReport {
  std::vector<MapFinding> findings;  // at most 20 of each check; `counts` has all
  std::map<std::string, std::uint64_t> counts;
  std::vector<LevelRow> levels;  // and the base domain at the end
  std::uint64_t input_triangles = 0, base_triangles = 0, points = 0, pieces = 0;
  // The map that is linear on input triangles and has the same vertex images: no claim of the file, but what others would draw.
  std::uint64_t linear_flips = 0, linear_judged = 0;
  std::optional<RemeshRow> remesh;  // of E7, where there is one

  bool sound() const { return counts.empty(); }
  void find(const std::string& check, const std::string& what);
};

// O(n log n).
HierarchyReport check_hierarchy(const scene::Hierarchy& hierarchy);

std::string to_text(const HierarchyReport& report);
std::string to_json_text(const HierarchyReport& report);  // "clues-maps-verdict/1"

// Parts of it.
void check_levels(const scene::Hierarchy& hierarchy, HierarchyReport& report);   // E1, E2, E3, E5
void check_overlay(const scene::Hierarchy& hierarchy, HierarchyReport& report);  // E4, E6

}  // namespace clues::validate
