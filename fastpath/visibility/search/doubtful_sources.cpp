#include "fastpath/visibility/search/doubtful_sources.h"

#include <algorithm>
#include <utility>

namespace clues::fastpath {

std::vector<DoubtfulSources::Placed> DoubtfulSources::placed() const {
  std::vector<Placed> found;
  for (const Sources::OfEdge& s : sources_.of_edges()) {
    if (s.beside)
      found.push_back({s.part.lo, s.part.hi, s.part.y, s.beside, &s.walk, &contours_[s.contour], 0, {}, false});
  }
  for (const Sources::OfVertex& s : sources_.of_vertices()) {
    const ExactPoint* x = &scene_.points[s.point];
    if (s.walk.end != Walk::End::unresolved) found.push_back({x, x, x, s.beside, &s.walk, nullptr, s.point, {}, false});
  }
  for (Placed& s : found) {
    s.around = hull(hull(s.lo->approximate(), s.hi->approximate()), hull(s.y->approximate(), s.beside->approximate()));
    s.walk->all_ways_aside([&](const IntervalBox& from, const IntervalBox& to) {
      s.around = hull(s.around, hull(from, to));
      return true;
    });
  }
  return found;
}

DoubtfulSources::Doubt DoubtfulSources::doubt_of(const Placed& s, std::size_t i) const {
  const bool place_misses =
      left_out_.surely_misses(i, s.y->approximate(), s.beside->approximate()) && keeps_out(*s.walk, left_out_, i);
  if (place_misses && left_out_.surely_misses(i, s.lo->approximate(), s.hi->approximate())) return Doubt::none;
  const bool holds_lo = left_out_.holds(i, *s.lo), holds_hi = left_out_.holds(i, *s.hi);
  if (holds_lo && holds_hi) return Doubt::settled;
  return place_misses && (holds_lo || holds_hi) ? Doubt::none : Doubt::left_out;
}

// A(x) of an end of a part of an edge.
const Apex& DoubtfulSources::apex_at(const ContourEdge& c, const ExactPoint* x) {
  const LocalEdge& e = scene_.edges[c.edge];
  for (const std::uint32_t v : {e.a, e.b}) {
    if (x == &scene_.points[v]) return contacts_.apex_of(v, pool_);
  }
  return *apexes_.emplace_back(std::make_unique<Apex>(scene_, pool_, true, c.edge, x));
}

// The A(y) of all y of a part of a contour edge lie behind the supporting plane through it, and behind the facets of A at one end that the other end is behind.
LeftOut::Around DoubtfulSources::around(const Placed& s) {
  if (!s.contour) return LeftOut::around(contacts_.apex_of(s.vertex, pool_));
  const Plane& h = *s.contour->plane;
  const auto has_cell_on = [&](int side) {
    return std::any_of(scene_.cell.vertices.begin(), scene_.cell.vertices.end(),
                       [&](const ExactPoint& v) { return h.side(v) == side; });
  };
  LeftOut::Around around;
  for (const int side : {1, -1}) {
    if (!has_cell_on(side)) around.push_back({&h, side, s.lo});
  }
  for (const auto& [x, other] : {std::pair(s.lo, s.hi), std::pair(s.hi, s.lo)}) {
    for (const LeftOut::Side& facet : LeftOut::around(apex_at(*s.contour, x))) {
      if (facet.plane->side(*other) >= 0) around.push_back(facet);
    }
  }
  return around;
}

DoubtfulSources::Doubt DoubtfulSources::doubt_from(const Placed& s, std::size_t first) const {
  Doubt doubt = Doubt::none;
  left_out_.any_near(s.around, first, [&](std::size_t i) {
    doubt = doubt_of(s, i);
    return doubt != Doubt::none;
  });
  return doubt;
}

void DoubtfulSources::leave_out() {
  if (left_out_.empty()) return;
  std::vector<Placed> all = placed();
  std::vector<Doubt> doubts(all.size());
  for (std::size_t first = 0, end = left_out_.size(); first < end; first = std::exchange(end, left_out_.size())) {
    left_out_.index();
    workers_.for_each(all.size(), [&](std::size_t k, Workers::Worker&) {
      doubts[k] = all[k].settled ? Doubt::none : doubt_from(all[k], first);
    });
    for (std::size_t k = 0; k < all.size(); ++k) {
      Placed& s = all[k];
      s.settled = s.settled || doubts[k] != Doubt::none;
      if (doubts[k] == Doubt::left_out) left_out_.add(around(s), hull(s.lo->approximate(), s.hi->approximate()));
    }
  }
}

}  // namespace clues::fastpath
