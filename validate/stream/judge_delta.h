// D24, judged from files alone: is a transition what the maps of its two cells say it is? Shares nothing with the code
// that makes transitions: borders are compared in plain rationals (boundary_chain.h).
//
// What is asked, of each side of each triangle of the scene:
//   (a) the lists of the two cells are those of the maps, and the packets their differences;
//   (b) every fragment is a triangle in the plane of its input triangle that turns as its side does;
//   (c) all fragments of a side together have the border of the triangle, so each point has one label (boundary_chain.h);
//   (d) those labelled `from` and `both` together have the border of VM(from), those labelled `to` and `both` that of
//       VM(to);
//   (e) a triangle that has a visible region in a map, or a fragment seen from an end, is in the list of that end;
//   (f) the doubles of the vertices are roundings of the exact ones: no double lies between the two.
// A side of which neither map shows anything may be left without fragments.
// Then VM(from) without DR_O and with DR_E is VM(to), point for point, and |VM(to)| - |VM(from)| = |DR_E| - |DR_O|.
#pragma once

#include <string>
#include <vector>

#include "scene/mesh/mesh.h"
#include "validate/stream/delta_file.h"

namespace clues::validate {

struct DeltaFinding {
  std::string what;  // one line
};

struct DeltaVerdict {
  std::vector<DeltaFinding> findings;  // none: it is right
  std::uint64_t sides = 0;             // that were compared; 0 without fragments
  // Areas of VM(from), VM(to), DR_E and DR_O, in parts of the area of their triangle, added up over all sides.
  Rational from = 0, to = 0, exposed = 0, occluded = 0;
};

// The two maps are of the same scene, in the same mode. O(n log n).
DeltaVerdict judge_delta(const scene::TriangleMesh& mesh, const DeltaRecord& delta, const MapFile& from,
                         const MapFile& to);

// D24: back from B to A what was newly visible is newly hidden, region for region. Both transitions have fragments.
std::vector<DeltaFinding> judge_reverse(const DeltaRecord& there, const DeltaRecord& back);

}  // namespace clues::validate
