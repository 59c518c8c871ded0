#include "tests/differential/reference_part.h"

#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/first_order.h"
#include "reference/visibility/labels/walk.h"
#include "reference/visibility/search/fixpoint.h"

namespace clues::tests {
namespace {

using exact::Point3;
using fastpath::SetLabel;
using Triangle3 = exact::Kernel::Triangle_3;

CGAL::Bbox_3 to_bbox(const fastpath::Box& b) { return {b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]}; }

class ReferencePart : public fastpath::PartialMap {
 public:
  ReferencePart(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, PartBug bug)
      : bug_(bug),
        map_(reference::first_order_visibility(mesh, cell, options_)),
        scene_(map_.complex, map_.cell),
        fixpoint_(reference::find_wedges(scene_, options_, statistics_)),
        walker_(scene_) {
    // The pieces as triangles; what is unbounded is cut far outside of the scene.
    for (const reference::ValidPiece& piece : fixpoint_.wedges.pieces()) {
      const reference::Wedge& wedge = piece.wedge;
      const auto far = [&](const Point3& on_ray) {
        return wedge.center + (on_ray - wedge.center) * exact::FT(1 << 30);
      };
      const Point3 a = wedge.near0, b = wedge.near1;
      const Point3 c = wedge.unbounded ? far(wedge.on_ray1) : wedge.far1;
      const Point3 d = wedge.unbounded ? far(wedge.on_ray0) : wedge.far0;
      for (const Triangle3& t : {Triangle3(a, b, c), Triangle3(a, c, d)}) {
        if (!t.is_degenerate()) triangles_.push_back(t);
      }
    }
    std::vector<CGAL::Bbox_3> boxes;
    for (const Triangle3& t : triangles_) boxes.push_back(t.bbox());
    tree_ = exact::BoxTree(std::move(boxes));
  }

  std::vector<std::uint32_t> visible() const override {
    return bug_ == PartBug::unlit ? std::vector<std::uint32_t>{} : map_.visible;
  }
  SetLabel label(const fastpath::Box& box) const override {
    if (wedge_may_touch(box)) return SetLabel::visible;
    std::vector<Point3> corners;
    for (unsigned i = 0; i < 8; ++i) {
      corners.push_back(exact::to_exact(
          {(i & 1U ? box.high : box.low)[0], (i & 2U ? box.high : box.low)[1], (i & 4U ? box.high : box.low)[2]}));
    }
    return label_at(box, corners);
  }
  SetLabel label_of_inside(std::span<const fastpath::ExactPoint> polygon, const fastpath::Box& about) const override {
    std::vector<Point3> corners;
    for (const fastpath::ExactPoint& p : polygon) {
      const fastpath::Exact3& x = p.exact();
      corners.emplace_back(exact::FT(x.x), exact::FT(x.y), exact::FT(x.z));
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Triangle3 triangle(corners[0], corners[i - 1], corners[i]);
      if (!triangle.is_degenerate() && touches(triangle.bbox(), triangle)) return SetLabel::visible;
    }
    return wedge_may_touch(about) ? SetLabel::elsewhere : label_at(about, corners);
  }
  SetLabel label_beside(const fastpath::Corners& t, const fastpath::Box& about) const override {
    const std::vector<Point3> corners{exact::to_exact(t[0]), exact::to_exact(t[1]), exact::to_exact(t[2])};
    const Triangle3 triangle(corners[0], corners[1], corners[2]);
    const exact::Plane3 plane = triangle.supporting_plane();
    const auto in_plane = [&](const Triangle3& piece) {
      return plane.has_on(piece[0]) && plane.has_on(piece[1]) && plane.has_on(piece[2]);
    };
    if (bug_ == PartBug::dark_below && plane.has_on_negative_side(exact::to_exact(fastpath::middle_of(about))))
      return SetLabel::hidden;
    if (touches(triangle.bbox(), triangle, in_plane)) return SetLabel::visible;
    return touches(to_bbox(about), box_of(about), in_plane) ? SetLabel::elsewhere : label_at(about, corners);
  }
  bool piece_may_touch(const fastpath::Corners& t) const override {
    if (bug_ == PartBug::unlit) return false;
    const Triangle3 triangle(exact::to_exact(t[0]), exact::to_exact(t[1]), exact::to_exact(t[2]));
    return triangle.is_degenerate() || touches(triangle.bbox(), triangle);
  }
  bool has_fallbacks() const override { return map_.statistics.conservative_fallbacks > 0; }

 private:
  // In the middle of the box, for all of the corners' hull.
  SetLabel label_at(const fastpath::Box& box, const std::vector<Point3>& corners) const {
    if (bug_ == PartBug::dark_everywhere) return SetLabel::hidden;
    const Point3 p = exact::to_exact(fastpath::middle_of(box));
    if (walker_.label({.p = p, .surface = std::nullopt}, fixpoint_.wedges, fixpoint_.left_out, 1).visible)
      return SetLabel::visible;
    return fixpoint_.left_out.may_reach(corners) ? SetLabel::visible : SetLabel::hidden;
  }
  bool wedge_may_touch(const fastpath::Box& box) const { return touches(to_bbox(box), box_of(box)); }
  static exact::Kernel::Iso_cuboid_3 box_of(const fastpath::Box& box) {
    return {exact::to_exact(box.low), exact::to_exact(box.high)};
  }
  template <class Shape>
  bool touches(const CGAL::Bbox_3& box, const Shape& shape) const {
    return touches(box, shape, [](const Triangle3&) { return false; });
  }
  template <class Shape, class But>
  bool touches(const CGAL::Bbox_3& box, const Shape& shape, const But& but) const {
    if (bug_ == PartBug::wedges_touch_nothing) return false;
    for (const std::uint32_t i : tree_.candidates([&](const CGAL::Bbox_3& b) { return CGAL::do_overlap(b, box); })) {
      if (!but(triangles_[i]) && CGAL::do_intersect(shape, triangles_[i])) return true;
    }
    return false;
  }

  PartBug bug_;
  reference::Options options_;
  reference::Statistics statistics_;
  reference::VisibilityMap map_;
  exact::SceneQuery scene_;
  reference::Fixpoint fixpoint_;
  reference::Walker walker_;
  std::vector<Triangle3> triangles_;
  exact::BoxTree tree_;
};

}  // namespace

fastpath::PartialMapMaker reference_parts(const exact::ConvexCell& cell, PartBug bug) {
  return [&cell, bug](const fastpath::ScenePart& part, fastpath::PartStage) {
    return std::make_shared<const ReferencePart>(part.mesh, cell, bug);
  };
}

}  // namespace clues::tests
