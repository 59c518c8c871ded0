#include "fastpath/visibility/refinement/adjusted_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fastpath/visibility/points/points.h"

#include "fastpath/predicates/estimated_vectors.h"

namespace clues::fastpath {
namespace {

constexpr int kOnEdge = 16;    // places of an edge that are asked whether something obstructs them
constexpr int kOnSegment = 8;  // places of an obstructed segment that look at the cell
constexpr int kBisections = 20;

Point along(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}
// a + x u + y w
Point moved(const Point& a, double x, const Point& u, double y, const Point& w) {
  return {a[0] + x * u[0] + y * w[0], a[1] + x * u[1] + y * w[1], a[2] + x * u[2] + y * w[2]};
}
std::optional<Point> unit(const Point& v) {
  const double size = length_estimate(v);
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  return Point{v[0] / size, v[1] / size, v[2] / size};
}

// The wedges of one edge and touching vertex: one plane.
struct Edge {
  Point center{}, normal{};  // normal: towards H-
  Point from{}, to{};
};

std::vector<Edge> edges_of(const std::vector<WedgePiece>& wedges) {
  std::map<std::pair<Point, Point>, Edge> found;
  for (const WedgePiece& w : wedges) {
    if (w.kind == PieceKind::se_mv) continue;
    const Point &a = std::min(w.outline_estimate[0], w.outline_estimate[1]),
                &b = std::max(w.outline_estimate[0], w.outline_estimate[1]);
    auto [edge, is_new] =
        found.try_emplace({w.center_estimate, w.normal_estimate}, Edge{w.center_estimate, w.normal_estimate, a, b});
    if (is_new) continue;
    edge->second.from = std::min(edge->second.from, a);
    edge->second.to = std::max(edge->second.to, b);
  }
  std::vector<Edge> edges;
  for (auto& [key, edge] : found) edges.push_back(edge);
  return edges;
}

// Seen along an edge: the wedge's plane at the angle 0, V from there to at most a half turn.
class Around {
 public:
  static std::optional<Around> make(const Edge& edge) {
    const auto d = unit(minus(edge.to, edge.from)), n = unit(edge.normal);
    if (!d || !n) return std::nullopt;
    auto u = unit(cross_of(*d, *n));
    if (!u) return std::nullopt;
    if (dot_of(*u, minus(edge.center, edge.from)) < 0) u = Point{-(*u)[0], -(*u)[1], -(*u)[2]};
    return Around(edge, *d, *u, *n);
  }

  double angle(const Point& v) const {
    const Point x = minus(v, edge_.from);
    return std::atan2(-dot_of(x, n_), dot_of(x, u_));
  }
  // The angle at which a line from p over the edge goes on.
  double angle_across(const Point& p) const {
    const Point x = minus(p, edge_.from);
    return std::atan2(dot_of(x, n_), -dot_of(x, u_));
  }
  double distance(const Point& v) const {
    const Point x = minus(v, edge_.from);
    return std::hypot(dot_of(x, n_), dot_of(x, u_));
  }
  double position(const Point& v) const { return dot_of(minus(v, edge_.from), d_); }
  const Point& center() const { return edge_.center; }
  double length() const { return position(edge_.to); }
  Point at(double position) const { return moved(edge_.from, position, d_, 0, d_); }
  // A point of the edge moved off it, towards the cell and H-: beside all that meets there.
  Point beside(double position, double step) const { return moved(at(position), step, u_, step, n_); }
  // Angles beyond this one are on the negative side.
  CutPlane plane(double angle) const {
    return {edge_.from, moved({0, 0, 0}, std::sin(angle), u_, std::cos(angle), n_)};
  }

