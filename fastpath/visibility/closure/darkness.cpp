#include "fastpath/visibility/closure/darkness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "fastpath/predicates/estimated_vectors.h"
#include "fastpath/visibility/scene/local_scene.h"
#include "fastpath/visibility/wedges/contact.h"

namespace clues::fastpath {
namespace {

CGAL::Bbox_3 to_bbox(const Box& b) { return {b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]}; }

// False only if all corners of the box are strictly on one side of the plane, by the filter alone.
bool plane_may_touch(const Corners& t, const Box& b) {
  bool negative = false, positive = false;
  for (unsigned i = 0; i < 8; ++i) {
    const Point p{(i & 1U) != 0 ? b.high[0] : b.low[0], (i & 2U) != 0 ? b.high[1] : b.low[1],
                  (i & 4U) != 0 ? b.high[2] : b.low[2]};
    const FilteredSign side = orient3d_filtered(t[0], t[1], t[2], p);
    if (!side.certain || side.sign == Sign::zero) return true;
    (side.sign == Sign::negative ? negative : positive) = true;
  }
  return negative && positive;
}

// Whether all of the cell is in the plane of the triangle.
bool holds_all(const Corners& t, std::span<const Point> cell) {
  return std::all_of(cell.begin(), cell.end(), [&](const Point& v) { return side_of_plane(t, v) == 0; });
}

std::vector<std::uint32_t> with_edge_on(const Bvh& scene, std::span<const std::uint32_t> part,
                                        std::span<const std::uint32_t> visible, std::span<const Point> cell) {
  std::vector<std::uint32_t> all(visible.begin(), visible.end());
  std::copy_if(part.begin(), part.end(), std::back_inserter(all), [&](std::uint32_t t) {
    return !std::binary_search(visible.begin(), visible.end(), t) && holds_all(scene.corners(t), cell);
  });
  return all;
}

// No more lit triangles than this may cut one that is proved to be dark part by part.
constexpr std::size_t kMostCuts = 4;

using Polygon = std::vector<ExactPoint>;

// The parts of a convex polygon on either side of a plane.
void cut_at(const Polygon& polygon, const Plane& plane, Pool& pool, std::vector<Polygon>& parts) {
  std::vector<const ExactPoint*> corners;
  std::vector<int> side;
  for (const ExactPoint& p : polygon) {
    corners.push_back(pool.keep(p));
    side.push_back(plane.side(p));
  }
  for (const int way : {1, -1}) {
    if (std::find(side.begin(), side.end(), way) == side.end()) continue;
    Polygon& part = parts.emplace_back();
    for (std::size_t i = 0; i < side.size(); ++i) {
      const std::size_t j = (i + 1) % side.size();
      if (side[i] != -way) part.push_back(*corners[i]);
      if (side[i] * side[j] < 0) part.push_back(ExactPoint::on_plane(*corners[i], *corners[j], plane));
    }
  }
}

// The parts into which the planes of these triangles cut t. Points made on the way are kept in the pool.
std::vector<Polygon> parts_of(const Corners& t, std::span<const Corners* const> cutting, Pool& pool) {
  const RoundedUp rounded_up;
  std::vector<Polygon> parts{{ExactPoint(t[0]), ExactPoint(t[1]), ExactPoint(t[2])}};
  for (const Corners* c : cutting) {
    const Plane* plane =
        pool.plane(*pool.keep(ExactPoint((*c)[0])), *pool.keep(ExactPoint((*c)[1])), *pool.keep(ExactPoint((*c)[2])));
    std::vector<Polygon> cut;
    for (const Polygon& part : parts) cut_at(part, *plane, pool, cut);
    parts = std::move(cut);
  }
  return parts;
}

// Boxes that contain a point of the inside of a convex polygon each, nearer to one corner than to the others.
std::vector<Box> about_inside(const Polygon& polygon) {
  const RoundedUp rounded_up;
  // Weights whose sum is exactly 1.
  const auto others = static_cast<double>(polygon.size() - 1), of_other = std::floor(32 / others) / 64,
             of_first = 1 - others * of_other;
  std::vector<Box> boxes;
  for (std::size_t first = 0; first < polygon.size(); ++first) {
    IntervalBox sum{Interval(0), Interval(0), Interval(0)};
    for (std::size_t i = 0; i < polygon.size(); ++i)
      sum = sum + Interval(i == first ? of_first : of_other) * polygon[i].approximate();
    boxes.push_back({{sum.x.inf(), sum.y.inf(), sum.z.inf()}, {sum.x.sup(), sum.y.sup(), sum.z.sup()}});
  }
  return boxes;
}

constexpr std::array<std::array<double, 3>, 3> kInside{
    {{0.3125, 0.375, 0.3125}, {0.25, 0.25, 0.5}, {0.5, 0.1875, 0.3125}}};

}  // namespace

