// The radial lower envelope of D13: a sweep of one ray around the centre, with the blockers it meets kept in order of distance.
// The pieces are a conforming complex, so their traces in the plane never cross, and the order of two traces is the same on every
// ray that meets both.
#include "reference/visibility/wedges/on_wedge.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace clues::reference {

using exact::FT;
using exact::Point2;
using exact::Point3;
using exact::Vector3;

namespace {

bool left(const Point2& a, const Point2& b, const Point2& c) { return CGAL::orientation(a, b, c) == CGAL::LEFT_TURN; }
bool right(const Point2& a, const Point2& b, const Point2& c) { return CGAL::orientation(a, b, c) == CGAL::RIGHT_TURN; }

// Boxes that can meet the sector: on its plane, between its rays, beyond its near bound.
class SectorBoxTest {
 public:
  explicit SectorBoxTest(const Sector& s)
      : plane_(s.plane), bounds_{lateral(s, s.on_ray0, 1), lateral(s, s.on_ray1, -1), near(s)} {}
  bool operator()(const CGAL::Bbox_3& box) const {
    if (!plane_(box)) return false;
    return std::all_of(std::begin(bounds_), std::end(bounds_), [&](const auto& h) { return h.may_be_positive(box); });
  }

 private:
  static exact::PlaneBoxTest lateral(const Sector& s, const Point3& ray, int sign) {
    const Vector3 inward = CGAL::cross_product(s.plane.orthogonal_vector(), ray - s.center);
    return exact::PlaneBoxTest(exact::Plane3(s.center, sign > 0 ? inward : -inward));
  }
  static exact::PlaneBoxTest near(const Sector& s) {
    if (s.from_apex()) return exact::PlaneBoxTest(s.plane);
    return exact::PlaneBoxTest(
        exact::Plane3(s.near0, CGAL::cross_product(s.near1 - s.near0, s.plane.orthogonal_vector())));
  }
  exact::PlaneBoxTest plane_;
  exact::PlaneBoxTest bounds_[3];
};

class Envelope {
 public:
  Envelope(const Sector& sector, const exact::SceneQuery& scene)
      : sector_(sector), complex_(scene.complex()), out_{PlaneFrame(sector.plane), {}, {}, {}, {}, {}, {}, {}} {
    for (const std::uint32_t p : sector.on_plane) side_of_[p] = CGAL::ON_ORIENTED_BOUNDARY;
    out_.center = out_.frame(sector.center);
    ray0_ = spot(sector.on_ray0);
    ray1_ = spot(sector.on_ray1);
    near0_ = out_.frame(sector.near0);
    near1_ = out_.frame(sector.near1);
    for (const std::uint32_t t : scene.candidates(SectorBoxTest(sector))) add_piece(t);
    for (const auto& [edge, at] : edge_crossing_) add_crossing({false, edge, at});
    for (const std::uint32_t p : plane_vertices_) add_crossing({true, p, spot(complex_.points[p])});
    std::sort(out_.coplanar_edges.begin(), out_.coplanar_edges.end());
    out_.coplanar_edges.erase(std::unique(out_.coplanar_edges.begin(), out_.coplanar_edges.end()),
                              out_.coplanar_edges.end());
    sweep();
  }
  OnWedge take() { return std::move(out_); }

 private:
  Spot spot(const Point3& p) const { return {p, out_.frame(p)}; }

  CGAL::Oriented_side side(std::uint32_t point) {
    const auto [it, fresh] = side_of_.try_emplace(point, CGAL::ON_ORIENTED_BOUNDARY);
    if (fresh) it->second = sector_.plane.oriented_side(complex_.points[point]);
    return it->second;
  }

  const Spot& crossing_of(std::uint32_t edge) {
    const auto found = edge_crossing_.find(edge);
    if (found != edge_crossing_.end()) return found->second;
    const Point3 &a = complex_.points[complex_.edges[edge].a], &b = complex_.points[complex_.edges[edge].b];
    return edge_crossing_.emplace(edge, spot(exact::crossing(sector_.plane, a, b))).first->second;
  }