 private:
  Around(const Edge& edge, const Point& d, const Point& u, const Point& n) : edge_(edge), d_(d), u_(u), n_(n) {}
  Edge edge_;
  Point d_, u_, n_;
};

// Points of the part to look at: corners, the middles between them, and the centre.
std::vector<Point> places_of(const std::vector<Point>& corners, const Point& center) {
  std::vector<Point> places = corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    places.push_back(along(corners[i], center, 0.5));
    for (std::size_t j = i + 1; j < corners.size(); ++j) places.push_back(along(corners[i], corners[j], 0.5));
  }
  places.push_back(center);
  return places;
}

struct Scored {
  double score = 0;
  CutPlane plane;
};

class Chooser {
 public:
  Chooser(const exact::ConvexCell& part, const Cell& cell, const std::vector<OpenPlace>& open, SegmentQueries& queries)
      : cell_(cell), open_(open), queries_(queries), center_(exact::to_double_estimate(part.center())) {
    for (const exact::Point3& v : part.vertices()) corners_.push_back(exact::to_double_estimate(v));
    places_ = places_of(corners_, center_);
  }

  void consider(const Edge& edge) {
    const auto around = Around::make(edge);
    if (!around) return;
    const double length = around->length();
    // Whatever is cut there: no line from an open place to the part passes the edge at an angle that could be gained.
    double widest = 0;
    for (const Point& v : corners_) widest = std::max(widest, around->angle(v));
    if (gain(*around, 0, length, widest) <= best_.score) return;
    double size = length;
    for (const Point* p : {&edge.from, &edge.to, &edge.center}) {
      for (const double x : *p) size = std::max(size, std::fabs(x));
    }
    const double step = size * 0x1p-30;
    const auto sees = [&](double position, const Point& v) {
      return !queries_.any_hit({v, around->beside(position, step)}, {{}, &cell_});
    };
    // Runs of places that something hides from the touching vertex; elsewhere the wedge is exact (FIG. 27).
    for (int i = 0, begin = 0; i <= kOnEdge; ++i) {
      if (i < kOnEdge && !sees((i + 0.5) / kOnEdge * length, edge.center)) continue;
      if (begin < i) consider_segment(*around, begin * length / kOnEdge, i * length / kOnEdge, widest, sees);
      begin = i + 1;
    }
  }

  std::optional<CutPlane> best() const {
    if (best_.score > 0) return best_.plane;
    return std::nullopt;
  }

 private:
  // D20: the segment, its halves and its quarters, each with what it sees of the part.
  template <class Sees>
  void consider_segment(const Around& around, double lo, double hi, double widest, const Sees& sees) {
    const auto at = [&](int i) { return lo + (hi - lo) * i / kOnSegment; };
    std::array<double, kOnSegment> first{};
    for (int i = 0; i < kOnSegment; ++i)
      first[static_cast<std::size_t>(i)] = first_seen(around, (at(i) + at(i + 1)) / 2, widest, sees);
    for (int width = kOnSegment; width >= 2; width /= 2) {
      for (int i = 0; i < kOnSegment; i += width) {
        const double angle = *std::min_element(first.begin() + i, first.begin() + i + width);
        // A little before it: what reaches beyond the plane must not see the segment, else its first-order wedge there is that of all of V-.
        if (angle < widest) offer(around, at(i), at(i + width), angle * (1 - 0x1p-16), 1);
        // A plane through the middle of the part helps too, less surely; it is what is left where the segment sees nothing, or all there is.
        offer(around, at(i), at(i + width), around.angle(center_), 0.5);
      }
    }
  }

  // The angle before which a place of the edge sees nothing of the part: between the samples it is searched for by bisection.
  template <class Sees>
  double first_seen(const Around& around, double position, double widest, const Sees& sees) const {
    const Point* seen = nullptr;
    for (const Point& v : places_) {
      if (around.angle(v) < (seen ? around.angle(*seen) : widest) && sees(position, v)) seen = &v;
    }
    if (!seen) return widest;
    Point from = around.center(), to = *seen;
    for (int k = 0; k < kBisections; ++k) {
      const Point middle = along(from, to, 0.5);
      (sees(position, middle) ? to : from) = middle;
    }
    return around.angle(from);
  }

