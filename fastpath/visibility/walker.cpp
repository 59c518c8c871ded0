#include "fastpath/visibility/walker.h"

#include <algorithm>
#include <set>

#include "fastpath/visibility/corner.h"
#include "fastpath/visibility/near_enough.h"

namespace clues::fastpath {

namespace {

constexpr std::int64_t kLongestWalk = 48;  // legs
constexpr int kAttempts = 40;              // sight lines in special position in a row

std::uint64_t mix(std::uint64_t x) {  // splitmix64's finisher
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr auto kNothing = [](const Plane&) { return false; };

}  // namespace

Walker::Walker(const LocalScene& scene, const PieceSet& pieces, std::int64_t longest)
    : scene_(&scene), pieces_(&pieces), longest_(longest == exact::Dials::kOwn ? kLongestWalk : longest) {
  const RoundedUp rounded_up;
  const std::size_t n = scene.cell.vertices.size();
  const std::size_t count = n == 1 ? 1 : 61;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> weights;
    for (std::size_t k = 0; k < n; ++k) weights.push_back(static_cast<double>(1 + mix(i * 1009 + k) % 4093));
    viewpoints_.push_back(own_.keep(scene.cell.interior_point(weights)));
  }
}

int Walker::height_sign(const Surface& s, const ExactPoint& x) const {
  return s.side * scene_->planes[s.piece].side(x);
}

const ExactPoint* Walker::in_front(const Surface& on, const Surface* also, std::uint64_t seed, Pool& pool) const {
  const auto good = [&](const ExactPoint& v) { return height_sign(on, v) > 0 && (!also || height_sign(*also, v) > 0); };
  for (std::uint64_t i = 0; i < 8; ++i) {
    const ExactPoint* v = viewpoint(mix(seed + i));
    if (good(*v)) return v;
  }
  const auto& s = scene_->cell.vertices;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!good(s[i])) continue;
    // Closer and closer to the vertex, by 2^-k; where doubles are too coarse for that, exactly.
    constexpr int kSteady = 20, kLevels = kSteady + 5;
    const auto place = [&](int level) {
      const int k = level < kSteady ? 2 + 3 * level : 62 << (level - kSteady);
      std::vector<double> weights(s.size());
      for (std::size_t j = 0; j < s.size(); ++j)
        weights[j] = std::ldexp(static_cast<double>(1 + mix(seed * 31 + j) % 61), j == i ? 0 : -k);
      weights[i] = 61;
      return k < 40 ? scene_->cell.interior_point(weights) : scene_->cell.combination(weights);
    };
    if (const auto v = near_enough(kLevels, place, good)) return pool.keep(*v);
  }
  if (!also) return nullptr;
  // An edge or a diagonal of V may cross the space between the planes: where it leaves the first, and a little before; and beside that, inside V.
  for (std::size_t i = 0; i < s.size(); ++i) {
    for (std::size_t j = 0; j < s.size(); ++j) {
      if (height_sign(on, s[i]) <= 0 || height_sign(on, s[j]) > 0) continue;
      // A point refers to those that it is made of: they are kept.
      const ExactPoint* x = pool.keep(ExactPoint::on_plane(s[i], s[j], scene_->planes[on.piece]));
      if (height_sign(*also, *x) <= 0) continue;
      const auto nearer = [&](const ExactPoint& from, const ExactPoint& to, std::uint64_t first) {
        return near_enough(
            200,
            [&](int k) { return ExactPoint::between(from, to, std::ldexp(1.0, -static_cast<int>(first) - 2 * k)); },
            good);
      };
      const auto between = nearer(*x, s[i], 1);
      if (!between) continue;
      const auto v = nearer(*pool.keep(*between), *viewpoint(seed), 1 + mix(seed) % 3);
      if (v) return pool.keep(*v);
    }
  }
  return nullptr;
}

