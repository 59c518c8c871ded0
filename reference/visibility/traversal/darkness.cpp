#include "reference/visibility/traversal/darkness.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "exact/cell/direction_cone.h"
#include "exact/dials.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using exact::Vector3;

namespace {

constexpr std::uint64_t kDarkSeed = 0xda4c;
constexpr std::uint32_t kLeafSize = 2;

// A valid wedge piece as the part of its plane on the positive sides of up to four others.
struct StripShape {
  Plane3 plane;
  std::vector<Plane3> bounds;
  exact::PlaneBoxTest plane_box;
  std::vector<exact::PlaneBoxTest> bound_boxes;

  explicit StripShape(const ValidPiece& piece) : plane(piece.wedge.plane), plane_box(plane) {
    const Wedge& w = piece.wedge;
    const Vector3 n = plane.orthogonal_vector();
    bounds.emplace_back(w.center, CGAL::cross_product(n, w.on_ray0 - w.center));
    bounds.emplace_back(w.center, CGAL::cross_product(w.on_ray1 - w.center, n));
    if (w.near0 != w.near1) bounds.emplace_back(w.near0, CGAL::cross_product(w.near1 - w.near0, n));
    if (piece.strip.blocker) {
      const Blocker& b = piece.on_wedge->blockers[*piece.strip.blocker];
      bounds.emplace_back(b.u.p, CGAL::cross_product(n, b.w.p - b.u.p));
    }
    for (const Plane3& h : bounds) bound_boxes.emplace_back(h);
  }

  // False only if the closed piece certainly misses the box.
  bool may_meet(const CGAL::Bbox_3& box) const {
    const CGAL::Protect_FPU_rounding<true> interval_rounding;
    return plane_box(box) &&
           std::all_of(bound_boxes.begin(), bound_boxes.end(), [&](const auto& h) { return h.may_be_positive(box); });
  }

  // Whether the closed piece meets the inside of the triangle (with an area, where the triangle lies in the plane). Exact.
  bool meets_inside(const std::array<Point3, 3>& t) const {
    std::array<FT, 3> at;
    bool above = false, below = false;
    for (std::size_t i = 0; i < 3; ++i) {
      at[i] = exact::value_at(plane, t[i]);
      above |= CGAL::is_positive(at[i]);
      below |= CGAL::is_negative(at[i]);
    }
    if (!above && !below) {
      std::vector<Point3> rest(t.begin(), t.end());
      for (const Plane3& h : bounds) rest = exact::clipped(rest, h);
      return rest.size() >= 3;
    }
    if (!above || !below) return false;
    std::vector<Point3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (CGAL::is_zero(at[i])) ends.push_back(t[i]);
      if (CGAL::sign(at[i]) * CGAL::sign(at[j]) < 0) ends.push_back(t[i] + (at[i] / (at[i] - at[j])) * (t[j] - t[i]));
    }
    // The part of the open trace (0,1) on the positive sides.
    FT lo(0), hi(1);
    for (const Plane3& h : bounds) {
      const FT a = exact::value_at(h, ends[0]), b = exact::value_at(h, ends[1]);
      if (CGAL::is_negative(a) && CGAL::is_negative(b)) return false;
      if (CGAL::is_negative(a)) lo = std::max(lo, FT(a / (a - b)));
      if (CGAL::is_negative(b)) hi = std::min(hi, FT(a / (a - b)));
    }
    return lo <= hi && lo < FT(1) && hi > FT(0);
  }
};

}  // namespace

class DarknessQuery {
 public:
  DarknessQuery(const Darkness& tree, const exact::SceneQuery& part, const Walker& walker, const Fixpoint& fixpoint,
                const std::vector<bool>& visited, std::uint64_t& shaft_tests)
      : tree_(tree),
        part_(part),
        walker_(walker),
        fixpoint_(fixpoint),
        visited_(visited),
        shaft_tests_(shaft_tests),
        shapes_(fixpoint.wedges.pieces().size()),
        before_(tree.order_.size() + 1, 0) {
    for (std::size_t i = 0; i < tree.order_.size(); ++i) before_[i + 1] = before_[i] + !visited[tree.order_[i]];
  }

  std::vector<std::uint32_t> run() {
    if (!tree_.nodes_.empty()) ask(0);
    std::sort(not_dark_.begin(), not_dark_.end());
    return std::move(not_dark_);
  }

