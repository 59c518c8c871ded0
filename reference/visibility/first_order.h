// First-order CLUES (D8-D17a): from a scene and a convex view cell to the exact visibility map. This is the door; the
// ideas live one to a file beside it: contour.h (D10, D11), anticone.h (D12), on_wedge.h and valid_pieces.h (D13),
// walk.h (D14), fixpoint.h (D17, D17a), regions.h (D15).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "exact/complex.h"
#include "exact/convex_cell.h"
#include "exact/dials.h"
#include "exact/kernel.h"
#include "exact/scene_query.h"
#include "exact/standard_range.h"
#include "reference/visibility/wedge.h"
#include "scene/cell_spec.h"
#include "scene/mesh.h"
#include "scene/result.h"

namespace clues::reference {

enum class Mode { sheet, solid };  // D4

// Two ways to one map. plain looks at the whole scene at once; traversal (traversal/traversal.h) goes outward from what is visible and
// never looks at what is hidden behind what it has met, beyond asking whether it is dark.
enum class Formulation { plain, traversal };

// Told from time to time; stages "refine", "wedges", "regions". Called from one thread at a time.
using Progress = std::function<void(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

// The planted bugs of the tests of the tests. A user never sets one.
enum class PlantedBug { none, wrong_wedge_side, retested_csv, no_rule_3, rounded_comparison };

struct Options {
  Mode mode = Mode::sheet;
  Formulation formulation = Formulation::plain;
  int threads = 0;  // 0: as many as the machine has; the result does not depend on it
  bool check_two_walks =
      true;  // D14: walk twice, from two independent v, and count disagreements (a debug build stops at one)
  Progress progress;
  PlantedBug planted_bug = PlantedBug::none;
  exact::Dials dials;  // the limits of D17, and what else only tests turn
};

// One face of the arrangement of DM segments on one side of one piece of the complex (D15).
struct Region {
  std::uint32_t piece = 0;
  bool front = true;     // side of the piece (the origins say what that is for the input triangles)
  bool visible = false;  // label (D14)
  std::vector<std::vector<exact::Point3>> rings;  // outer boundary first, then holes
  exact::FT area_fraction;                        // of the piece's own area, exactly
  exact::Point3 sample;                           // the interior point whose label this is
};

struct DmSegment {
  std::uint32_t piece = 0;
  bool front = true;
  bool boundary = false;  // labels differ on its two sides: an OB segment
  exact::Point3 a, b;
};

struct Statistics {
  std::uint64_t sv_me = 0, se_me = 0, se_mv = 0;  // wedges with a valid piece
  std::uint64_t csv = 0;                          // compound silhouette vertices made
  std::uint64_t inside_corners = 0;               // SE-MV wedges at mesh vertices
  int generations = 0;                            // highest generation of a wedge
  std::uint64_t parallel_edges = 0;  // contour edges whose supporting plane touches V along an edge or facet
  std::uint64_t refined_triangles = 0;
  std::uint64_t regions_visible = 0, regions_hidden = 0;
  std::uint64_t walks = 0;
  std::uint64_t walk_disagreements = 0;  // D14; must stay 0
  std::uint64_t rounds = 0;
  std::uint64_t conservative_fallbacks = 0;  // D17
  std::uint64_t wedges_built = 0;            // wedges whose valid part was looked for
  // Of the traversal alone:
  std::uint64_t surfaces_visited = 0;  // pieces that blocked anything, of all passes
  std::uint64_t surfaces_seen = 0;     // those of them that a sight line reached
  std::uint64_t sight_lines = 0;
  std::uint64_t shaft_tests = 0;  // boxes and surfaces asked for whether they are dark
  std::uint64_t passes = 0;
  std::uint64_t by_order = 0;  // passes in which no sight line helped, and the overlap order decided
  std::uint64_t cycles = 0;    // overlap cycles met by it
  std::uint64_t clusters = 0;  // those that trimming did not break
};

// What Omega and Bounds hold is in the standard range of the scene (exact/standard_range.h): `range` leads
// back from there. What first_order_visibility returns is in the coordinates of the scene.
struct VisibilityMap {
  exact::Complex complex;
  exact::ConvexCell cell;
  Mode mode = Mode::sheet;
  Formulation formulation = Formulation::plain;
  std::vector<Wedge> wedges;  // the valid pieces
  std::vector<DmSegment> segments;
  std::vector<Region> regions;         // by piece, front before back
  std::vector<std::uint32_t> visible;  // the PVS: input triangle ids, ascending
  Statistics statistics;
  std::string method = "first-order";  // or how it was refined (D20, D21)
  exact::StandardRange range = {};
};

// Throws scene::Error not_solid when mode is solid and the mesh is not closed and consistently oriented;
// unsupported as StandardRange does.
VisibilityMap first_order_visibility(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                     const Options& options);

// The same map in the coordinates of the scene, exactly.
VisibilityMap moved_back(VisibilityMap map);

// The sides of the pieces of a complex, numbered.
inline std::size_t side_index(std::uint32_t piece, bool front) { return 2 * std::size_t{piece} + (front ? 0 : 1); }

// The map of a cell, or of a part of it, in a complex that was cut for the whole cell: what lies in the whole cell does not occlude,
// also where it is outside the part (D21). Regions only of the sides wanted (per side_index; empty: all); the mode is not checked against the mesh.
VisibilityMap first_order_visibility_in(const exact::Complex& complex, const exact::ConvexCell& cell,
                                        const Options& options, const std::vector<bool>& wanted = {});

// D15: the PVS by the map's regions. D3: a triangle that meets the cell is visible.
void find_visible(const exact::SceneQuery& scene, VisibilityMap& map);

// The result file's contents, in the coordinates of the scene; scene_file and scene_sha256 are left to the
// caller. with_map adds regions, segments and wedges.
// With render_states its regions carry those too (render_states.h).
scene::Result to_result(const VisibilityMap& map, const scene::CellSpec& cell, bool with_map,
                        bool with_render_states = false);

}  // namespace clues::reference
