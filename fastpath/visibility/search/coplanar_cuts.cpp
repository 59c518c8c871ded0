#include "fastpath/visibility/search/coplanar_cuts.h"

namespace clues::fastpath {

namespace {

bool is_before(const ValidPiece& piece, const ExactPoint* q) {
  return piece.near0 && piece.on->turn(piece.near0, piece.near1, q) > 0;
}

// Whether q, on one of the piece's rays, is neither before its near edge nor beyond its blocker.
bool reaches(const ValidPiece& piece, const ExactPoint* q) {
  return !is_before(piece, q) && piece.on->reaches(piece.blocker, q);
}

// False only if all of the segment ab, in the plane, is before the near edge or beyond the blocker.
bool may_touch(const ValidPiece& piece, const ExactPoint& a, const ExactPoint& b) {
  return !(is_before(piece, &a) && is_before(piece, &b)) &&
         (piece.on->reaches(piece.blocker, &a) || piece.on->reaches(piece.blocker, &b));
}

// Whether the inside of the edge ab, in the plane, crosses the ray in one point, in front of the centre.
bool crosses_ray(const OnWedge& on, const ExactPoint* ray, const ExactPoint& a, const ExactPoint& b) {
  const int from_a = on.turn(&a, ray);
  return from_a != 0 && from_a == on.turn(ray, &b) && from_a == on.turn(&a, &b);
}

// Where the edge crosses the plane through the ray that is normal to the wedge.
ExactPoint crossing_in_plane(const OnWedge& on, const ExactPoint& ray, const ExactPoint& a, const ExactPoint& b) {
  const Exact3 &c = on.center->exact(), &n = on.plane->normal_exact();
  const Exact3 beside = cross(n, ray.exact() - c);
  const Rational at_a = dot(beside, a.exact() - c), at_b = dot(beside, b.exact() - c);
  return ExactPoint(a.exact() + Rational(at_a / (at_a - at_b)) * (b.exact() - a.exact()));
}

}  // namespace

std::vector<std::pair<std::uint32_t, const ExactPoint*>> CoplanarCuts::of(const std::vector<ValidPiece>& pieces) {
  struct Cut {
    const ValidPiece* piece = nullptr;
    const ExactPoint* ray = nullptr;
    std::uint32_t edge = 0;
    const ExactPoint** at = nullptr;
  };
  std::vector<std::vector<Cut>> found(pieces.size());
  workers_.for_each(pieces.size(), [&](std::size_t i, Workers::Worker&) {
    const ValidPiece& piece = pieces[i];
    for (const std::uint32_t e : piece.on->coplanar_edges) {
      if (!is_contour_[e]) continue;
      const ExactPoint &a = scene_.points[scene_.edges[e].a], &b = scene_.points[scene_.edges[e].b];
      if (!may_touch(piece, a, b)) continue;
      for (const ExactPoint* ray : {piece.ray0, piece.ray1}) {
        if (crosses_ray(*piece.on, ray, a, b)) found[i].push_back({&piece, ray, e, nullptr});
      }
    }
  });
  std::vector<Cut> all, fresh;
  for (const auto& list : found) {
    for (Cut cut : list) {
      const auto [known, is_fresh] = known_.try_emplace({cut.piece->on, cut.ray, cut.edge}, nullptr);
      cut.at = &known->second;
      all.push_back(cut);
      if (is_fresh) fresh.push_back(cut);
    }
  }
  workers_.for_each(fresh.size(), [&](std::size_t i, Workers::Worker& worker) {
    const Cut& c = fresh[i];
    const LocalEdge& e = scene_.edges[c.edge];
    *c.at = worker.pool.keep(crossing_in_plane(*c.piece->on, *c.ray, scene_.points[e.a], scene_.points[e.b]));
  });
  std::vector<char> is_reached(all.size());
  workers_.for_each(
      all.size(), [&](std::size_t i, Workers::Worker&) { is_reached[i] = reaches(*all[i].piece, *all[i].at) ? 1 : 0; });
  std::vector<std::pair<std::uint32_t, const ExactPoint*>> cuts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_reached[i] != 0) cuts.emplace_back(all[i].edge, *all[i].at);
  }
  return cuts;
}

}  // namespace clues::fastpath