bool Walker::is_wall(std::uint32_t piece, const Surface& of, const Surface& other) const {
  const auto& c = scene_->pieces[piece].corners;
  if (piece != of.piece) {
    const Plane& h = scene_->planes[of.piece];
    if (!std::all_of(c.begin(), c.end(), [&](std::uint32_t i) { return h.side(scene_->points[i]) == 0; })) return false;
  }
  return std::any_of(c.begin(), c.end(), [&](std::uint32_t i) { return height_sign(other, scene_->points[i]) > 0; });
}

std::vector<std::uint32_t> Walker::common_edges(const Surface& a, const Surface& b) const {
  std::vector<std::uint32_t> found, wall{a.piece};
  std::set<std::uint32_t> met{a.piece};
  for (std::size_t i = 0; i < wall.size(); ++i) {
    for (const std::uint32_t id : scene_->pieces[wall[i]].edges) {
      const auto& pieces = scene_->edges[id].pieces;
      if (std::any_of(pieces.begin(), pieces.end(), [&](std::uint32_t t) { return is_wall(t, b, a); })) {
        found.push_back(id);
        continue;
      }
      for (const std::uint32_t t : pieces) {
        if (is_wall(t, a, b) && met.insert(t).second) wall.push_back(t);
      }
    }
  }
  return found;
}

Walker::Chain Walker::chain_of(std::size_t first, const std::vector<std::uint32_t>& edges) const {
  Chain ends{scene_->edges[edges[first]].a, scene_->edges[edges[first]].b};
  std::vector<bool> used(edges.size(), false);
  used[first] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const LocalEdge& e = scene_->edges[edges[i]];
      for (std::uint32_t& end : ends) {
        if (used[i] || (e.a != end && e.b != end)) continue;
        end = e.a == end ? e.b : e.a;
        used[i] = grown = true;
      }
    }
  }
  return ends;
}

