// D15 in doubles: every side is cut along the lines of its DM segments into convex parts, and each part has the label of a point beside its middle.
#include "fastpath/visibility/map/regions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fastpath/predicates/estimated_vectors.h"

namespace clues::fastpath {
namespace {

// How far off its side, to its extent, a region is asked for its label; its corners are estimates, less far off.
constexpr double kStep = 0x1p-34;

struct Trace {
  Point a, b;
};

std::vector<std::array<std::vector<Trace>, 2>> traces_of_sides(const LocalScene& scene, const PieceSet& pieces) {
  std::vector<std::array<std::vector<Trace>, 2>> traces(scene.pieces.size());  // front, back
  for (const ValidPiece& piece : pieces.pieces()) {
    const OnWedge& on = *piece.on;
    if (piece.blocker >= 0) {
      const std::uint32_t t = on.blockers[static_cast<std::size_t>(piece.blocker)].piece;
      traces[t][scene.planes[t].side(*on.center) > 0 ? 0 : 1].push_back(
          {far_end_estimate(piece, piece.ray0), far_end_estimate(piece, piece.ray1)});
    }
    for (const Radial& r : on.radials) {
      if (on.turn(piece.ray0, r.w) < 0 || on.turn(r.w, piece.ray1) < 0) continue;
      for (std::vector<Trace>& side : traces[r.piece]) side.push_back({r.u->estimate(), r.w->estimate()});
    }
  }
  return traces;
}

// Cuts the parts that the trace runs through along its line.
std::vector<std::vector<Point>> cut_along(const std::vector<std::vector<Point>>& parts, const Trace& trace,
                                          const Point& n, double extent) {
  const Point along = minus(trace.b, trace.a), beside = cross_of(n, along);
  const double tolerance = length_estimate(beside) * extent * 0x1p-40;
  const auto at = [](const Point& d, const Point& x, const Point& o) {
    return d[0] * (x[0] - o[0]) + d[1] * (x[1] - o[1]) + d[2] * (x[2] - o[2]);
  };
  std::vector<std::vector<Point>> out;
  for (const std::vector<Point>& part : parts) {
    std::vector<Point> left, right;
    double first = HUGE_VAL, last = -HUGE_VAL;  // of the line inside the part, along the trace
    double most = 0, least = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Point &p = part[i], &q = part[(i + 1) % part.size()];
      const double hp = at(beside, p, trace.a), hq = at(beside, q, trace.a);
      most = std::max(most, hp);
      least = std::min(least, hp);
      if (hp >= 0) left.push_back(p);
      if (hp <= 0) right.push_back(p);
      Point x = p;
      if (hp * hq < 0) {
        for (std::size_t k = 0; k < 3; ++k) x[k] = p[k] + hp / (hp - hq) * (q[k] - p[k]);
        left.push_back(x);
        right.push_back(x);
      } else if (hp != 0) {
        continue;
      }
      first = std::min(first, at(along, x, trace.a));
      last = std::max(last, at(along, x, trace.a));
    }
    const double end = at(along, trace.b, trace.a);
    const bool runs_through = std::min(last, end) - std::max(first, 0.0) > 0x1p-40 * end;
    if (most > tolerance && least < -tolerance && runs_through) {
      out.push_back(std::move(left));
      out.push_back(std::move(right));
    } else {
      out.push_back(part);
    }
  }
  return out;
}

// Just off a point inside piece t, on that side: in doubles where they are fine enough, so not far from the origin; else exactly.
ExactPoint beside(const LocalScene& scene, std::uint32_t t, int side, const Point& inner,
                  const std::vector<Point>& corners, const Point& n) {
  const double size = length_estimate(n), extent = std::sqrt(size);
  Point off{};
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    off[k] = inner[k] + side * extent * kStep * (n[k] / size);
    largest = std::max(largest, std::abs(inner[k]));
  }
  const Plane& plane = scene.planes[t];
  if (largest * 0x1p-52 <= extent * kStep / 4) {
    const ExactPoint p(off);
    if (plane.side(p) == side) return p;
  }
  // The point of the plane with about the same weights of the corners.
  const Point d = minus(inner, corners[0]), u = minus(corners[1], corners[0]), w = minus(corners[2], corners[0]);
  const auto share = [&](const Point& c) { return (c[0] * n[0] + c[1] * n[1] + c[2] * n[2]) / (size * size); };
  const double at1 = share(cross_of(d, w)), at2 = share(cross_of(u, d));
  Exact3 sum = Rational(0) * scene.corner(t, 0).exact();
  Rational all(0);
  for (const auto& [corner, weight] : {std::pair(0, 1 - at1 - at2), std::pair(1, at1), std::pair(2, at2)}) {
    const Rational part(std::clamp(weight, kStep, 1.0));
    sum = sum + part * scene.corner(t, static_cast<std::size_t>(corner)).exact();
    all += part;
  }
  return ExactPoint::lifted(ExactPoint(Rational(1 / all) * sum), scene.corner(t, 0), kStep, plane, side);
}

