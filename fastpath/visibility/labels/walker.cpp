#include "fastpath/visibility/labels/walker.h"

#include <algorithm>

#include "exact/mix.h"
#include "fastpath/visibility/points/near_enough.h"

namespace clues::fastpath {

using exact::mix;

namespace {

constexpr std::int64_t kLongestWalk = 48;  // legs
constexpr int kAttempts = 40;              // sight lines in special position in a row
constexpr int kRefused = 8;                // and that come through elsewhere, before a nearer place is better
constexpr std::size_t kLegsInGroove = 4;   // before it is taken for one

constexpr auto kNothing = [](const Plane&) { return false; };

}  // namespace

bool keeps_out(const Walk& walk, const LeftOut& left_out) {
  return walk.all_ways_aside(
      [&](const IntervalBox& from, const IntervalBox& to) { return left_out.surely_misses(from, to); });
}

bool keeps_out(const Walk& walk, const LeftOut& left_out, std::size_t i) {
  return walk.all_ways_aside(
      [&](const IntervalBox& from, const IntervalBox& to) { return left_out.surely_misses(i, from, to); });
}

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
    // Closer and closer to the vertex, by 2^-k; where doubles are too coarse for that, exactly, and as near as planes of doubles may come to it (walker.h).
    constexpr int kSteady = 20, kLevels = kSteady + 7;
    const auto place = [&](int level) {
      const int k = level < kSteady ? 2 + 3 * level : 62 << (level - kSteady);
      const auto part = [&](std::size_t j) { return static_cast<double>(1 + mix(seed * 31 + j) % 61); };
      if (k < 40) {
        std::vector<double> weights(s.size());
        for (std::size_t j = 0; j < s.size(); ++j) weights[j] = j == i ? 61 : std::ldexp(part(j), -k);
        return scene_->cell.interior_point(weights);
      }
      std::vector<Rational> weights(s.size());
      for (std::size_t j = 0; j < s.size(); ++j) {
        weights[j] = j == i ? 61 : part(j);
        if (j != i) mpq_div_2exp(weights[j].get_mpq_t(), weights[j].get_mpq_t(), static_cast<mp_bitcnt_t>(k));
      }
      return scene_->cell.combination(weights);
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

Walk Walker::walk(const ExactPoint* p, Pool& pool, const Manner& manner, const MayCome& may_come) const {
  Walk walk;
  if (scene_->cell.contains(*p)) {
    walk.end = Walk::End::cell;
    return walk;
  }
  std::optional<Surface> on, before;
  int refused = 0;
  for (std::int64_t depth = 0; depth < longest_; ++depth) {
    if (walk.legs.size() >= manner.least && corner_leg(walk, pool)) {
      walk.end = Walk::End::surface;
      return walk;
    }
    bool both = false;
    const ExactPoint* along = nullptr;
    if (before) {
      const Both how = in_front_of_both(*on, *before, std::nullopt);
      both = how == Both::meet;
      if (!both && walk.legs.size() >= std::max(manner.least, kLegsInGroove)) {  // by now it may be one
        if (groove_leg(walk, *on, *before, how, pool)) {
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
      const std::uint64_t number = mix(manner.seed * 1000003 + static_cast<std::uint64_t>(depth * 1009 + attempt));
      const ExactPoint* v = viewpoint(number);
      if (on) {
        v = both ? in_front(*on, &*before, number, pool) : attempt == 0 ? along : nullptr;
        if (!v) v = in_front(*on, nullptr, number, pool);
        if (!v) {
          walk.end = scene_->faces_cell(on->piece, on->side) ? Walk::End::unresolved : Walk::End::surface;
          return walk;
        }
      }
      const LocalScene::Last last = scene_->last_crossing(*v, *p);
      if (last.degenerate) continue;
      if (!last.piece) {
        walk.end = Walk::End::cell;
        return walk;
      }
      if (depth == 0 && may_come && !may_come(*v)) {
        if (++refused == kRefused) break;
        continue;
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
      int level = manner.near;
      const auto next = near_enough(level, *m, *p, [&](const ExactPoint& x) {
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
  walk.from_nowhere = refused > 0 && walk.legs.empty();
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
  if (walk.end == Walk::End::unresolved) return Crossing::yes;
  Crossing result = Crossing::no;
  for (const Leg& leg : walk.legs) {
    if (!leg.is_sight_line()) return result;
    const Crossing c = leg_crossed(leg, first);
    if (c == Crossing::yes) return c;
    if (c == Crossing::touch) result = c;
    if (leg.next && pieces_->may_meet(*leg.next, *leg.p, first, kNothing)) return Crossing::touch;
  }
  return walk.end == Walk::End::surface ? result : Crossing::yes;
}

Crossing Walker::visible_by_last_leg(const Walk& walk, std::size_t first) const {
  return walk.ends_in_the_dark() ? leg_crossed(walk.legs.back(), first) : Crossing::no;
}

bool Walker::is_met(const Walk& walk, std::size_t first) const {
  return std::any_of(walk.legs.begin(), walk.legs.end(), [&](const Leg& leg) {
    return leg_crossed(leg, first) != Crossing::no ||
           (leg.next && pieces_->may_meet(*leg.next, *leg.p, first, kNothing));
  });
}

bool Walker::last_leg_is_in_doubt(const Walk& walk) const {
  return walk.ends_in_the_dark() && pieces_->may_leave(*walk.legs.back().m, *walk.legs.back().p);
}

Walker::Label Walker::label(const ExactPoint* p, const LeftOut& left_out, Pool& pool, std::uint64_t seed) const {
  for (std::uint64_t attempt = 0; attempt < 12; ++attempt) {
    const Walk made = walk(p, pool, {seed + attempt * 7919});
    if (made.end == Walk::End::unresolved) continue;
    if (made.end != Walk::End::surface) return Label::visible;
    const Crossing last = visible_by_last_leg(made, 0);  // no other leg is crossed: the walk went on
    if (last == Crossing::yes && !last_leg_is_in_doubt(made)) return Label::visible;
    if (last != Crossing::no) continue;
    if (keeps_out(made, left_out)) return Label::hidden;
  }
  return Label::unresolved;
}

}  // namespace clues::fastpath
