// Faces of the local arrangement around a point, by union of arc sides.
#include "reference/visibility/wedges/local_star.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Vector3;

namespace {

CGAL::Sign det_sign(const Vector3& a, const Vector3& b, const Vector3& c) {
  return CGAL::sign(CGAL::determinant(a, b, c));
}

// Where y is in the plane of the arc ab with normal a x b, which is shorter than a half turn.
enum class OnArc { outside, at_end, inside };
OnArc on_arc(const Vector3& a, const Vector3& b, const Vector3& normal, const Vector3& y) {
  const CGAL::Sign from_a = CGAL::sign(normal * CGAL::cross_product(a, y));
  if (from_a == CGAL::NEGATIVE) return OnArc::outside;
  const CGAL::Sign to_b = CGAL::sign(normal * CGAL::cross_product(y, b));
  if (to_b == CGAL::NEGATIVE || (from_a == CGAL::ZERO && to_b == CGAL::ZERO)) return OnArc::outside;
  return from_a == CGAL::ZERO || to_b == CGAL::ZERO ? OnArc::at_end : OnArc::inside;
}
bool in_arc(const Vector3& a, const Vector3& b, const Vector3& normal, const Vector3& y) {
  return on_arc(a, b, normal, y) != OnArc::outside;
}

// The first sign that is not zero.
CGAL::Sign leading(const FT& a, const FT& b, const FT& c) {
  const CGAL::Sign sa = CGAL::sign(a);
  if (sa != CGAL::ZERO) return sa;
  const CGAL::Sign sb = CGAL::sign(b);
  return sb != CGAL::ZERO ? sb : CGAL::sign(c);
}

// Where b lies in the turn about axis that starts at a, given the sign of the turn from a to b: 0 at a, 1 in the first half turn, 2 opposite,
// 3 in the second half turn.
int half_turn(CGAL::Sign turn, const Vector3& axis, const Vector3& a, const Vector3& b) {
  if (turn != CGAL::ZERO) return turn == CGAL::POSITIVE ? 1 : 3;
  return CGAL::is_positive(CGAL::cross_product(axis, a) * CGAL::cross_product(axis, b)) ? 0 : 2;
}

}  // namespace

CGAL::Sign side_of(const Vector3& normal, const Beside& d) {
  return leading(normal * d.limit, normal * d.aside, normal * d.off);
}

LocalStar LocalStar::around_vertex(const exact::Complex& complex, std::uint32_t point) {
  LocalStar star;
  std::map<std::uint32_t, int> node_of;
  const auto node = [&](std::uint32_t other) {
    const auto [it, fresh] = node_of.try_emplace(other, static_cast<int>(star.nodes_.size()));
    if (fresh) star.nodes_.push_back(complex.points[other] - complex.points[point]);
    return it->second;
  };
  for (const std::uint32_t t : complex.point_pieces[point]) {
    const auto& c = complex.pieces[t].corners;
    const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), point) - c.begin());
    const int a = node(c[(at + 1) % 3]), b = node(c[(at + 2) % 3]);
    star.arcs_.push_back({a, b, {}});
  }
  star.finish();
  return star;
}

LocalStar LocalStar::around_edge_point(const exact::Complex& complex, std::uint32_t edge, const exact::Point3& x) {
  LocalStar star;
  const exact::Edge& e = complex.edges[edge];
  const Vector3 along = complex.points[e.b] - complex.points[e.a];
  star.nodes_ = {along, -along};
  for (const std::uint32_t t : e.pieces) {
    const auto& c = complex.pieces[t].corners;
    const auto third = *std::find_if(c.begin(), c.end(), [&](auto i) { return i != e.a && i != e.b; });
    const int m = static_cast<int>(star.nodes_.size());
    star.nodes_.push_back(complex.points[third] - x);
    star.arcs_.push_back({0, m, {}});
    star.arcs_.push_back({m, 1, {}});
  }
  star.finish();
  return star;
}

