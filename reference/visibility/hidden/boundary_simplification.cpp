#include "reference/visibility/hidden/boundary_simplification.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Point2;

namespace {

// A corner, and the segment that leaves it.
struct Corner {
  Point2 p;
  bool boundary = true;  // the segment does not lie on the outline
  // Two points of the original border that the segment runs along. A chord has none and is never extended: so corners are old ones or crossings of old lines, and
  // numbers stay short.
  std::optional<std::pair<Point2, Point2>> line;
};

using Ring = std::vector<Corner>;

// One step: corner `at` of the ring goes (cut), or the segment that leaves it (extend), and with it the triangle `lost`, counter-clockwise.
struct Step {
  FT loss;
  std::array<Point2, 3> lost;
  bool extend = false;
  std::size_t ring = 0, at = 0;
  std::vector<Point2> may_touch;  // corners of `lost` at which other parts of the border may end

  bool operator<(const Step& other) const {
    return std::tie(loss, lost, extend) < std::tie(other.loss, other.lost, other.extend);
  }
};

std::optional<Point2> crossing(const std::pair<Point2, Point2>& g, const std::pair<Point2, Point2>& h) {
  const exact::Vector2 u = g.second - g.first, w = h.second - h.first;
  const FT det = CGAL::determinant(u, w);
  if (CGAL::is_zero(det)) return std::nullopt;
  const Point2 x = g.first + (CGAL::determinant(h.first - g.first, w) / det) * u;
  return Point2(exact::collapsed(x.x()), exact::collapsed(x.y()));
}

// Whether segment pq meets the closed triangle elsewhere than where it ends in a corner that it may touch.
bool in_the_way(const std::array<Point2, 3>& t, const std::vector<Point2>& may_touch, const Point2& p,
                const Point2& q) {
  const auto excused = [&](const Point2& end) {
    return std::find(may_touch.begin(), may_touch.end(), end) != may_touch.end();
  };
  const auto enters_from = [&](const Point2& end, const Point2& other) {  // other in the closed cone at that corner
    const auto k = static_cast<std::size_t>(std::find(t.begin(), t.end(), end) - t.begin());
    return CGAL::orientation(end, t[(k + 1) % 3], other) != CGAL::RIGHT_TURN &&
           CGAL::orientation(end, t[(k + 2) % 3], other) != CGAL::LEFT_TURN;
  };
  if (excused(p)) return enters_from(p, q);
  if (excused(q)) return enters_from(q, p);
  return CGAL::do_intersect(Kernel::Segment_2(p, q), Kernel::Triangle_2(t[0], t[1], t[2]));
}

class Simplifier {
 public:
  Simplifier(const Face2& face, const Kernel::Triangle_2& outline) {
    for (const Ring2& ring : face) {
      rings_.emplace_back();
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
        rings_.back().push_back({p, !on_outline(outline, p, q), std::pair(p, q)});
      }
    }
  }

  void run(FT budget) {
    while (const auto step = best_step(budget)) {
      budget = exact::collapsed(budget - step->loss);
      take(*step);
    }
  }

  Face2 face() const {
    Face2 out;
    for (const Ring& ring : rings_) {
      out.emplace_back();
      for (const Corner& c : ring) out.back().push_back(c.p);
    }
    return out;
  }

