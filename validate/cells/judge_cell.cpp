// Sight lines are aimed a little beyond a triangle, so that they cross it or miss it; where one crosses it and nothing before it, the crossing is found in rationals.
#include "validate/cells/judge_cell.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <optional>
#include <random>

#include "exact/cell/convex_cell.h"
#include "exact/sight/witness.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/refinement/sight_lines.h"

namespace clues::validate {
namespace {

using scene::Point;
using Ids = std::vector<std::uint32_t>;

constexpr int lines_to_listed = 64, lines_to_missing = 4096;

class CellJudge {
 public:
  CellJudge(const fastpath::SeeThroughScene& scene, const std::vector<Point>& points)
      : scene_(scene),
        cell_(exact::ConvexCell::from_doubles(points)),
        lines_(scene.blocking(), points, cell_, fastpath::SideMode::sheet),
        viewpoints_(lines_.viewpoints(cell_)) {}

  // Triangles that block, of which a sight line reaches a point.
  std::uint64_t count_reached(const Ids& ids, std::atomic<std::uint64_t>& sight_lines) const {
    Ids blocking;
    for (const auto t : ids) {
      if (const auto at = scene_.find_blocking(t)) blocking.push_back(*at);
    }
    const auto reached = lines_.reach(blocking, viewpoints_, lines_to_listed);
    const auto count = static_cast<std::uint64_t>(std::count(reached.begin(), reached.end(), 1));
    sight_lines += 2 * count;  // at least: the lines that did not reach it are not counted
    return count;
  }

  std::optional<Witness> find_witness(std::uint32_t id, std::atomic<std::uint64_t>& sight_lines) const {
    const auto& corners = scene_.scene().mesh.triangles[id];
    fastpath::Corners t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = scene_.scene().mesh.points[corners[i]];
    fastpath::SegmentQueries queries(scene_.blocking());
    const auto at = scene_.find_blocking(id);
    const Ids itself = at ? Ids{*at} : Ids{};
    std::mt19937_64 random(id);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < lines_to_missing && !viewpoints_.empty(); ++i) {
      const Point& v = viewpoints_[random() % viewpoints_.size()];
      std::array<double, 3> w{unit(random), unit(random), unit(random)};
      if (i % 2 == 1) w[random() % 3] += 30;  // what is seen of a triangle in part, is most often a corner
      const double sum = w[0] + w[1] + w[2];
      Point p{};
      for (std::size_t c = 0; c < 3; ++c) {
        p[c] = (w[0] * t[0][c] + w[1] * t[1][c] + w[2] * t[2][c]) / sum;
        p[c] += (p[c] - v[c]) * 0x1p-20;
      }
      ++sight_lines;
      if (queries.any_hit({v, p}, {itself, &lines_.cell()})) continue;
      if (auto witness = confirmed(id, v, p)) return witness;
    }
    return std::nullopt;
  }

 private:
  // Where the line from v through p crosses the triangle, if the witness checker agrees.
  std::optional<Witness> confirmed(std::uint32_t id, const Point& v, const Point& p) const {
    const auto& corners = scene_.scene().mesh.triangles[id];
    std::array<exact::Point3, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = exact::to_exact(scene_.scene().mesh.points[corners[i]]);
    const exact::Point3 from = exact::to_exact(v), to = exact::to_exact(p);
    const auto n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    const exact::FT slope = n * (to - from);
    if (slope == 0) return std::nullopt;
    const exact::FT s = n * (t[0] - from) / slope;
    if (s <= 0 || s > 1) return std::nullopt;
    const exact::Point3 at = from + s * (to - from);
    // All that blocks, and the triangle itself where it does not.
    scene::TriangleMesh mesh = scene_.blocking().mesh();
    std::uint32_t place = 0;
    if (const auto there = scene_.find_blocking(id)) {
      place = *there;
    } else {
      place = static_cast<std::uint32_t>(mesh.triangles.size());
      scene::Triangle own{};
      for (std::size_t i = 0; i < 3; ++i) {
        own[i] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(scene_.scene().mesh.points[corners[i]]);
      }
      mesh.triangles.push_back(own);
      mesh.face_of.push_back(place);
    }
    const bool front = n * (from - t[0]) > 0;
    if (!exact::check_witness(mesh, cell_, place, front, from, at).valid) return std::nullopt;
    return Witness{id, front, from, at};
  }

  const fastpath::SeeThroughScene& scene_;
  exact::ConvexCell cell_;
  fastpath::SightLines lines_;
  std::vector<Point> viewpoints_;
};

}  // namespace

CellJudgement judge_cell(const fastpath::SeeThroughScene& scene, const std::vector<Point>& cell, const Ids& list) {
  const auto seen = fastpath::visible_through(scene, cell, {});
  CellJudgement out;
  out.listed = list.size();
  out.fallbacks = seen.conservative_fallbacks;
  std::merge(seen.blocking.begin(), seen.blocking.end(), seen.passing.begin(), seen.passing.end(),
             std::back_inserter(out.may_be_seen));
  std::erase_if(out.may_be_seen, [&](std::uint32_t t) { return !scene.scene().counting(t); });
  std::atomic<std::uint64_t> sight_lines{0};
  const CellJudge judge(scene, cell);
  out.witnessed = judge.count_reached(out.may_be_seen, sight_lines);
  Ids missing;
  std::set_difference(out.may_be_seen.begin(), out.may_be_seen.end(), list.begin(), list.end(),
                      std::back_inserter(missing));
  std::vector<std::optional<Witness>> found(missing.size());
  tbb::parallel_for(std::size_t{0}, missing.size(),
                    [&](std::size_t i) { found[i] = judge.find_witness(missing[i], sight_lines); });
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (found[i]) {
      out.holes.push_back(*found[i]);
    } else {
      out.undecided.push_back(missing[i]);
    }
  }
  out.sight_lines = sight_lines;
  return out;
}

}  // namespace clues::validate
