#include "fastpath/visibility/map/local_map.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fastpath/visibility/labels/one_label.h"
#include "fastpath/visibility/map/regions.h"
#include "fastpath/visibility/map/sides.h"
#include "fastpath/visibility/search/search.h"
#include "fastpath/visibility/wedges/workers.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

namespace {

IntervalBox to_box(const Box& b) {
  return {Interval(b.low[0], b.high[0]), Interval(b.low[1], b.high[1]), Interval(b.low[2], b.high[2])};
}

IntervalBox bounds_of(const LocalScene& scene, const Box* outside) {
  return outside ? hull(scene.bounds, to_box(*outside)) : scene.bounds;
}

Interval wider(const Interval& side, double by) { return side + Interval(-by, by); }

// What set_box needs: bounds of every segment that pieces are asked about. With L the largest side of what
// holds mesh and cell, and E that of the mesh alone, ends of segments are
// - corners of the mesh, points of V, of segments between these and those that follow, and places that the
//   caller asks about: in `given`;
// - beside a side of a piece (sides.cpp): E/16 off it, or exactly by 2^-21 E;
// - beside a contour edge (beside_edge): 2^-5 (1 + 2^-5) of its length, at most 0.06 E, or exactly by 2^-29
//   of the way across to the cell, at most 2 L, with 2^-5 of that, times 4 at most, along the normal: 2^-27
//   L;
// - beside x, on the way to another point (point_near): rounded to 2^-52 L;
// - beside a vertex on the way through V, perhaps beyond V (views_of_cell): L/32 in each coordinate. Each is
//   rounded, a few times, in the unit of the largest coordinate. So it is enough to add E/8 + L/16 and 2^-50
//   of the largest coordinate around the mesh. The box that the closure gives leaves E/2 (first_order.cpp),
//   which is as much where L is below 6 E and E is not next to the spacing of doubles.
IntervalBox bounds_of_segments(const LocalScene& scene, const IntervalBox& given) {
  if (scene.points.empty()) return given;
  const RoundedUp rounded_up;
  IntervalBox mesh = scene.points.front().approximate();
  for (const ExactPoint& p : scene.points) mesh = hull(mesh, p.approximate());
  const auto largest_side = [](const IntervalBox& b) {
    return std::max({b.x.sup() - b.x.inf(), b.y.sup() - b.y.inf(), b.z.sup() - b.z.inf()});
  };
  double largest = 0;
  for (const Interval* side : {&scene.bounds.x, &scene.bounds.y, &scene.bounds.z})
    largest = std::max({largest, std::fabs(side->inf()), std::fabs(side->sup())});
  const double by = largest_side(mesh) / 8 + largest_side(scene.bounds) / 16 + 0x1p-50 * largest;
  return hull(given, IntervalBox{wider(mesh.x, by), wider(mesh.y, by), wider(mesh.z, by)});
}

}  // namespace

class LocalMap::Parts {
 public:
  Parts(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& part,
        const LocalMapOptions& o, const std::vector<bool>& w, const Box* outside,
        std::span<const std::uint8_t> dark = {})
      : options(o),
        scene(complex, whole, part, dark),
        wanted(w),
        bounds(fastpath::bounds_of(scene, outside)),
        workers(scene),
        bounds_asked(bounds_of_segments(scene, bounds)),
        search(scene, bounds_asked, options, counts, workers) {
    make();
  }

  void make() {
    const RoundedUp rounded_up;
    const std::uint64_t before = exact_decisions();
    counts.pieces = scene.pieces.size();
    counts.refined_triangles = scene.refined_triangles;
    search.run();
    one_label.emplace(search.walker(), search.pieces(), search.left_out());
    Sides sides(scene, search.pieces(), *one_label, options.mode, wanted);
    sides.find_visible(workers);
    visible = std::move(sides.visible);
    lit = std::move(sides.lit);
    counts.walks += sides.walks;
    labels_of_sides = one_label->unresolved();
    counts.conservative_fallbacks += sides.fallbacks + labels_of_sides;
    counts.exact_decisions = exact_decisions() - before;
  }

  std::vector<std::uint32_t> find_in_doubt() {
    if (counts.conservative_fallbacks == 0) return {};
    const RoundedUp rounded_up;
    search.keep_known();
    const Sides sides(scene, search.pieces(), *one_label, options.mode, wanted);
    return sides.in_doubt_of(visible, search.walker(), workers);
  }

  WedgePiece estimated(ValidPiece p) const {
    set_box(p, bounds);
    WedgePiece out;
    out.kind = p.kind;
    out.generation = p.generation;
    out.normal_estimate = p.on->plane->normal_estimate();
    for (double& x : out.normal_estimate) x /= 2;
    out.center_estimate = p.on->center->estimate();
    out.unbounded = p.blocker < 0;
    outline(p, out);
    out.box = {{p.box.x.inf(), p.box.y.inf(), p.box.z.inf()}, {p.box.x.sup(), p.box.y.sup(), p.box.z.sup()}};
    return out;
  }

  const LocalMapOptions options;
  LocalMapCounts counts;
  LocalScene scene;
  const std::vector<bool> wanted;  // by triangle
  IntervalBox bounds;              // of scene and cell, and of what the caller asks about
  Workers workers;
  IntervalBox bounds_asked;
  Search search;
  std::vector<std::uint32_t> visible, lit;
  std::optional<OneLabel> one_label;
  std::uint64_t labels_of_sides = 0;  // that are visible because nothing is known

