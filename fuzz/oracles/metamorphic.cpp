// Relations between scenes. A witness of one scene (D6) is carried to a changed scene in which the same triangle must be visible; the subject is asked
// again there. Only E is monotone under such changes, so witnesses are compared, not PVS - but where the geometry stays as it was, an exact subject must
// give the same answer, and where the cell is cut, it may not see more from a part than from the whole (D21).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "fuzz/findings/dials.h"
#include "fuzz/generators/parts.h"
#include "fuzz/oracles/oracle.h"

namespace clues::fuzz {
namespace {

using exact::Point3;
using exact::Vector3;
using scene::Point;
using validate::Witness;

// A changed case and where things went.
struct Changed {
  Case scene;
  std::vector<std::vector<std::uint32_t>>
      heirs;          // per old triangle: the new ones that are parts of it; none: it is gone
  double factor = 1;  // new point = factor * old point + offset
  Point offset{};
  bool same_geometry = false;  // the visible set is the same, and so is Omega
  bool part_of_cell = false;   // Omega is a part of what it was
};

Changed unchanged(const Case& scene) {
  Changed out{scene, {}, 1, {}, false, false};
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) out.heirs.push_back({t});
  return out;
}

Changed permuted(const Case& scene, Random& random) {
  Changed out = unchanged(scene);
  auto& triangles = out.scene.mesh.triangles;
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = order.size(); i-- > 1;)
    std::swap(order[i], order[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
  for (std::uint32_t t = 0; t < order.size(); ++t) {
    triangles[t] = scene.mesh.triangles[order[t]];
    const auto turn = random.between(0, 2);
    std::rotate(triangles[t].begin(), triangles[t].begin() + turn, triangles[t].end());
    out.heirs[order[t]] = {t};
  }
  out.same_geometry = true;
  return out;
}

// One triangle in two, at the middle of an edge where that is a double.
Changed split(const Case& scene, Random& random) {
  Changed out = unchanged(scene);
  auto& mesh = out.scene.mesh;
  const auto t = static_cast<std::uint32_t>(random.between(0, static_cast<int>(mesh.triangles.size()) - 1));
  const scene::Triangle old = mesh.triangles[t];
  const Point &a = mesh.points[old[0]], &b = mesh.points[old[1]];
  Point m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = a[i] / 2 + b[i] / 2;
  if (CGAL::midpoint(exact::to_exact(a), exact::to_exact(b)) != exact::to_exact(m)) return out;
  const auto middle = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(m);
  mesh.triangles[t] = {old[0], middle, old[2]};
  out.heirs[t].push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
  mesh.triangles.push_back({middle, old[1], old[2]});
  mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
  return out;
}

// Where a vertex more goes on the longest edge: a quarter along, from the lesser end on, so that triangles on both sides of an edge get the same one. None where
// that is no double.
struct MoreVertex {
  std::size_t first = 0;  // corner of the triangle at which the edge begins
  Point at{};
};
std::optional<MoreVertex> on_longest_edge(const scene::TriangleMesh& mesh, const scene::Triangle& t) {
  std::array<Point3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = exact::to_exact(mesh.points[t[i]]);
  MoreVertex out;
  for (std::size_t i = 1; i < 3; ++i) {
    if (CGAL::compare_distance(p[out.first], p[(out.first + 1) % 3], p[i], p[(i + 1) % 3]) == CGAL::SMALLER)
      out.first = i;
  }
  const Point3 &a = std::min(p[out.first], p[(out.first + 1) % 3]), &b = std::max(p[out.first], p[(out.first + 1) % 3]);
  const Point3 quarter = a + (b - a) / 4;
  out.at = exact::to_double_estimate(quarter);
  if (exact::to_exact(out.at) != quarter) return std::nullopt;
  return out;
}

// One triangle in two, or every one, at a vertex more on its longest edge. Neighbours that have the edge keep it: there is a T-junction then.
Changed with_more_vertices(const Case& scene, Random& random) {
  Changed out = unchanged(scene);
  auto& mesh = out.scene.mesh;
  const auto all = static_cast<std::uint32_t>(mesh.triangles.size());
  const bool one = random.one_in(2);
  const auto only = static_cast<std::uint32_t>(random.between(0, static_cast<int>(all) - 1));
  for (std::uint32_t t = one ? only : 0; t < (one ? only + 1 : all); ++t) {
    const auto more = on_longest_edge(scene.mesh, scene.mesh.triangles[t]);
    if (!more) continue;
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(more->at);
    scene::Triangle first = mesh.triangles[t], second = first;
    first[(more->first + 1) % 3] = middle;
    second[more->first] = middle;
    mesh.triangles[t] = first;
    out.heirs[t].push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back(second);
    mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
  }
  out.same_geometry = true;
  return out;
}

// Nothing where a coordinate would round.
Changed moved(const Case& scene, double factor, const Point& offset) {
  Changed out = unchanged(scene);
  out.factor = factor;
  out.offset = offset;
  out.same_geometry = true;
  bool rounds = false;
  for (auto* points : {&out.scene.mesh.points, &out.scene.cell}) {
    for (Point& p : *points) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = factor * p[i] + offset[i];
        rounds = rounds || (x - offset[i]) / factor != p[i] || !std::isfinite(x);
        p[i] = x;
      }
    }
  }
  return rounds ? unchanged(scene) : out;
}