void LocalStar::finish() {
  for (Arc& arc : arcs_) {
    arc.normal = CGAL::cross_product(nodes_[static_cast<std::size_t>(arc.a)], nodes_[static_cast<std::size_t>(arc.b)]);
  }
  face_.resize(arcs_.size() * 2);
  std::iota(face_.begin(), face_.end(), 0);
  component_.resize(arcs_.size());
  std::iota(component_.begin(), component_.end(), 0);
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
    const Vector3& axis = nodes_[static_cast<std::size_t>(n)];
    struct Spoke {
      int arc;
      Vector3 to;
      int left, right;  // arc sides counter-clockwise and clockwise of the spoke, seen from the tip of axis
    };
    std::vector<Spoke> spokes;
    for (int i = 0; i < static_cast<int>(arcs_.size()); ++i) {
      const Arc& arc = arcs_[static_cast<std::size_t>(i)];
      if (arc.a == n) spokes.push_back({i, nodes_[static_cast<std::size_t>(arc.b)], 2 * i, 2 * i + 1});
      if (arc.b == n) spokes.push_back({i, nodes_[static_cast<std::size_t>(arc.a)], 2 * i + 1, 2 * i});
    }
    if (spokes.empty()) continue;
    const Vector3 reference = spokes.front().to;
    const auto half = [&](const Vector3& to) { return half_turn(det_sign(axis, reference, to), axis, reference, to); };
    std::sort(spokes.begin() + 1, spokes.end(), [&](const Spoke& x, const Spoke& y) {
      const int hx = half(x.to), hy = half(y.to);
      return hx != hy ? hx < hy : det_sign(axis, x.to, y.to) == CGAL::POSITIVE;
    });
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Spoke &x = spokes[i], &y = spokes[(i + 1) % spokes.size()];
      face_[static_cast<std::size_t>(root(x.left))] = root(y.right);
      const int from = component_[static_cast<std::size_t>(x.arc)], to = component_[static_cast<std::size_t>(y.arc)];
      std::replace(component_.begin(), component_.end(), from, to);
    }
  }
}

bool LocalStar::meets_circle(const Vector3& normal) const {
  std::vector<CGAL::Sign> side;
  for (const Vector3& d : nodes_) side.push_back(CGAL::sign(normal * d));
  const auto crosses = [&](const Arc& arc) {
    return side[static_cast<std::size_t>(arc.a)] * side[static_cast<std::size_t>(arc.b)] < 0;
  };
  return std::count(side.begin(), side.end(), CGAL::ZERO) + std::count_if(arcs_.begin(), arcs_.end(), crosses) > 1;
}

LocalStar LocalStar::with_circle(const Vector3& normal) const {
  LocalStar star;
  star.nodes_ = nodes_;
  std::vector<int> on_circle;
  std::vector<FT> at;
  for (const Vector3& d : nodes_) {
    at.push_back(normal * d);
    if (CGAL::is_zero(at.back())) on_circle.push_back(static_cast<int>(at.size()) - 1);
  }
  const auto add_node = [&](const Vector3& d) {
    on_circle.push_back(static_cast<int>(star.nodes_.size()));
    star.nodes_.push_back(d);
    return on_circle.back();
  };
  std::vector<Arc> covering;
  for (const Arc& arc : arcs_) {
    const FT &at_a = at[static_cast<std::size_t>(arc.a)], &at_b = at[static_cast<std::size_t>(arc.b)];
    if (CGAL::is_zero(at_a) && CGAL::is_zero(at_b)) covering.push_back(arc);
    if (CGAL::sign(at_a) * CGAL::sign(at_b) >= 0) {
      star.arcs_.push_back(arc);
      continue;
    }
    const int c = add_node(CGAL::abs(at_b) * nodes_[static_cast<std::size_t>(arc.a)] +
                           CGAL::abs(at_a) * nodes_[static_cast<std::size_t>(arc.b)]);
    star.arcs_.push_back({arc.a, c, {}});
    star.arcs_.push_back({c, arc.b, {}});
  }
  // Four more, so that no part is longer than a quarter turn.
  const Vector3 zero =
      CGAL::is_zero(normal.x()) && CGAL::is_zero(normal.y()) ? Vector3(1, 0, 0) : Vector3(-normal.y(), normal.x(), 0);
  const Vector3 quarter = CGAL::cross_product(normal, zero);
  const auto node = [&](int i) -> const Vector3& { return star.nodes_[static_cast<std::size_t>(i)]; };
  for (const Vector3& d : {zero, quarter, -zero, -quarter}) {
    if (std::none_of(on_circle.begin(), on_circle.end(), [&](int i) { return same_direction(node(i), d); }))
      add_node(d);
  }
  const auto half = [&](const Vector3& d) { return half_turn(det_sign(normal, zero, d), normal, zero, d); };
  std::sort(on_circle.begin(), on_circle.end(), [&](int i, int k) {
    const int hi = half(node(i)), hk = half(node(k));
    return hi != hk ? hi < hk : det_sign(normal, node(i), node(k)) == CGAL::POSITIVE;
  });
  star.circle_ = star.arcs_.size();
  for (std::size_t i = 0; i < on_circle.size(); ++i) {
    const int a = on_circle[i], b = on_circle[(i + 1) % on_circle.size()];
    const Vector3 middle = node(a) + node(b);
    const auto covers = [&](const Arc& arc) { return in_arc(node(arc.a), node(arc.b), arc.normal, middle); };
    if (std::none_of(covering.begin(), covering.end(), covers)) star.arcs_.push_back({a, b, {}});
  }
  star.finish();
  return star;
}

