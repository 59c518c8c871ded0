// The independent answers that tests compare with: CGAL's exact kernel, one triangle at a time, no tree, no filter of ours.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/predicates/filter.h"
#include "fuzz/generators/random.h"

namespace clues::fastpath {

// D5: the open segment meets the closed triangle (which has area).
bool oracle_meets(const Segment& s, const Corners& t);
// D3: ... in a point outside int V. Where along the segment that begins (an infimum); nullopt when it does not.
std::optional<exact::FT> oracle_first_block(const Segment& s, const Corners& t, const exact::ConvexCell* cell);

std::vector<std::uint32_t> oracle_all_hits(const Segment& s, const scene::TriangleMesh& mesh,
                                           const exact::ConvexCell* cell = nullptr);
std::optional<std::uint32_t> oracle_first_hit(const Segment& s, const scene::TriangleMesh& mesh,
                                              const exact::ConvexCell* cell = nullptr);

// Uniform in [-1,1), all 53 bits.
double random_double(fuzz::Random& random);
// x moved by `steps` representable numbers.
double stepped(double x, int steps);

// A segment that is aimed at a triangle of the mesh, at one of its corners, edges or its plane, exactly or a few units in the last place
// beside; or at random through the scene.
Segment aimed_segment(const scene::TriangleMesh& mesh, fuzz::Random& random);

scene::TriangleMesh moved(const scene::TriangleMesh& mesh, double factor, double offset);  // each coordinate rounded

}  // namespace clues::fastpath
