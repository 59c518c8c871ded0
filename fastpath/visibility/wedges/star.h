// The local picture of a contour vertex x: on a small sphere around it every incident piece is an arc of a great circle, and the arcs cut the free
// space into faces (D12). Faces are named by the sides of arcs that they have; directions beside others are decided without a distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "fastpath/visibility/points/integers.h"
#include "fastpath/visibility/wedges/on_wedge.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

// Between the directions of two mesh vertices, of a piece at x; ab is the mesh edge of the piece opposite to x.
struct LocalArc {
  std::uint32_t a = 0, b = 0, edge = 0, piece = 0;
};

// Of mesh vertex `id`, or of a point inside mesh edge `id`.
std::vector<LocalArc> arcs_around(const LocalScene& scene, bool on_edge, std::uint32_t id);

// The first sign that is not zero.
template <class NT>
int leading(const NT& a, const NT& b, const NT& c) {
  const int s = sign_of(a);
  if (s != 0) return s;
  const int t = sign_of(b);
  return t != 0 ? t : sign_of(c);
}

// A direction beside another: limit, moved a little to aside, and by much less to off.
template <class NT>
struct Beside {
  Vec3<NT> limit, aside, off;
  SpotName at;  // in which limit points, if that is of the mesh
  int side_of(const Vec3<NT>& normal) const {
    return leading(dot(normal, limit), dot(normal, aside), dot(normal, off));
  }
};

// Whether one is a positive multiple of the other.
template <class NT>
bool same_direction(const Vec3<NT>& a, const Vec3<NT>& b) {
  const Vec3<NT> c = cross(a, b);
  return sign_of(c.x) == 0 && sign_of(c.y) == 0 && sign_of(c.z) == 0 && sign_of(NT(dot(a, b))) > 0;
}

// For x in the plane of the arc ab with this normal: whether it lies in the closed arc.
template <class NT>
bool in_arc(const Vec3<NT>& a, const Vec3<NT>& b, const Vec3<NT>& normal, const Vec3<NT>& x) {
  return det_sign(normal, a, x) >= 0 && det_sign(normal, x, b) >= 0;
}

// Where `to` lies in the turn about axis that starts at `from`: 0 at from, 1 in the first half turn, 2 opposite, 3 in the second half turn.
template <class NT>
int half_turn(const Vec3<NT>& axis, const Vec3<NT>& from, const Vec3<NT>& to) {
  const int side = det_sign(axis, from, to);
  if (side != 0) return side > 0 ? 1 : 3;
  return sign_of(NT(dot(cross(axis, from), cross(axis, to)))) > 0 ? 0 : 2;
}

// Intervals that find no way leave the question to whole numbers.
template <class NT>
[[noreturn]] void give_up(const char* what) {
  if constexpr (std::is_same_v<NT, Interval>) throw Unsure{};
  throw scene::Error(scene::ErrorCode::internal, what);
}

// The arcs around x, in one number type.
template <class NT>
class Star {
 public:
  using V = Vec3<NT>;

  // x: mesh vertex `id`, or a point inside mesh edge `id`. Keeps references to scene and x.
  Star(const LocalScene& scene, bool on_edge, std::uint32_t id, const ExactPoint* x, const std::vector<LocalArc>& arcs)
      : scene_(&scene), x_(x) {
    std::map<std::uint32_t, int> node_of;
    const auto node = [&](std::uint32_t v) {
      const auto [it, fresh] = node_of.try_emplace(v, static_cast<int>(nodes_.size()));
      if (fresh) nodes_.push_back(to(scene.points[v]));
      return it->second;
    };
    if (on_edge) {  // nodes 0 and 1: along the edge
      node(scene.edges[id].b);
      node(scene.edges[id].a);
    }
    for (const LocalArc& arc : arcs) {
      const int a = node(arc.a), b = node(arc.b);
      arcs_.push_back({a, b, arc.piece, cross(nodes_[idx(a)], nodes_[idx(b)])});
    }
    find_faces();
  }

  V to(const ExactPoint& p) const { return direction<NT>(*x_, p); }

  // Whether arcs meet the great circle of this normal in more than one place. If not, it divides no face next to it: one gets from one way through it to another along it.
  bool is_divided_by(const V& n) const {
    const std::vector<int> side = sides_of(n);
    return std::count(side.begin(), side.end(), 0) +
               std::count_if(arcs_.begin(), arcs_.end(),
                             [&](const Arc& arc) { return side[idx(arc.a)] * side[idx(arc.b)] < 0; }) >
           1;
  }

