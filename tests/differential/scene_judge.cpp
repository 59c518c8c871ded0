#include "tests/differential/scene_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "fuzz/generators/random.h"
#include "fuzz/oracles/oracle.h"
#include "validate/certificates/region_points.h"
#include "validate/visible_set/visible_set.h"

namespace clues::tests {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using Triangle3 = exact::Kernel::Triangle_3;

std::string text_of(const Point3& p) {
  return fmt::format("({}, {}, {})", exact::to_string_exact(p.x()), exact::to_string_exact(p.y()),
                     exact::to_string_exact(p.z()));
}

class Judge {
 public:
  Judge(const fuzz::Case& scene, const JudgeSettings& settings)
      : scene_(scene),
        settings_(settings),
        random_(fuzz::Random(scene.seed ^ 0x6a09e667f3bcc908ULL).next() ^ scene.index),
        cell_(exact::ConvexCell::from_doubles(scene.cell)) {
    for (const auto& [a, b, c] : scene.mesh.triangles) triangles_.emplace_back(corner(a), corner(b), corner(c));
  }

  Judgement judge() {
    const double begin = processor_seconds();
    answers_ = ask_kernels(scene_, cell_, settings_, out_);
    compare_lists();
    compare_areas();
    try {
      if (settings_.truth) judge_truth();
    } catch (const std::exception& error) {
      out_.flaw("exception of a judge: " + one_line(error.what()), "");
    }
    out_.seconds = processor_seconds() - begin;
    return std::move(out_);
  }

 private:
  Point3 corner(std::uint32_t i) const { return exact::to_exact(scene_.mesh.points[i]); }

  // --- against each other

  // What one kernel knows to be in Omega is in every first-order answer (D17b).
  void compare_lists() {
    for (const KernelAnswer& less : answers_) {
      for (const KernelAnswer& more : answers_) {
        if (!less.first_order || !more.first_order) continue;
        const auto is_in = [](const std::vector<std::uint32_t>& list, std::uint32_t t) {
          return std::binary_search(list.begin(), list.end(), t);
        };
        for (const std::uint32_t t : less.visible) {
          if (is_in(less.in_doubt, t) || is_in(more.visible, t)) continue;
          out_.flaw("list: " + less.kernel + " knows a triangle that is missing from " + more.kernel,
                    "triangle " + std::to_string(t) + "; fallbacks of the latter: " + std::to_string(more.fallbacks));
        }
      }
    }
  }

  using Areas = std::map<std::pair<std::uint32_t, bool>, double>;

  static Areas visible_areas(const KernelAnswer& a) {
    Areas areas;
    if (a.map) {
      for (const reference::Region& r : a.map->regions) {
        if (!r.visible) continue;
        const auto& c = a.map->complex.pieces[r.piece].corners;
        const auto& points = a.map->complex.points;
        const double area = std::sqrt(CGAL::to_double(CGAL::squared_area(points[c[0]], points[c[1]], points[c[2]]))) *
                            CGAL::to_double(r.area_fraction);
        for (const exact::Origin& o : a.map->complex.pieces[r.piece].origins)
          areas[{o.triangle, o.same_side == r.front}] += area;
      }
    } else {
      for (const fastpath::LocalRegion& r : *a.regions) {
        if (r.visible) areas[{r.triangle, r.front}] += r.area_estimate;
      }
    }
    return areas;
  }

