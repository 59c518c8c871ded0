// The cut of one plane after the other; see umbra.h.
#include "reference/visibility/hidden/umbra.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "exact/box_tree.h"
#include "exact/cell/direction_cone.h"
#include "exact/complex/simple_point.h"
#include "exact/threads.h"
#include "reference/visibility/planar/plane_parts.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using exact::Vector3;

namespace {

// A convex polygon that may bound the umbra.
struct Sheet {
  UmbraFacetKind kind;
  std::uint32_t triangle;
  Plane3 plane;
  std::vector<Point3> corners;
  bool lit = false;  // a wedge piece, of which the H- side is visible (D13); one that only separates (T10) says nothing
};

using PlaneKey = std::array<FT, 4>;

// The same for two planes exactly when they are the same set of points.
PlaneKey key_of(const Plane3& h) {
  PlaneKey key{h.a(), h.b(), h.c(), h.d()};
  const FT lead = *std::find_if(key.begin(), key.end(), [](const FT& x) { return !CGAL::is_zero(x); });
  for (FT& x : key) x = exact::collapsed(x / lead);
  return key;
}

Vector3 axis(int i) { return {i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0}; }

// The planes of the box, normals outward.
std::vector<Plane3> sides_of(const Box& box) {
  std::vector<Plane3> sides;
  for (int i = 0; i < 3; ++i) {
    sides.emplace_back(box.lo, -axis(i));
    sides.emplace_back(box.hi, axis(i));
  }
  return sides;
}

// The corners of side `i` (as in sides_of), in cyclic order.
std::vector<Point3> corners_of_side(const Box& box, int i) {
  const int k = i / 2, u = (k + 1) % 3, w = (k + 2) % 3;
  std::vector<Point3> corners;
  for (const auto& [at_u, at_w] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    FT x[3];
    x[k] = i % 2 == 0 ? box.lo[k] : box.hi[k];
    x[u] = at_u ? box.hi[u] : box.lo[u];
    x[w] = at_w ? box.hi[w] : box.lo[w];
    corners.emplace_back(x[0], x[1], x[2]);
  }
  return corners;
}

void collapse(std::vector<Point3>& corners) {
  for (Point3& p : corners) p = exact::collapsed(p);
}

// Where the plane meets the box, at least everywhere in it: a square around the box, seen along the plane's largest axis.
std::vector<Point3> wide_polygon(const Plane3& h, const Box& box) {
  const int k = exact::dominant_axis(h.orthogonal_vector()), u = (k + 1) % 3, w = (k + 2) % 3;
  const FT n[3] = {h.a(), h.b(), h.c()};
  std::vector<Point3> corners;
  for (const auto& [at_u, at_w] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    FT x[3];
    x[u] = at_u ? box.hi[u] : box.lo[u];
    x[w] = at_w ? box.hi[w] : box.lo[w];
    x[k] = -(n[u] * x[u] + n[w] * x[w] + h.d()) / n[k];
    corners.emplace_back(x[0], x[1], x[2]);
  }
  return corners;
}

// Marks of parts of a plane: visible on the side to which the plane's normal points, and on the other.
constexpr unsigned kLitBefore = 1, kLitBehind = 2;

class Builder {
 public:
  Builder(const Omega& omega, const Box& box)
      : omega_(omega), box_(box), sides_(sides_of(box)), labels_(omega, box.lo.bbox() + box.hi.bbox()) {
    add_box();
    add_surfaces();
    add_wedges();
    std::vector<CGAL::Bbox_3> boxes;
    std::map<PlaneKey, std::size_t> known;
    for (std::uint32_t i = 0; i < sheets_.size(); ++i) {
      CGAL::Bbox_3 b;
      for (const Point3& p : sheets_[i].corners) b += p.bbox();
      boxes.push_back(b);
      const auto [at, fresh] = known.emplace(key_of(sheets_[i].plane), groups_.size());
      if (fresh) groups_.emplace_back();
      groups_[at->second].push_back(i);
      group_of_.push_back(at->second);
    }
    tree_ = exact::BoxTree(std::move(boxes));
  }

