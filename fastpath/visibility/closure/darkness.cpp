#include "fastpath/visibility/closure/darkness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "fastpath/predicates/estimated_vectors.h"
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
bool is_edge_on(const Corners& t, std::span<const Point> cell) {
  return std::all_of(cell.begin(), cell.end(), [&](const Point& v) { return side_of_plane(t, v) == 0; });
}

std::vector<std::uint32_t> with_edge_on(const Bvh& scene, std::span<const std::uint32_t> part,
                                        std::span<const std::uint32_t> visible, std::span<const Point> cell) {
  std::vector<std::uint32_t> all(visible.begin(), visible.end());
  std::copy_if(part.begin(), part.end(), std::back_inserter(all), [&](std::uint32_t t) {
    return !std::binary_search(visible.begin(), visible.end(), t) && is_edge_on(scene.corners(t), cell);
  });
  return all;
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

bool Dividers::may_touch(const Corners& t) const {
  const Box box = scene::bounds_of(t);
  for (const std::uint32_t i : near(box)) {
    if (plane_may_touch(corners_[i], box) && plane_may_touch(t, scene::bounds_of(corners_[i]))) return true;
  }
  return false;
}

Dividers::Meets Dividers::may_meet_inside(const Corners& t) const {
  Meets meets = Meets::nothing;
  for (const std::uint32_t i : near(scene::bounds_of(t))) {
    if (!may_meet_inside_conservative(t, corners_[i])) continue;
    if (!in_plane_of(t, corners_[i])) return Meets::across;
    meets = Meets::in_plane;
  }
  return meets;
}

std::vector<std::uint32_t> Dividers::near(const Box& box) const {
  const CGAL::Bbox_3 b = to_bbox(box);
  return tree_.candidates([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(b, other); });
}

Darkness::Darkness(const PartialMap& map, const Bvh& scene, std::span<const std::uint32_t> part,
                   std::span<const std::uint32_t> visible, std::span<const Point> cell)
    : map_(map), dividers_(scene, with_edge_on(scene, part, visible, cell)), cell_(cell) {}

bool Darkness::dark(const Corners& t) const {
  if (is_edge_on(t, cell_) && !touch(scene::bounds_of(t), scene::bounds_of(cell_))) return true;
  const Dividers::Meets meets = dividers_.may_meet_inside(t);
  if (meets == Dividers::Meets::across) return false;
  if (meets == Dividers::Meets::nothing && dark_inside(t)) return true;
  return cell_on_one_side(t) && dark_beside(t, 1) && dark_beside(t, -1);
}

// By a place about a point of the inside.
bool Darkness::dark_inside(const Corners& t) const {
  for (const std::array<double, 3>& weight : kInside) {
    const Box about = about_inside(t, weight);
    if (dividers_.may_touch(about)) continue;
    const SetLabel label = map_.label_of_inside(t, about);
    if (label != SetLabel::elsewhere) return label == SetLabel::hidden;
  }
  return false;
}

// What only grazes t, in its plane, is no light: a lit floor on which t stands flush, a wedge that runs along a row of fronts. Then what is right
// beside the inside of t is cut by nothing and has one label on either side. Claim: if both are hidden and the cell is on one side of the plane of t, no
// point x of the inside is in Omega(K). Proof: t is not in K. Were x in Omega(K) and on no triangle of K, its continuations in K would run on beyond it
// and be in Omega(K): right beside t, away from the cell. Were it on one, that lies in the plane; light that meets x comes off the plane, as int V is,
// so it has just been in what is right beside t.
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

bool Darkness::cell_on_one_side(const Corners& t) const {
  bool negative = false, positive = false;
  for (const Point& v : cell_) {
    const int side = side_of_plane(t, v);
    negative |= side < 0;
    positive |= side > 0;
  }
  return negative != positive;
}

// One level of the tree after the other, each in parallel, answers in order: the same for any number of threads.
std::vector<std::uint32_t> Darkness::not_proved(const Bvh& tree, const Which& skip, const Which& counts,
                                                std::size_t enough, ProvedDark& proved, ClosureCounts& figures) const {
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