  // Regions of the fast path are doubles, so this is no exact test.
  void compare_areas() {
    const KernelAnswer *exact = nullptr, *fast = nullptr;
    for (const KernelAnswer& a : answers_) {
      if (a.kernel == "plain reference") exact = &a;
      if (a.kernel == "fast path") fast = &a;
    }
    if (!exact || !fast || exact->fallbacks + fast->fallbacks > 0) return;
    out_.count("scenes whose areas were compared");
    const Areas a = visible_areas(*exact), b = visible_areas(*fast);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const bool front : {true, false}) {
        const auto in_a = a.find({t, front}), in_b = b.find({t, front});
        const double x = in_a == a.end() ? 0 : in_a->second, y = in_b == b.end() ? 0 : in_b->second;
        const double whole = std::sqrt(CGAL::to_double(triangles_[t].squared_area()));
        if (std::abs(x - y) <= 1e-9 * whole) continue;
        out_.flaw(x < y ? "area: the fast path has more than the reference"
                        : "area: the fast path has less than the reference",
                  "triangle " + std::to_string(t) + (front ? " front" : " back") + ": reference " + std::to_string(x) +
                      ", fast path " + std::to_string(y) + " of " + std::to_string(whole));
      }
    }
  }

  // --- against the truth

  void judge_truth() {
    take_soup();
    const double begin = processor_seconds();
    for (const KernelAnswer& a : answers_) judge_regions(a);
    judge_lists();
    out_.count_time("points and lines", begin);
    if (!settings_.visible_set) return;
    const double before = processor_seconds();
    judge_by_visible_set();
    out_.count_time("the exact visible set", before);
  }

  void take_soup() {
    std::optional<exact::Complex> own;
    const exact::Complex* complex = nullptr;
    for (const KernelAnswer& a : answers_) {
      if (a.map) complex = &a.map->complex;
    }
    if (!complex) complex = &own.emplace(exact::build_complex(scene_.mesh, &cell_));
    for (const exact::Piece& p : complex->pieces)
      soup_.push_back({complex->points[p.corners[0]], complex->points[p.corners[1]], complex->points[p.corners[2]]});
  }

  // The narrowed D6: v must not lie on a triangle, but for one in the plane of a flat cell, or one that holds the line of a segment cell around v. Then
  // the points of V near v see p as well.
  bool generic(const Point3& v) const {
    if (cell_.dimension() == 0 || cell_.dimension() == 3) return true;
    for (const Triangle3& t : triangles_) {
      if (t.is_degenerate() || !t.has_on(v)) continue;
      if (cell_.dimension() == 2) {
        for (const Point3& s : cell_.vertices()) {
          if (!t.supporting_plane().has_on(s)) return false;
        }
        continue;
      }
      const Point3 &a = cell_.vertices()[0], &b = cell_.vertices()[1];
      if (!t.supporting_plane().has_on(a) || !t.supporting_plane().has_on(b)) return false;
      const auto part = CGAL::intersection(t, exact::Kernel::Line_3(a, b));
      const auto* segment = part ? boost::get<exact::Kernel::Segment_3>(&*part) : nullptr;
      if (!segment || segment->source() == v || segment->target() == v) return false;
    }
    return true;
  }

  Point3 any_viewpoint() {
    std::vector<int> weights;
    for (std::size_t i = 0; i < cell_.vertices().size(); ++i)
      weights.push_back(random_.between(1, 40) * (random_.one_in(4) ? 16 : 1));
    return cell_.interior_point(weights);
  }

  bool convicts(std::uint32_t t, bool front, const Point3& v, const Point3& p) const {
    return generic(v) && exact::check_witness(scene_.mesh, cell_, t, front, v, p).valid;
  }

  // v, or a point of V next to it, from which the line to p convicts.
  std::optional<Point3> convicting(std::uint32_t t, bool front, const Point3& v, const Point3& p) {
    if (convicts(t, front, v, p)) return v;
    for (int k = 0; k < 32 && cell_.dimension() > 0; ++k) {
      const Point3 near = exact::collapsed(v + FT(std::ldexp(1, -1 - k)) * (any_viewpoint() - v));
      if (convicts(t, front, near, p)) return near;
    }
    return std::nullopt;
  }

  static std::string line_text(std::uint32_t t, bool front, const Point3& v, const Point3& p) {
    return "triangle " + std::to_string(t) + (front ? " front" : " back") + ", v = " + text_of(v) +
           ", p = " + text_of(p);
  }

  bool faces_cell(const Plane3& side) const {
    return std::any_of(cell_.vertices().begin(), cell_.vertices().end(),
                       [&](const Point3& s) { return side.oriented_side(s) == CGAL::ON_POSITIVE_SIDE; });
  }

  // A point of the triangle that is called hidden on that side (D18, D5).
  void judge_hidden_point(const std::string& whose, std::uint32_t t, bool front, const Point3& p) {
    const Plane3 plane = triangles_[t].supporting_plane(), side = front ? plane : plane.opposite();
    if (!faces_cell(side)) return;
    out_.count("hidden points put to the oracle");
    const exact::OcclusionAnswer answer = exact::point_occlusion(p, side, cell_, soup_);
    if (!answer.occluded && answer.witness) {
      if (const auto v = convicting(t, front, *answer.witness, p)) {
        out_.flaw("WRONG: " + whose, line_text(t, front, *v, p));
      } else if (cell_.dimension() == 3) {
        out_.flaw("the oracle sees a hidden point, and its line is refused", line_text(t, front, *answer.witness, p));
      } else {
        out_.count("hidden points seen from no point of V in general position");
      }
    }
    const Point3 v = any_viewpoint();
    out_.count("sight lines to hidden points");
    if (convicts(t, front, v, p)) {
      out_.flaw("WRONG: " + whose, line_text(t, front, v, p));
      if (answer.occluded) out_.flaw("the oracle calls a point occluded that is seen", line_text(t, front, v, p));
    }
  }

  void judge_regions(const KernelAnswer& a) {
    const std::string whose = "a hidden region of the " + a.kernel + " is seen";
    if (a.map) {
      for (const reference::Region& r : a.map->regions) {
        if (r.visible) continue;
        out_.count("hidden regions");
        const exact::Origin& o = a.map->complex.pieces[r.piece].origins.front();
        for (const Point3& p : validate::interior_points(r.rings, settings_.points_per_region))
          judge_hidden_point(whose, o.triangle, r.front == o.same_side, p);
      }
    } else {
      for (const fastpath::LocalRegion& r : *a.regions) {
        if (r.visible) continue;
        const double whole = std::sqrt(CGAL::to_double(triangles_[r.triangle].squared_area()));
        if (r.area_estimate < 1e-6 * whole) continue;
        out_.count("hidden regions");
        if (const auto p = point_inside(r)) judge_hidden_point(whose, r.triangle, r.front, *p);
      }
    }
  }

  // A point of the triangle at the middle of a convex region whose corners are doubles.
  std::optional<Point3> point_inside(const fastpath::LocalRegion& r) const {
    scene::Point middle{};
    for (const scene::Point& q : r.outline_estimate) {
      for (std::size_t i = 0; i < 3; ++i) middle[i] += q[i] / static_cast<double>(r.outline_estimate.size());
    }
    const auto at = [&](std::size_t i) { return scene_.mesh.points[scene_.mesh.triangles[r.triangle][i]]; };
    const auto minus = [](const scene::Point& a, const scene::Point& b) {
      return scene::Point{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto cross = [](const scene::Point& a, const scene::Point& b) {
      return scene::Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const scene::Point& a, const scene::Point& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const scene::Point u = minus(at(1), at(0)), w = minus(at(2), at(0)), d = minus(middle, at(0)), n = cross(u, w);
    const double b = dot(cross(d, w), n) / dot(n, n), c = dot(cross(u, d), n) / dot(n, n), a = 1 - b - c;
    if (std::min({a, b, c}) < 1e-9) return std::nullopt;
    const Triangle3& t = triangles_[r.triangle];
    return exact::collapsed(CGAL::barycenter(t[0], FT(a), t[1], FT(b), t[2], FT(c)));
  }

  void judge_lists() {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      std::vector<const KernelAnswer*> deniers;
      for (const KernelAnswer& a : answers_) {
        if (!std::binary_search(a.visible.begin(), a.visible.end(), t)) deniers.push_back(&a);
      }
      if (deniers.empty() || triangles_[t].is_degenerate()) continue;
      out_.count("triangles that somebody does not list");
      const auto convict = [&](const std::string& how, const std::string& detail) {
        for (const KernelAnswer* a : deniers) out_.flaw("WRONG: " + how + " is missing from the " + a->kernel, detail);
      };
      if (exact::meets_cell({triangles_[t][0], triangles_[t][1], triangles_[t][2]}, cell_)) {
        convict("a triangle that meets the cell", "triangle " + std::to_string(t));
        continue;
      }
      for (int i = 0; i < settings_.sight_lines; ++i) {
        const int a = random_.between(1, 30), b = random_.between(1, 30), c = random_.between(1, 30);
        const Point3 p = exact::collapsed(
            CGAL::barycenter(triangles_[t][0], FT(a), triangles_[t][1], FT(b), triangles_[t][2], FT(c)));
        const Point3 v = any_viewpoint();
        const auto side = triangles_[t].supporting_plane().oriented_side(v);
        if (side == CGAL::ON_ORIENTED_BOUNDARY) continue;
        const bool front = side == CGAL::ON_POSITIVE_SIDE;
        out_.count("sight lines to triangles that are not listed");
        if (convicts(t, front, v, p)) convict("a visible triangle", line_text(t, front, v, p));
        if (i > 1) continue;
        const Plane3 plane = triangles_[t].supporting_plane();
        for (const bool f : {true, false}) {
          const Plane3 asked = f ? plane : plane.opposite();
          if (!faces_cell(asked)) continue;
          const auto answer = exact::point_occlusion(p, asked, cell_, soup_);
          if (answer.occluded || !answer.witness) continue;
          if (const auto w = convicting(t, f, *answer.witness, p))
            convict("a visible triangle", line_text(t, f, *w, p));
        }
      }
    }
  }

  void judge_by_visible_set() {
    validate::VisibleSetOptions options;
    options.trust_map = false;
    const auto set = validate::exact_visible_set(scene_.mesh, cell_, options);
    out_.count("scenes decided completely");
    for (std::uint32_t t = 0; t < set.triangles.size(); ++t) {
      const validate::TriangleSight& sight = set.triangles[t];
      if (sight.sight == validate::Sight::undecided) out_.count("triangles undecided by the exact visible set");
      if (!sight.witness) continue;
      const validate::Witness& w = *sight.witness;
      const auto v = convicting(t, w.front, w.v, w.p);
      if (!v) {
        if (cell_.dimension() == 3)
          out_.flaw("the exact visible set has a line that is refused", line_text(t, w.front, w.v, w.p));
        out_.count("triangles of the exact visible set seen from no point of V in general position");
        continue;
      }
      for (const KernelAnswer& a : answers_) {
        if (!std::binary_search(a.visible.begin(), a.visible.end(), t))
          out_.flaw("WRONG: a visible triangle is missing from the " + a.kernel, line_text(t, w.front, *v, w.p));
        if (a.map && fuzz::in_hidden_region(*a.map, t, w.front, w.p))
          out_.flaw("WRONG: a hidden region of the " + a.kernel + " is seen", line_text(t, w.front, *v, w.p));
      }
    }
  }

  const fuzz::Case& scene_;
  const JudgeSettings& settings_;
  fuzz::Random random_;
  exact::ConvexCell cell_;
  std::vector<Triangle3> triangles_;
  std::vector<KernelAnswer> answers_;
  std::vector<exact::TriangleCorners> soup_;
  Judgement out_;
};

}  // namespace

Judgement judge_scene(const fuzz::Case& scene, const JudgeSettings& settings) { return Judge(scene, settings).judge(); }

}  // namespace clues::tests