std::vector<std::pair<std::vector<int>, std::vector<int>>> LocalStar::across_circle() const {
  const bool connected = std::all_of(component_.begin(), component_.end(), [&](int c) { return c == component_[0]; });
  std::vector<std::pair<std::vector<int>, std::vector<int>>> sides;
  for (std::size_t i = circle_; i < arcs_.size(); ++i) {
    if (connected) {
      const int left = static_cast<int>(2 * i);
      sides.push_back({{root(left + 1)}, {root(left)}});
      continue;
    }
    const Vector3 &a = nodes_[static_cast<std::size_t>(arcs_[i].a)], &b = nodes_[static_cast<std::size_t>(arcs_[i].b)];
    sides.emplace_back(face_of(nudged(a + b, -arcs_[i].normal)), face_of(nudged(a + b, arcs_[i].normal)));
  }
  return sides;
}

int LocalStar::root(int side) const {
  while (face_[static_cast<std::size_t>(side)] != side) side = face_[static_cast<std::size_t>(side)];
  return side;
}

std::vector<int> LocalStar::face_of(const Vector3& d) const {
  std::vector<int> name;
  std::vector<int> done;
  for (std::size_t first = 0; first < arcs_.size(); ++first) {
    const int component = component_[first];
    if (std::find(done.begin(), done.end(), component) != done.end()) continue;
    done.push_back(component);
    // Go from d, or from a direction beside it, towards a point of the component; the first arc met tells the face. A path
    // through a node or along an arc tells nothing: take another.
    std::optional<int> side = side_met(d, first);
    for (int attempt = 1; !side && attempt < 64; ++attempt) {
      const Vector3 by(attempt % 7 - 3, (attempt * 3) % 11 - 5, (attempt * 5) % 13 - 6);
      const std::optional<Vector3> beside = nudged_if_possible(d, by, CGAL::NULL_VECTOR);  // not along an arc through d
      if (beside) side = side_met(*beside, first, attempt);
    }
    if (!side) throw scene::Error(scene::ErrorCode::internal, "local star: no clean path to an incident piece");
    name.push_back(root(*side));
  }
  return name;
}

bool same_direction(const Vector3& a, const Vector3& b) {
  return CGAL::cross_product(a, b) == CGAL::NULL_VECTOR && CGAL::is_positive(a * b);
}

int LocalStar::sides_at(const Vector3& d, const std::vector<int>& face) const {
  int count = 0;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    for (const int node : {arcs_[i].a, arcs_[i].b}) {
      if (!same_direction(nodes_[static_cast<std::size_t>(node)], d)) continue;
      for (const std::size_t side : {2 * i, 2 * i + 1})
        count += std::find(face.begin(), face.end(), root(static_cast<int>(side))) != face.end() ? 1 : 0;
    }
  }
  return count;
}

std::vector<Vector3> LocalStar::border_of(const std::vector<int>& face) const {
  std::vector<Vector3> ends;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const auto is_side = [&](std::size_t side) {
      return std::find(face.begin(), face.end(), root(static_cast<int>(side))) != face.end();
    };
    if (!is_side(2 * i) && !is_side(2 * i + 1)) continue;
    ends.push_back(nodes_[static_cast<std::size_t>(arcs_[i].a)]);
    ends.push_back(nodes_[static_cast<std::size_t>(arcs_[i].b)]);
  }
  return ends;
}

