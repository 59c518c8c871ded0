#include "tests/differential/scene_judge.h"

#include <time.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "exact/scene_query.h"
#include "exact/witness.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement.h"
#include "fuzz/campaign/dials.h"
#include "fuzz/campaign/oracle.h"
#include "fuzz/generators/random.h"
#include "reference/visibility/backprojection.h"
#include "reference/visibility/bounds.h"
#include "reference/visibility/subdivision.h"
#include "validate/region_points.h"
#include "validate/visible_set.h"

namespace clues::tests {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using Triangle3 = exact::Kernel::Triangle_3;

constexpr double kSlow = 2;  // seconds of one kernel on at most 10 triangles

std::string text_of(const Point3& p) {
  return fmt::format("({}, {}, {})", exact::to_string_exact(p.x()), exact::to_string_exact(p.y()),
                     exact::to_string_exact(p.z()));
}

// The first line, and of files only their names.
std::string one_line(const std::string& what) {
  std::string line;
  for (std::istringstream words(what); words;) {
    std::string word;
    words >> word;
    const auto slash = word.rfind('/');
    if (!word.empty()) line += (line.empty() ? "" : " ") + (slash == word.npos ? word : word.substr(slash + 1));
  }
  return line.substr(0, 160);
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
    ask();
    compare_lists();
    compare_areas();
    try {
      if (settings_.truth) judge_truth();
    } catch (const std::exception& error) {
      flaw("exception of a judge: " + one_line(error.what()), "");
    }
    out_.seconds = processor_seconds() - begin;
    return std::move(out_);
  }

 private:
  Point3 corner(std::uint32_t i) const { return exact::to_exact(scene_.mesh.points[i]); }

  void flaw(const std::string& category, const std::string& detail) {
    const bool known =
        std::any_of(out_.flaws.begin(), out_.flaws.end(), [&](const Flaw& f) { return f.category == category; });
    if (!known) out_.flaws.push_back({category, detail});
  }
  static double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  double count_time(const std::string& of, double begin) {
    const double seconds = processor_seconds() - begin;
    count("ms of " + of, static_cast<std::uint64_t>(1e3 * seconds + 0.5));
    return seconds;
  }
  void count(const std::string& what, std::uint64_t n = 1) { out_.counts[what] += n; }

  // --- the kernels