  // The trace of a piece in the plane, if the piece reaches into H-.
  void add_piece(std::uint32_t t) {
    const auto& corners = complex_.pieces[t].corners;
    std::vector<std::uint32_t> on;
    bool above = false, below = false;
    for (const std::uint32_t c : corners) {
      const CGAL::Oriented_side s = side(c);
      if (s == CGAL::ON_ORIENTED_BOUNDARY) on.push_back(c);
      above |= s == CGAL::ON_POSITIVE_SIDE;
      below |= s == CGAL::ON_NEGATIVE_SIDE;
    }
    if (on.size() == 3) out_.coplanar_pieces.push_back(t);
    if (on.size() >= 2) {
      for (const std::uint32_t e : complex_.piece_edges[t]) {
        if (side(complex_.edges[e].a) == CGAL::ON_ORIENTED_BOUNDARY &&
            side(complex_.edges[e].b) == CGAL::ON_ORIENTED_BOUNDARY) {
          out_.coplanar_edges.push_back(e);
        }
      }
    }
    if (!above) return;
    std::vector<Spot> ends;
    for (const std::uint32_t c : on) {
      plane_vertices_.insert(c);
      ends.push_back(spot(complex_.points[c]));
    }
    if (below) {
      for (const std::uint32_t e : complex_.piece_edges[t]) {
        const CGAL::Oriented_side a = side(complex_.edges[e].a), b = side(complex_.edges[e].b);
        if (a != b && a != CGAL::ON_ORIENTED_BOUNDARY && b != CGAL::ON_ORIENTED_BOUNDARY)
          ends.push_back(crossing_of(e));
      }
    }
    if (ends.size() != 2) return;  // touches the plane in one corner
    const CGAL::Orientation turn = CGAL::orientation(out_.center, ends[0].q, ends[1].q);
    if (turn == CGAL::COLLINEAR) {
      add_radial(t, ends[0], ends[1]);
      return;
    }
    if (turn == CGAL::RIGHT_TURN) std::swap(ends[0], ends[1]);
    add_blocker({t, ends[0], ends[1]});
  }

  void add_radial(std::uint32_t t, Spot u, Spot w) {
    if (!in_closed_sector(w.q)) std::swap(u, w);
    if (!in_closed_sector(w.q)) return;
    if (!in_closed_sector(u.q)) u = {sector_.center, out_.center};  // on the other side of the centre, or the centre
    if (beyond(u.q) < 0 || beyond(w.q) < 0) return;
    if (CGAL::has_larger_distance_to_point(out_.center, u.q, w.q)) std::swap(u, w);
    out_.radials.push_back({t, u, w});
  }

  // Angular tests for points that may lie anywhere in the plane.
  bool in_closed_cone(const Point2& u, const Point2& w, const Point2& x) const {
    return !right(out_.center, u, x) && !left(out_.center, w, x) &&
           (left(out_.center, u, x) || right(out_.center, w, x));
  }
  bool in_open_cone(const Point2& u, const Point2& w, const Point2& x) const {
    return left(out_.center, u, x) && right(out_.center, w, x);
  }
  bool in_closed_sector(const Point2& x) const { return in_closed_cone(ray0_.q, ray1_.q, x); }

  // +1 beyond the near bound, -1 before it.
  int beyond(const Point2& x) const {
    if (sector_.from_apex()) return 1;
    return -static_cast<int>(CGAL::orientation(near0_, near1_, x));
  }

  void add_crossing(const Crossing& c) {
    if (c.at.q != out_.center && in_closed_sector(c.at.q) && beyond(c.at.q) > 0) out_.crossings.push_back(c);
  }

  // Keeps the blocker if it covers more than one ray of the sector beyond the near bound; notes its angular interval.
  void add_blocker(const Blocker& b) {
    Spot from, to;
    if (in_closed_sector(b.u.q)) {
      from = b.u;
    } else if (in_closed_cone(b.u.q, b.w.q, ray0_.q)) {
      from = ray0_;
    } else {
      return;
    }
    if (in_closed_sector(b.w.q)) {
      to = b.w;
    } else if (in_closed_cone(b.u.q, b.w.q, ray1_.q)) {
      to = ray1_;
    } else {
      return;
    }
    if (!left(out_.center, from.q, to.q)) return;
    // The trace does not cross the near edge, so one point of it inside the open sector tells.
    int where = beyond(b.u.q) + beyond(b.w.q);
    if (beyond(b.u.q) * beyond(b.w.q) < 0 || where == 0) {
      const Point2 ray = CGAL::midpoint(unit_like(from.q), unit_like(to.q));
      where = beyond(on_line(b, ray));
    }
    if (where <= 0) return;
    intervals_.push_back({from, to});
    out_.blockers.push_back(b);
  }

  // A point of the ray through x at a distance that does not depend on x's (so that the middle of two is well between them).
  Point2 unit_like(const Point2& x) const {
    const exact::Vector2 d = x - out_.center;
    return out_.center + d / (CGAL::abs(d.x()) + CGAL::abs(d.y()));
  }
  Point2 on_line(const Blocker& b, const Point2& ray) const {
    const exact::Vector2 d = ray - out_.center, u = b.u.q - out_.center, along = b.w.q - b.u.q;
    const FT t = -CGAL::determinant(d, u) / CGAL::determinant(d, along);
    return b.u.q + t * along;
  }