// About half of the triangles, `kept` among them. Fewer triangles hide less; and a map of half the scene costs far less than half.
Changed without_some_triangles(const Case& scene, Random& random, std::uint32_t kept) {
  Changed out = unchanged(scene);
  auto& mesh = out.scene.mesh;
  mesh.triangles.clear();
  mesh.face_of.clear();
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    out.heirs[t].clear();
    if (t != kept && random.one_in(2)) continue;
    const auto heir = static_cast<std::uint32_t>(mesh.triangles.size());
    out.heirs[t].push_back(heir);
    mesh.triangles.push_back(scene.mesh.triangles[t]);
    mesh.face_of.push_back(heir);
  }
  return out;
}

Changed with_a_larger_cell(const Case& scene, Random& random) {
  Changed out = unchanged(scene);
  Point p = scene.cell[static_cast<std::size_t>(random.between(0, static_cast<int>(scene.cell.size()) - 1))];
  for (double& x : p) x += random.between(-8, 8) / 8.0;
  out.scene.cell.push_back(p);
  return out;
}

// The cell, cut into pyramids from a point c inside: the hulls of c and all points but one cover it (a ray from c leaves through a facet, and no facet has all
// points). One of them.
Changed with_a_part_of_the_cell(const Case& scene, const exact::ConvexCell& cell, Random& random) {
  Changed out = unchanged(scene);
  const Point c = exact::to_double_estimate(cell.center());
  if (scene.cell.size() < 2 || !cell.interior_contains(exact::to_exact(c))) return out;
  out.scene.cell[static_cast<std::size_t>(random.between(0, static_cast<int>(scene.cell.size()) - 1))] = c;
  out.part_of_cell = true;
  return out;
}

// Source and target swapped: the witness' triangle becomes the cell, and a small triangle around v the target. About half of the others stay.
struct Swapped {
  Case scene;
  Witness witness;
};
Swapped swapped(const Case& scene, const Witness& w, Random& random) {
  Swapped out{without_some_triangles(scene, random, w.triangle).scene, w};
  auto& mesh = out.scene.mesh;
  out.scene.cell.clear();
  for (const auto c : scene.mesh.triangles[w.triangle]) out.scene.cell.push_back(scene.mesh.points[c]);
  const Point v = exact::to_double_estimate(w.v), p = exact::to_double_estimate(w.p);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(p[i] - v[i]) > std::abs(p[axis] - v[axis])) axis = i;
  }
  const double size = std::abs(p[axis] - v[axis]) / 64;
  const auto corner = [&](int a, int b) {
    Point q = v;
    q[(axis + 1) % 3] += a * size;
    q[(axis + 2) % 3] += b * size;
    return q;
  };
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {corner(-1, -1), corner(2, -1), corner(-1, 2)});
  out.witness.triangle = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
  out.witness.front = p[axis] > v[axis];  // the corners turn counter-clockwise seen from beyond
  out.witness.v = w.p;
  out.witness.p = exact::to_exact(v);
  return out;
}