  void offer(const Around& around, double lo, double hi, double angle, double worth) {
    if (!(angle > 0x1p-20)) return;
    const double score = worth * gain(around, lo, hi, angle);
    if (score > best_.score) best_ = {score, around.plane(angle)};
  }

  // The open places that lines from the part reach over the segment at angles before this one only.
  double gain(const Around& around, double lo, double hi, double angle) const {
    double sum = 0;
    for (const OpenPlace& place : open_) {
      const double across = around.angle_across(place.at);
      if (!(across > 0 && across < angle)) continue;
      const double p = around.distance(place.at);
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (const Point& v : corners_) {
        const double t = around.distance(v) / (around.distance(v) + p);
        const double y = (1 - t) * around.position(v) + t * around.position(place.at);
        least = std::min(least, y);
        most = std::max(most, y);
      }
      if (least <= hi && most >= lo) sum += place.weight;
    }
    return sum;
  }

  const Cell& cell_;
  const std::vector<OpenPlace>& open_;
  SegmentQueries& queries_;
  Point center_;
  std::vector<Point> corners_, places_;
  Scored best_;
};

}  // namespace

std::optional<CutPlane> choose_cut(const std::vector<WedgePiece>& wedges, const exact::ConvexCell& part,
                                   const Cell& cell, const std::vector<OpenPlace>& open, SegmentQueries& queries) {
  Chooser chooser(part, cell, open, queries);
  for (const Edge& edge : edges_of(wedges)) chooser.consider(edge);
  return chooser.best();
}

// A closed half space cuts a polytope into the hull of its vertices there and of where the plane crosses its edges. A crossing that is moved along its
// edge, away from the vertex that is kept, only makes that hull larger; and it stays in the cell. So the two hulls cover the cell, wherever they end.
std::vector<exact::ConvexCell> parts_along(const exact::ConvexCell& cell, const CutPlane& plane) {
  using exact::FT;
  using exact::Point3;
  const Point3 base = exact::to_exact(plane.base);
  const exact::Vector3 normal(plane.normal[0], plane.normal[1], plane.normal[2]);
  std::vector<FT> height;
  std::array<std::vector<Point3>, 2> kept;  // below, above
  bool cut[2] = {false, false};
  for (const Point3& v : cell.vertices()) {
    height.push_back(exact::collapsed(FT(normal * (v - base))));
    const CGAL::Sign side = CGAL::sign(height.back());
    if (side != CGAL::POSITIVE) kept[0].push_back(v);
    if (side != CGAL::NEGATIVE) kept[1].push_back(v);
    if (side != CGAL::ZERO) cut[side == CGAL::POSITIVE ? 1 : 0] = true;
  }
  if (!cut[0] || !cut[1]) return {cell};
  constexpr double kSteps = 0x1p30;
  for (const auto& e : cell.edges()) {
    auto below = static_cast<std::size_t>(e[0]), above = static_cast<std::size_t>(e[1]);
    if (height[below] > height[above]) std::swap(below, above);
    if (CGAL::sign(height[below]) != CGAL::NEGATIVE || CGAL::sign(height[above]) != CGAL::POSITIVE) continue;
    const Point3 &a = cell.vertices()[below], &b = cell.vertices()[above];
    // The double is off by far less than a step: between one step less and two more is the crossing.
    const double t = std::floor(kSteps * CGAL::to_double(FT(height[below] / (height[below] - height[above]))));
    const auto at = [&](double steps) {
      return exact::collapsed(a + FT(std::clamp(steps, 0.0, kSteps) / kSteps) * (b - a));
    };
    kept[0].push_back(at(t + 2));
    kept[1].push_back(at(t - 1));
  }
  return {exact::ConvexCell(kept[0]), exact::ConvexCell(kept[1])};
}

}  // namespace clues::fastpath