Walker::Both Walker::in_front_of_both(const Surface& a, const Surface& b, const std::optional<Chain>& ends) const {
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
      const auto x = coordinates<NT>(scene_->points[(*ends)[0]]), y = coordinates<NT>(scene_->points[(*ends)[1]]);
      const auto past = [&](const Vec3<NT>& end) {
        const auto along = [&](std::size_t k) { return dot(y - x, coordinates<NT>(vertices[k]) - end); };
        return sign_of(NT(NT(from_j * along(i)) + NT(from_i * along(j))));
      };
      upon_edge = upon_edge && past(x) >= 0 && past(y) <= 0;
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

const ExactPoint* Walker::along_groove(const ExactPoint& p, const Surface& on, const Surface& before,
                                       Pool& pool) const {
  const ExactPoint* far = in_front(on, nullptr, 0, pool);
  if (!far) return nullptr;
  // Where the closed V touches the space in front of both: a vertex, or a point where an edge or a diagonal of V leaves the space in front of the first.
  const auto& s = scene_->cell.vertices;
  const ExactPoint* end = nullptr;
  for (const ExactPoint& x : s) {
    if (!end && height_sign(on, x) >= 0 && height_sign(before, x) >= 0) end = &x;
  }
  for (std::size_t i = 0; i < s.size() && !end; ++i) {
    for (std::size_t j = 0; j < s.size() && !end; ++j) {
      if (height_sign(on, s[i]) <= 0 || height_sign(on, s[j]) > 0) continue;
      const ExactPoint* x = pool.keep(ExactPoint::on_plane(s[i], s[j], scene_->planes[on.piece]));
      if (height_sign(before, *x) >= 0) end = x;
    }
  }
  if (!end) return nullptr;
  for (int k = 3; k <= 60; k += 3) {
    const ExactPoint v = ExactPoint::between(*end, *far, std::ldexp(1.0, -k));
    const LocalScene::Last last = scene_->last_crossing(v, p);
    if (!last.degenerate && last.piece != before.piece) return pool.keep(v);
  }
  return nullptr;
}

// A groove between two walls that meet in an edge, into which no point of V looks: the walk would go from one wall to the other for ever, towards
// the edge. Beside the edge all is hidden, as V touches the edge's line nowhere but upon the edge (docs/definition.md, D14); so it ends with a leg from the edge.
bool Walker::groove_leg(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const {
  const Leg& last = walk.legs.back();
  const std::vector<std::uint32_t> common = common_edges(on, before);
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
    if (how == Both::touch && in_front_of_both(on, before, chain_of(i, common)) != Both::apart) continue;
    const ExactPoint* y = pool.keep(ExactPoint::between(a, b, t));
    if (scene_->cell.divides(*y, *last.next)) continue;
    const bool blocked = scene_->tree.any(SegmentTest(*y, *last.next), [&](std::uint32_t occluder) {
      const std::uint32_t piece = scene_->occluders[occluder];
      if (std::find(e.pieces.begin(), e.pieces.end(), piece) != e.pieces.end()) return false;
      return scene_->crosses(*y, *last.next, piece) != Crossing::no;
    });
    if (blocked) return false;
    const auto at_edge =
        std::find_if(e.pieces.begin(), e.pieces.end(), [&](std::uint32_t t2) { return is_wall(t2, on, before); });
    if (at_edge == e.pieces.end()) continue;
    walk.legs.push_back({y, last.next, nullptr, *at_edge, last.side, true, false});
    return true;
  }
  return false;
}

// Several walls that meet in a corner, into which no point of V looks.
bool Walker::corner_leg(Walk& walk) const {
  constexpr std::size_t kTurns = 6;
  const std::size_t n = walk.legs.size();
  if (n < kTurns || n % 3 != 0) return false;
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
    const bool blocked = scene_->tree.any(SegmentTest(y, *last.next), [&](std::uint32_t i) {
      const std::uint32_t piece = scene_->occluders[i];
      if (std::find(incident.begin(), incident.end(), piece) != incident.end()) return false;
      return scene_->crosses(y, *last.next, piece) != Crossing::no;
    });
    if (blocked || !is_dark_corner(*scene_, corner, *last.next)) continue;
    walk.legs.push_back({&y, last.next, nullptr, last.piece, last.side, false, true});
    return true;
  }
  return false;
}