Dividers::Dividers(const Bvh& bvh, const std::vector<std::uint32_t>& ids) {
  std::vector<CGAL::Bbox_3> boxes;
  for (const std::uint32_t id : ids) {
    corners_.push_back(bvh.corners(id));
    boxes.push_back(to_bbox(scene::bounds_of(corners_.back())));
  }
  tree_ = exact::BoxTree(std::move(boxes));
}

bool Dividers::may_touch(const Box& box, const Corners* aside) const {
  for (const std::uint32_t i : near(box)) {
    if (plane_may_touch(corners_[i], box) && !(aside && in_plane_of(*aside, corners_[i]))) return true;
  }
  return false;
}

Dividers::Meeting Dividers::may_meet_inside(const Corners& t) const {
  Meeting meeting;
  for (const std::uint32_t i : near(scene::bounds_of(t))) {
    if (!may_meet_inside_conservative(t, corners_[i])) continue;
    if (in_plane_of(t, corners_[i])) {
      meeting.in_plane = true;
    } else {
      meeting.across.push_back(i);
    }
  }
  return meeting;
}

std::vector<std::uint32_t> Dividers::near(const Box& box) const {
  const CGAL::Bbox_3 b = to_bbox(box);
  return tree_.candidates([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(b, other); });
}

Darkness::Darkness(const PartialMap& map, const Bvh& scene, std::span<const std::uint32_t> part,
                   std::span<const std::uint32_t> visible, std::span<const Point> cell)
    : map_(map), dividers_(scene, with_edge_on(scene, part, visible, cell)), cell_(cell) {}

bool Darkness::is_edge_on(const Corners& t) const { return holds_all(t, cell_); }

bool Darkness::dark(const Corners& t) const {
  if (is_edge_on(t) && !touch(scene::bounds_of(t), scene::bounds_of(cell_))) return true;
  const Dividers::Meeting meeting = dividers_.may_meet_inside(t);
  if (meeting.across.size() > kMostCuts) return false;
  if (!meeting.in_plane && dark_inside(t, meeting.across)) return true;
  const int side = meeting.across.empty() ? side_of_cell(t) : 0;
  return side != 0 && dark_beside(t, side);
}

// Of parts into which lit triangles cut t: no light is on any of them. (What of t lies in the planes of these has measure zero.)
bool Darkness::dark_inside(const Corners& t, std::span<const std::uint32_t> across) const {
  std::vector<const Corners*> cutting;
  for (const std::uint32_t i : across) cutting.push_back(&dividers_.corners(i));
  Pool pool;
  const std::vector<Polygon> parts = parts_of(t, cutting, pool);
  return std::all_of(parts.begin(), parts.end(), [this](const Polygon& part) {
    // By a place about a point of the inside.
    for (const Box& about : about_inside(part)) {
      if (dividers_.may_touch(about)) continue;
      const SetLabel label = map_.label_of_inside(part, about);
      if (label != SetLabel::elsewhere) return label == SetLabel::hidden;
    }
    return false;
  });
}