class Metamorphic : public Oracle {
 public:
  const char* name() const override { return "metamorphic"; }
  const char* what() const override {
    return "permuted, split, with vertices more on edges, scaled, moved, fewer triangles, the cell larger or cut, cell "
           "and target swapped: what was "
           "seen is still seen";
  }

  std::vector<const char*> needs() const override {
    return {"witnesses carried to changed scenes",
            "relations: permute",
            "relations: split",
            "relations: vertices more",
            "relations: scale",
            "relations: move",
            "relations: remove",
            "relations: grow the cell",
            "relations: cut the cell",
            "relations: swap cell and target"};
  }

  void examine(Exam& exam) const override {
    Random random = exam.random(name());
    const auto witnesses = some_witnesses(exam, random);
    // In solid mode the mesh must stay closed.
    static constexpr int all[] = {permute, split_one, scale, move, grow, cut, remove, swap, add_vertices};
    static constexpr int closed[] = {permute, scale, move, grow, cut};
    const int relation = exam.scene().solid ? closed[random.between(0, 4)] : all[random.between(0, 8)];
    exam.count(std::string("relations: ") + relations[relation]);
    if (relation != swap) return ask_again(exam, relation, random, witnesses);
    if (!witnesses.empty()) ask_swapped(exam, any(witnesses, random), random);
  }

 private:
  enum Relation { permute, split_one, scale, move, remove, grow, cut, swap, add_vertices };
  static constexpr const char* relations[] = {"permute",      "split",         "scale",        "move",
                                              "remove",       "grow the cell", "cut the cell", "swap cell and target",
                                              "vertices more"};

  static std::vector<Witness> some_witnesses(Exam& exam, Random& random) {
    std::vector<Witness> out;
    const exact::SceneQuery query(exam.map().complex, exam.cell());
    for (const auto& r : exam.map().regions) {
      if (!r.visible || out.size() >= 6 || random.one_in(3)) continue;
      const auto& plane = exam.map().complex.planes[r.piece];
      std::vector<int> weights;
      for (std::size_t k = 0; k < exam.cell().vertices().size(); ++k) weights.push_back(random.between(1, 16));
      const Point3 v = exam.cell().interior_point(weights);
      if (plane.oriented_side(v) != (r.front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE)) continue;
      if (!query.is_free(v, r.sample)) continue;
      const auto& o = exam.map().complex.pieces[r.piece].origins.front();
      const Witness w{o.triangle, r.front == o.same_side, v, r.sample};
      if (exact::check_witness(exam.scene().mesh, exam.cell(), w.triangle, w.front, w.v, w.p).valid) out.push_back(w);
    }
    exam.count("witnesses carried to changed scenes", out.size());
    return out;
  }

  static Changed change(const Exam& exam, int relation, Random& random) {
    const Case& scene = exam.scene();
    switch (relation) {
      case permute:
        return permuted(scene, random);
      case split_one:
        return split(scene, random);
      case add_vertices:
        return with_more_vertices(scene, random);
      case scale:
        return moved(scene, std::ldexp(1, random.between(-40, 40)), {});
      case move:
        return moved(scene, 1,
                     {random.between(-64, 64) / 16.0, random.between(-64, 64) / 16.0, random.between(-64, 64) / 16.0});
      case remove:
        return without_some_triangles(
            scene, random,
            static_cast<std::uint32_t>(random.between(0, static_cast<int>(scene.mesh.triangles.size()) - 1)));
      case grow:
        return with_a_larger_cell(scene, random);
      default:
        return with_a_part_of_the_cell(scene, exam.cell(), random);
    }
  }

