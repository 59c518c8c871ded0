#include "reference/visibility/search/doubtful_sources.h"

namespace clues::reference {

using exact::Point3;

namespace {

// A source as one figure (anticone.h): a part of an edge from lo to hi with its point y, or a vertex, which is all three.
struct Figure {
  Point3 lo, hi, y;
  const Walk* walk = nullptr;
  const ContourEdge* contour = nullptr;  // none: a vertex
  std::size_t looked_at = 0;             // how many of what is left out
  bool settled = false;                  // no matter what else is left out
  bool* keeps_out = nullptr;             // Source::keeps_out
};

enum class Doubt { none, none_outside, settled, left_out };  // none_outside: of what is outside of the anti-cone

Doubt doubt_of(const Figure& f, const LeftOut& left_out, std::size_t i) {
  const bool walk_counts = !f.walk->runs_through(left_out, i);
  if (walk_counts && !left_out.meets(i, f.lo, f.hi)) return Doubt::none;
  const bool holds_lo = left_out.holds(i, f.lo), holds_hi = left_out.holds(i, f.hi);
  if (holds_lo && holds_hi) return Doubt::settled;
  return walk_counts && (holds_lo || holds_hi) && !left_out.holds(i, f.y) ? Doubt::none_outside : Doubt::left_out;
}

}  // namespace

void leave_out_doubtful_sources(std::vector<Source>& sources, const std::vector<VertexSource>& vertex_sources,
                                const std::vector<ContourEdge>& contours, const exact::ConvexCell& cell,
                                LeftOut& left_out) {
  std::vector<Figure> figures;
  for (Source& s : sources) {
    if (!s.walk.unresolved) figures.push_back({s.lo, s.hi, s.y, &s.walk, &contours[s.contour], 0, false, &s.keeps_out});
  }
  for (const VertexSource& s : vertex_sources) {
    if (!s.walk.unresolved) figures.push_back({s.x, s.x, s.x, &s.walk, nullptr, 0, false, nullptr});
  }
  for (bool more = true; more;) {
    more = false;
    for (Figure& f : figures) {
      for (; !f.settled && f.looked_at < left_out.size(); ++f.looked_at) {
        const Doubt doubt = doubt_of(f, left_out, f.looked_at);
        if (doubt != Doubt::none && f.keeps_out) *f.keeps_out = false;
        f.settled = doubt == Doubt::settled || doubt == Doubt::left_out;
        if (doubt != Doubt::left_out) continue;
        if (f.contour) {
          left_out.add(f.lo, f.hi, f.contour->plane, cell);
        } else {
          left_out.add(f.lo, cell);
        }
        more = true;
      }
    }
  }
}

}  // namespace clues::reference
