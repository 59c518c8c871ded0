#include "fastpath/visibility/closure/closure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "exact/box_tree.h"
#include "fastpath/predicates/estimated_vectors.h"
#include "fastpath/visibility/closure/sight_rays.h"
#include "fastpath/visibility/wedges/contact.h"

namespace clues::fastpath {
namespace {

// How many rays at a time look for a first guess, at most, and how many times, while they find what is new; and how many triangles whose
// proof failed are looked at before the map is made anew: as many as this, or as the map has, times two. (Of a scene behind a hole in K all proofs may fail.)
constexpr std::size_t kRays = 4096, kTimes = 6, kFailures = 512, kFailuresPerMapped = 2;

CGAL::Bbox_3 to_bbox(const Box& b) { return {b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]}; }

// Child `lane` of a node in the coordinates of the scene, rounded outward: the local box contains the exact triangles in exact local coordinates;
// dividing by a power of two is exact (or overflows to infinity, which is outward), the sum is rounded once.
Box child_box(const LocalFrame& frame, const BoxLanes& node, std::size_t lane) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::nextafter(static_cast<double>(node.side[i][lane]) / frame.scale + frame.center[i], -kInfinity);
    box.high[i] =
        std::nextafter(static_cast<double>(node.side[i + 3][lane]) / frame.scale + frame.center[i], kInfinity);
  }
  return box;
}

// The triangles of K that are lit, as boxes: all that light meets. What is dark in K stops no light, and need not be in K.
class LitTriangles {
 public:
  LitTriangles(const Bvh& bvh, const std::vector<std::uint32_t>& ids) {
    std::vector<CGAL::Bbox_3> boxes;
    for (const std::uint32_t id : ids) {
      corners_.push_back(bvh.corners(id));
      boxes.push_back(to_bbox(scene::bounds_of(corners_.back())));
    }
    tree_ = exact::BoxTree(std::move(boxes));
  }

  // Conservative: a box and the plane of a triangle beside it. Those in the plane of `aside` are not asked about.
  bool may_touch(const Box& box, const Corners* aside = nullptr) const {
    for (const std::uint32_t i : near(box)) {
      if (plane_may_touch(corners_[i], box) && !(aside && in_plane_of(*aside, corners_[i]))) return true;
    }
    return false;
  }
  // Whether one may have a point inside t, which is none of them: only some that lie in its plane, or others.
  enum class Meets : std::uint8_t { nothing, in_plane, across };
  Meets may_meet_inside(const Corners& t) const {
    Meets meets = Meets::nothing;
    for (const std::uint32_t i : near(scene::bounds_of(t))) {
      if (!may_meet_inside_conservative(t, corners_[i])) continue;
      if (!in_plane_of(t, corners_[i])) return Meets::across;
      meets = Meets::in_plane;
    }
    return meets;
  }

 private:
  std::vector<std::uint32_t> near(const Box& box) const {
    const CGAL::Bbox_3 b = to_bbox(box);
    return tree_.candidates([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(b, other); });
  }
  // False only if all corners of the box are strictly on one side of the plane, by the filter alone.
  static bool plane_may_touch(const Corners& t, const Box& b) {
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

  std::vector<Corners> corners_;
  exact::BoxTree tree_;
};

// Proofs that triangles lie outside Omega(K).
class Darkness {
 public:
  Darkness(const PartialMap& map, LitTriangles lit, std::span<const Point> cell)
      : map_(map), lit_(std::move(lit)), cell_(cell) {}

  // The triangles of the tree for which there is none, but for those that are skipped; no more levels of the tree are opened once there are `enough`.
  template <class Skip>
  std::vector<std::uint32_t> not_proved(const Bvh& tree, const Skip& skip, std::size_t enough,
                                        ClosureCounts& counts) const;

 private:
  bool dark(const Box& box) const { return !lit_.may_touch(box) && map_.label(box) == SetLabel::hidden; }
  bool dark(const Corners& t) const;
  bool dark_inside(const Corners& t) const;
  bool dark_beside(const Corners& t, int side) const;
  bool cell_on_one_side(const Corners& t) const;