Walk Walker::walk(const ExactPoint* p, Pool& pool, std::uint64_t seed) const {
  Walk walk;
  if (scene_->cell.contains(*p)) {
    walk.end = Walk::End::cell;
    return walk;
  }
  std::optional<Surface> on, before;
  for (std::int64_t depth = 0; depth < longest_; ++depth) {
    if (corner_leg(walk)) {
      walk.end = Walk::End::surface;
      return walk;
    }
    bool both = false;
    const ExactPoint* along = nullptr;
    if (before) {
      const std::size_t n = walk.legs.size();
      const Both how = in_front_of_both(*on, *before, std::nullopt);
      both = how == Both::meet;
      if (!both && n >= 4) {  // by now it may be a groove
        if (is_wall(walk.legs[n - 3].piece, *on, *before) && is_wall(walk.legs[n - 4].piece, *before, *on) &&
            groove_leg(walk, *on, *before, how, pool)) {
          walk.end = Walk::End::surface;
          return walk;
        }
        if (how == Both::touch) along = along_groove(*p, *on, *before, pool);
      }
    }
    if (on) {  // next to a flat cell or a segment few points of V may see p: those right beneath it
      const std::optional<ExactPoint> beneath = scene_->cell.foot(*p);
      if (beneath && height_sign(*on, *beneath) > 0) {
        const LocalScene::Last last = scene_->last_crossing(*beneath, *p);
        if (!last.degenerate && !last.piece) {
          walk.end = Walk::End::cell;
          return walk;
        }
      }
    }
    bool found = false;
    for (int attempt = 0; attempt < kAttempts && !found; ++attempt) {
      const std::uint64_t number = mix(seed * 1000003 + static_cast<std::uint64_t>(depth * 1009 + attempt));
      const ExactPoint* v = viewpoint(number);
      if (on) {
        v = both ? in_front(*on, &*before, number, pool) : attempt == 0 ? along : nullptr;
        if (!v) v = in_front(*on, nullptr, number, pool);
        if (!v) {
          const auto& s = scene_->cell.vertices;
          const bool faced =
              std::any_of(s.begin(), s.end(), [&](const ExactPoint& x) { return height_sign(*on, x) > 0; });
          walk.end = faced ? Walk::End::unresolved : Walk::End::surface;
          return walk;
        }
      }
      const LocalScene::Last last = scene_->last_crossing(*v, *p);
      if (last.degenerate) continue;
      if (!last.piece) {
        walk.end = Walk::End::cell;
        return walk;
      }
      const Plane& h = scene_->planes[*last.piece];
      const ExactPoint* m = pool.keep(ExactPoint::on_plane(*v, *p, h));
      const int side = h.side(*p);
      const Crossing crossed = leg_crossed({m, p, nullptr, *last.piece, side, false}, 0);
      if (crossed == Crossing::yes) {
        walk.end = Walk::End::crossed;
        return walk;
      }
      if (crossed == Crossing::touch) continue;
      const auto next = near_enough(*m, *p, [&](const ExactPoint& x) {
        return h.side(x) == side && !scene_->may_meet(x, *p) && !scene_->is_on_surface(x) &&
               !pieces_->may_meet(x, *p, 0, kNothing);
      });
      found = next.has_value();
      if (found) walk.legs.push_back({m, p, pool.keep(*next), *last.piece, side, false});
    }
    if (!found) break;
    before = on;
    on = Surface{walk.legs.back().piece, walk.legs.back().side};
    p = walk.legs.back().next;
  }
  walk.end = Walk::End::unresolved;
  return walk;
}

Crossing Walker::leg_crossed(const Leg& leg, std::size_t first) const {
  const auto holds = [&](const Plane& h, std::uint32_t point) { return h.side(scene_->points[point]) == 0; };
  const auto holds_piece = [&](const Plane& h) {
    const auto& c = scene_->pieces[leg.piece].corners;
    return !leg.from_edge && !leg.from_corner && holds(h, c[0]) && holds(h, c[1]) && holds(h, c[2]);
  };
  const auto holds_edge = [&](const Plane& h) {  // a wedge through the edge itself runs outside the groove
    if (leg.from_corner) return true;            // the leg leaves its plane
    if (!leg.from_edge) return false;
    const auto& edges = scene_->pieces[leg.piece].edges;
    return std::any_of(edges.begin(), edges.end(),
                       [&](std::uint32_t e) { return holds(h, scene_->edges[e].a) && holds(h, scene_->edges[e].b); });
  };
  return pieces_->crossed(*leg.m, *leg.p, first, holds_piece, holds_edge);
}

Crossing Walker::visible(const Walk& walk, std::size_t first) const {
  if (walk.end != Walk::End::surface) return Crossing::yes;
  Crossing result = Crossing::no;
  for (const Leg& leg : walk.legs) {
    const Crossing c = leg_crossed(leg, first);
    if (c == Crossing::yes) return c;
    if (c == Crossing::touch) result = c;
    if (leg.next && pieces_->may_meet(*leg.next, *leg.p, first, kNothing)) result = Crossing::touch;
  }
  return result;
}

Walker::Label Walker::label(const ExactPoint* p, Pool& pool, std::uint64_t seed) const {
  for (std::uint64_t attempt = 0; attempt < 12; ++attempt) {
    const Walk made = walk(p, pool, seed + attempt * 7919);
    if (made.end == Walk::End::unresolved) continue;
    const Crossing c = visible(made, 0);
    if (c != Crossing::touch) return c == Crossing::yes ? Label::visible : Label::hidden;
  }
  return Label::unresolved;
}

}  // namespace clues::fastpath
