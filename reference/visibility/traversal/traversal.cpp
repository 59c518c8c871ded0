#include "reference/visibility/traversal/traversal.h"

#include <algorithm>

#include "reference/visibility/traversal/darkness.h"
#include "reference/visibility/traversal/overlap.h"
#include "reference/visibility/traversal/spread.h"

namespace clues::reference {

namespace {

// What is mapped first.
void look_first(Spread& spread, const exact::Complex& complex, exact::Dials::FirstGuess guess,
                const std::vector<std::uint32_t>& seeds) {
  switch (guess) {
    case exact::Dials::FirstGuess::seen:
      return seeds.empty() ? spread.look_around() : spread.look_at(seeds);
    case exact::Dials::FirstGuess::nothing:
      return;
    case exact::Dials::FirstGuess::everything:
      for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) spread.visit(t);
  }
}

// Nothing has been seen yet: the surfaces nearest to the cell, one by one, until a sight line meets something.
void look_for_the_first(Spread& spread, const exact::SceneQuery& whole, std::vector<std::uint32_t> pieces) {
  const exact::Complex& complex = whole.complex();
  std::vector<double> distance(complex.pieces.size());
  const scene::Point center = exact::to_double_estimate(whole.cell().center());
  for (const std::uint32_t t : pieces) {
    const scene::Point p = exact::to_double_estimate(complex.points[complex.pieces[t].corners[0]]);
    for (std::size_t i = 0; i < 3; ++i) distance[t] += (p[i] - center[i]) * (p[i] - center[i]);
  }
  std::sort(pieces.begin(), pieces.end(),
            [&](auto s, auto t) { return std::pair(distance[s], s) < std::pair(distance[t], t); });
  for (const std::uint32_t t : pieces) {
    spread.look_at({t});
    if (spread.anything_seen()) return;
  }
}

// The surfaces at every visible edge and corner.
void visit_around(Spread& spread, const exact::Complex& complex, const Fixpoint& fixpoint) {
  for (const std::uint32_t e : fixpoint.lit_edges) {
    for (const std::uint32_t t : complex.edges[e].pieces) spread.visit(t);
  }
  for (const std::uint32_t p : fixpoint.lit_points) {
    for (const std::uint32_t t : complex.point_pieces[p]) spread.visit(t);
  }
}

// The work of all passes, but the wedges of the last.
void carry_over(Statistics& all, const Statistics& last) {
  const Statistics before = all;
  all = last;
  all.refined_triangles = before.refined_triangles;
  all.walks += before.walks;
  all.rounds += before.rounds;
  all.wedges_built += before.wedges_built;
  all.sight_lines = before.sight_lines;
  all.shaft_tests = before.shaft_tests;
  all.passes = before.passes;
  all.by_order = before.by_order;
  all.cycles = before.cycles;
  all.clusters = before.clusters;
}

}  // namespace

exact::Complex part_of(const exact::Complex& complex, const std::vector<bool>& occluders) {
  exact::Complex part = complex;
  const auto keep = [&](std::vector<std::uint32_t>& pieces) {
    std::erase_if(pieces, [&](std::uint32_t t) { return !occluders[t]; });
  };
  for (exact::Edge& e : part.edges) keep(e.pieces);
  for (auto& pieces : part.point_pieces) keep(pieces);
  for (auto& edges : part.point_edges) {
    std::erase_if(edges, [&](std::uint32_t e) { return part.edges[e].pieces.empty(); });
  }
  return part;
}

Traversal traverse(const exact::SceneQuery& whole, const Options& options, Statistics& statistics,
                   const std::vector<std::uint32_t>& seeds) {
  const exact::Complex& complex = whole.complex();
  const Darkness darkness(complex);
  Spread spread(whole, statistics, options.dials.sight_rays);
  look_first(spread, complex, options.dials.first_guess, seeds);
  for (;;) {
    ++statistics.passes;
    const std::vector<bool> visited = spread.visited();
    auto part = std::make_unique<exact::Complex>(part_of(complex, visited));
    auto scene = std::make_unique<exact::SceneQuery>(*part, whole.cell(), visited);
    Statistics of_pass;
    Fixpoint fixpoint = find_wedges(*scene, options, of_pass);
    carry_over(statistics, of_pass);

    visit_around(spread, complex, fixpoint);
    const Walker walker(*scene, options.dials.longest_walk);
    std::vector<std::uint32_t> lit =
        darkness.not_dark(*scene, walker, fixpoint, spread.visited(), statistics.shaft_tests);
    if (options.dials.batch > 0) lit.resize(std::min(lit.size(), options.dials.batch));
    if (lit.empty() && spread.visited() == visited) {
      statistics.surfaces_visited = static_cast<std::uint64_t>(std::count(visited.begin(), visited.end(), true));
      statistics.surfaces_seen = spread.seen_count();
      return {std::move(part), std::move(scene), std::move(fixpoint), visited};
    }
    const std::vector<bool> before = spread.visited();
    if (spread.anything_seen()) {
      spread.look_at(lit);
    } else {
      look_for_the_first(spread, whole, lit);
    }
    if (lit.empty() || spread.visited() != before) continue;
    ++statistics.by_order;  // all suspended
    const OverlapGraph graph = overlap_of_pieces(whole, lit);
    const Front front = pieces_in_front(whole, graph);
    statistics.cycles += front.cycles;
    statistics.clusters += front.clusters;
    for (const std::uint32_t t : front.pieces) spread.visit_with_neighbours(t);
  }
}

}  // namespace clues::reference
