// Sight lines are aimed a little beyond a triangle, so that they cross it or miss it; where one crosses it and nothing before it, the crossing is found in rationals.
#include "validate/cells/judge_cell.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <optional>
#include <random>
#include <utility>

#include "exact/cell/convex_cell.h"
#include "exact/sight/witness.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/closure/sight_lines.h"
#include "fastpath/visibility/closure/sight_rays.h"
#include "validate/cells/near_segment.h"

namespace clues::validate {
namespace {

using scene::Point;
using Ids = std::vector<std::uint32_t>;

constexpr int lines_to_listed = 64, lines_to_missing = 4096, lines_to_hidden = 128, lines_to_passing = 8;

class CellJudge {
 public:
  CellJudge(const fastpath::SeeThroughScene& scene, const std::vector<Point>& points)
      : scene_(scene),
        cell_(exact::ConvexCell::from_doubles(points)),
        lines_(scene.blocking(), points, cell_, fastpath::SideMode::sheet),
        viewpoints_(lines_.viewpoints(cell_)) {}

  // Triangles of which a sight line reaches a point.
  std::uint64_t count_reached(const Ids& ids, std::atomic<std::uint64_t>& sight_lines) const {
    Ids places, passing;
    for (const auto t : ids) {
      if (const auto at = scene_.find_blocking(t)) {
        places.push_back(*at);
      } else {
        passing.push_back(t);
      }
    }
    const auto reached = lines_.reach(places, viewpoints_, lines_to_listed);
    const auto walls = static_cast<std::uint64_t>(std::count(reached.begin(), reached.end(), 1));
    sight_lines += walls;  // at least: those that reached nothing are not counted
    std::atomic<std::uint64_t> others{0};
    tbb::parallel_for(std::size_t{0}, passing.size(), [&](std::size_t i) {
      if (reaches_passing(passing[i], lines_to_listed, sight_lines)) ++others;
    });
    return walls + others;
  }

  // What accuses, or would if it were not too long; none where shorter lines were free and refused.
  struct Search {
    std::optional<Witness> witness, beyond;
    bool refused = false;  // a line that is not too long
  };
  Search find_witness(std::uint32_t id, int tries, const Accuser& accuser,
                      std::atomic<std::uint64_t>& sight_lines) const {
    Search out;
    look_for_witness(out, id, tries, accuser, sight_lines);
    return out;
  }

  // What sight lines find, ascending: walls from neighbour to neighbour, each with the line that found it; the others by lines to each.
  struct Found {
    std::uint32_t id = 0;
    std::optional<fastpath::Segment> ray;
  };
  std::vector<Found> find_by_lines(std::atomic<std::uint64_t>& sight_lines) const {
    const auto sights = fastpath::sights_from(scene_.blocking(), lines_.cell());
    sight_lines += sights.shot;
    std::vector<Found> found;
    for (std::size_t i = 0; i < sights.triangles.size(); ++i) {
      const auto id = scene_.blocking_id(sights.triangles[i]);
      if (scene_.scene().counting(id)) found.push_back({id, sights.rays[i]});
    }
    std::vector<std::uint8_t> reached(scene_.passing().mesh().triangles.size(), 0);
    tbb::parallel_for(std::size_t{0}, reached.size(), [&](std::size_t i) {
      reached[i] = reaches_passing(scene_.passing_id(static_cast<std::uint32_t>(i)), lines_to_passing, sight_lines);
    });
    for (std::uint32_t i = 0; i < reached.size(); ++i) {
      if (reached[i] != 0) found.push_back({scene_.passing_id(i), std::nullopt});
    }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.id < b.id; });
    return found;
  }

  Search find_witness(const Found& found, const Accuser& accuser, std::atomic<std::uint64_t>& sight_lines) const {
    Search out;
    if (!found.ray || !take(out, found.id, {found.ray->a, found.ray->b}, accuser))
      look_for_witness(out, found.id, lines_to_missing, accuser, sight_lines);
    return out;
  }

 private:
  struct Line {
    Point v, p;
  };