// Around the corners of a region and what is right beside them.
std::vector<IntervalBox> enclosures(const std::vector<Point>& corners, double extent) {
  std::vector<IntervalBox> boxes;
  for (const Point& p : corners) {
    const auto about = [&](double x) {
      const double off = extent * kStep + std::abs(x) * 0x1p-50;
      return Interval(x - off, x + off);
    };
    boxes.push_back({about(p[0]), about(p[1]), about(p[2])});
  }
  return boxes;
}

void map_side(const LocalScene& scene, std::uint32_t t, bool front, const LocalOrigin& origin,
              const std::vector<Trace>& traces, const RegionIsVisible& visible, std::vector<LocalRegion>& regions) {
  const int side = front ? 1 : -1;
  const bool in_cell = scene.pieces[t].in_cell, faced = scene.faces_cell(t, side);
  const std::vector<Point> whole{scene.corner(t, 0).estimate(), scene.corner(t, 1).estimate(),
                                 scene.corner(t, 2).estimate()};
  const Point n = cross_of(minus(whole[1], whole[0]), minus(whole[2], whole[0]));
  const double size = length_estimate(n), extent = std::sqrt(size);
  if (!(size > 0)) return;
  std::vector<std::vector<Point>> parts{whole};
  if (faced && !in_cell) {
    for (const Trace& trace : traces) parts = cut_along(parts, trace, n, extent);
  }
  for (std::vector<Point>& part : parts) {
    LocalRegion region;
    region.triangle = origin.triangle;
    region.front = origin.same_side == front;
    Point sum{0, 0, 0}, center{0, 0, 0};
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (i >= 2) {
        const Point c = cross_of(minus(part[i - 1], part[0]), minus(part[i], part[0]));
        for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k] / 2;
      }
      for (std::size_t k = 0; k < 3; ++k) center[k] += part[i][k] / static_cast<double>(part.size());
    }
    region.area_estimate = length_estimate(sum);
    region.visible = in_cell || (faced && visible(enclosures(part, extent), beside(scene, t, side, center, whole, n)));
    region.outline_estimate = std::move(part);
    regions.push_back(std::move(region));
  }
}

}  // namespace

bool counts_for(SideMode mode, const LocalOrigin& o, bool front) {
  return mode == SideMode::sheet || o.same_side == front;
}

std::vector<LocalRegion> make_regions(const LocalScene& scene, const PieceSet& pieces, SideMode mode,
                                      const std::vector<bool>& wanted, const RegionIsVisible& visible) {
  std::vector<LocalRegion> regions;
  const auto traces = traces_of_sides(scene, pieces);
  for (std::uint32_t t = 0; t < scene.pieces.size(); ++t) {
    for (const bool front : {true, false}) {
      for (const LocalOrigin& o : scene.pieces[t].origins) {
        if (wanted[o.triangle] && counts_for(mode, o, front))
          map_side(scene, t, front, o, traces[t][front ? 0 : 1], visible, regions);
      }
    }
  }
  return regions;
}

}  // namespace clues::fastpath