  const PartialMap& map_;
  LitTriangles lit_;
  std::span<const Point> cell_;
};

constexpr std::array<std::array<double, 3>, 3> kInside{
    {{0.3125, 0.375, 0.3125}, {0.25, 0.25, 0.5}, {0.5, 0.1875, 0.3125}}};

bool Darkness::dark(const Corners& t) const {
  const LitTriangles::Meets meets = lit_.may_meet_inside(t);
  if (meets == LitTriangles::Meets::across) return false;
  if (meets == LitTriangles::Meets::nothing && dark_inside(t)) return true;
  return cell_on_one_side(t) && dark_beside(t, 1) && dark_beside(t, -1);
}

// By a place about a point of the inside.
bool Darkness::dark_inside(const Corners& t) const {
  for (const std::array<double, 3>& weight : kInside) {
    const Box about = about_inside(t, weight);
    if (lit_.may_touch(about)) continue;
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
      if (side_of_plane(t, middle_of(about)) != side || lit_.may_touch(about, &t)) continue;
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

template <class Skip>
std::vector<std::uint32_t> Darkness::not_proved(const Bvh& tree, const Skip& skip, std::size_t enough,
                                                ClosureCounts& counts) const {
  counts.boxes_dark = counts.boxes_opened = counts.triangles_dark = 0;
  std::vector<std::uint32_t> failed, level;
  if (!tree.nodes().empty()) level.push_back(0);
  // One level of the tree after the other, each in parallel, answers in order: the same for any number of threads.
  while (!level.empty() && failed.size() < enough) {
    struct Answer {
      std::vector<std::uint32_t> open, failed;
      std::uint64_t boxes_dark = 0, triangles_dark = 0;
    };
    std::vector<Answer> answers(level.size());
    tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) {
      const BoxLanes& node = tree.nodes()[level[i]];
      Answer& answer = answers[i];
      for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
        const std::uint32_t child = node.child[lane];
        if (child == BoxLanes::kEmpty) continue;
        if (dark(child_box(tree.frame(), node, lane))) {
          ++answer.boxes_dark;
        } else if ((child & BoxLanes::kLeaf) == 0) {
          answer.open.push_back(child);
        } else {
          const TriangleBlock& block = tree.blocks()[child & ~BoxLanes::kLeaf];
          for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t t = block.id[k];
            if (skip(t) || (k > 0 && t == block.id[0])) continue;
            if (dark(tree.corners(t))) {
              ++answer.triangles_dark;
            } else {
              answer.failed.push_back(t);
            }
          }
        }
      }
    });
    counts.boxes_opened += level.size();
    level.clear();
    for (const Answer& a : answers) {
      level.insert(level.end(), a.open.begin(), a.open.end());
      failed.insert(failed.end(), a.failed.begin(), a.failed.end());
      counts.boxes_dark += a.boxes_dark;
      counts.triangles_dark += a.triangles_dark;
    }
  }
  return failed;
}

class Closer {
 public:
  Closer(const Bvh& bvh, const Cell& cell, const exact::Dials& dials)
      : bvh_(bvh),
        cell_(cell),
        failures_(dials.batch),
        rays_(bvh, cell, dials.sight_rays),
        in_part_(bvh.mesh().triangles.size(), 0) {}

  // False if it was there.
  bool add(std::uint32_t triangle) {
    if (in_part_[triangle] != 0) return false;
    in_part_[triangle] = 1;
    part_.push_back(triangle);
    return true;
  }
  const std::vector<std::uint32_t>& part() const { return part_; }
  std::uint64_t rays() const { return rays_.count(); }
  void add_all();
  void add_triangles_by_the_cell();
  void add_seen_by_rays();

  // The scene of the part, ids ascending.
  scene::TriangleMesh part_mesh();
  // Tries to prove every triangle outside the part dark; adds what is in the way of that. False: all are dark.
  bool add_what_may_be_lit(const PartialMap& map, const std::vector<std::uint32_t>& visible);

  ClosureCounts counts;

 private:
  void add_with_neighbours(std::vector<std::uint32_t> seen);
  // Adds what sight lines to the triangles meet first; else the triangles themselves.
  void add_front_of(const std::vector<std::uint32_t>& triangles);

  const Bvh& bvh_;
  const Cell& cell_;
  std::size_t failures_;  // a dial; 0: our own number
  SightRays rays_;
  std::vector<std::uint8_t> in_part_;
  std::vector<std::uint32_t> part_;
};

void Closer::add_all() {
  for (std::uint32_t t = 0; t < in_part_.size(); ++t) add(t);
}

// D3: what meets the cell is visible. All whose boxes do: too many does no harm.
void Closer::add_triangles_by_the_cell() {
  const Box cell = scene::bounds_of(cell_.vertices());
  std::vector<std::uint32_t> nodes{0};
  while (!nodes.empty() && !bvh_.nodes().empty()) {
    const BoxLanes& node = bvh_.nodes()[nodes.back()];
    nodes.pop_back();
    for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
      const std::uint32_t child = node.child[lane];
      if (child == BoxLanes::kEmpty || !touch(cell, child_box(bvh_.frame(), node, lane))) continue;
      if ((child & BoxLanes::kLeaf) == 0) {
        nodes.push_back(child);
        continue;
      }
      for (const std::uint32_t t : bvh_.blocks()[child & ~BoxLanes::kLeaf].id) {
        if (touch(cell, scene::bounds_of(bvh_.corners(t)))) add(t);
      }
    }
  }
  if (part_.empty()) rays_.cell_is_empty();
}