  Umbra run() const {
    std::vector<Part> parts(groups_.size());
    tbb::parallel_for(std::size_t{0}, groups_.size(), [&](std::size_t i) { parts[i] = cut(i); });
    Umbra umbra;
    umbra.bounds = box_;
    umbra.planes = groups_.size();
    for (Part& p : parts) {
      umbra.parts += p.parts;
      umbra.fallbacks += p.fallbacks;
      std::move(p.facets.begin(), p.facets.end(), std::back_inserter(umbra.facets));
    }
    return umbra;
  }

 private:
  struct Part {
    std::vector<UmbraFacet> facets;
    std::uint64_t parts = 0, fallbacks = 0;
  };

  void add_box() {
    for (int i = 0; i < 6; ++i) {
      sheets_.push_back(
          {UmbraFacetKind::bound, 0, sides_[static_cast<std::size_t>(i)], corners_of_side(box_, i), false});
    }
  }

  void add_sheet(UmbraFacetKind kind, std::uint32_t triangle, const Plane3& plane, std::vector<Point3> corners,
                 bool lit = false) {
    for (const Plane3& side : sides_) {
      const bool out = std::any_of(corners.begin(), corners.end(),
                                   [&](const Point3& p) { return side.oriented_side(p) == CGAL::ON_POSITIVE_SIDE; });
      if (out) corners = exact::clipped(corners, side.opposite());
    }
    if (corners.size() < 3) return;
    collapse(corners);
    sheets_.push_back({kind, triangle, plane, std::move(corners), lit});
  }

  void add_surfaces() {
    const exact::Complex& complex = omega_.map().complex;
    for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
      if (complex.in_cell[t]) continue;
      const exact::Piece& piece = complex.pieces[t];
      std::vector<Point3> corners;
      for (const std::uint32_t c : piece.corners) corners.push_back(complex.points[c]);
      add_sheet(UmbraFacetKind::surface, piece.origins.front().triangle, complex.planes[t], std::move(corners));
    }
  }

  void add_wedges() {
    for (const ValidPiece& piece : omega_.fixpoint().wedges.pieces()) {
      const Wedge& w = piece.wedge;
      std::vector<Point3> corners;
      if (w.unbounded) {
        corners = wide_polygon(w.plane, box_);
        const Vector3 n = w.plane.orthogonal_vector();
        const auto keep_left = [&](const Point3& a, const Vector3& along) {
          corners = exact::clipped(corners, Plane3(a, CGAL::cross_product(n, along)));
        };
        keep_left(w.center, w.on_ray0 - w.center);
        keep_left(w.center, w.center - w.on_ray1);
        if (w.near0 != w.near1) keep_left(w.near0, w.near0 - w.near1);
      } else {
        for (const Point3& p : {w.near0, w.far0, w.far1, w.near1}) {  // at a joint of edge and blocker two are one
          if (std::find(corners.begin(), corners.end(), p) == corners.end()) corners.push_back(p);
        }
      }
      add_sheet(UmbraFacetKind::wedge, 0, w.plane, std::move(corners), !piece.holds_cell);
    }
  }

  // Whether the segment from q (in the planes of `own`) to p may touch a sheet of another plane, or p is not inside the box.
  bool in_the_way(const Point3& q, const Point3& p, const std::vector<std::uint32_t>& own) const {
    for (const Plane3& side : sides_) {
      if (side.oriented_side(p) != CGAL::ON_NEGATIVE_SIDE) return true;
    }
    for (const std::uint32_t i : tree_.candidates(exact::SegmentBoxTest(q, p))) {
      if (std::binary_search(own.begin(), own.end(), i)) continue;
      const Sheet& s = sheets_[i];
      const CGAL::Oriented_side at_q = s.plane.oriented_side(q), at_p = s.plane.oriented_side(p);
      if (at_q == at_p && at_q != CGAL::ON_ORIENTED_BOUNDARY) continue;
      bool left = false, right = false;
      for (std::size_t k = 0; k < s.corners.size(); ++k) {
        const CGAL::Orientation o = CGAL::orientation(q, p, s.corners[k], s.corners[(k + 1) % s.corners.size()]);
        left |= o == CGAL::POSITIVE;
        right |= o == CGAL::NEGATIVE;
      }
      if (!(left && right)) return true;
    }
    return false;
  }