  template <class Ask>
  void ask_kernel(const std::string& kernel, const Ask& ask) {
    const auto& wanted = settings_.kernels;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), kernel) == wanted.end()) return;
    const double begin = processor_seconds();
    try {
      const exact::TurnedProcessDials turned(fuzz::process_dials(scene_.dials));
      KernelAnswer answer = ask();
      answer.kernel = kernel;
      if (settings_.planted_bug) settings_.planted_bug(answer);
      count("answers of " + kernel);
      if (answer.fallbacks > 0) {
        count("scenes with fallbacks of " + kernel);
        if (settings_.no_fallbacks && !fuzz::is_limited(scene_.dials) && answer.first_order &&
            scene_.mesh.triangles.size() <= 10)
          flaw("fallback of " + kernel, std::to_string(answer.fallbacks) + " of them");
      }
      answers_.push_back(std::move(answer));
    } catch (const std::exception& error) {
      count("exceptions of " + kernel);
      flaw("exception of " + kernel + ": " + one_line(error.what()), "");
    }
    if (count_time(kernel, begin) > kSlow && scene_.mesh.triangles.size() <= 10)
      count("slow scenes of " + kernel);  // a figure, and no flaw: machines differ
  }

  reference::Options reference_options() const {
    reference::Options options;
    options.threads = 1;
    options.dials = fuzz::map_dials(scene_.dials);
    return options;
  }
  fastpath::LocalMapOptions fast_options() const {
    fastpath::LocalMapOptions options;
    options.dials = fuzz::map_dials(scene_.dials);
    return options;
  }

  void ask() {
    const auto from_map = [&](reference::VisibilityMap map, bool first_order) {
      KernelAnswer a;
      a.visible = map.visible;
      a.fallbacks = map.statistics.conservative_fallbacks;
      a.first_order = first_order;
      if (first_order && map.statistics.walk_disagreements > 0)
        flaw("walks of the reference disagree", std::to_string(map.statistics.walk_disagreements) + " times");
      a.map = std::move(map);
      return a;
    };
    ask_kernel("plain reference", [&] {
      return from_map(reference::first_order_visibility(scene_.mesh, cell_, reference_options()), true);
    });
    ask_kernel("traversal", [&] {
      reference::Options options = reference_options();
      options.formulation = reference::Formulation::traversal;
      return from_map(reference::first_order_visibility(scene_.mesh, cell_, options), true);
    });
    const fastpath::Bvh bvh(scene_.mesh);
    const auto from_fast = [](std::vector<std::uint32_t> visible, std::uint64_t fallbacks, bool first_order,
                              std::vector<fastpath::LocalRegion> regions) {
      KernelAnswer a;
      a.visible = std::move(visible);
      a.fallbacks = fallbacks;
      a.first_order = first_order;
      a.regions = std::move(regions);
      return a;
    };
    ask_kernel("fast path", [&] {
      fastpath::FirstOrder found = fastpath::first_order_visibility(bvh, scene_.cell, fast_options(), true);
      return from_fast(found.visible, found.conservative_fallbacks, true, std::move(found.regions));
    });
    if (!settings_.refined) return;
    const bool by_planes = scene_.index % 2 == 1;
    ask_kernel(by_planes ? "backprojected reference" : "subdivided reference", [&] {
      reference::Bounds bounds(scene_.mesh, cell_, reference_options());
      if (by_planes) {
        refine_by_backprojection(bounds, {1, 0});
      } else {
        refine_by_cells(bounds, {2, 0});
      }
      return from_map(bounds.refined_map("refined"), false);
    });
    ask_kernel(by_planes ? "backprojected fast path" : "subdivided fast path", [&] {
      fastpath::RefinementOptions refinement;
      refinement.by = by_planes ? fastpath::RefineBy::backprojection : fastpath::RefineBy::cells;
      refinement.max_depth = 2;
      refinement.regions = true;
      auto found = fastpath::refined_visibility(bvh, scene_.cell, fast_options(), refinement);
      return from_fast(found.visible, found.conservative_fallbacks, false, std::move(found.first_order.regions));
    });
  }

  // --- against each other

  // What is in Omega without a fallback is in every first-order answer.
  void compare_lists() {
    for (const KernelAnswer& less : answers_) {
      for (const KernelAnswer& more : answers_) {
        if (!less.first_order || !more.first_order || less.fallbacks > 0) continue;
        for (const std::uint32_t t : less.visible) {
          if (std::binary_search(more.visible.begin(), more.visible.end(), t)) continue;
          flaw("list: " + less.kernel + " has a triangle more than " + more.kernel,
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
    count("scenes whose areas were compared");
    const Areas a = visible_areas(*exact), b = visible_areas(*fast);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const bool front : {true, false}) {
        const auto in_a = a.find({t, front}), in_b = b.find({t, front});
        const double x = in_a == a.end() ? 0 : in_a->second, y = in_b == b.end() ? 0 : in_b->second;
        const double whole = std::sqrt(CGAL::to_double(triangles_[t].squared_area()));
        if (std::abs(x - y) <= 1e-9 * whole) continue;
        flaw(x < y ? "area: the fast path has more than the reference"
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
    count_time("points and lines", begin);
    if (!settings_.visible_set) return;
    const double before = processor_seconds();
    judge_by_visible_set();
    count_time("the exact visible set", before);
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
    count("hidden points put to the oracle");
    const exact::OcclusionAnswer answer = exact::point_occlusion(p, side, cell_, soup_);
    if (!answer.occluded && answer.witness) {
      if (const auto v = convicting(t, front, *answer.witness, p)) {
        flaw("WRONG: " + whose, line_text(t, front, *v, p));
      } else if (cell_.dimension() == 3) {
        flaw("the oracle sees a hidden point, and its line is refused", line_text(t, front, *answer.witness, p));
      } else {
        count("hidden points seen from no point of V in general position");
      }
    }
    const Point3 v = any_viewpoint();
    count("sight lines to hidden points");
    if (convicts(t, front, v, p)) {
      flaw("WRONG: " + whose, line_text(t, front, v, p));
      if (answer.occluded) flaw("the oracle calls a point occluded that is seen", line_text(t, front, v, p));
    }
  }

  void judge_regions(const KernelAnswer& a) {
    const std::string whose = "a hidden region of the " + a.kernel + " is seen";
    if (a.map) {
      for (const reference::Region& r : a.map->regions) {
        if (r.visible) continue;
        count("hidden regions");
        const exact::Origin& o = a.map->complex.pieces[r.piece].origins.front();
        for (const Point3& p : validate::interior_points(r.rings, settings_.points_per_region))
          judge_hidden_point(whose, o.triangle, r.front == o.same_side, p);
      }
    } else {
      for (const fastpath::LocalRegion& r : *a.regions) {
        if (r.visible) continue;
        const double whole = std::sqrt(CGAL::to_double(triangles_[r.triangle].squared_area()));
        if (r.area_estimate < 1e-6 * whole) continue;
        count("hidden regions");
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
      count("triangles that somebody does not list");
      const auto convict = [&](const std::string& how, const std::string& detail) {
        for (const KernelAnswer* a : deniers) flaw("WRONG: " + how + " is missing from the " + a->kernel, detail);
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
        count("sight lines to triangles that are not listed");
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
    count("scenes decided completely");
    for (std::uint32_t t = 0; t < set.triangles.size(); ++t) {
      const validate::TriangleSight& sight = set.triangles[t];
      if (sight.sight == validate::Sight::undecided) count("triangles undecided by the exact visible set");
      if (!sight.witness) continue;
      const validate::Witness& w = *sight.witness;
      const auto v = convicting(t, w.front, w.v, w.p);
      if (!v) {
        if (cell_.dimension() == 3)
          flaw("the exact visible set has a line that is refused", line_text(t, w.front, w.v, w.p));
        count("triangles of the exact visible set seen from no point of V in general position");
        continue;
      }
      for (const KernelAnswer& a : answers_) {
        if (!std::binary_search(a.visible.begin(), a.visible.end(), t))
          flaw("WRONG: a visible triangle is missing from the " + a.kernel, line_text(t, w.front, *v, w.p));
        if (a.map && fuzz::in_hidden_region(*a.map, t, w.front, w.p))
          flaw("WRONG: a hidden region of the " + a.kernel + " is seen", line_text(t, w.front, *v, w.p));
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

bool is_box(const std::vector<scene::Point>& points, scene::Point& lo, scene::Point& hi) {
  lo = hi = points.front();
  for (const scene::Point& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  std::set<scene::Point> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.insert({i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]});
  return std::all_of(corners.begin(), corners.end(),
                     [&](const scene::Point& c) { return std::find(points.begin(), points.end(), c) != points.end(); });
}

}  // namespace

Judgement judge_scene(const fuzz::Case& scene, const JudgeSettings& settings) { return Judge(scene, settings).judge(); }

fuzz::Case shrunk(const fuzz::Case& scene, const JudgeSettings& settings, const std::string& category) {
  fuzz::Case best = scene;
  // Only what the flaw is about is asked.
  JudgeSettings asked = settings;
  for (const char* kernel : {"plain reference", "traversal", "fast path", "subdivided reference",
                             "backprojected reference", "subdivided fast path", "backprojected fast path"}) {
    if (category.find(kernel) != category.npos) asked.kernels.emplace_back(kernel);
  }
  if (category.find("area") == 0 || category.find("walks") == 0) asked.kernels = {"plain reference", "fast path"};
  asked.truth = category.find("fallback") != 0 && category.find("exception of") != 0 && category.find("slow") != 0 &&
                category.find("list") != 0;
  const auto keeps = [&](const fuzz::Case& smaller) {
    const Judgement j = judge_scene(smaller, asked);
    return std::any_of(j.flaws.begin(), j.flaws.end(), [&](const Flaw& f) { return f.category == category; });
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t t = best.mesh.triangles.size(); t-- > 0 && best.mesh.triangles.size() > 1;) {
      fuzz::Case smaller = best;
      smaller.mesh.triangles.erase(smaller.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      smaller.mesh.face_of.erase(smaller.mesh.face_of.begin() + static_cast<std::ptrdiff_t>(t));
      if (!keeps(smaller)) continue;
      best = std::move(smaller);
      changed = true;
    }
    const int dimension = exact::ConvexCell::from_doubles(best.cell).dimension();
    for (std::size_t i = best.cell.size(); i-- > 0 && best.cell.size() > 1;) {
      fuzz::Case smaller = best;
      smaller.cell.erase(smaller.cell.begin() + static_cast<std::ptrdiff_t>(i));
      if (exact::ConvexCell::from_doubles(smaller.cell).dimension() != dimension || !keeps(smaller)) continue;
      best = std::move(smaller);
      changed = true;
    }
  }
  return best;
}

std::string to_obj_text(const fuzz::Case& scene) {
  std::ostringstream text;
  text.precision(17);
  std::map<scene::Point, std::size_t> numbers;
  std::vector<std::array<std::size_t, 3>> faces;
  for (const scene::Triangle& t : scene.mesh.triangles) {
    std::array<std::size_t, 3> face{};
    for (std::size_t i = 0; i < 3; ++i) {
      const scene::Point& p = scene.mesh.points[t[i]];
      const auto known = numbers.find(p);
      if (known == numbers.end()) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      face[i] = known == numbers.end() ? numbers.emplace(p, numbers.size() + 1).first->second : known->second;
    }
    faces.push_back(face);
  }
  for (const auto& f : faces) text << "f " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  for (const auto& [name, value] : scene.dials) text << "# dial " << name << ' ' << value << '\n';
  scene::Point lo, hi;
  if (is_box(scene.cell, lo, hi)) {
    text << "--cell box:" << lo[0] << ',' << lo[1] << ',' << lo[2] << ',' << hi[0] << ',' << hi[1] << ',' << hi[2]
         << '\n';
  } else {
    text << "--cell cell.obj:\n";
    for (const scene::Point& p : scene.cell) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  return text.str();
}

}  // namespace clues::tests