std::optional<int> LocalStar::side_met(const Vector3& d, std::size_t aim_arc, int aim) const {
  const Vector3 target = FT(1 + aim) * nodes_[static_cast<std::size_t>(arcs_[aim_arc].a)] +
                         FT(1 + (aim * 7) % 11) * nodes_[static_cast<std::size_t>(arcs_[aim_arc].b)];
  std::optional<int> side;
  FT nearest(2);
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    if (component_[i] != component_[aim_arc]) continue;
    const Arc& arc = arcs_[i];
    const FT at_d = arc.normal * d, at_target = i == aim_arc ? FT(0) : arc.normal * target;
    const CGAL::Sign sd = CGAL::sign(at_d), st = CGAL::sign(at_target);
    if (sd == CGAL::ZERO && st == CGAL::ZERO) return std::nullopt;
    if (sd == CGAL::ZERO || sd == st) continue;
    const Vector3 y = CGAL::abs(at_target) * d + CGAL::abs(at_d) * target;
    const Vector3 &a = nodes_[static_cast<std::size_t>(arc.a)], &b = nodes_[static_cast<std::size_t>(arc.b)];
    const OnArc where = on_arc(a, b, arc.normal, y);
    if (where == OnArc::outside) continue;
    if (where == OnArc::at_end) return std::nullopt;
    const FT t = at_d / (at_d - at_target);
    if (t < nearest) {
      nearest = t;
      side = static_cast<int>(2 * i) + (sd == CGAL::POSITIVE ? 0 : 1);
    }
  }
  return side;
}

std::vector<FT> LocalStar::heights(const Vector3& d) const {
  std::vector<FT> out;
  for (const Arc& arc : arcs_) out.push_back(arc.normal * d);
  return out;
}

bool LocalStar::free_between(const Vector3& d0, const Vector3& d1) const {
  return free_between(d0, heights(d0), d1, heights(d1));
}

bool LocalStar::free_between(const Vector3& d0, const std::vector<FT>& heights0, const Vector3& d1,
                             const std::vector<FT>& heights1) const {
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const Arc& arc = arcs_[i];
    const FT &at0 = heights0[i], &at1 = heights1[i];
    const CGAL::Sign s0 = CGAL::sign(at0), s1 = CGAL::sign(at1);
    if (s0 == CGAL::ZERO && s1 != CGAL::ZERO) continue;  // leaves the arc's plane at once
    if (s0 != CGAL::ZERO && s0 == s1) continue;
    const Vector3 &a = nodes_[static_cast<std::size_t>(arc.a)], &b = nodes_[static_cast<std::size_t>(arc.b)];
    if (s0 == CGAL::ZERO) {  // runs within the arc's great circle: it must not end on the arc, nor pass one of its ends
      const Vector3 turn = CGAL::cross_product(d0, d1);
      const auto passes = [&](const Vector3& x) {
        return CGAL::is_positive(turn * CGAL::cross_product(d0, x)) &&
               CGAL::is_positive(turn * CGAL::cross_product(x, d1));
      };
      if (in_arc(a, b, arc.normal, d1) || passes(a) || passes(b)) return false;
      continue;
    }
    if (in_arc(a, b, arc.normal, CGAL::abs(at1) * d0 + CGAL::abs(at0) * d1)) return false;
  }
  return true;
}

bool LocalStar::free_between(const Beside& d0, const Vector3& d1) const {
  for (const Arc& arc : arcs_) {
    const CGAL::Sign s0 = side_of(arc.normal, d0), s1 = CGAL::sign(arc.normal * d1);
    if (s0 != CGAL::ZERO && s0 == s1) continue;
    if (s0 == CGAL::ZERO && s1 != CGAL::ZERO) continue;
    if (s0 == CGAL::ZERO) return false;  // within the arc's great circle: not a way to rely on
    const FT at0 = CGAL::abs(arc.normal * d0.limit), at1 = CGAL::abs(arc.normal * d1);
    const Vector3& a = nodes_[static_cast<std::size_t>(arc.a)];
    const Vector3& b = nodes_[static_cast<std::size_t>(arc.b)];
    if (in_arc(a, b, arc.normal, CGAL::is_zero(at0) ? d0.limit : at1 * d0.limit + at0 * d1)) return false;
  }
  return true;
}