  void look_for_witness(Search& out, std::uint32_t id, int tries, const Accuser& accuser,
                        std::atomic<std::uint64_t>& sight_lines) const {
    const auto t = corners_of(id);
    fastpath::SegmentQueries queries(scene_.blocking());
    const auto at = scene_.find_blocking(id);
    const Ids itself = at ? Ids{*at} : Ids{};
    std::mt19937_64 random(id);
    for (int i = 0; i < tries && !viewpoints_.empty(); ++i) {
      const Line line = line_to(t, i, random);
      if (out.beyond && is_too_long(line, accuser)) continue;
      ++sight_lines;
      if (queries.any_hit({line.v, line.p}, {itself, &lines_.cell()})) continue;
      if (take(out, id, line, accuser)) return;
    }
  }

  // Of a free line: whether it accuses.
  bool take(Search& out, std::uint32_t id, const Line& line, const Accuser& accuser) const {
    const auto crossing = crossing_of(id, line);
    if (!crossing) return false;
    const bool too_long = is_too_long(line, accuser);
    auto& found = too_long ? out.beyond : out.witness;
    if (confirmed(*crossing, accuser)) {
      found = *crossing;
    } else {
      out.refused = out.refused || !too_long;
    }
    return out.witness.has_value();
  }

  // Or nearly: what accuses is surely no longer.
  static bool is_too_long(const Line& line, const Accuser& accuser) {
    if (accuser.far_plane == 0) return false;
    const double far = accuser.far_plane * (1 - 0x1p-40);
    return std::hypot(line.p[0] - line.v[0], line.p[1] - line.v[1], line.p[2] - line.v[2]) > far;
  }

  // The i-th line to a triangle: a little beyond it, so that it crosses it or misses it.
  Line line_to(const fastpath::Corners& t, int i, std::mt19937_64& random) const {
    std::uniform_real_distribution<double> unit(0, 1);
    Line line{viewpoints_[random() % viewpoints_.size()], {}};
    std::array<double, 3> w{unit(random), unit(random), unit(random)};
    if (i % 2 == 1) w[random() % 3] += 30;  // what is seen of a triangle in part, is most often a corner
    const double sum = w[0] + w[1] + w[2];
    for (std::size_t c = 0; c < 3; ++c) {
      line.p[c] = (w[0] * t[0][c] + w[1] * t[1][c] + w[2] * t[2][c]) / sum;
      line.p[c] += (line.p[c] - line.v[c]) * 0x1p-20;
    }
    return line;
  }

  fastpath::Corners corners_of(std::uint32_t id) const {
    fastpath::Corners t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = scene_.scene().mesh.points[scene_.scene().mesh.triangles[id][i]];
    return t;
  }

  bool reaches_passing(std::uint32_t id, int tries, std::atomic<std::uint64_t>& sight_lines) const {
    const auto t = corners_of(id);
    fastpath::SegmentQueries walls(scene_.blocking()), others(scene_.passing());
    std::mt19937_64 random(id);
    for (int i = 0; i < tries && !viewpoints_.empty(); ++i) {
      const Line line = line_to(t, i, random);
      ++sight_lines;
      if (walls.any_hit({line.v, line.p}, {{}, &lines_.cell()})) continue;
      const auto crossed = others.all_hits({line.v, line.p}, {{}, &lines_.cell()});
      if (std::any_of(crossed.begin(), crossed.end(), [&](std::uint32_t k) { return scene_.passing_id(k) == id; }))
        return true;
    }
    return false;
  }

  // Where the line crosses the plane of the triangle, not beyond its end.
  std::optional<Witness> crossing_of(std::uint32_t id, const Line& line) const {
    const auto& corners = scene_.scene().mesh.triangles[id];
    std::array<exact::Point3, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = exact::to_exact(scene_.scene().mesh.points[corners[i]]);
    const exact::Point3 from = exact::to_exact(line.v), to = exact::to_exact(line.p);
    const auto n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    const exact::FT slope = n * (to - from);
    if (slope == 0) return std::nullopt;
    const exact::FT s = n * (t[0] - from) / slope;
    if (s <= 0 || s > 1) return std::nullopt;
    return Witness{id, n * (from - t[0]) > 0, from, from + s * (to - from)};
  }

