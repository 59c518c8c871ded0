// Where a walk (D14) would go on for ever: grooves, corners, and their slices where the cell is a segment. The argument is
// that of the reference (reference/visibility/labels/walk.h; docs/definition.md 6).
#include <algorithm>
#include <set>

#include "fastpath/visibility/labels/corner.h"
#include "fastpath/visibility/labels/walker.h"
#include "fastpath/visibility/points/near_enough.h"

namespace clues::fastpath {

bool Walker::is_wall(std::uint32_t piece, const Surface& of, const Surface& other) const {
  const auto& c = scene_->pieces[piece].corners;
  if (piece != of.piece) {
    const Plane& h = scene_->planes[of.piece];
    if (!std::all_of(c.begin(), c.end(), [&](std::uint32_t i) { return h.side(scene_->points[i]) == 0; })) return false;
  }
  return std::any_of(c.begin(), c.end(), [&](std::uint32_t i) { return height_sign(other, scene_->points[i]) > 0; });
}

Walker::Wall Walker::wall_of(const Surface& a, const Surface& b) const {
  Wall wall{{a.piece}, {}};
  std::set<std::uint32_t> met{a.piece};
  for (std::size_t i = 0; i < wall.pieces.size(); ++i) {
    for (const std::uint32_t id : scene_->pieces[wall.pieces[i]].edges) {
      const auto& pieces = scene_->edges[id].pieces;
      if (std::any_of(pieces.begin(), pieces.end(), [&](std::uint32_t t) { return is_wall(t, b, a); })) {
        wall.edges.push_back(id);
        continue;
      }
      for (const std::uint32_t t : pieces) {
        if (is_wall(t, a, b) && met.insert(t).second) wall.pieces.push_back(t);
      }
    }
  }
  return wall;
}

bool Walker::is_whole_at(std::uint32_t point, std::uint32_t from, std::uint32_t to, const Surface& wall,
                         const Surface& other) const {
  std::optional<std::uint32_t> piece;
  for (std::uint32_t edge = from; edge != to;) {
    const std::vector<std::uint32_t>& pieces = scene_->edges[edge].pieces;
    const auto next = std::find_if(pieces.begin(), pieces.end(),
                                   [&](std::uint32_t t) { return t != piece && is_wall(t, wall, other); });
    if (next == pieces.end()) return false;
    piece = *next;
    const auto& edges = scene_->pieces[*piece].edges;
    edge = *std::find_if(edges.begin(), edges.end(), [&](std::uint32_t id) {
      return id != edge && (scene_->edges[id].a == point || scene_->edges[id].b == point);
    });
  }
  return true;
}

Walker::Chain Walker::chain_of(std::size_t first, const std::vector<std::uint32_t>& edges, const Surface& a,
                               const Surface& b) const {
  const std::uint32_t e0 = edges[first];
  Chain ends{GrooveEnd{scene_->edges[e0].a, e0}, GrooveEnd{scene_->edges[e0].b, e0}};
  std::vector<bool> used(edges.size(), false);
  used[first] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const LocalEdge& e = scene_->edges[edges[i]];
      for (GrooveEnd& end : ends) {
        if (used[i] || (e.a != end.point && e.b != end.point)) continue;
        if (!is_whole_at(end.point, end.edge, edges[i], a, b) || !is_whole_at(end.point, end.edge, edges[i], b, a))
          continue;
        end = {e.a == end.point ? e.b : e.a, edges[i]};
        used[i] = grown = true;
      }
    }
  }
  return ends;
}