bool LocalStar::spreads_around_edge(const Beside& d, const Vector3& inner, const std::vector<Vector3>& rays) const {
  // Seen along the edge every piece is a ray, and a way may turn by less than a half turn at once. Angles about the axis, from d:
  const Vector3& axis = nodes_[0];
  const auto turn = [&](const Vector3& w) { return side_of(CGAL::cross_product(w, axis), d); };  // of d -> w
  const auto half = [&](const Vector3& w) { return half_turn(turn(w), axis, d.limit, w); };
  bool ccw = true;  // inner comes before all pieces
  for (std::size_t i = 2; i < nodes_.size(); ++i) {
    const int h = half(nodes_[i]), h_inner = half(inner);
    ccw &= h_inner != h ? h_inner < h : det_sign(axis, inner, nodes_[i]) == CGAL::POSITIVE;
  }
  const CGAL::Sign way = ccw ? CGAL::POSITIVE : CGAL::NEGATIVE;
  if (turn(inner) == way) return true;
  // Too far for one step: by way of some w of the cone, less than a half turn from d and from inner.
  struct Forms {
    FT from_d[3], to_inner;  // signed: both positive (the first by its leading part) is what is asked for
  };
  std::vector<Forms> forms;
  for (const Vector3& r : rays) {
    const Vector3 n = CGAL::cross_product(r, axis);
    const FT sign(ccw ? 1 : -1);
    forms.push_back(
        {{sign * (n * d.limit), sign * (n * d.aside), sign * (n * d.off)}, sign * CGAL::determinant(axis, r, inner)});
  }
  for (const Forms& a : forms) {
    if (leading(a.from_d[0], a.from_d[1], a.from_d[2]) != CGAL::POSITIVE) continue;
    for (const Forms& b : forms) {  // a alone, or a combination of a and b
      if (!CGAL::is_positive(b.to_inner)) continue;
      const auto cross = [&](int k) { return FT(a.from_d[k] * b.to_inner - a.to_inner * b.from_d[k]); };
      if (CGAL::is_positive(a.to_inner) || leading(cross(0), cross(1), cross(2)) == CGAL::POSITIVE) return true;
    }
  }
  return false;
}

Vector3 LocalStar::nudged(const Vector3& d, const Vector3& by, const Vector3& then) const {
  if (const std::optional<Vector3> moved = nudged_if_possible(d, by, then)) return *moved;
  throw scene::Error(scene::ErrorCode::internal, "local star: a direction cannot leave its arc");
}

std::optional<Vector3> LocalStar::nudged_if_possible(const Vector3& d, const Vector3& by, const Vector3& then) const {
  // Down to 2^-40960: the three may differ in size by more than the range of doubles. All fail only if the way runs along an arc through d.
  constexpr int kQuarters = 20, kSquares = 10;
  const std::vector<FT> at_d = heights(d), at_by = heights(by), at_then = heights(then);
  std::vector<FT> at_moved(arcs_.size());
  FT step(1);
  for (int k = 0; k <= kQuarters + kSquares; ++k, step = k <= kQuarters ? step / FT(4) : step * step) {
    const Vector3 moved = d + step * by + step * step * then;
    for (std::size_t i = 0; i < arcs_.size(); ++i) at_moved[i] = at_d[i] + step * at_by[i] + step * step * at_then[i];
    const auto right = [&](std::size_t i) {
      const CGAL::Sign side = CGAL::sign(at_moved[i]);
      // Leave the arc's great circle on the side that `by` points to.
      if (CGAL::is_zero(at_d[i]) && side != leading(at_by[i], at_then[i], FT(0))) return false;
      const Arc& arc = arcs_[i];
      return side != CGAL::ZERO || !in_arc(nodes_[static_cast<std::size_t>(arc.a)],
                                           nodes_[static_cast<std::size_t>(arc.b)], arc.normal, moved);
    };
    bool all = free_between(d, at_d, moved, at_moved);
    for (std::size_t i = 0; all && i < arcs_.size(); ++i) all = right(i);
    if (all) return moved;
  }
  return std::nullopt;
}

