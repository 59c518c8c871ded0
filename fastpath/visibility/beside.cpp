#include "fastpath/visibility/beside.h"

#include <algorithm>
#include <cmath>

#include "scene/error.h"

namespace clues::fastpath {

namespace {

double length(const Point& v) { return length_estimate(v); }
double inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

std::optional<ExactPoint> beside_edge(const LocalScene& scene, const PieceSet& set, const ContourEdge& c,
                                      const EdgePart& part, int& level) {
  const LocalEdge& edge = scene.edges[c.edge];
  const ExactPoint &touching = scene.cell.vertices[static_cast<std::size_t>(c.touching.front())],
                   &a = scene.points[edge.a], &b = scene.points[edge.b];
  const Point y = part.y->estimate(), along = minus(b.estimate(), a.estimate());
  Point to = minus(touching.estimate(), y);  // across the edge
  const double shift = -inner(to, along) / inner(along, along);
  for (std::size_t k = 0; k < 3; ++k) to[k] += shift * along[k];
  const Vec3<Interval>& n = c.plane->normal_approximate();
  const Point up{n.x.inf() + n.x.sup(), n.y.inf() + n.y.sup(), n.z.inf() + n.z.sup()};
  const double size = std::min(length(to), length(minus(part.hi->estimate(), part.lo->estimate())));
  constexpr int kDoubles = 4;
  if (!(length(to) > 0 && length(up) > 0)) level = std::max(level, kDoubles);
  for (; level < 2 * kDoubles; ++level) {
    const ExactPoint beside = [&] {
      if (level >= kDoubles) {  // features smaller than the spacing of doubles
        const double step = std::ldexp(1.0, -5 - 24 * (level - kDoubles + 1));
        const Exact3 across = touching.exact() + Rational(std::isfinite(shift) ? shift : 0) * (b.exact() - a.exact());
        return ExactPoint::lifted(*part.y, ExactPoint(across), step, *c.plane, 0x1p-5);
      }
      const double step = std::ldexp(size, -5 - 7 * level);
      Point p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = y[k] + step * (to[k] / length(to)) + step * 0x1p-5 * (up[k] / length(up));
      return ExactPoint(p);
    }();
    // Between H- and the event surface of the other supporting plane there is one label.
    if (c.plane->side(beside) <= 0 || (c.other && c.other->side(beside) >= 0)) continue;
    const bool blocked = scene.tree.any(SegmentTest(beside, *part.y), [&](std::uint32_t i) {
      const std::uint32_t t = scene.occluders[i];
      if (std::find(edge.pieces.begin(), edge.pieces.end(), t) != edge.pieces.end()) return false;
      return scene.crosses(*part.y, beside, t) != Crossing::no;
    });
    if (blocked || set.may_meet(beside, *part.y, 0, holds_edge(scene, c.edge))) continue;
    return beside;
  }
  return std::nullopt;
}

std::vector<ExactPoint> viewpoints_of_parts(const LocalScene& scene, const Apex& apex, const ExactPoint& inside) {
  const auto& s = scene.cell.vertices;
  std::vector<ExactPoint> found;
  const auto weights = [&](double others) {
    std::vector<double> w(s.size());
    for (std::size_t j = 0; j < s.size(); ++j)
      w[j] = others * static_cast<double>(3 + (7 * j + 11 * found.size()) % 13) / 16;
    return w;
  };
  for (std::size_t i = 0; i < s.size(); ++i) {
    for (const double others : {0x1p-8, 0x1p-20}) {
      std::vector<double> w = weights(others);
      w[i] = 1;
      found.push_back(scene.cell.interior_point(w));
    }
  }
  const Point x = apex.x()->estimate();
  const auto& pieces = apex.on_edge() ? scene.edges[apex.id()].pieces : scene.point_pieces[apex.id()];
  for (const std::uint32_t t : pieces) {
    const Plane& h = scene.planes[t];
    for (const auto& [i, j] : scene.cell.edges) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (h.side(s[a]) * h.side(s[b]) >= 0) continue;
      const ExactPoint c = ExactPoint::on_plane(s[a], s[b], h);
      const Point pc = c.estimate(), pa = s[a].estimate(), pb = s[b].estimate();
      const double part = length(minus(pc, pa)) / length(minus(pb, pa));
      for (const double step : {0x1p-4, 0x1p-10, 0x1p-20}) {
        for (const double way : {-step, step}) {
          if (!(part + way > 0 && part + way < 1)) continue;
          std::vector<double> w = weights(step * 0x1p-5);
          w[a] = 1 - part - way;
          w[b] = part + way;
          found.push_back(scene.cell.interior_point(w));
        }
      }
    }
    // Beside the directions of incident edges that point into V.
    for (const std::uint32_t c : scene.pieces[t].corners) {
      const Point along = minus(scene.points[c].estimate(), x);
      if (length(along) == 0) continue;
      const Point center = inside.estimate();
      const double far = length(minus(center, x)) / length(along);
      const Vec3<Interval>& n = h.normal_approximate();
      const Point up{n.x.inf(), n.y.inf(), n.z.inf()};
      for (const double reach : {0.25, 0.5, 0.75, 1.0, 1.25, 1.5}) {
        for (const double way : {-0x1p-12, 0x1p-12}) {
          Point p;
          for (std::size_t k = 0; k < 3; ++k)
            p[k] = x[k] + reach * far * along[k] + way * far * length(along) * up[k] / length(up);
          if (!std::isfinite(p[0] + p[1] + p[2])) continue;
          const ExactPoint v(p);
          if (scene.cell.interior_contains(v)) found.push_back(v);
        }
      }
    }
  }
  // All of those near vertices, and one more for each other face; where faces cannot be told apart, all.
  std::vector<const ExactPoint*> to;
  for (const ExactPoint& v : found) to.push_back(&v);
  std::vector<int> face;
  try {
    face = apex.faces_of(to);
  } catch (const scene::Error& error) {
    if (error.code() != scene::ErrorCode::internal) throw;
    return found;
  }
  std::vector<ExactPoint> out;
  std::vector<int> done;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool is_new = std::find(done.begin(), done.end(), face[i]) == done.end();
    if (!is_new && i >= 2 * s.size()) continue;
    done.push_back(face[i]);
    out.push_back(found[i]);
  }
  return out;
}

}  // namespace clues::fastpath