  // limit, moved so little that no arc's great circle lies between (or, where intervals do not know, no arc), and that it is `good`.
  template <class Good>
  std::optional<V> moved_if_possible(const Beside<NT>& d, const Good& good) const {
    for (const int exponent : {2, 5, 10, 15, 20, 25, 30, 60, 120, 250, 500, 1000, 2000, 4000, 8000}) {
      const V m = moved_by<NT>(d.limit, d.aside, d.off, exponent);
      if (std::all_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) { return is_beside(arc, d, m); }) && good(m))
        return m;
    }
    return std::nullopt;
  }
  template <class Good>
  V moved(const Beside<NT>& d, const Good& good) const {
    if (const std::optional<V> m = moved_if_possible(d, good)) return *m;
    give_up<NT>("apex: a direction has no neighbour on its side");
  }
  V moved(const Beside<NT>& d) const { return moved(d, anywhere); }

  // Sides of arcs, 2 i to the left of arc i, 2 i + 1 to its right: for each one of those that it is joined with around the nodes that are `wanted`, where
  // neighbouring arcs face each other across one face. The same one for all that are joined.
  template <class Wanted>
  std::vector<int> joined_sides(const Wanted& wanted) const {
    std::vector<int> side(2 * arcs_.size());
    std::iota(side.begin(), side.end(), 0);
    for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
      if (wanted(nodes_[idx(n)])) join_around(n, side);
    }
    for (std::size_t i = 0; i < side.size(); ++i) side[i] = root(side, static_cast<int>(i));
    return side;
  }

  // Whether d lies on an arc.
  bool is_on_arc(const V& d) const {
    return std::any_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) {
      return sign_of(NT(dot(arc.normal, d))) == 0 && in_arc(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, d);
    });
  }

  // Names the face of the sphere that holds d, which is on no arc.
  std::vector<int> face_of(const V& d) const {
    std::vector<int> name, done;
    for (std::size_t first = 0; first < arcs_.size(); ++first) {
      const int component = component_[first];
      if (std::find(done.begin(), done.end(), component) != done.end()) continue;
      done.push_back(component);
      int side = -1;
      for (int aim = 0; aim < 40 && side < 0; ++aim) {
        if (aim == 0) {
          side = side_met(d, first, aim);
        } else {  // from a direction beside it: it may lie on great circles of arcs
          const V by{NT(aim % 7 - 3), NT((aim * 3) % 11 - 5), NT((aim * 5) % 13 - 6)};
          if (const std::optional<V> start = moved_if_possible({d, by, by, {}}, anywhere))
            side = side_met(*start, first, aim);
        }
      }
      if (side < 0) give_up<NT>("apex: no clean way to an incident piece");
      name.push_back(face_[idx(side)]);
    }
    return name;
  }

  // The directions in which the arcs that border this face end, each once.
  std::vector<V> border_of(const std::vector<int>& face) const {
    std::vector<bool> is_end(nodes_.size(), false);
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      const auto is_side = [&](std::size_t side) {
        return std::find(face.begin(), face.end(), face_[side]) != face.end();
      };
      if (is_side(2 * i) || is_side(2 * i + 1)) is_end[idx(arcs_[i].a)] = is_end[idx(arcs_[i].b)] = true;
    }
    std::vector<V> ends;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (is_end[n]) ends.push_back(nodes_[n]);
    }
    return ends;
  }

  // How many sides of arcs that end in this direction the face has: two for each sector next to it in which the face comes there.
  int sides_at(const V& d, const std::vector<int>& face) const {
    int count = 0;
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      for (const int node : {arcs_[i].a, arcs_[i].b}) {
        if (!same_direction(nodes_[idx(node)], d)) continue;
        for (const std::size_t side : {2 * i, 2 * i + 1})
          count += std::find(face.begin(), face.end(), face_[side]) != face.end() ? 1 : 0;
      }
    }
    return count;
  }

  // Whether the great circle arc (the way) from d0, just beside d0.limit and on no arc, to d1 surely meets no
  // arc: arc by arc, by the sides of its great circle on which the ends are. On one side both: the way, less
  // than a half turn, stays there. d0 on the circle and d1 not: they have d0 in common, which is on no arc.
  // d0 beside the circle and d1 on it: they have d1 in common. On different sides: one point y; if the circle
  // holds d0.limit, y is as near to that as d0 is, and an arc, being closed, that does not hold the limit
  // does not come so near. Both on it: not surely. (Opposite ends make y zero, which counts as on the arc.)
  bool free_between(const Beside<NT>& d0, const V& d1) const {
    for (const Arc& arc : arcs_) {
      if constexpr (std::is_same_v<NT, Interval>) {
        if (passes_beside(arc, d0.limit, height(arc, d0), d1, dot(arc.normal, d1))) continue;
      }
      const int s0 = side_of(arc, d0), s1 = sign_of(NT(dot(arc.normal, d1)));
      if (s0 != 0 && s0 == s1) continue;
      if (s0 == 0 && s1 != 0) continue;
      if (s0 == 0) return false;
      if (s1 == 0 && in_arc(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, d1)) return false;
      const NT l = height(arc, d0), m = dot(arc.normal, d1);
      const NT at0 = sign_of(l) < 0 ? NT(-l) : l, at1 = sign_of(m) < 0 ? NT(-m) : m;
      const V y = sign_of(at0) == 0 ? d0.limit : V(at1 * d0.limit + at0 * d1);
      if (in_arc(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, y)) return false;
    }
    return true;
  }

  // Whether the great circle arc between two directions, less than a half turn apart, meets no arc.
  bool is_free(const V& d0, const V& d1) const {
    return std::none_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) {
      const V &a = nodes_[idx(arc.a)], &b = nodes_[idx(arc.b)];
      const NT at0 = dot(arc.normal, d0), at1 = dot(arc.normal, d1);
      if constexpr (std::is_same_v<NT, Interval>) {
        if (passes_beside(arc, d0, at0, d1, at1)) return false;
      }
      const int s0 = sign_of(at0), s1 = sign_of(at1);
      if (s0 == 0 && in_arc(a, b, arc.normal, d0)) return true;
      if (s1 == 0 && in_arc(a, b, arc.normal, d1)) return true;
      if (s0 == 0 && s1 == 0) return !same_direction(d0, d1) && in_arc(d0, d1, cross(d0, d1), a);
      return s0 * s1 < 0 && in_arc(a, b, arc.normal, V(NT(s1 * at1) * d0 + NT(s0 * at0) * d1));
    });
  }

  // Around an edge point; d and inner in one face, inner inside the cone spanned by `rays`: whether one can get from d to inner by ways that each
  // turn by less than a half turn towards a direction of the cone. Seen along the edge every piece is a ray.
  // `along(i)`: whether ray i is in one plane with d.limit and the edge.
  template <class Along>
  bool spreads(const Beside<NT>& d, const V& inner, const std::vector<V>& rays, const Along& along) const {
    const V& axis = nodes_[0];
    // Of d to w; `level`: limit, w and the edge are in one plane.
    const auto turn = [&](const V& w, bool level) {
      const V n = cross(w, axis);
      return level ? leading(NT(0), NT(dot(n, d.aside)), NT(dot(n, d.off))) : d.side_of(n);
    };
    const auto half = [&](const V& w, bool level) {  // 0: like d, 1: first half turn, 2: opposite, 3: second half turn
      const int s = turn(w, level);
      if (s != 0) return s > 0 ? 1 : 3;
      return sign_of(NT(dot(cross(axis, d.limit), cross(axis, w)))) > 0 ? 0 : 2;
    };
    bool ccw = true;  // inner comes before all pieces
    const int half_inner = half(inner, false);
    for (int i = 2; i < static_cast<int>(nodes_.size()) && ccw; ++i) {
      const bool level = std::any_of(arcs_.begin(), arcs_.end(),
                                     [&](const Arc& arc) { return (arc.a == i || arc.b == i) && is_on(arc, d); });
      const int h = half(nodes_[idx(i)], level);
      ccw = half_inner != h ? half_inner < h : det_sign(axis, inner, nodes_[idx(i)]) > 0;
    }
    const int way = ccw ? 1 : -1;
    if (turn(inner, false) == way) return true;
    // Too far for one step: by way of some w of the cone, less than a half turn from d and from inner.
    struct Forms {
      NT from_d[3], to_inner;
    };
    const NT sign(way);
    std::vector<Forms> forms;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const V n = cross(rays[i], axis);
      const NT at_limit = dot(n, d.limit);
      forms.push_back({{filtered_sign(at_limit) == kUnsure && along(i) ? NT(0) : NT(sign * at_limit),
                        NT(sign * dot(n, d.aside)), NT(sign * dot(n, d.off))},
                       NT(sign * NT(dot(axis, cross(rays[i], inner))))});
    }
    for (const Forms& a : forms) {
      if (leading(a.from_d[0], a.from_d[1], a.from_d[2]) <= 0) continue;
      for (const Forms& b : forms) {  // a alone, or a combination of a and b
        if (sign_of(b.to_inner) <= 0) continue;
        const auto minor = [&](int k) { return NT(NT(a.from_d[k] * b.to_inner) - NT(a.to_inner * b.from_d[k])); };
        if (sign_of(a.to_inner) > 0 || leading(minor(0), minor(1), minor(2)) > 0) return true;
      }
    }
    return false;
  }

 protected:
  static constexpr std::uint32_t kNoPiece = ~0U;
  struct Arc {
    int a, b;
    std::uint32_t piece;  // kNoPiece: of none
    V normal;
  };
  static std::size_t idx(int i) { return static_cast<std::size_t>(i); }
  // Of the nodes.
  std::vector<int> sides_of(const V& normal) const {
    std::vector<int> side;
    for (const V& d : nodes_) side.push_back(sign_of(NT(dot(normal, d))));
    return side;
  }
  // Once all arcs are there.
  void find_faces() {
    face_ = joined_sides([](const V&) { return true; });
    std::vector<int> of_node(nodes_.size());
    std::iota(of_node.begin(), of_node.end(), 0);
    for (const Arc& arc : arcs_) {
      const int from = of_node[idx(arc.a)], to = of_node[idx(arc.b)];
      std::replace(of_node.begin(), of_node.end(), from, to);
    }
    component_.clear();
    for (const Arc& arc : arcs_) component_.push_back(of_node[idx(arc.a)]);
  }

  const LocalScene* scene_;
  const ExactPoint* x_;
  std::vector<V> nodes_;
  std::vector<Arc> arcs_;
  std::vector<int> face_, component_;  // of sides of arcs; of arcs

 private:
  static constexpr auto anywhere = [](const V&) { return true; };

  // Whether the arc's great circle holds the limit of d because both are of one piece: then no sign need be computed.
  bool is_on(const Arc& arc, const Beside<NT>& d) const {
    if (arc.piece == kNoPiece) return false;
    const LocalPiece& piece = scene_->pieces[arc.piece];
    const auto& ids = d.at.kind == SpotName::Kind::vertex ? piece.corners : piece.edges;
    return d.at.kind != SpotName::Kind::none && std::find(ids.begin(), ids.end(), d.at.id) != ids.end();
  }
  NT height(const Arc& arc, const Beside<NT>& d) const { return is_on(arc, d) ? NT(0) : NT(dot(arc.normal, d.limit)); }
  int side_of(const Arc& arc, const Beside<NT>& d) const {
    if (!is_on(arc, d)) return d.side_of(arc.normal);
    return leading(NT(0), NT(dot(arc.normal, d.aside)), NT(dot(arc.normal, d.off)));
  }

  // Intervals do not tell on which side of an arc's great circle something is that another arc, of a surface that is nearly flat, has in common with it. That need not matter: where
  // the circle is met, the arc may be elsewhere. Surely; y holds the place.
  static bool misses(const V& a, const V& b, const V& normal, const V& y) {
    return filtered_sign(NT(dot(normal, cross(a, y)))) == -1 || filtered_sign(NT(dot(normal, cross(y, b)))) == -1;
  }
  // Of the way from d to e, with these heights over the arc's great circle, one of which is unsure.
  bool passes_beside(const Arc& arc, const V& d, const Interval& at_d, const V& e, const Interval& at_e) const {
    if ((filtered_sign(at_d) == kUnsure) == (filtered_sign(at_e) == kUnsure)) return false;
    return misses(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, CGAL::abs(at_e) * d + CGAL::abs(at_d) * e);
  }
  // Whether m, moved from d, is where d is with respect to an arc.
  bool is_beside(const Arc& arc, const Beside<NT>& d, const V& m) const {
    const NT at = dot(arc.normal, m);
    if constexpr (std::is_same_v<NT, Interval>) {
      if ((filtered_sign(at) == kUnsure || filtered_sign(height(arc, d)) == kUnsure) &&
          misses(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, d.limit + Interval(0, 1) * (m - d.limit)))
        return true;
    }
    return sign_of(at) == side_of(arc, d);
  }

  static int root(const std::vector<int>& joined, int side) {
    while (joined[idx(side)] != side) side = joined[idx(side)];
    return side;
  }

  void join_around(int n, std::vector<int>& joined) const {
    struct Spoke {
      int arc, to, left, right;
    };
    std::vector<Spoke> spokes;
    for (int i = 0; i < static_cast<int>(arcs_.size()); ++i) {
      if (arcs_[idx(i)].a == n) spokes.push_back({i, arcs_[idx(i)].b, 2 * i, 2 * i + 1});
      if (arcs_[idx(i)].b == n) spokes.push_back({i, arcs_[idx(i)].a, 2 * i + 1, 2 * i});
    }
    if (spokes.empty()) return;
    if (spokes.size() > 2) {
      const V& axis = nodes_[idx(n)];
      const V& zero = nodes_[idx(spokes.front().to)];
      std::sort(spokes.begin() + 1, spokes.end(), [&](const Spoke& s, const Spoke& t) {
        if (s.to == t.to) return false;
        const V &to_s = nodes_[idx(s.to)], &to_t = nodes_[idx(t.to)];
        const int hs = half_turn(axis, zero, to_s), ht = half_turn(axis, zero, to_t);
        return hs != ht ? hs < ht : det_sign(axis, to_s, to_t) > 0;
      });
    }
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Spoke &s = spokes[i], &t = spokes[(i + 1) % spokes.size()];
      joined[idx(root(joined, s.left))] = root(joined, t.right);
    }
  }

  // The side of the first arc of this component on the way from d to a point of one of its arcs; -1: not a clean way, or not surely one. Every
  // clean way leads to the same face, so there is no need to decide what is unsure.
  int side_met(const V& d, std::size_t aim_arc, int aim) const {
    const V target =
        NT(1 + aim) * nodes_[idx(arcs_[aim_arc].a)] + NT(1 + (aim * 7) % 11) * nodes_[idx(arcs_[aim_arc].b)];
    int side = -1;
    NT nearest_above(2), nearest_below(1);  // of the way from d to the target, as a fraction
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      if (component_[i] != component_[aim_arc]) continue;
      const Arc& arc = arcs_[i];
      if (i != aim_arc && arc.piece == arcs_[aim_arc].piece)
        continue;  // in one great circle, which the way meets at its end
      const NT at_d = dot(arc.normal, d), at_target = i == aim_arc ? NT(0) : NT(dot(arc.normal, target));
      const int sd = filtered_sign(at_d), st = filtered_sign(at_target);
      if constexpr (std::is_same_v<NT, Interval>) {
        if (passes_beside(arc, d, at_d, target, at_target)) continue;
      }
      if (sd == kUnsure || st == kUnsure || (sd == 0 && st == 0)) return -1;
      if (sd == 0 || sd == st) continue;
      const NT above = sd > 0 ? at_d : NT(-at_d), beyond = sd > 0 ? NT(-at_target) : at_target, below = above + beyond;
      const int later = side < 0 ? -1 : filtered_sign(NT(NT(above * nearest_below) - NT(nearest_above * below)));
      if (later == 0 || later == 1) continue;
      const V y = i == aim_arc ? target : V(beyond * d + above * target);
      const V &a = nodes_[idx(arc.a)], &b = nodes_[idx(arc.b)];
      const int after_a = filtered_sign(dot(arc.normal, cross(a, y)));
      if (after_a < 0) continue;
      const int before_b = filtered_sign(dot(arc.normal, cross(y, b)));
      if (before_b < 0) continue;
      if (after_a != 1 || before_b != 1 || later == kUnsure) return -1;
      nearest_above = above;
      nearest_below = below;
      side = static_cast<int>(2 * i) + (sd > 0 ? 0 : 1);
    }
    return side;
  }
};

}  // namespace clues::fastpath
