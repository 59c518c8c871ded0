// Sampled sight lines, each decided exactly (D5): at random; through vertices and beside edges, off by tiny amounts; toward the borders of hidden
// regions; and from the cell to points of hidden regions. The first three end where the fast path says that a segment ends.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "fastpath/queries/segment_queries.h"
#include "fuzz/findings/sight_aims.h"
#include "fuzz/generators/parts.h"
#include "fuzz/oracles/oracle.h"

namespace clues::fuzz {
namespace {

using exact::Point3;
using scene::Point;

class Shooter {
 public:
  Shooter(Exam& exam, const char* oracle)
      : exam_(exam),
        oracle_(oracle),
        random_(exam.random(oracle)),
        bvh_(exam.scene().mesh),
        cell_(exam.scene().cell),
        queries_(bvh_) {
    for (int tries = 0; tries < 24 && viewpoints_.size() < 8; ++tries) {
      const Point v = mix(exam_.scene().cell);
      if (exam_.cell().interior_contains(exact::to_exact(v))) viewpoints_.push_back(v);
    }
    // Extremal lines leave the cell near its corners.
    const Point c = exact::to_double_estimate(exam_.cell().center());
    for (int tries = 0; tries < 24 && near_corners_.size() < 8; ++tries) {
      Point v = any(exam_.scene().cell);
      const double t = std::ldexp(1, -random_.between(1, 20));
      for (std::size_t i = 0; i < 3; ++i) v[i] += t * (c[i] - v[i]);
      if (exam_.cell().interior_contains(exact::to_exact(v))) near_corners_.push_back(v);
    }
  }

  void shoot() {
    if (!viewpoints_.empty()) {
      for (int i = 0; i < 96; ++i) shoot_at("random", mix(exam_.scene().mesh.points), viewpoints_);
      for (int i = 0; i < 64; ++i)
        shoot_at("through vertices", off_by_a_little(any(exam_.scene().mesh.points), random_), viewpoints_);
      for (int i = 0; i < 96; ++i) shoot_at("beside edges", off_by_a_little(on_an_edge(), random_), viewpoints_);
      const auto borders = borders_of_what_is_denied();
      for (int i = 0; i < 96 && !borders.empty(); ++i) {
        const auto& [a, b] = any(borders);
        shoot_at("toward borders", off_by_a_little(on_line(a, b, random_.between(0, 16) / 16.0), random_),
                 random_.one_in(2) ? near_corners_ : viewpoints_);
      }
    }
    at_denied_points();
    const auto& counts = queries_.counts();
    exam_.count("sight lines decided", counts.queries);
    exam_.count("blocks of triangles decided in floats", counts.blocks);
    exam_.count("triangles decided in doubles", counts.doubles);
    exam_.count("triangles decided in whole numbers", counts.exact);
  }

 private:
  template <class T>
  const T& any(const std::vector<T>& from) {
    return fuzz::any(from, random_);
  }

  // Where labels change on surfaces, and the outlines of triangles that the answer lacks: what is wrong about an answer is wrong there first.
  std::vector<std::array<Point, 2>> borders_of_what_is_denied() const {
    std::vector<std::array<Point, 2>> out;
    for (const auto& s : exam_.map().segments) {
      if (s.boundary) out.push_back({exact::to_double_estimate(s.a), exact::to_double_estimate(s.b)});
    }
    const auto& mesh = exam_.scene().mesh;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (exam_.lists(t)) continue;
      for (std::size_t i = 0; i < 3; ++i)
        out.push_back({mesh.points[mesh.triangles[t][i]], mesh.points[mesh.triangles[t][(i + 1) % 3]]});
    }
    return out;
  }

  Point mix(const std::vector<Point>& points) { return random_mean(points, 16, random_); }

  Point on_an_edge() {
    const auto& mesh = exam_.scene().mesh;
    const scene::Triangle& t = any(mesh.triangles);
    const auto i = static_cast<std::size_t>(random_.between(0, 2));
    const Point &a = mesh.points[t[i]], &b = mesh.points[t[(i + 1) % 3]];
    return on_line(a, b, random_.between(0, 64) / 64.0);
  }

  // From the cell past q; what it hits is visible.
  void shoot_at(const char* aim, const Point& q, const std::vector<Point>& from_where) {
    if (from_where.empty()) return;
    const Point& v = any(from_where);
    const Point end = on_line(v, q, 4);
    exam_.count(std::string("sight lines ") + aim);
    const auto hit = queries_.first_hit({v, end}, {{}, &cell_});
    exam_.count(hit ? "sight lines that end on a surface" : "sight lines into the open");
    if (!hit) return;
    const bool listed = exam_.lists(*hit);
    if (listed ? found_region_ || !exam_.answer().map : found_triangle_) return;
    const auto corners = bvh_.corners(*hit);
    const exact::TriangleCorners t{exact::to_exact(corners[0]), exact::to_exact(corners[1]),
                                   exact::to_exact(corners[2])};
    if (const auto witness = witness_on(*hit, t, exact::to_exact(v), exact::to_exact(end))) file(*witness, aim);
  }

  void at_denied_points() {
    const exact::SceneQuery query(exam_.map().complex, exam_.cell());
    for (const auto& d : exam_.denied(4)) {
      if (exam_.lists(d.triangle) ? found_region_ : found_triangle_) continue;
      for (int i = 0; i < 3; ++i) {
        std::vector<int> weights;
        for (std::size_t k = 0; k < exam_.cell().vertices().size(); ++k)
          weights.push_back(random_.between(1, 40) * (random_.one_in(3) ? 8 : 1));
        const Point3 v = exam_.cell().interior_point(weights);
        if (d.side.oriented_side(v) != CGAL::ON_POSITIVE_SIDE) continue;
        exam_.count("sight lines to hidden points");
        if (!query.is_free(v, d.p)) continue;
        file({d.triangle, d.front, v, d.p}, "to a point called hidden");
        break;
      }
    }
  }

  void file(const validate::Witness& w, const char* aim) {
    bool& found = exam_.lists(w.triangle) ? found_region_ : found_triangle_;
    if (found || !exam_.denies(w)) return;  // most are not: the checker is asked about few
    if (exact::check_witness(exam_.scene().mesh, exam_.cell(), w.triangle, w.front, w.v, w.p).special) return;
    found = exam_.claim(oracle_, w, fmt::format("a free sight line ({}) ends where all is called hidden", aim));
  }

  Exam& exam_;
  const char* oracle_;
  Random random_;
  fastpath::Bvh bvh_;
  fastpath::Cell cell_;
  fastpath::SegmentQueries queries_;
  std::vector<Point> viewpoints_, near_corners_;  // in int V
  bool found_region_ = false, found_triangle_ = false;
};

class SightLines : public Oracle {
 public:
  const char* name() const override { return "sight-lines"; }
  const char* what() const override {
    return "sight lines at random, through vertices, beside edges, toward borders of hidden regions";
  }
  std::vector<const char*> needs() const override {
    return {"sight lines random",
            "sight lines through vertices",
            "sight lines beside edges",
            "sight lines toward borders",
            "sight lines that end on a surface",
            "sight lines into the open",
            "blocks of triangles decided in floats",
            "triangles decided in doubles",
            "triangles decided in whole numbers"};
  }
  void examine(Exam& exam) const override { Shooter(exam, name()).shoot(); }
};

}  // namespace

std::unique_ptr<Oracle> make_sight_lines() { return std::make_unique<SightLines>(); }

}  // namespace clues::fuzz