Walker::Both Walker::in_front_of_both(const Surface& a, const Surface& b, const std::optional<Ends>& ends) const {
  const auto& vertices = scene_->cell.vertices;
  return decide([&]<class NT>() {
    const auto height = [&](const Surface& s, const ExactPoint& x) {
      const Plane& h = scene_->planes[s.piece];
      return NT(NT(s.side) * dot(normal_of<NT>(h), coordinates<NT>(x) - coordinates<NT>(h.base())));
    };
    std::vector<NT> ha, hb;
    for (const ExactPoint& s : vertices) {
      ha.push_back(height(a, s));
      hb.push_back(height(b, s));
    }
    bool touches = false, upon_edge = true;
    // Of the line of both walls, the point of V that divides the way from i to j in these parts.
    const auto touch = [&](std::size_t i, const NT& from_j, std::size_t j, const NT& from_i) {
      touches = true;
      if (!ends) return;
      const auto x = coordinates<NT>(scene_->points[ends->of[0].point]),
                 y = coordinates<NT>(scene_->points[ends->of[1].point]);
      const auto past = [&](const Vec3<NT>& end) {
        const auto along = [&](std::size_t k) { return dot(y - x, coordinates<NT>(vertices[k]) - end); };
        return sign_of(NT(NT(from_j * along(i)) + NT(from_i * along(j))));
      };
      upon_edge = upon_edge && (ends->closed[0] || past(x) >= 0) && (ends->closed[1] || past(y) <= 0);
    };
    for (std::size_t i = 0; i < ha.size(); ++i) {
      const int ai = sign_of(ha[i]), bi = sign_of(hb[i]);
      if (ai > 0 && bi > 0) return Both::meet;
      if (ai == 0 && bi == 0) {
        touch(i, NT(1), i, NT(0));
      } else if (ai >= 0 && bi >= 0) {
        touches = true;
        upon_edge = false;
      }
      if (ai <= 0) continue;
      for (std::size_t j = 0; j < ha.size(); ++j) {
        if (sign_of(ha[j]) >= 0) continue;
        // The second height where the first is zero.
        const int s = sign_of(NT(NT(hb[j] * ha[i]) - NT(hb[i] * ha[j])));
        if (s > 0) return Both::meet;
        if (s == 0) touch(i, NT(-ha[j]), j, ha[i]);
      }
    }
    return touches && !(ends && upon_edge) ? Both::touch : Both::apart;
  });
}

bool Walker::is_dark_over(const Chain& chain, const Surface& on, const Surface& before, const ExactPoint& q) const {
  const auto is_dark_with = [&](bool first_closed, bool second_closed) {
    return in_front_of_both(on, before, Ends{chain, {first_closed, second_closed}}) == Both::apart;
  };
  if (is_dark_with(false, false)) return true;
  if (!is_dark_with(true, true)) return false;
  const std::size_t first = is_dark_with(false, true) ? 1 : 0, count = first == 1 || is_dark_with(true, false) ? 1 : 2;
  const std::span<const GrooveEnd> passed = std::span(chain).subspan(first, count);  // V touches the line beyond these
  const auto is_between_walls = [&](std::uint32_t piece) {
    const auto& c = scene_->pieces[piece].corners;
    return std::any_of(c.begin(), c.end(), [&](std::uint32_t i) {
      return height_sign(on, scene_->points[i]) > 0 && height_sign(before, scene_->points[i]) > 0;
    });
  };
  return std::none_of(passed.begin(), passed.end(),
                      [&](const GrooveEnd& end) {
                        const auto& pieces = scene_->edges[end.edge].pieces;
                        return std::any_of(pieces.begin(), pieces.end(), is_between_walls);
                      }) &&
         closes_groove(*scene_, passed, q);
}

std::vector<const ExactPoint*> Walker::ends_of_groove(const Surface& a, const Surface& b, Pool& pool) const {
  std::vector<const ExactPoint*> ends;
  const auto note = [&](const ExactPoint* x) {
    if (height_sign(b, *x) >= 0 &&
        std::none_of(ends.begin(), ends.end(), [&](const ExactPoint* end) { return equal(*end, *x); }))
      ends.push_back(x);
  };
  const auto& s = scene_->cell.vertices;
  for (const ExactPoint& x : s) {
    if (height_sign(a, x) >= 0) note(&x);
  }
  for (const ExactPoint& x : s) {
    if (height_sign(a, x) <= 0) continue;
    for (const ExactPoint& y : s) {
      if (height_sign(a, y) <= 0) note(pool.keep(ExactPoint::on_plane(x, y, scene_->planes[a.piece])));
    }
  }
  return ends;
}

const ExactPoint* Walker::along_groove(const ExactPoint& p, const Surface& on, const Surface& before,
                                       Pool& pool) const {
  const ExactPoint* far = in_front(on, nullptr, 0, pool);
  if (!far) return nullptr;
  const Plane& wall = scene_->planes[before.piece];
  const auto is_of_wall = [&](std::uint32_t piece) {  // which may be in many pieces
    const auto& c = scene_->pieces[piece].corners;
    return std::all_of(c.begin(), c.end(), [&](std::uint32_t i) { return wall.side(scene_->points[i]) == 0; });
  };
  for (const ExactPoint* end : ends_of_groove(on, before, pool)) {
    for (int k = 3; k <= 60; k += 3) {
      const ExactPoint v = ExactPoint::between(*end, *far, std::ldexp(1.0, -k));
      const LocalScene::Last last = scene_->last_crossing(v, p);
      if (!last.degenerate && !(last.piece && is_of_wall(*last.piece))) return pool.keep(v);
    }
  }
  return nullptr;
}