 private:
  // Where the ray from the centre through r crosses the near edge.
  static Point near_end(const ValidPiece& p, const Point& r) {
    const Point c = p.on->center->estimate(), a = p.near0->estimate(), b = p.near1->estimate();
    Point n{}, across{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = (a[j] - c[j]) * (b[k] - c[k]) - (a[k] - c[k]) * (b[j] - c[j]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      across[i] = n[j] * (r[k] - c[k]) - n[k] * (r[j] - c[j]);
    }
    double at_a = 0, at_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      at_a += across[i] * (a[i] - c[i]);
      at_b += across[i] * (b[i] - c[i]);
    }
    const double t = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  }

  // near 0, near 1, far 1, far 0
  static void outline(const ValidPiece& p, WedgePiece& out) {
    const Point c = p.on->center->estimate();
    const auto far = [&](const ExactPoint* ray) {
      if (p.blocker >= 0) return far_end_estimate(p, ray);
      const Point r = ray->estimate();
      double reach = HUGE_VAL;  // where the ray leaves the piece's box
      const double low[3] = {p.box.x.inf(), p.box.y.inf(), p.box.z.inf()},
                   high[3] = {p.box.x.sup(), p.box.y.sup(), p.box.z.sup()};
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = r[k] - c[k];
        if (d != 0) reach = std::min(reach, ((d > 0 ? high[k] : low[k]) - c[k]) / d);
      }
      if (!std::isfinite(reach)) reach = 1;
      return Point{c[0] + reach * (r[0] - c[0]), c[1] + reach * (r[1] - c[1]), c[2] + reach * (r[2] - c[2])};
    };
    if (!p.near0) {
      out.outline_estimate.push_back(c);
    } else {
      out.outline_estimate.push_back(near_end(p, p.ray0->estimate()));
      out.outline_estimate.push_back(near_end(p, p.ray1->estimate()));
    }
    out.outline_estimate.push_back(far(p.ray1));
    out.outline_estimate.push_back(far(p.ray0));
  }
};

const std::vector<std::uint32_t>& LocalMap::visible() const { return parts_->visible; }
std::vector<WedgePiece> LocalMap::pieces() const {
  const RoundedUp rounded_up;
  std::vector<WedgePiece> out;
  for (const ValidPiece& p : parts_->search.pieces().pieces()) out.push_back(parts_->estimated(p));
  return out;
}
const std::vector<std::uint32_t>& LocalMap::lit() const { return parts_->lit; }
std::vector<std::uint32_t> LocalMap::find_in_doubt() { return parts_->find_in_doubt(); }
const LocalMapCounts& LocalMap::counts() const { return parts_->counts; }
std::uint64_t LocalMap::conservative_labels() const {
  return parts_->one_label->unresolved() - parts_->labels_of_sides;
}

std::vector<LocalRegion> LocalMap::regions() const {
  const RoundedUp rounded_up;
  return make_regions(parts_->scene, parts_->search.pieces(), parts_->options.mode, parts_->wanted,
                      [&](std::span<const IntervalBox> region, const ExactPoint& p) {
                        return parts_->one_label->of_uncut(region, p) != Label::hidden;
                      });
}

LocalMap::Label LocalMap::label(const Point& p) const {
  const RoundedUp rounded_up;
  const ExactPoint at(p);
  return parts_->one_label->of_uncut({&at.approximate(), 1}, at);
}

LocalMap::Label LocalMap::label(const Box& box) const {
  const RoundedUp rounded_up;
  return parts_->one_label->of_box(box);
}

LocalMap::Label LocalMap::label_of_inside(std::span<const ExactPoint> polygon, const Box& about) const {
  const RoundedUp rounded_up;
  return parts_->one_label->of_inside(polygon, about);
}

LocalMap::Label LocalMap::label_beside(const Corners& triangle, const Box& about) const {
  const RoundedUp rounded_up;
  return parts_->one_label->of_beside(triangle, about);
}

bool LocalMap::piece_may_touch(const Box& box) const {
  const RoundedUp rounded_up;
  return parts_->one_label->piece_may_touch(to_box(box));
}

bool LocalMap::piece_may_touch(const Corners& triangle) const {
  const RoundedUp rounded_up;
  return parts_->one_label->piece_may_touch(triangle);
}

namespace {

void require_standard_range(const scene::TriangleMesh& mesh) {
  for (const Point& p : mesh.points) {
    for (const double x : p) {
      if (!std::isfinite(x))
        throw scene::Error(scene::ErrorCode::non_finite, "local map: a coordinate is not a finite number");
      if (std::fabs(x) >= 0x1p129)
        throw scene::Error(scene::ErrorCode::unsupported,
                           "local map: a coordinate is beyond 2^128; move the scene into the standard range first");
    }
  }
}

LocalMap map_of_all(const exact::Complex& complex, const exact::ConvexCell& cell, const LocalMapOptions& options,
                    const Box* outside, std::span<const std::uint8_t> dark = {}) {
  std::vector<bool> wanted(complex.input_triangles, true);
  for (std::size_t t = 0; t < dark.size(); ++t) wanted[t] = dark[t] == 0;
  return LocalMap(std::make_shared<LocalMap::Parts>(complex, cell, cell, options, wanted, outside, dark));
}

}  // namespace

LocalMap make_local_map(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const LocalMapOptions& options,
                        const Box* outside) {
  require_standard_range(mesh);
  return map_of_all(exact::build_complex(mesh, &cell), cell, options, outside);
}

LocalMap make_local_map(const PartOfScene& part, const exact::ConvexCell& cell, const LocalMapOptions& options,
                        const Box* outside) {
  require_standard_range(part.mesh);
  return map_of_all(exact::build_complex(part.mesh, &cell, part.ids, part.memory), cell, options, outside, part.dark);
}

LocalMap make_local_map_in(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& part,
                           const LocalMapOptions& options, const std::vector<bool>& wanted) {
  return LocalMap(std::make_shared<LocalMap::Parts>(complex, whole, part, options, wanted, nullptr));
}

}  // namespace clues::fastpath