 private:
  void ask(std::uint32_t id) {
    const Darkness::Node& node = tree_.nodes_[id];
    if (before_[node.end] == before_[node.begin]) return;  // all visited
    if (before_[node.end] - before_[node.begin] > 1 && fixpoint_.left_out.empty() && is_one_part(node.box)) {
      const std::optional<bool> lit = label(point_in(node.box));
      if (lit) {
        if (*lit) add_all(node);
        return;
      }
    }
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const std::uint32_t t = tree_.order_[i];
        if (!visited_[t] && !is_dark(t)) not_dark_.push_back(t);
      }
      return;
    }
    ask(id + 1);
    ask(node.right);
  }

  void add_all(const Darkness::Node& node) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (!visited_[tree_.order_[i]]) not_dark_.push_back(tree_.order_[i]);
    }
  }

  const StripShape& shape(std::uint32_t i) {
    if (!shapes_[i]) shapes_[i] = std::make_unique<const StripShape>(fixpoint_.wedges.pieces()[i]);
    return *shapes_[i];
  }

  std::vector<std::uint32_t> wedges_near(const CGAL::Bbox_3& box) const {
    return fixpoint_.wedges.candidates([&box](const CGAL::Bbox_3& b) { return CGAL::do_overlap(b, box); });
  }

  // Whether no visited surface and no wedge piece meets the box.
  bool is_one_part(const CGAL::Bbox_3& box) {
    for (const std::uint32_t t : part_.candidates([&box](const CGAL::Bbox_3& b) { return CGAL::do_overlap(b, box); })) {
      const exact::PlaneBoxTest plane(part_.complex().planes[t]);
      const CGAL::Protect_FPU_rounding<true> interval_rounding;
      if (plane(box)) return false;
    }
    const auto near = wedges_near(box);
    return std::none_of(near.begin(), near.end(), [&](std::uint32_t i) { return shape(i).may_meet(box); });
  }

  static Point3 point_in(const CGAL::Bbox_3& box) {
    const auto between = [](double lo, double hi, int p, int q) { return FT(lo) + (FT(hi) - FT(lo)) * FT(p) / FT(q); };
    return exact::collapsed(Point3(between(box.xmin(), box.xmax(), 5, 11), between(box.ymin(), box.ymax(), 7, 13),
                                   between(box.zmin(), box.zmax(), 9, 17)));
  }

  // Whether p is visible; none if p lies in special position. p must be on no wedge piece.
  std::optional<bool> label(const Point3& p) {
    ++shaft_tests_;
    try {
      return walker_.label({p, std::nullopt, nullptr}, fixpoint_.wedges, fixpoint_.left_out, kDarkSeed).visible;
    } catch (const scene::Error&) {
      return std::nullopt;
    }
  }

  bool is_dark(std::uint32_t t) {
    const exact::Complex& complex = part_.complex();
    const auto& c = complex.pieces[t].corners;
    const std::array<Point3, 3> corners{complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]};
    const CGAL::Bbox_3& box = tree_.boxes_[t];
    for (const std::uint32_t i : wedges_near(box)) {
      if (shape(i).may_meet(box) && shape(i).meets_inside(corners)) return false;
    }
    const std::vector<Point3> ring(corners.begin(), corners.end());
    if (fixpoint_.left_out.may_reach(ring)) return false;
    return !label(exact::collapsed(CGAL::barycenter(corners[0], FT(5), corners[1], FT(6), corners[2], FT(7))))
                .value_or(true);
  }

  const Darkness& tree_;
  const exact::SceneQuery& part_;
  const Walker& walker_;
  const Fixpoint& fixpoint_;
  const std::vector<bool>& visited_;
  std::uint64_t& shaft_tests_;
  std::vector<std::unique_ptr<const StripShape>> shapes_;
  std::vector<std::uint32_t> before_;  // unvisited pieces before each place of the tree's order
  std::vector<std::uint32_t> not_dark_;
};

Darkness::Darkness(const exact::Complex& complex) {
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    const auto& c = complex.pieces[t].corners;
    boxes_.push_back(complex.points[c[0]].bbox() + complex.points[c[1]].bbox() + complex.points[c[2]].bbox());
    if (!complex.in_cell[t]) order_.push_back(t);
  }
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t Darkness::build(std::uint32_t begin, std::uint32_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  CGAL::Bbox_3 box;
  for (std::uint32_t i = begin; i < end; ++i) box += boxes_[order_[i]];
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeafSize || exact::process_dials::is_on(exact::process_dials::flat_trees)) return id;
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (box.max(i) - box.min(i) > box.max(axis) - box.min(axis)) axis = i;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto key = [&](std::uint32_t t) { return std::pair(boxes_[t].min(axis) + boxes_[t].max(axis), t); };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t s, std::uint32_t t) { return key(s) < key(t); });
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[id].right = right;
  return id;
}

std::vector<std::uint32_t> Darkness::not_dark(const exact::SceneQuery& part, const Walker& walker,
                                              const Fixpoint& fixpoint, const std::vector<bool>& visited,
                                              std::uint64_t& shaft_tests) const {
  return DarknessQuery(*this, part, walker, fixpoint, visited, shaft_tests).run();
}

}  // namespace clues::reference
