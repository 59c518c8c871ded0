// D19, the basic judge: is a PVS sound for a scene and a cell, and where it lists too much, how much? It believes nobody: a triangle
// counts as visible only with a sight line that exact/sight/witness.h has confirmed (or when it meets the cell, D3), and as hidden
// only by the exact first-order map (T1). What lies between is `undecided`, never `sound`.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"
#include "validate/certificates/chain.h"

namespace clues::validate {

// Proof that a triangle is visible: the open segment (v, p) is free (D5, D6).
struct Witness {
  std::uint32_t triangle = 0;
  bool front = true;  // p is seen on this side
  exact::Point3 v;    // in int V
  exact::Point3 p;    // in the relative interior of the triangle
};

enum class TriangleVerdict {
  // not listed
  hidden,             // rightly so: no region in Omega (T1)
  missing_undecided,  // in Omega, but no witness was found
  missing_visible,    // visible: the PVS is unsound
  // listed
  exact,        // visible
  first_order,  // in Omega, but no witness was found (or there is none: Judgement::proved_hidden)
  loose,        // not even in Omega
};

enum class Verdict { sound, undecided, unsound };

struct Judgement {
  Verdict verdict = Verdict::undecided;
  std::vector<TriangleVerdict> triangles;  // per input triangle
  std::vector<Witness> witnesses;          // of visible triangles, ascending by triangle
  std::vector<std::uint32_t> meet_cell;    // visible without a witness (D3), ascending
  std::uint64_t missing_visible = 0, missing_undecided = 0;
  std::uint64_t exact = 0, first_order = 0, loose = 0;
  std::vector<Chain>
      chains;  // of triangles in Omega without a witness, ascending by triangle; filled in by who wants them (chain_search.h)
  std::vector<std::uint32_t> proved_hidden;  // of those in Omega without a witness, by settle.h; ascending
  // Hidden by the map, and yet with a confirmed witness: the reference is wrong. Must stay empty.
  std::vector<Witness> contradictions;
};

struct JudgeOptions {
  std::size_t points_per_region = 12;  // places on each visible region of a triangle without a witness so far
  // Whether one point of each hidden region is put to the oracle too, and light is looked for on hidden triangles past
  // what blocks (light_search.h), so that a wrong map is noticed.
  bool cross_check = true;
  std::vector<std::uint32_t> only;  // not empty: only these triangles (ascending) are judged, the others left `hidden`
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

// `map` is the first-order map of `mesh` for its cell; `pvs` is ascending, ids below the number of triangles. At most
// points_per_region oracle calls per visible region; far fewer where the first sight lines are free.
Judgement judge_pvs(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map,
                    const std::vector<std::uint32_t>& pvs, const JudgeOptions& options = {});

// D7, D19: by the counters of missing triangles.
Verdict verdict_of(const Judgement& judgement);

// The triangles in Omega without a witness, ascending.
std::vector<std::uint32_t> undecided(const Judgement& judgement);

}  // namespace clues::validate
