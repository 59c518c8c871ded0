// D6 decided exactly: which triangles of a small scene are visible from a cell, with a proof either way. docs/visible-set.md has the method
// and why it is complete. Meant for up to about 60 triangles: the work grows with triangles x edges x crossings of shadows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

enum class Sight {
  visible,
  hidden,
  no_surface,  // a degenerate triangle
  undecided,   // the window limit was reached
};

struct TriangleSight {
  Sight sight = Sight::hidden;
  bool meets_cell = false;         // visible by D3
  std::optional<Witness> witness;  // visible otherwise; confirmed by exact::check_witness
  enum class Proof { none, meets_cell, witness, first_order_map, exhaustive } proof = Proof::none;
};

struct VisibleSetOptions {
  reference::Mode mode = reference::Mode::sheet;
  std::uint64_t window_limit = 0;  // windows per triangle; 0: none
  bool trust_map =
      true;  // see docs/visible-set.md, section 5; false: hidden triangles are proved hidden without the first-order map
  std::vector<std::uint32_t> only;  // ascending: decides these and leaves the others undecided; empty: all
  bool points_first = true;         // false: sweep the edges before asking single points; slower, for the tests
};

struct VisibleSetStatistics {
  std::uint64_t edges = 0;            // that can bound free sight lines, of the scene
  std::uint64_t edges_swept = 0;      // summed over sides of triangles
  std::uint64_t windows = 0;          // decided, at one place each
  std::uint64_t events = 0;           // ranges between them that began or ended at a critical place
  std::uint64_t point_questions = 0;  // whole cells seen from one point
  std::uint64_t found_by_point = 0;   // visible triangles by how their witness was found
  std::uint64_t found_by_edge = 0;
  std::uint64_t hidden_exhaustive = 0, hidden_by_map = 0;
};

struct VisibleSet {
  std::vector<TriangleSight> triangles;  // per input triangle
  VisibleSetStatistics statistics;
};

// Throws scene::Error not_solid as first_order_visibility does, and internal if a free line found fails the witness check.
VisibleSet exact_visible_set(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                             const VisibleSetOptions& options = {});

}  // namespace clues::validate