void Closer::add_seen_by_rays() {
  add_with_neighbours(rays_.beside(part_));
  for (std::size_t time = 0; time < kTimes; ++time) {
    const std::size_t before = part_.size();
    add_with_neighbours(rays_.around(std::min(bvh_.mesh().triangles.size(), kRays), time));
    if (part_.size() == before) break;
  }
}

// And what is seen next to them, and next to that. Ids that are kNothing are left out.
void Closer::add_with_neighbours(std::vector<std::uint32_t> seen) {
  while (!seen.empty()) {
    std::vector<std::uint32_t> fresh;
    for (const std::uint32_t t : seen) {
      if (t != SightRays::kNothing && add(t)) fresh.push_back(t);
    }
    seen = rays_.beside(fresh);
  }
}

scene::TriangleMesh Closer::part_mesh() {
  std::sort(part_.begin(), part_.end());
  scene::TriangleMesh mesh;
  std::vector<std::uint32_t> points;
  for (const std::uint32_t t : part_) {
    const scene::Triangle& corners = bvh_.mesh().triangles[t];
    points.insert(points.end(), corners.begin(), corners.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const std::uint32_t p : points) mesh.points.push_back(bvh_.mesh().points[p]);
  for (const std::uint32_t t : part_) {
    scene::Triangle corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = std::lower_bound(points.begin(), points.end(), bvh_.mesh().triangles[t][i]);
      corners[i] = static_cast<std::uint32_t>(at - points.begin());
    }
    mesh.triangles.push_back(corners);
    mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
  }
  return mesh;
}

void Closer::add_front_of(const std::vector<std::uint32_t>& triangles) {
  const std::vector<std::uint32_t> met = rays_.towards(triangles);
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto first = met.begin() + static_cast<std::ptrdiff_t>(i * SightRays::kTowards);
    const std::size_t before = seen.size();
    std::copy_if(first, first + SightRays::kTowards, std::back_inserter(seen),
                 [&](std::uint32_t t) { return t != SightRays::kNothing && in_part_[t] == 0; });
    if (seen.size() == before) add(triangles[i]);
  }
  add_with_neighbours(std::move(seen));
}

bool Closer::add_what_may_be_lit(const PartialMap& map, const std::vector<std::uint32_t>& visible) {
  const Darkness darkness(map, LitTriangles(bvh_, visible), cell_.vertices());
  const std::size_t enough = failures_ > 0 ? failures_ : std::max(kFailures, kFailuresPerMapped * part_.size());
  std::vector<std::uint32_t> failed = darkness.not_proved(
      bvh_, [&](std::uint32_t t) { return in_part_[t] != 0; }, enough, counts);
  if (failures_ > 0) failed.resize(std::min(failed.size(), failures_));
  add_front_of(failed);
  return !failed.empty();
}

}  // namespace

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

std::vector<std::uint32_t> not_proved_dark(const Bvh& others, const Closure& closure, const Bvh& scene,
                                           const Cell& cell) {
  const Darkness darkness(*closure.map, LitTriangles(scene, closure.visible), cell.vertices());
  ClosureCounts uncounted;
  auto left = darkness.not_proved(
      others, [](std::uint32_t) { return false; }, others.mesh().triangles.size(), uncounted);
  std::sort(left.begin(), left.end());
  return left;
}

Closure close_over_visible(const Bvh& bvh, const Cell& cell, const PartialMapMaker& make_map, std::size_t whole,
                           const exact::Dials& dials, std::span<const std::uint32_t> guess) {
  using FirstGuess = exact::Dials::FirstGuess;
  Closer closer(bvh, cell, dials);
  const bool small = dials.first_guess == FirstGuess::seen && bvh.mesh().triangles.size() <= whole;
  if (small || dials.first_guess == FirstGuess::everything) {
    closer.add_all();
  } else if (!bvh.nodes().empty()) {
    closer.add_triangles_by_the_cell();
    for (const auto t : guess) closer.add(t);
    if (dials.first_guess == FirstGuess::seen) closer.add_seen_by_rays();
  }
  Closure result;
  do {
    ++closer.counts.passes;
    result.part_mesh = closer.part_mesh();
    result.map = make_map(result.part_mesh, closer.part());
    result.part = closer.part();
    result.visible.clear();
    for (const std::uint32_t i : result.map->visible()) result.visible.push_back(result.part[i]);
  } while (result.part.size() < bvh.mesh().triangles.size() && !bvh.nodes().empty() &&
           closer.add_what_may_be_lit(*result.map, result.visible));
  result.counts = closer.counts;
  result.counts.rays = closer.rays();
  return result;
}

}  // namespace clues::fastpath
