#include "fuzz/trials/denied_sight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "exact/cell/convex_cell.h"
#include "exact/sight/scene_query.h"
#include "fastpath/predicates/estimated_vectors.h"
#include "fastpath/queries/segment_queries.h"
#include "fuzz/findings/sight_aims.h"
#include "fuzz/findings/witness_text.h"
#include "fuzz/generators/parts.h"
#include "scene/mesh/bounds.h"

namespace clues::fuzz {
namespace {

using scene::Point;
using Ids = std::vector<std::uint32_t>;

constexpr std::array aims{"through vertices", "beside edges", "beside edges of what is listed", "to inner points"};
constexpr std::size_t to_vertices = 0, to_edges = 1, past_listed = 2;

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
  }

  std::optional<DeniedSight> find(std::uint64_t lines) {
    choose_viewpoints(lines);
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
    for (std::uint64_t i = 0; i < lines && !found_; ++i) shoot(static_cast<std::size_t>(i % aims.size()));
    for (std::size_t aim = 0; aim < aims.size(); ++aim)
      outcome_.counters[std::string("sight lines ") + aims[aim]] += shot_[aim];
    outcome_.counters["sight lines decided"] += std::accumulate(shot_.begin(), shot_.end(), std::uint64_t{0});
    outcome_.counters["sight lines that end on a surface"] += on_surfaces_;
    outcome_.counters["sight lines into the open"] += into_the_open_;
    outcome_.counters["panes crossed"] += panes_crossed_;
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

  // One for each 256 lines, at least 16.
  void choose_viewpoints(std::uint64_t lines) {
    const auto box = scene::bounds_of(points_);
    const std::uint64_t wanted = std::max<std::uint64_t>(16, lines / 256);
    for (std::uint64_t tries = 0; tries < 3 * wanted && viewpoints_.size() < wanted; ++tries) {
      Point sum = random_mean(points_, 64, random_);
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

  std::uint32_t denied() { return !near_.empty() && !random_.one_in(3) ? any(near_, random_) : any(denied_, random_); }
  Point on_an_edge_of(std::uint32_t triangle) {
    const auto t = corners_of(triangle);
    const auto i = static_cast<std::size_t>(random_.between(0, 2));
    return on_line(t[i], t[(i + 1) % 3], random_.between(0, 64) / 64.0);
  }
  Point within(std::uint32_t triangle) {
    const auto t = corners_of(triangle);
    const double a = random_.between(1, 32), b = random_.between(1, 32), c = random_.between(1, 32);
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (a * t[0][k] + b * t[1][k] + c * t[2][k]) / (a + b + c);
    return p;
  }

  void shoot(std::size_t aim) {
    if (aim == past_listed && edges_of_listed_.empty()) return;
    ++shot_[aim];
    const Point& v = any(viewpoints_, random_);
    look_along(v, target(aim), aim);
  }

  Point target(std::size_t aim) {
    switch (aim) {
      case to_vertices: {
        const auto corners = corners_of(denied());
        return off_by_a_little(any(corners, random_), random_);
      }
      case to_edges:
        return off_by_a_little(on_an_edge_of(denied()), random_);
      case past_listed:
        return off_by_a_little(on_an_edge_of(any(edges_of_listed_, random_)), random_);
      default:
        return within(denied());
    }
  }

  // From the cell past q; the first wall that it meets is visible, and what it crosses before.
  void look_along(const Point& v, const Point& q, std::size_t aim) {
    const Point end = on_line(v, q, 4);
    const auto wall = walls_.first_hit({v, end}, {{}, &cell_});
    ++(wall ? on_surfaces_ : into_the_open_);
    if (wall) {
      if (const auto id = scene_.blocking_id(*wall); is_denied(id)) claim(id, v, end, aims[aim], true);
    }
    if (found_ || scene_.passing().mesh().triangles.empty()) return;
    for (const auto pane : panes_.all_hits({v, end}, {{}, &cell_})) {
      const auto id = scene_.passing_id(pane);
      ++panes_crossed_;
      if (is_denied(id) && !(wall && is_behind_a_wall(id, v, end))) claim(id, v, end, aims[aim], false);
      if (found_) return;
    }
  }

  // Whether walls stop the line from v before it crosses the pane, but for rounding: the checker takes long to say so, and most panes are behind some wall.
  bool is_behind_a_wall(std::uint32_t pane, const Point& v, const Point& end) {
    const auto t = corners_of(pane);
    const Point normal = fastpath::cross_of(fastpath::minus(t[1], t[0]), fastpath::minus(t[2], t[0]));
    const double at_v = fastpath::dot_of(normal, fastpath::minus(v, t[0]));
    const double at_end = fastpath::dot_of(normal, fastpath::minus(end, t[0]));
    const Point p = on_line(v, end, at_v / (at_v - at_end));
    return std::isfinite(p[0] + p[1] + p[2]) && walls_.any_hit({v, p}, {{}, &cell_});
  }

  // Where the line crosses the triangle. Of a wall that it meets first nothing else may stand before that point.
  void claim(std::uint32_t id, const Point& v, const Point& end, const char* aim, bool is_first) {
    const auto t = exact_corners(id);
    if (!is_surface(t)) return;
    const auto w = witness_on(id, t, exact::to_exact(v), exact::to_exact(end));
    if (!w) return;
    const auto checked = check_flagged_witness(scene_.scene(), hull_, *w);
    if (checked.valid) {
      found_ = DeniedSight{id, *w, aim};
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
  std::array<std::uint64_t, aims.size()> shot_{};
  std::uint64_t on_surfaces_ = 0, into_the_open_ = 0, panes_crossed_ = 0;
  std::optional<DeniedSight> found_;
};

}  // namespace

std::optional<DeniedSight> find_denied_sight(const fastpath::SeeThroughScene& scene, const std::vector<Point>& cell,
                                             const Ids& list, std::uint64_t lines, Random random, Outcome& outcome) {
  return DeniedShooter(scene, cell, list, random, outcome).find(lines);
}

}  // namespace clues::fuzz