template <class Skip>
bool Walker::is_blocked(const ExactPoint& y, const ExactPoint& q, const Skip& skip) const {
  return scene_->tree.any(SegmentTest(y, q), [&](std::uint32_t occluder) {
    const std::uint32_t t = scene_->occluders[occluder];
    return !skip(t) && scene_->crosses(y, q, t) != Crossing::no;
  });
}

// A groove between two walls that meet in an edge, into which no point of V looks: the walk would go from one wall to the
// other for ever, towards the edge. Beside the edge all is hidden, as V touches the edge's line nowhere but upon the edge
// (docs/definition.md, D14); so it ends with a leg from the edge.
bool Walker::groove_leg(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const {
  const std::size_t n = walk.legs.size();
  if (!is_wall(walk.legs[n - 3].piece, on, before) || !is_wall(walk.legs[n - 4].piece, before, on)) return false;
  return scene_->cell.dimension == 1 ? leg_in_slice(walk, on, before, how, pool)
                                     : leg_from_edge(walk, on, before, how, pool);
}

bool Walker::leg_from_edge(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const {
  const Leg& last = walk.legs.back();
  // It is rounded, and has to be in the groove for all that.
  if (height_sign(on, *last.next) <= 0 || height_sign(before, *last.next) <= 0) return false;
  const std::vector<std::uint32_t> common = wall_of(on, before).edges;
  for (std::size_t i = 0; i < common.size(); ++i) {
    const LocalEdge& e = scene_->edges[common[i]];
    const ExactPoint &a = scene_->points[e.a], &b = scene_->points[e.b];
    const Point pa = a.estimate(), pb = b.estimate(), q = last.next->estimate();
    double along = 0, length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      along += (q[k] - pa[k]) * (pb[k] - pa[k]);
      length += (pb[k] - pa[k]) * (pb[k] - pa[k]);
    }
    const double t = along / length;
    if (!(t > 0 && t < 1)) continue;
    // Where V touches the line beyond this chain of edges, sight lines come in through the gap.
    if (how == Both::touch && !is_dark_over(chain_of(i, common, on, before), on, before, *last.next)) continue;
    const ExactPoint* y = pool.keep(ExactPoint::between(a, b, t));
    if (scene_->cell.divides(*y, *last.next)) continue;
    const auto at_y = [&](std::uint32_t wall) {
      return std::find(e.pieces.begin(), e.pieces.end(), wall) != e.pieces.end();
    };
    if (is_blocked(*y, *last.next, at_y)) return false;
    const auto at_edge =
        std::find_if(e.pieces.begin(), e.pieces.end(), [&](std::uint32_t t2) { return is_wall(t2, on, before); });
    if (at_edge == e.pieces.end()) continue;
    walk.legs.push_back({y, last.next, nullptr, *at_edge, on.side, true, false});
    return true;
  }
  return false;
}

// In the plane through the cell, a segment, and the last point of the walk: with the normal n, divided by the line of V, and
// the point is above that line. Rare enough for rationals throughout.
bool Walker::leg_in_slice(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const {
  const Leg& last = walk.legs.back();
  const ExactPoint& q = *last.next;
  const auto& s = scene_->cell.vertices;
  const auto normal = [&](const Surface& of) {
    const Exact3& m = scene_->planes[of.piece].normal_exact();
    return of.side > 0 ? m : -m;
  };
  const Exact3 u = s[1].exact() - s[0].exact(), n = cross(u, q.exact() - s[0].exact()), up = cross(n, u);
  const Exact3 at_wall = normal(on), at_other = normal(before);
  const Rational volume = dot(n, cross(at_wall, at_other));
  if (sign_of(volume) == 0) return false;  // no tip in this slice
  if (height_sign(on, q) <= 0 || height_sign(before, q) <= 0) return false;
  // n . (y - s0) = 0, and y is in both planes.
  const auto part = [&](const Surface& of) {
    return Rational(-of.side * scene_->planes[of.piece].value_exact(s[0]) / volume);
  };
  const Exact3 to_y = part(on) * cross(at_other, n) + part(before) * cross(n, at_wall);
  // The rays of the walls: in the slice and its plane, before the other wall.
  Exact3 along_wall = cross(n, at_wall), along_other = cross(n, at_other);
  if (sign_of(dot(along_wall, at_other)) < 0) along_wall = -along_wall;
  if (sign_of(dot(along_other, at_wall)) < 0) along_other = -along_other;
  const int level = sign_of(dot(up, to_y));
  if (level < 0) return false;
  const bool above = level == 0 && sign_of(dot(up, along_wall)) > 0 && sign_of(dot(up, along_other)) > 0;
  if (how != Both::apart && !above) return false;
  const ExactPoint* y = pool.keep(ExactPoint(s[0].exact() + to_y));
  const std::optional<std::uint32_t> piece = piece_from(*y, along_wall, on, before);
  if (!piece || !piece_from(*y, along_other, before, on)) return false;
  const auto leaves_plane = [&](std::uint32_t t) {
    return scene_->planes[t].side(*y) == 0 && scene_->planes[t].side(q) != 0;
  };
  if (is_blocked(*y, q, leaves_plane)) return false;
  walk.legs.push_back({y, &q, nullptr, *piece, last.side, false, true});
  return true;
}

std::optional<std::uint32_t> Walker::piece_from(const ExactPoint& y, const Exact3& d, const Surface& wall,
                                                const Surface& other) const {
  const auto holds = [&](std::uint32_t t) {
    const auto& c = scene_->pieces[t].corners;
    const auto corner = [&](std::size_t i) -> const Exact3& { return scene_->points[c[i]].exact(); };
    const Exact3 m = cross(corner(1) - corner(0), corner(2) - corner(0));
    const auto inside = [&](std::size_t from, std::size_t to) {
      const Exact3 inwards = cross(m, corner(to) - corner(from));
      const int at_y = sign_of(dot(inwards, y.exact() - corner(from)));
      return at_y > 0 || (at_y == 0 && sign_of(dot(inwards, d)) >= 0);
    };
    return inside(0, 1) && inside(1, 2) && inside(2, 0);
  };
  const std::vector<std::uint32_t> pieces = wall_of(wall, other).pieces;
  const auto found = std::find_if(pieces.begin(), pieces.end(), holds);
  return found == pieces.end() ? std::nullopt : std::optional(*found);
}

// Several walls that meet in a corner, into which no point of V looks.
bool Walker::corner_leg(Walk& walk, Pool& pool) const {
  constexpr std::size_t kTurns = 6;
  const std::size_t n = walk.legs.size();
  if (n < kTurns || n % 3 != 0 || scene_->cell.dimension == 1) return false;  // leg_in_slice() sees to those
  const Leg& last = walk.legs.back();
  for (const std::uint32_t corner : scene_->pieces[last.piece].corners) {
    const bool of_all = std::all_of(walk.legs.end() - kTurns, walk.legs.end(), [&](const Leg& leg) {
      const auto& c = scene_->pieces[leg.piece].corners;
      return std::find(c.begin(), c.end(), corner) != c.end();
    });
    if (!of_all) continue;
    const ExactPoint& y = scene_->points[corner];
    if (scene_->cell.divides(y, *last.next)) continue;
    const auto& incident = scene_->point_pieces[corner];
    const auto at_y = [&](std::uint32_t t) { return std::find(incident.begin(), incident.end(), t) != incident.end(); };
    if (is_blocked(y, *last.next, at_y) || !is_dark_corner(*scene_, corner, *last.next)) continue;
    walk.legs.push_back({&y, last.next, nullptr, last.piece, last.side, false, true});
    return true;
  }
  return leg_from_edge_at_corner(walk, pool);
}

bool Walker::leg_from_edge_at_corner(Walk& walk, Pool& pool) const {
  const std::size_t n = walk.legs.size();
  for (const auto& [i, j] : {std::pair(n - 1, n - 2), std::pair(n - 1, n - 3), std::pair(n - 2, n - 3)}) {
    const Surface on{walk.legs[i].piece, walk.legs[i].side}, other{walk.legs[j].piece, walk.legs[j].side};
    const Both how = in_front_of_both(on, other, std::nullopt);
    if (how != Both::meet && leg_from_edge(walk, on, other, how, pool)) return true;
  }
  return false;
}

}  // namespace clues::fastpath