// What only grazes t, in its plane, is no light: a lit floor on which t stands flush, a wedge that runs along a row of fronts. Then what is right
// beside the inside of t is cut by nothing and has one label on either side. Claim: if the cell is on one side of the plane of t, and what is right beside the inside of t
// is hidden on that side, no point x of the inside is in Omega(K). Proof: int V is strictly on that side. If x is in V, so are points right beside it there. Else
// x came into Omega(K) first by some C(y, v) with y not x (D9); this comes to x from the side of v, so what is right before x is in Omega(K), and right beside t on that side.
// The place: in a box that holds a point of the inside, with the middle on the side asked about, which nothing touches that is not in the plane.
bool Darkness::dark_beside(const Corners& t, int side) const {
  const Point n = cross_of(minus(t[1], t[0]), minus(t[2], t[0]));
  const Box all = scene::bounds_of(t);
  double extent = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    extent = std::max(extent, all.high[i] - all.low[i]);
    largest = std::max(largest, std::fabs(n[i]));
  }
  if (!(largest > 0)) return false;
  for (const std::array<double, 3>& weight : kInside) {
    for (const double step : {0x1p-6, 0x1p-12, 0x1p-20}) {
      Box about = about_inside(t, weight);
      for (std::size_t i = 0; i < 3; ++i) {
        const double by = side * (n[i] / largest) * step * extent;
        (by > 0 ? about.high : about.low)[i] += by;
      }
      if (side_of_plane(t, middle_of(about)) != side || dividers_.may_touch(about, &t)) continue;
      const SetLabel label = map_.label_beside(t, about);
      if (label != SetLabel::elsewhere) return label == SetLabel::hidden;
    }
  }
  return false;
}

int Darkness::side_of_cell(const Corners& t) const {
  bool negative = false, positive = false;
  for (const Point& v : cell_) {
    const int side = side_of_plane(t, v);
    negative |= side < 0;
    positive |= side > 0;
  }
  return static_cast<int>(positive) - static_cast<int>(negative);
}

// One level of the tree after the other, each in parallel, answers in order: the same for any number of threads.
std::vector<std::uint32_t> Darkness::not_proved(const Bvh& tree, const Which& skip, const Which& counts,
                                                std::size_t enough, ProvedDark& proved, ClosureCounts& figures,
                                                std::vector<std::uint32_t>* one_by_one) const {
  std::vector<std::uint32_t> failed, level;
  if (!tree.nodes().empty() && proved.nodes[0] == 0) level.push_back(0);
  for (bool any_counts = false; !level.empty() && !(any_counts && failed.size() >= enough);) {
    struct Answer {
      std::vector<std::uint32_t> open, failed, dark_children, dark;
    };
    std::vector<Answer> answers(level.size());
    tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) {
      const BoxLanes& node = tree.nodes()[level[i]];
      Answer& answer = answers[i];
      for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
        const std::uint32_t child = node.child[lane];
        if (child == BoxLanes::kEmpty) continue;
        const bool leaf = (child & BoxLanes::kLeaf) != 0;
        if ((leaf ? proved.blocks[child & ~BoxLanes::kLeaf] : proved.nodes[child]) != 0) continue;
        if (dark(tree.child_bounds(node, lane))) {
          answer.dark_children.push_back(child);
        } else if (!leaf) {
          answer.open.push_back(child);
        } else {
          const TriangleBlock& block = tree.blocks()[child & ~BoxLanes::kLeaf];
          for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t t = block.id[k];
            if ((k > 0 && t == block.id[0]) || proved.triangles[t] != 0 || skip(t)) continue;
            (dark(tree.corners(t)) ? answer.dark : answer.failed).push_back(t);
          }
        }
      }
    });
    figures.boxes_opened += level.size();
    level.clear();
    for (const Answer& a : answers) {
      level.insert(level.end(), a.open.begin(), a.open.end());
      failed.insert(failed.end(), a.failed.begin(), a.failed.end());
      any_counts = any_counts || std::any_of(a.failed.begin(), a.failed.end(), counts);
      for (const std::uint32_t child : a.dark_children) {
        ((child & BoxLanes::kLeaf) != 0 ? proved.blocks[child & ~BoxLanes::kLeaf] : proved.nodes[child]) = 1;
      }
      for (const std::uint32_t t : a.dark) proved.triangles[t] = 1;
      if (one_by_one) one_by_one->insert(one_by_one->end(), a.dark.begin(), a.dark.end());
      figures.boxes_dark += a.dark_children.size();
      figures.triangles_dark += a.dark.size();
    }
  }
  return failed;
}

Box about_inside(const Corners& t, const std::array<double, 3>& weight) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = weight[0] * t[0][i] + weight[1] * t[1][i] + weight[2] * t[2][i];
    const double off = 0x1p-50 * std::max({std::fabs(t[0][i]), std::fabs(t[1][i]), std::fabs(t[2][i])}) + 0x1p-1071;
    box.low[i] = x - 2 * off;
    box.high[i] = x + 2 * off;
  }
  return box;
}

}  // namespace clues::fastpath
