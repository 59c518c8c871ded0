#include "reference/visibility/planar/plane_parts.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>

#include "exact/complex/simple_point.h"

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Point2;
using exact::Point3;

namespace {

constexpr int kUnset = -2, kNone = -1;
constexpr int kOutline = -1, kSeveral = -2;  // sources of segments

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Tds = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cut = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds, CGAL::Exact_intersections_tag>>;
using Outline =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

Point2 collapsed(const Point2& p) { return {exact::collapsed(p.x()), exact::collapsed(p.y())}; }

// A short point strictly inside the counter-clockwise triangle.
Point2 inside(const Point2& a, const Point2& b, const Point2& c) {
  const Point2 p = CGAL::barycenter(a, FT(3), b, FT(4), c, FT(5));
  const auto holds = [&](const Point2& q) {
    return CGAL::left_turn(a, b, q) && CGAL::left_turn(b, c, q) && CGAL::left_turn(c, a, q);
  };
  for (int level = 0; level < exact::kSimpleLevels; ++level) {
    const Point2 q(exact::simple_near(p.x(), level), exact::simple_near(p.y(), level));
    if (holds(q)) return q;
  }
  return collapsed(p);
}

// Numbers the faces that can be reached from `start` without crossing a constrained edge.
template <class Triangulation>
void flood(const Triangulation& t, typename Triangulation::Face_handle start, int number) {
  std::vector<typename Triangulation::Face_handle> open{start};
  start->info() = number;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (t.is_infinite(next) || next->info() != kUnset || t.is_constrained({face, i})) continue;
      next->info() = number;
      open.push_back(next);
    }
  }
}

using Border = std::map<std::pair<int, int>, int>;  // from, to (numbers of points): what lies left

// Takes out the points at which the border of two classes just runs straight on.
void straighten(Border& border, const std::vector<Point2>& points) {
  std::vector<std::vector<int>> next(points.size());
  for (const auto& [edge, left] : border) next[static_cast<std::size_t>(edge.first)].push_back(edge.second);
  for (int at = 0; at < static_cast<int>(points.size()); ++at) {
    const auto& ends = next[static_cast<std::size_t>(at)];
    if (ends.size() != 2) continue;
    const int a = ends[0], b = ends[1];
    const auto point = [&](int i) { return points[static_cast<std::size_t>(i)]; };
    if (!CGAL::collinear(point(a), point(at), point(b))) continue;
    const int one = border.at({a, at}), two = border.at({at, a});
    for (const auto& e : {std::pair(a, at), {at, a}, {at, b}, {b, at}}) border.erase(e);
    border[{a, b}] = one;
    border[{b, a}] = two;
    std::replace(next[static_cast<std::size_t>(a)].begin(), next[static_cast<std::size_t>(a)].end(), at, b);
    std::replace(next[static_cast<std::size_t>(b)].begin(), next[static_cast<std::size_t>(b)].end(), at, a);
  }
}

}  // namespace

struct PlaneCut::Triangulated {
  Cut cdt;
  std::map<decltype(Cut::Constraint_id().vl_ptr()), std::size_t> segment_of;
};

PlaneCut::PlaneCut(const exact::Plane3& plane) : plane_(plane), frame_(plane), cut_(std::make_unique<Triangulated>()) {}

PlaneCut::~PlaneCut() = default;

void PlaneCut::add_polygon(const std::vector<Point3>& corners) {
  std::vector<Point2> flat;
  for (const Point3& p : corners) flat.push_back(frame_(p));
  if (CGAL::orientation(flat[0], flat[1], flat[2]) == CGAL::RIGHT_TURN) std::reverse(flat.begin(), flat.end());
  for (std::size_t i = 0; i < flat.size(); ++i)
    segments_.push_back({flat[i], flat[(i + 1) % flat.size()], {kOutline, 0, 0}});
  polygons_.push_back(std::move(flat));
}

void PlaneCut::add_segment(const Point3& a3, const Point3& b3, const Trace& trace) {
  Point2 a = frame_(a3), b = frame_(b3);
  const std::vector<Point2>& polygon = polygons_.back();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 &s = polygon[i], &t = polygon[(i + 1) % polygon.size()];
    const CGAL::Orientation at_a = CGAL::orientation(s, t, a), at_b = CGAL::orientation(s, t, b);
    if (at_a != CGAL::LEFT_TURN && at_b != CGAL::LEFT_TURN) return;  // outside, or along the outline
    if (at_a == CGAL::RIGHT_TURN || at_b == CGAL::RIGHT_TURN) {
      const FT u = CGAL::determinant(t - s, a - s), w = CGAL::determinant(t - s, b - s);
      (at_a == CGAL::RIGHT_TURN ? a : b) = a + (u / (u - w)) * (b - a);
    }
  }
  segments_.push_back({collapsed(a), collapsed(b), trace});
}

namespace {

// What two segments that run along each other say.
PlaneCut::Trace both(const PlaneCut::Trace& x, const PlaneCut::Trace& y) {
  if (x.source == kOutline) return y;
  if (y.source == kOutline) return x;
  if (x.source != y.source || x.source == kSeveral) return {kSeveral, 0, 0};
  return {x.source, x.left | y.left, x.right | y.right};
}

}  // namespace

