#include "fuzz/trials/denied_sight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/cell/convex_cell.h"
#include "exact/sight/scene_query.h"
#include "fastpath/queries/segment_queries.h"
#include "fuzz/findings/witness_text.h"
#include "fuzz/generators/parts.h"
#include "scene/mesh/bounds.h"

namespace clues::fuzz {
namespace {

using exact::Point3;
using scene::Point;
using Ids = std::vector<std::uint32_t>;

class DeniedShooter {
 public:
  DeniedShooter(const fastpath::SeeThroughScene& scene, const std::vector<Point>& points, const Ids& list,
                Random random, Outcome& outcome)
      : scene_(scene),
        mesh_(scene.scene().mesh),
        points_(points),
        list_(list),
        random_(random),
        outcome_(outcome),
        hull_(exact::ConvexCell::from_doubles(points)),
        cell_(points),
        walls_(scene.blocking()),
        panes_(scene.passing()) {
    std::vector<bool> is_lit(mesh_.points.size());
    for (const auto t : list_) {
      if (scene_.scene().blocking(t)) edges_of_listed_.push_back(t);
      for (const auto c : mesh_.triangles[t]) is_lit[c] = true;
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_denied(t)) continue;
      denied_.push_back(t);
      const auto& corners = mesh_.triangles[t];
      if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return is_lit[c]; })) near_.push_back(t);
    }
    outcome_.counters["triangles denied"] += denied_.size();
    choose_viewpoints();
  }

  std::optional<DeniedSight> find(int lines) {
    if (denied_.empty()) return std::nullopt;
    const auto box = scene::bounds_of(points_);
    for (const auto t : denied_) {
      const auto corners = corners_of(t);
      if (!scene::touch(box, scene::bounds_of(corners))) continue;
      ++outcome_.counters["triangles denied near the cell"];
      if (const auto exact = exact_corners(t); is_surface(exact) && exact::meets_cell(exact, hull_))
        return DeniedSight{t, std::nullopt, "it meets the cell"};
    }
    if (viewpoints_.empty()) {
      ++outcome_.counters["cells without a viewpoint"];
      return std::nullopt;
    }
    for (int i = 0; i < lines && !found_; ++i) shoot(i);
    outcome_.counters["sight lines decided"] += walls_.counts().queries;
    outcome_.counters["triangles decided in whole numbers"] += walls_.counts().exact + panes_.counts().exact;
    return found_;
  }

 private:
  bool is_denied(std::uint32_t t) const {
    return scene_.scene().counting(t) && !std::binary_search(list_.begin(), list_.end(), t);
  }
  std::array<Point, 3> corners_of(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {mesh_.points[a], mesh_.points[b], mesh_.points[c]};
  }
  exact::TriangleCorners exact_corners(std::uint32_t t) const {
    const auto corners = corners_of(t);
    return {exact::to_exact(corners[0]), exact::to_exact(corners[1]), exact::to_exact(corners[2])};
  }
  static bool is_surface(const exact::TriangleCorners& t) { return !CGAL::collinear(t[0], t[1], t[2]); }

  void choose_viewpoints() {
    const auto box = scene::bounds_of(points_);
    for (int tries = 0; tries < 48 && viewpoints_.size() < 16; ++tries) {
      Point sum{};
      double total = 0;
      for (const Point& p : points_) {
        const double weight = random_.between(1, 64) * (random_.one_in(3) ? 64 : 1);
        total += weight;
        for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * p[i];
      }
      for (double& x : sum) x /= total;
      for (std::size_t i = 0; i < 3; ++i) {  // in the plane of a flat cell, exactly, where that is across an axis
        if (box.low[i] == box.high[i]) sum[i] = box.low[i];
      }
      if (tries % 2 == 1) {  // extremal lines leave the cell near its corners
        const Point corner = any(points_, random_);
        const double t = std::ldexp(1, -random_.between(1, 20));
        for (std::size_t i = 0; i < 3; ++i) sum[i] = corner[i] + t * (sum[i] - corner[i]);
      }
      if (hull_.interior_contains(exact::to_exact(sum))) viewpoints_.push_back(sum);
    }
  }

  Point off_by_little(Point p) {
    for (double& x : p) {
      const int kind = random_.between(0, 4);
      if (kind <= 1) x = std::nextafter(x, kind == 0 ? -1e300 : 1e300);
      if (kind >= 3) x += std::ldexp(random_.one_in(2) ? 1 : -1, -random_.between(10, 40));
    }
    return p;
  }
  std::uint32_t denied() { return !near_.empty() && !random_.one_in(3) ? any(near_, random_) : any(denied_, random_); }
  Point on_an_edge_of(std::uint32_t triangle) {
    const auto t = corners_of(triangle);
    const auto i = static_cast<std::size_t>(random_.between(0, 2));
    const double s = random_.between(0, 64) / 64.0;
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = t[i][k] + s * (t[(i + 1) % 3][k] - t[i][k]);
    return p;
  }
  Point within(std::uint32_t triangle) {
    const auto t = corners_of(triangle);
    const double a = random_.between(1, 32), b = random_.between(1, 32), c = random_.between(1, 32);
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (a * t[0][k] + b * t[1][k] + c * t[2][k]) / (a + b + c);
    return p;
  }

  void shoot(int number) {
    switch (number % 4) {
      case 0: {
        const auto corners = corners_of(denied());
        return shoot_at("through vertices", off_by_little(any(corners, random_)));
      }
      case 1:
        return shoot_at("beside edges", off_by_little(on_an_edge_of(denied())));
      case 2:
        if (edges_of_listed_.empty()) return;
        return shoot_at("beside edges of what is listed", off_by_little(on_an_edge_of(any(edges_of_listed_, random_))));
      default:
        return shoot_at("to inner points", within(denied()));
    }
  }

  // From the cell past q; the first wall that it meets is visible, and what it crosses before.
  void shoot_at(const char* aim, const Point& q) {
    const Point& v = any(viewpoints_, random_);
    Point end;
    for (std::size_t i = 0; i < 3; ++i) end[i] = v[i] + 4 * (q[i] - v[i]);
    ++outcome_.counters[std::string("sight lines ") + aim];
    const auto wall = walls_.first_hit({v, end}, {{}, &cell_});
    ++outcome_.counters[wall ? "sight lines that end on a surface" : "sight lines into the open"];
    const Point3 from = exact::to_exact(v), to = exact::to_exact(end);
    if (wall) {
      if (const auto id = scene_.blocking_id(*wall); is_denied(id)) claim(id, from, to, aim, true);
    }
    if (found_ || scene_.passing().mesh().triangles.empty()) return;
    for (const auto pane : panes_.all_hits({v, end}, {{}, &cell_})) {
      const auto id = scene_.passing_id(pane);
      ++outcome_.counters["panes crossed"];
      if (is_denied(id)) claim(id, from, to, aim, false);
      if (found_) return;
    }
  }

  // Where the line crosses the triangle. Of a wall that it meets first nothing else may stand before that point.
  void claim(std::uint32_t id, const Point3& from, const Point3& to, const char* aim, bool is_first) {
    const auto t = exact_corners(id);
    if (!is_surface(t)) return;
    const exact::Plane3 plane(t[0], t[1], t[2]);
    const exact::FT at_v = exact::value_at(plane, from), at_end = exact::value_at(plane, to);
    if (CGAL::is_zero(at_v) || at_v == at_end) return;
    const Point3 p = exact::collapsed(from + at_v / (at_v - at_end) * (to - from));
    for (std::size_t i = 0; i < 3; ++i) {  // on an edge: no witness (D5)
      if (CGAL::coplanar_orientation(t[i], t[(i + 1) % 3], t[(i + 2) % 3], p) != CGAL::POSITIVE) return;
    }
    const validate::Witness w{id, CGAL::is_positive(at_v), from, p};
    const auto checked = check_flagged_witness(scene_.scene(), hull_, w);
    if (checked.valid) {
      found_ = DeniedSight{id, w, aim};
    } else if (is_first && !checked.special) {
      outcome_.contradictions.push_back(
          fmt::format("triangle {} is said to be met first, and the witness checker says: {}", id, checked.reason));
    }
  }

  const fastpath::SeeThroughScene& scene_;
  const scene::TriangleMesh& mesh_;
  const std::vector<Point>& points_;
  const Ids& list_;
  Random random_;
  Outcome& outcome_;
  exact::ConvexCell hull_;
  fastpath::Cell cell_;
  fastpath::SegmentQueries walls_, panes_;
  Ids denied_, near_, edges_of_listed_;
  std::vector<Point> viewpoints_;  // in int V
  std::optional<DeniedSight> found_;
};

}  // namespace

std::optional<DeniedSight> find_denied_sight(const fastpath::SeeThroughScene& scene, const std::vector<Point>& cell,
                                             const Ids& list, int lines, Random random, Outcome& outcome) {
  return DeniedShooter(scene, cell, list, random, outcome).find(lines);
}

}  // namespace clues::fuzz