  // A short point off q on the side that n points to, with nothing between. Not straight along n, so that the way there runs in no plane of the scene.
  Point3 beside(const Point3& q, const Plane3& plane, const Vector3& n, const std::vector<std::uint32_t>& own) const {
    constexpr int kSteps = 48, kSlowly = 24;
    const CGAL::Sign wanted = CGAL::sign(plane.orthogonal_vector() * n);
    const Vector3 skew = n + CGAL::cross_product(n, Vector3(FT(5) / FT(97), FT(7) / FT(89), FT(11) / FT(83)));
    FT step = FT(1) / FT(4);
    for (int i = 0; i < kSteps; ++i, step = i < kSlowly ? step / FT(4) : FT(step * step)) {
      const Point3 exactly = q + step * skew;
      for (int level = 0; level <= exact::kSimpleLevels; ++level) {
        const Point3 p = level == exact::kSimpleLevels
                             ? exact::collapsed(exactly)
                             : Point3(exact::simple_near(exactly.x(), level), exact::simple_near(exactly.y(), level),
                                      exact::simple_near(exactly.z(), level));
        if (CGAL::sign(exact::value_at(plane, p)) == wanted && !in_the_way(q, p, own)) return p;
      }
    }
    throw scene::Error(scene::ErrorCode::internal, "umbra: no free point beside a part of a plane");
  }

  // Of a part of one of these sheets, beside which p is.
  bool is_hidden(const Point3& p, const std::vector<Point3>& sheet, Part& out) const {
    const Walker::Label label = labels_(p, sheet);
    out.fallbacks += label.fallback;
    return !label.visible;
  }

  Part cut(std::size_t group) const {
    const std::vector<std::uint32_t>& own = groups_[group];
    const Plane3& plane = sheets_[own.front()].plane;
    PlaneCut cut(plane);
    for (const std::uint32_t i : own) {
      cut.add_polygon(sheets_[i].corners);
      CGAL::Bbox_3 box;
      for (const Point3& p : sheets_[i].corners) box += p.bbox();
      for (const std::uint32_t other :
           tree_.candidates([&](const CGAL::Bbox_3& b) { return CGAL::do_overlap(b, box); })) {
        if (std::binary_search(own.begin(), own.end(), other)) continue;
        const auto trace = trace_of(sheets_[other].corners, plane);
        if (!trace) continue;
        cut.add_segment(trace->first, trace->second, lit_beside(other, *trace, plane));
      }
    }
    Part out;
    std::vector<int> classes;
    const std::vector<PlaneCut::Component> components = cut.components();
    for (const PlaneCut::Component& c : components) {
      classes.push_back(-1);
      const Sheet* best = nullptr;  // a surface if any, else a wedge piece, else the box
      unsigned lit = c.marks;
      for (std::size_t k = 0; k < own.size(); ++k) {
        if (!cut.covers(k, c)) continue;
        const Sheet& s = sheets_[own[k]];
        if (!best || s.kind < best->kind) best = &s;
        if (!s.lit) continue;
        const bool up = CGAL::is_positive(s.plane.orthogonal_vector() * plane.orthogonal_vector());
        lit |= up ? kLitBefore : kLitBehind;
      }
      if (!best) continue;
      ++out.parts;
      // The far side of the box is nowhere.
      Vector3 n = plane.orthogonal_vector();
      n = n / (CGAL::abs(n.x()) + CGAL::abs(n.y()) + CGAL::abs(n.z()));
      bool hidden[2] = {false, false};  // behind, before
      for (const bool front : {false, true}) {
        const Vector3 off = front ? n : -n;
        if ((lit & (front ? kLitBefore : kLitBehind)) != 0) continue;
        const bool nowhere = std::any_of(sides_.begin(), sides_.end(), [&](const Plane3& side) {
          return side.has_on(c.inner) && CGAL::is_positive(side.orthogonal_vector() * off);
        });
        if (!nowhere) hidden[front] = is_hidden(beside(c.inner, plane, off, own), best->corners, out);
      }
      if (hidden[0] == hidden[1]) continue;
      // Sheets of one kind and triangle are one: the seams between them bound nothing.
      const auto same = std::find_if(own.begin(), own.end(), [&](std::uint32_t i) {
        return sheets_[i].kind == best->kind && sheets_[i].triangle == best->triangle;
      });
      classes.back() = 2 * static_cast<int>(*same) + (hidden[0] ? 0 : 1);
    }
    for (PlaneCut::Facet& f : cut.facets(classes)) {
      const Sheet& s = sheets_[static_cast<std::size_t>(f.of / 2)];
      if (f.of % 2 == 1) std::swap(f.corners[1], f.corners[2]);
      out.facets.push_back({s.kind, s.triangle, f.corners});
    }
    return out;
  }