void PlaneCut::insert_segments() {
  for (Segment& s : segments_) {
    if (s.a < s.b) continue;
    std::swap(s.a, s.b);
    std::swap(s.trace.left, s.trace.right);
  }
  std::sort(segments_.begin(), segments_.end(),
            [](const Segment& x, const Segment& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  std::size_t kept = 0;
  for (Segment& s : segments_) {
    if (kept > 0 && segments_[kept - 1].a == s.a && segments_[kept - 1].b == s.b) {
      segments_[kept - 1].trace = both(segments_[kept - 1].trace, s.trace);
    } else {
      segments_[kept++] = s;
    }
  }
  segments_.erase(segments_.begin() + static_cast<std::ptrdiff_t>(kept), segments_.end());
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto id = cut_->cdt.insert_constraint(segments_[i].a, segments_[i].b);
    cut_->segment_of.emplace(id.vl_ptr(), i);
  }
}

void PlaneCut::collect_marks() {
  const Cut& cdt = cut_->cdt;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (!cdt.is_constrained({f, i})) continue;
      const auto from = f->vertex(Cut::ccw(i)), to = f->vertex(Cut::cw(i));  // f lies left
      const bool along = from->point() < to->point();
      Trace trace{kOutline, 0, 0};
      for (auto c = cdt.contexts_begin(from, to); c != cdt.contexts_end(from, to); ++c)
        trace = both(trace, segments_[cut_->segment_of.at(c->id().vl_ptr())].trace);
      components_[static_cast<std::size_t>(f->info())].marks |= along ? trace.left : trace.right;
    }
  }
}

const std::vector<PlaneCut::Component>& PlaneCut::components() {
  Cut& cdt = cut_->cdt;
  insert_segments();
  for (auto v = cdt.finite_vertices_begin(); v != cdt.finite_vertices_end(); ++v) v->set_point(collapsed(v->point()));
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info() = kUnset;
  std::vector<double> sizes;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    if (f->info() != kUnset) continue;
    flood(cdt, f, static_cast<int>(sizes.size()));
    sizes.push_back(-1);
  }
  components_.resize(sizes.size());
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    const Point2 &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
    const double size = CGAL::to_double(CGAL::area(a, b, c));
    const auto i = static_cast<std::size_t>(f->info());
    if (size <= sizes[i]) continue;  // any triangle would do
    sizes[i] = size;
    components_[i].flat = inside(a, b, c);
  }
  for (Component& c : components_) c.inner = frame_.lifted(plane_, c.flat);
  collect_marks();
  return components_;
}

bool PlaneCut::covers(std::size_t polygon, const Component& component) const {
  const std::vector<Point2>& p = polygons_[polygon];
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (CGAL::orientation(p[i], p[(i + 1) % p.size()], component.flat) != CGAL::LEFT_TURN) return false;
  }
  return true;
}

std::vector<PlaneCut::Facet> PlaneCut::facets(const std::vector<int>& of) const {
  const Cut& cdt = cut_->cdt;
  const auto class_of = [&](Cut::Face_handle f) {
    return cdt.is_infinite(f) ? kNone : of[static_cast<std::size_t>(f->info())];
  };
  // The borders between components of different numbers.
  std::map<Point2, int> number;
  std::vector<std::pair<std::pair<Point2, Point2>, int>> edges;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int here = class_of(f), there = class_of(f->neighbor(i));
      if (here == there) continue;
      const Point2 &a = f->vertex(Cut::ccw(i))->point(), &b = f->vertex(Cut::cw(i))->point();
      edges.push_back({{a, b}, here});
      if (cdt.is_infinite(f->neighbor(i))) edges.push_back({{b, a}, there});
      number.emplace(a, 0);
      number.emplace(b, 0);
    }
  }
  std::vector<Point2> points;
  for (auto& [p, i] : number) {
    i = static_cast<int>(points.size());
    points.push_back(p);
  }
  Border border;
  for (const auto& [edge, left] : edges) border[{number.at(edge.first), number.at(edge.second)}] = left;
  straighten(border, points);

  Outline outline;
  std::vector<Outline::Vertex_handle> handles(points.size());
  const auto handle = [&](int i) {
    auto& h = handles[static_cast<std::size_t>(i)];
    if (h == Outline::Vertex_handle()) {
      h = outline.insert(points[static_cast<std::size_t>(i)]);
      h->info() = i;
    }
    return h;
  };
  for (const auto& [edge, left] : border) {
    if (edge.first < edge.second) outline.insert_constraint(handle(edge.first), handle(edge.second));
  }
  for (auto f = outline.all_faces_begin(); f != outline.all_faces_end(); ++f) f->info() = kUnset;
  for (auto f = outline.finite_faces_begin(); f != outline.finite_faces_end(); ++f) {
    for (int i = 0; i < 3 && f->info() == kUnset; ++i) {
      const auto at = border.find({f->vertex(Outline::ccw(i))->info(), f->vertex(Outline::cw(i))->info()});
      if (at != border.end()) flood(outline, f, at->second);
    }
  }
  std::vector<Facet> facets;
  for (auto f = outline.finite_faces_begin(); f != outline.finite_faces_end(); ++f) {
    if (f->info() < 0) continue;
    int first = 0;  // begin with the least corner
    for (int i = 1; i < 3; ++i) {
      if (f->vertex(i)->info() < f->vertex(first)->info()) first = i;
    }
    Facet facet{f->info(), {}};
    for (int i = 0; i < 3; ++i)
      facet.corners[static_cast<std::size_t>(i)] = frame_.lifted(plane_, f->vertex((first + i) % 3)->point());
    facets.push_back(std::move(facet));
  }
  std::sort(facets.begin(), facets.end(), [](const Facet& x, const Facet& y) {
    if (x.of != y.of) return x.of < y.of;
    return std::lexicographical_compare(x.corners.begin(), x.corners.end(), y.corners.begin(), y.corners.end());
  });
  return facets;
}

}  // namespace clues::reference
