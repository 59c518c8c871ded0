// Relations between scenes. A witness of one scene (D6) is carried to a changed scene in which the same triangle must be visible; the subject is asked
// again there. Only E is monotone, so witnesses are compared, not PVS - but for changes that leave the geometry as it was, where an exact subject
// must give the same answer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "exact/scene_query.h"
#include "exact/witness.h"
#include "fuzz/campaign/oracle.h"

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
};

Changed unchanged(const Case& scene) {
  Changed out{scene, {}, 1, {}, false};
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

Changed without_a_triangle(const Case& scene, Random& random) {
  Changed out = unchanged(scene);
  auto& mesh = out.scene.mesh;
  if (mesh.triangles.size() < 2) return out;
  const auto gone = static_cast<std::uint32_t>(random.between(0, static_cast<int>(mesh.triangles.size()) - 1));
  mesh.triangles.erase(mesh.triangles.begin() + gone);
  mesh.face_of.pop_back();
  for (std::uint32_t t = 0; t < out.heirs.size(); ++t) {
    out.heirs[t] = t == gone ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{t - (t > gone ? 1U : 0U)};
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

class Metamorphic : public Oracle {
 public:
  const char* name() const override { return "metamorphic"; }
  const char* what() const override {
    return "permuted, split, scaled, moved, with a triangle less or a larger cell: what was seen is still seen";
  }

  std::vector<const char*> needs() const override {
    return {"witnesses carried to changed scenes",
            "relations: permute",
            "relations: split",
            "relations: scale",
            "relations: move",
            "relations: remove",
            "relations: grow the cell"};
  }

  void examine(Exam& exam) const override {
    Random random = exam.random(name());
    const auto witnesses = some_witnesses(exam, random);
    const int first = random.between(0, 5);
    for (const int relation : {first, (first + random.between(1, 5)) % 6}) {
      if (ask_again(exam, relation, random, witnesses)) return;
    }
  }

 private:
  static constexpr const char* relations[] = {"permute", "split", "scale", "move", "remove", "grow the cell"};

  static std::vector<Witness> some_witnesses(Exam& exam, Random& random) {
    std::vector<Witness> out;
    const exact::SceneQuery query(exam.map().complex, exam.cell());
    for (const auto& r : exam.map().regions) {
      if (!r.visible || out.size() >= 6 || random.one_in(3)) continue;
      const auto& plane = exam.map().complex.planes[r.piece];
      const Point3& v = exam.cell().center();
      if (plane.oriented_side(v) != (r.front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE)) continue;
      if (!query.is_free(v, r.sample)) continue;
      const auto& o = exam.map().complex.pieces[r.piece].origins.front();
      const Witness w{o.triangle, r.front == o.same_side, v, r.sample};
      if (exact::check_witness(exam.scene().mesh, exam.cell(), w.triangle, w.front, w.v, w.p).valid) out.push_back(w);
    }
    exam.count("witnesses carried to changed scenes", out.size());
    return out;
  }

  static Changed change(const Case& scene, int relation, Random& random) {
    switch (relation) {
      case 0:
        return permuted(scene, random);
      case 1:
        return split(scene, random);
      case 2:
        return moved(scene, std::ldexp(1, random.between(-40, 40)), {});
      case 3:
        return moved(scene, 1,
                     {random.between(-64, 64) / 16.0, random.between(-64, 64) / 16.0, random.between(-64, 64) / 16.0});
      case 4:
        return without_a_triangle(scene, random);
      default:
        return with_a_larger_cell(scene, random);
    }
  }

  // True when it found something.
  bool ask_again(Exam& exam, int relation, Random& random, const std::vector<Witness>& witnesses) const {
    const Changed changed = change(exam.scene(), relation, random);
    exam.count(std::string("relations: ") + relations[relation]);
    Answer answer;
    try {
      answer = exam.subject().answer(changed.scene.mesh, changed.scene.cell);
    } catch (const NoAnswer& error) {
      exam.file(without_answer(changed.scene, error.what()));
      return true;
    }
    const auto lists = [&](std::uint32_t t) { return std::binary_search(answer.pvs.begin(), answer.pvs.end(), t); };
    const auto cell = exact::ConvexCell::from_doubles(changed.scene.cell);
    for (const Witness& w : witnesses) {
      const auto carry = [&](const Point3& p) {
        return Point3(changed.factor * p.x() + changed.offset[0], changed.factor * p.y() + changed.offset[1],
                      changed.factor * p.z() + changed.offset[2]);
      };
      for (const std::uint32_t heir : changed.heirs[w.triangle]) {
        const Witness carried{heir, w.front, carry(w.v), carry(w.p)};
        const bool denied =
            !lists(heir) || (answer.map && in_hidden_region(*answer.map, heir, carried.front, carried.p));
        if (!denied) continue;
        // Of the parts of a triangle at most one has p; a triangle that the larger cell touches needs no witness.
        if (!exact::check_witness(changed.scene.mesh, cell, heir, carried.front, carried.v, carried.p).valid) continue;
        Finding f;
        f.oracle = name();
        f.verdict = lists(heir) ? "hidden-region/visible" : "hidden/visible";
        f.where = changed.scene;
        f.triangle = heir;
        f.witness = to_text(carried);
        f.explanation =
            fmt::format("after the change '{}' a triangle that was seen is called hidden", relations[relation]);
        exam.file(std::move(f));
        return true;
      }
    }
    if (!changed.same_geometry || !answer.map) return false;
    for (std::uint32_t t = 0; t < changed.heirs.size(); ++t) {
      if (exam.lists(t) == lists(changed.heirs[t].front())) continue;
      Finding f;
      f.oracle = name();
      f.verdict = "answer/other-answer";
      f.where = exam.scene();
      f.explanation = fmt::format("the change '{}' changes the answer about triangle {}", relations[relation], t);
      exam.file(std::move(f));
      return true;
    }
    return false;
  }
};

}  // namespace

std::unique_ptr<Oracle> make_metamorphic() { return std::make_unique<Metamorphic>(); }

}  // namespace clues::fuzz