  // Whether the accuser and the witness checker agree.
  bool confirmed(const Witness& witness, const Accuser& accuser) const {
    if (accuser.accuses && !accuser.accuses(witness)) return false;
    // All that blocks, and the triangle itself where it does not.
    scene::TriangleMesh mesh = scene_.blocking().mesh();
    std::uint32_t place = 0;
    if (const auto there = scene_.find_blocking(witness.triangle)) {
      place = *there;
    } else {
      place = static_cast<std::uint32_t>(mesh.triangles.size());
      const fastpath::Corners corners = corners_of(witness.triangle);
      scene::Triangle own{};
      for (std::size_t i = 0; i < 3; ++i) {
        own[i] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(corners[i]);
      }
      mesh.triangles.push_back(own);
      mesh.face_of.push_back(place);
    }
    const NearSegment near = near_segment(std::move(mesh), place, witness.v, witness.p);
    return exact::check_witness(near.mesh, cell_, near.triangle, witness.front, witness.v, witness.p).valid;
  }

  const fastpath::SeeThroughScene& scene_;
  exact::ConvexCell cell_;
  fastpath::SightLines lines_;
  std::vector<Point> viewpoints_;
};

void take_verdicts(CellJudgement& out, const Ids& missing, const std::vector<CellJudge::Search>& searches) {
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const CellJudge::Search& found = searches[i];
    if (found.witness) {
      out.holes.push_back(*found.witness);
    } else if (found.beyond && !found.refused) {
      out.beyond.push_back(*found.beyond);
    } else {
      out.undecided.push_back(missing[i]);
    }
  }
}

}  // namespace

CellJudgement judge_cell(const fastpath::SeeThroughScene& scene, const std::vector<Point>& cell, const Ids& list,
                         const Accuser& accuser) {
  const auto seen = fastpath::visible_through(scene, cell, {});
  CellJudgement out;
  out.listed = list.size();
  out.fallbacks = seen.conservative_fallbacks;
  out.may_be_seen = seen.counting(scene.scene());
  std::atomic<std::uint64_t> sight_lines{0};
  const CellJudge judge(scene, cell);
  out.witnessed = judge.count_reached(out.may_be_seen, sight_lines);
  Ids missing;
  std::set_difference(out.may_be_seen.begin(), out.may_be_seen.end(), list.begin(), list.end(),
                      std::back_inserter(missing));
  const auto search = [&](const Ids& ids, int tries, const Accuser& of) {
    std::vector<CellJudge::Search> searches(ids.size());
    tbb::parallel_for(std::size_t{0}, ids.size(),
                      [&](std::size_t i) { searches[i] = judge.find_witness(ids[i], tries, of, sight_lines); });
    return searches;
  };
  take_verdicts(out, missing, search(missing, lines_to_missing, accuser));
  Ids hidden;
  for (std::uint32_t t = 0; t < scene.scene().mesh.triangles.size(); ++t) {
    if (scene.scene().counting(t) && !std::binary_search(out.may_be_seen.begin(), out.may_be_seen.end(), t))
      hidden.push_back(t);
  }
  for (const auto& found : search(hidden, lines_to_hidden, {})) {
    if (found.witness) out.contradictions.push_back(*found.witness);
  }
  out.sight_lines = sight_lines;
  return out;
}

CellJudgement search_cell(const fastpath::SeeThroughScene& scene, const std::vector<Point>& cell, const Ids& list,
                          const Accuser& accuser) {
  CellJudgement out;
  out.listed = list.size();
  std::atomic<std::uint64_t> sight_lines{0};
  const CellJudge judge(scene, cell);
  auto found = judge.find_by_lines(sight_lines);
  out.by_lines_alone = true;
  out.witnessed = found.size();
  std::erase_if(found, [&](const auto& one) { return std::binary_search(list.begin(), list.end(), one.id); });
  Ids missing;
  for (const auto& one : found) missing.push_back(one.id);
  std::vector<CellJudge::Search> searches(found.size());
  tbb::parallel_for(std::size_t{0}, found.size(),
                    [&](std::size_t i) { searches[i] = judge.find_witness(found[i], accuser, sight_lines); });
  take_verdicts(out, missing, searches);
  out.sight_lines = sight_lines;
  return out;
}

}  // namespace clues::validate