  // The H- side of a valid wedge piece is visible (D13). So is a part of the plane on its H- side that ends at the piece: on the side of
  // the plane, or both, to which the piece reaches. Left and right of the trace, seen with the plane's normal up.
  PlaneCut::Trace lit_beside(std::uint32_t other, const std::pair<Point3, Point3>& trace, const Plane3& plane) const {
    const Sheet& sheet = sheets_[other];
    const int source = static_cast<int>(group_of_[other]);
    if (!sheet.lit) return {source, 0, 0};
    unsigned lit = 0;
    for (const Point3& p : sheet.corners) {
      const CGAL::Oriented_side side = plane.oriented_side(p);
      if (side != CGAL::ON_ORIENTED_BOUNDARY) lit |= side == CGAL::ON_POSITIVE_SIDE ? kLitBefore : kLitBehind;
    }
    const Vector3 left = CGAL::cross_product(plane.orthogonal_vector(), trace.second - trace.first);
    if (CGAL::is_positive(sheet.plane.orthogonal_vector() * left)) return {source, lit, 0};
    return {source, 0, lit};
  }

  static std::optional<std::pair<Point3, Point3>> trace_of(const std::vector<Point3>& corners, const Plane3& plane) {
    std::vector<Point3> ends;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const CGAL::Oriented_side at_a = plane.oriented_side(a), at_b = plane.oriented_side(b);
      if (at_a == CGAL::ON_ORIENTED_BOUNDARY) {
        ends.push_back(a);
      } else if (at_b != CGAL::ON_ORIENTED_BOUNDARY && at_a != at_b) {
        ends.push_back(exact::crossing(plane, a, b));
      }
    }
    if (ends.size() != 2) return std::nullopt;  // touches in a corner
    return std::pair(ends[0], ends[1]);
  }

  const Omega& omega_;
  Box box_;
  std::vector<Plane3> sides_;
  SpaceLabels labels_;
  std::vector<Sheet> sheets_;
  std::vector<std::vector<std::uint32_t>> groups_;  // sheets of one plane, ascending
  std::vector<std::size_t> group_of_;               // per sheet
  exact::BoxTree tree_;
};

Box wide_box(const CGAL::Bbox_3& b) {
  double extent = 1;
  for (int i = 0; i < 3; ++i) extent = std::max(extent, b.max(i) - b.min(i));
  const auto out = [&](int i, bool hi) { return hi ? b.max(i) + extent : b.min(i) - extent; };
  return {Point3(out(0, false), out(1, false), out(2, false)), Point3(out(0, true), out(1, true), out(2, true))};
}

}  // namespace

Umbra build_umbra(const Omega& omega, const std::optional<Box>& bounds, int threads) {
  const exact::StandardRange& range = omega.map().range;
  const Box box =
      bounds ? Box{range.moved_in(bounds->lo), range.moved_in(bounds->hi)} : wide_box(omega.scene().bounds());
  for (int i = 0; i < 3; ++i) {
    if (box.lo[i] >= box.hi[i])
      throw scene::Error(scene::ErrorCode::bad_argument, "the bounds of an umbra must be a solid box");
  }
  for (const Plane3& side : sides_of(box)) {
    for (const Point3& s : omega.map().cell.vertices()) {
      if (side.oriented_side(s) == CGAL::ON_POSITIVE_SIDE)
        throw scene::Error(scene::ErrorCode::bad_argument, "the bounds of an umbra must contain the cell");
    }
  }
  const Builder builder(omega, box);
  Umbra umbra = exact::by_threads(threads, [&] { return builder.run(); });
  if (!range.moves()) return umbra;
  umbra.bounds = {range.moved_back(umbra.bounds.lo), range.moved_back(umbra.bounds.hi)};
  for (UmbraFacet& facet : umbra.facets) {
    for (Point3& p : facet.corners) p = range.moved_back(p);
  }
  return umbra;
}

}  // namespace clues::reference