namespace {

// A point of int V on the ray from x, if there is one: of a solid cell the middle between where the ray enters and where
// it leaves, of a polygon the point where the ray meets its plane. A ray within that plane, or the line of a segment, has
// none.
std::optional<exact::Point3> inside_along(const exact::Point3& x, const Vector3& ray, const exact::ConvexCell& cell) {
  if (cell.dimension() < 2) return std::nullopt;
  if (cell.dimension() == 2) {
    const exact::Plane3& h = cell.facets()[0].plane;
    const FT slope = h.orthogonal_vector() * ray, at_x = exact::value_at(h, x);
    if (CGAL::sign(slope) * CGAL::sign(at_x) >= 0) return std::nullopt;
    const exact::Point3 c = exact::collapsed(x + (-at_x / slope) * ray);
    return cell.interior_contains(c) ? std::optional(c) : std::nullopt;
  }
  FT enter(0);
  std::optional<FT> leave;
  for (const exact::CellFacet& f : cell.facets()) {
    const FT slope = f.plane.orthogonal_vector() * ray, at_x = exact::value_at(f.plane, x);
    if (CGAL::is_zero(slope)) {
      if (!CGAL::is_negative(at_x)) return std::nullopt;
    } else if (CGAL::is_negative(slope)) {
      enter = std::max(enter, FT(-at_x / slope));
    } else {
      const FT t = -at_x / slope;
      if (!leave || t < *leave) leave = t;
    }
  }
  if (!leave || enter >= *leave) return std::nullopt;
  return exact::collapsed(x + ((enter + *leave) / FT(2)) * ray);
}

}  // namespace

std::vector<Vector3> LocalStar::into_cell(const exact::Point3& x, const exact::ConvexCell& cell) const {
  std::vector<Vector3> found;
  const std::vector<exact::Point3>& s = cell.vertices();
  // From x to c, a point of the cell, and from there a little towards `to` and by much less towards a point inside, which must be off the planes
  // that hold both. (A flat cell may lie in such a plane as a whole; then there is none.)
  std::vector<exact::Point3> inside{cell.center()};
  for (int k = 1; k <= 3; ++k) {
    std::vector<int> weights;
    for (std::size_t i = 0; i < s.size(); ++i) weights.push_back(1 + (static_cast<int>(i) * k * k + 3 * k) % 17);
    inside.push_back(cell.interior_point(weights));
  }
  const auto add = [&](const exact::Point3& c, const Vector3& to) {
    for (const exact::Point3& z : inside) {
      const std::optional<Vector3> d = nudged_if_possible(c - x, to / FT(4), (z - c) / FT(4));
      if (!d) continue;
      if (cell.interior_contains(x + *d)) found.push_back(*d);
      return;
    }
  };
  for (const exact::Point3& c : s) {
    if (c != x) add(c, cell.center() - c);
  }
  for (const Arc& arc : arcs_) {
    for (const auto& [i, j] : cell.edges()) {
      const exact::Point3 &a = s[static_cast<std::size_t>(i)], &b = s[static_cast<std::size_t>(j)];
      const FT at_a = arc.normal * (a - x), at_b = arc.normal * (b - x);
      if (CGAL::sign(at_a) * CGAL::sign(at_b) > 0 || (CGAL::is_zero(at_a) && CGAL::is_zero(at_b))) continue;
      const exact::Point3 c = exact::zero_on_line(a, b, at_a, at_b);
      if (c == x) continue;
      if (c != a) add(c, a - c);
      if (c != b) add(c, b - c);
    }
    for (const int n : {arc.a, arc.b}) {
      const std::optional<exact::Point3> c = inside_along(x, nodes_[static_cast<std::size_t>(n)], cell);
      if (!c) continue;
      Vector3 across = arc.normal;
      if (cell.dimension() == 2) {  // within its plane
        const Vector3 h = cell.facets()[0].plane.orthogonal_vector();
        across = across - (across * h) / (h * h) * h;
      }
      for (const Vector3& to : {across, -across}) {
        FT scale(1);  // so small that c stays in V
        while (!cell.interior_contains(*c + scale * to)) scale = scale / FT(2);
        add(*c, scale * to);
      }
    }
  }
  return found;
}

std::vector<Vector3> LocalStar::traces(const Vector3& normal) const {
  std::vector<Vector3> found;
  for (const Arc& arc : arcs_) {
    const Vector3 &a = nodes_[static_cast<std::size_t>(arc.a)], &b = nodes_[static_cast<std::size_t>(arc.b)];
    const FT at_a = normal * a, at_b = normal * b;
    if (CGAL::is_zero(at_a)) found.push_back(a);
    if (CGAL::is_zero(at_b)) found.push_back(b);
    if (CGAL::sign(at_a) * CGAL::sign(at_b) < 0) found.push_back(CGAL::abs(at_b) * a + CGAL::abs(at_a) * b);
  }
  return found;
}

}  // namespace clues::reference