  // Whether a is nearer than b on the rays that meet both.
  bool nearer(std::uint32_t ia, std::uint32_t ib) const {
    const Blocker &a = out_.blockers[ia], &b = out_.blockers[ib];
    for (const Point2* x : {&a.u.q, &a.w.q}) {
      if (!in_closed_cone(b.u.q, b.w.q, *x)) continue;
      const CGAL::Orientation o = CGAL::orientation(b.u.q, b.w.q, *x);  // left: on the centre's side
      if (o != CGAL::COLLINEAR) return o == CGAL::LEFT_TURN;
    }
    for (const Point2* x : {&b.u.q, &b.w.q}) {
      if (!in_closed_cone(a.u.q, a.w.q, *x)) continue;
      const CGAL::Orientation o = CGAL::orientation(a.u.q, a.w.q, *x);
      if (o != CGAL::COLLINEAR) return o == CGAL::RIGHT_TURN;
    }
    return ia < ib;
  }

  void sweep() {
    struct Stop {
      Spot at;
      std::vector<std::uint32_t> begin, end;
    };
    std::vector<Stop> stops{{ray0_, {}, {}}, {ray1_, {}, {}}};
    for (std::uint32_t i = 0; i < intervals_.size(); ++i) {
      stops.push_back({intervals_[i].first, {i}, {}});
      stops.push_back({intervals_[i].second, {}, {i}});
    }
    std::stable_sort(stops.begin(), stops.end(),
                     [&](const Stop& x, const Stop& y) { return left(out_.center, x.at.q, y.at.q); });
    std::vector<Stop> merged;
    for (Stop& s : stops) {
      if (!merged.empty() && !left(out_.center, merged.back().at.q, s.at.q)) {
        merged.back().begin.insert(merged.back().begin.end(), s.begin.begin(), s.begin.end());
        merged.back().end.insert(merged.back().end.end(), s.end.begin(), s.end.end());
      } else {
        merged.push_back(std::move(s));
      }
    }
    const auto by_distance = [this](std::uint32_t a, std::uint32_t b) { return nearer(a, b); };
    std::set<std::uint32_t, decltype(by_distance)> active(by_distance);
    std::vector<decltype(active.begin())> place(intervals_.size());
    for (std::size_t i = 0; i + 1 < merged.size(); ++i) {
      for (const std::uint32_t b : merged[i].end) active.erase(place[b]);
      for (const std::uint32_t b : merged[i].begin) place[b] = active.insert(b).first;
      std::optional<std::uint32_t> nearest;
      if (!active.empty()) nearest = *active.begin();
      if (!out_.strips.empty() && out_.strips.back().blocker == nearest) {
        out_.strips.back().on_ray1 = merged[i + 1].at;
      } else {
        out_.strips.push_back({merged[i].at, merged[i + 1].at, nearest});
      }
    }
  }

  const Sector& sector_;
  const exact::Complex& complex_;
  OnWedge out_;
  Spot ray0_, ray1_;
  Point2 near0_, near1_;
  std::unordered_map<std::uint32_t, CGAL::Oriented_side> side_of_;
  std::map<std::uint32_t, Spot> edge_crossing_;
  std::set<std::uint32_t> plane_vertices_;
  std::vector<std::pair<Spot, Spot>> intervals_;  // per blocker: the rays of the sector that it covers
};

}  // namespace

OnWedge on_wedge_visibility(const Sector& sector, const exact::SceneQuery& scene) {
  return Envelope(sector, scene).take();
}

bool reaches(const OnWedge& wedge, const Strip& strip, const Point2& q) {
  if (!strip.blocker) return true;
  const Blocker& b = wedge.blockers[*strip.blocker];
  return CGAL::orientation(b.u.q, b.w.q, q) != CGAL::RIGHT_TURN;
}

std::vector<Strip> strips_between(const OnWedge& wedge, const Spot& lo, const Spot& hi) {
  std::vector<Strip> out;
  const Point2& c = wedge.center;
  for (Strip s : wedge.strips) {
    if (left(c, s.on_ray0.q, lo.q)) s.on_ray0 = lo;
    if (left(c, hi.q, s.on_ray1.q)) s.on_ray1 = hi;
    if (left(c, s.on_ray0.q, s.on_ray1.q)) out.push_back(std::move(s));
  }
  return out;
}

Point3 far_point(const OnWedge& wedge, const Blocker& b, const Spot& on_ray) {
  const exact::Vector2 d = on_ray.q - wedge.center;
  const FT at_u = CGAL::determinant(d, b.u.q - wedge.center), at_w = CGAL::determinant(d, b.w.q - wedge.center);
  if (CGAL::is_zero(at_u)) return b.u.p;
  if (CGAL::is_zero(at_w)) return b.w.p;
  return exact::zero_on_line(b.u.p, b.w.p, at_u, at_w);
}

}  // namespace clues::reference