 private:
  std::optional<Step> best_step(const FT& budget) const {
    std::vector<Step> steps;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      if (rings_[r].size() < 4) continue;
      for (std::size_t i = 0; i < rings_[r].size(); ++i) {
        for (auto step : {cut(r, i), extension(r, i)}) {
          if (step && step->loss <= budget) steps.push_back(std::move(*step));
        }
      }
    }
    std::sort(steps.begin(), steps.end());
    const auto best = std::find_if(steps.begin(), steps.end(), [&](const Step& s) { return is_free(s); });
    if (best == steps.end()) return std::nullopt;
    return *best;
  }

  const Corner& corner(std::size_t r, std::size_t i) const { return rings_[r][i % rings_[r].size()]; }
  std::size_t before(std::size_t r, std::size_t i) const { return (i + rings_[r].size() - 1) % rings_[r].size(); }

  // The region is to the left of its border. Collinear neighbours, which earlier steps can leave, lose nothing.
  std::optional<Step> cut(std::size_t r, std::size_t i) const {
    const Corner &from = corner(r, before(r, i)), &mid = corner(r, i);
    const Point2 &a = from.p, &b = mid.p, &c = corner(r, i + 1).p;
    if (!from.boundary || !mid.boundary) return std::nullopt;
    const CGAL::Orientation turn = CGAL::orientation(a, b, c);
    if (turn == CGAL::RIGHT_TURN) return std::nullopt;
    const bool straight = turn == CGAL::COLLINEAR;
    Step step = made(r, i, false, {a, b, c});
    step.may_touch = straight ? std::vector{a, c} : std::vector{a, b, c};
    return step;
  }

  std::optional<Step> extension(std::size_t r, std::size_t i) const {
    const Corner &from = corner(r, before(r, i)), &mid = corner(r, i), &to = corner(r, i + 1);
    if (!from.boundary || !mid.boundary || !to.boundary || !from.line || !to.line) return std::nullopt;
    const Point2 &a = from.p, &b = mid.p, &c = to.p, &d = corner(r, i + 2).p;
    const CGAL::Orientation at_b = CGAL::orientation(a, b, c), at_c = CGAL::orientation(b, c, d);
    if (at_b == CGAL::COLLINEAR || at_c == CGAL::COLLINEAR) return std::nullopt;
    if (at_b == CGAL::LEFT_TURN && at_c == CGAL::LEFT_TURN) return std::nullopt;
    const auto x = crossing(*from.line, *to.line);
    if (!x || CGAL::orientation(b, c, *x) != CGAL::LEFT_TURN) return std::nullopt;
    Step step = made(r, i, true, {b, c, *x});  // beyond a, or d, x has that corner in the way
    if (at_b == CGAL::LEFT_TURN) step.may_touch = {b};
    if (at_c == CGAL::LEFT_TURN) step.may_touch = {c};
    return step;
  }

  Step made(std::size_t r, std::size_t i, bool extend, const std::array<Point2, 3>& lost) const {
    return {exact::collapsed(twice_area({lost[0], lost[1], lost[2]})), lost, extend, r, i, {}};
  }

  // Nothing else of the border meets what is given up. As it is hidden beside the corner or segment that goes, all of it is.
  bool is_free(const Step& step) const {
    const bool straight = CGAL::is_zero(step.loss);
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const std::size_t n = rings_[r].size();
      for (std::size_t i = 0; i < n; ++i) {
        if (r == step.ring && (i == before(r, step.at) || i == step.at || (step.extend && i == (step.at + 1) % n)))
          continue;
        const Point2 &p = rings_[r][i].p, &q = rings_[r][(i + 1) % n].p;
        if (straight ? p == step.lost[1] || q == step.lost[1] : in_the_way(step.lost, step.may_touch, p, q))
          return false;
      }
    }
    return true;
  }

  void take(const Step& step) {
    Ring& ring = rings_[step.ring];
    if (step.extend) {
      const std::size_t next = (step.at + 1) % ring.size();
      ring[step.at] = ring[next];
      ring[step.at].p = step.lost[2];
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(next));
    } else {
      ring[before(step.ring, step.at)].line.reset();
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(step.at));
    }
  }

  std::vector<Ring> rings_;
};

}  // namespace

std::size_t boundary_segments(const Face2& face, const Kernel::Triangle_2& outline) {
  std::size_t count = 0;
  for (const Ring2& ring : face) {
    for (std::size_t i = 0; i < ring.size(); ++i) count += !on_outline(outline, ring[i], ring[(i + 1) % ring.size()]);
  }
  return count;
}

Face2 simplified(const Face2& face, const Kernel::Triangle_2& outline, const FT& budget) {
  Simplifier simplifier(face, outline);
  simplifier.run(budget);
  return simplifier.face();
}

}  // namespace clues::reference