  static std::optional<Answer> answer_to(Exam& exam, const Case& scene) {
    try {
      return exam.subject().answer(scene);
    } catch (const NoAnswer& error) {
      exam.file(without_answer(scene, error.what()));
      return std::nullopt;
    }
  }

  // A carried witness that the answer denies. Of the parts of a triangle at most one has p; a triangle that the cell touches needs no witness.
  bool denied(Exam& exam, const Case& scene, const exact::ConvexCell& cell, const Answer& answer, const Witness& w,
              const char* relation) const {
    const bool listed = std::binary_search(answer.pvs.begin(), answer.pvs.end(), w.triangle);
    if (listed && !(answer.map && in_hidden_region(*answer.map, w.triangle, w.front, w.p))) return false;
    if (scene.solid && !w.front) return false;
    if (!exact::check_witness(scene.mesh, cell, w.triangle, w.front, w.v, w.p).valid) return false;
    Finding f;
    f.oracle = name();
    f.verdict = listed ? "hidden-region/visible" : "hidden/visible";
    f.where = scene;
    f.triangle = w.triangle;
    f.witness = to_text(w);
    f.explanation = fmt::format("after the change '{}' a triangle that was seen is called hidden", relation);
    exam.file(std::move(f));
    return true;
  }

  // Exactly the triangles of Omega. Refined maps depend on where the cell was cut, limited ones on what was left out.
  static bool is_omega(const Answer& answer) {
    if (!answer.map) return answer.in_doubt && answer.in_doubt->empty();
    return answer.map->method == "first-order" && answer.map->statistics.conservative_fallbacks == 0;
  }

  void ask_swapped(Exam& exam, const Witness& witness, Random& random) const {
    const Swapped changed = swapped(exam.scene(), witness, random);
    const auto answer = answer_to(exam, changed.scene);
    if (!answer) return;
    const auto cell = exact::ConvexCell::from_doubles(changed.scene.cell);
    denied(exam, changed.scene, cell, *answer, changed.witness, relations[swap]);
  }

  void ask_again(Exam& exam, int relation, Random& random, const std::vector<Witness>& witnesses) const {
    const Changed changed = change(exam, relation, random);
    const auto answer = answer_to(exam, changed.scene);
    if (!answer) return;
    const auto cell = exact::ConvexCell::from_doubles(changed.scene.cell);
    for (const Witness& w : witnesses) {
      const auto carry = [&](const Point3& p) {
        return Point3(changed.factor * p.x() + changed.offset[0], changed.factor * p.y() + changed.offset[1],
                      changed.factor * p.z() + changed.offset[2]);
      };
      for (const std::uint32_t heir : changed.heirs[w.triangle]) {
        if (denied(exam, changed.scene, cell, *answer, {heir, w.front, carry(w.v), carry(w.p)}, relations[relation]))
          return;
      }
    }
    if (is_limited(exam.scene().dials) || !is_omega(exam.answer()) || !is_omega(*answer)) return;
    exam.count("lists compared with those of changed scenes");
    for (std::uint32_t t = 0; t < changed.heirs.size(); ++t) {
      const auto& heirs = changed.heirs[t];
      if (heirs.empty()) continue;
      const bool before = exam.lists(t), after = std::any_of(heirs.begin(), heirs.end(), [&](std::uint32_t heir) {
                                           return std::binary_search(answer->pvs.begin(), answer->pvs.end(), heir);
                                         });
      if (!(changed.same_geometry ? before != after : changed.part_of_cell && after && !before)) continue;
      Finding f;
      f.oracle = name();
      f.verdict = "answer/other-answer";
      f.where = exam.scene();
      f.explanation = fmt::format("the change '{}' changes the answer about triangle {}", relations[relation], t);
      return exam.file(std::move(f));
    }
  }
};

}  // namespace

std::unique_ptr<Oracle> make_metamorphic() { return std::make_unique<Metamorphic>(); }

}  // namespace clues::fuzz
