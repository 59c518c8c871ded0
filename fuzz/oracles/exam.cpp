// What all oracles need: the subject's answer, the places it denies, and the only way by which a claim becomes a finding.
#include <fmt/format.h>

#include <algorithm>

#include "exact/cell/standard_range.h"
#include "exact/complex/complex.h"
#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "fuzz/findings/case_random.h"
#include "fuzz/oracles/oracle.h"
#include "fuzz/oracles/rules.h"
#include "scene/messages/error.h"
#include "validate/certificates/region_points.h"
#include "validate/certificates/words.h"
#include "validate/windows/rational.h"

namespace clues::fuzz {

using exact::Point3;
using reference::Region;
using validate::Witness;

namespace {

reference::VisibilityMap guide_for(const Case& scene) {
  reference::Options options;
  options.threads = 1;
  if (scene.solid) options.mode = reference::Mode::solid;
  return reference::first_order_visibility(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
}

// A place to look, no more: what meets a triangle that is listed is called visible, all of it.
reference::VisibilityMap guide_by(const Case& scene, const std::vector<std::uint32_t>& pvs) {
  const exact::StandardRange range(scene.mesh, scene.cell);
  const auto cell = exact::ConvexCell::from_doubles(range.moved_in(scene.cell));
  reference::VisibilityMap map{exact::build_complex(range.moved_in(scene.mesh), &cell),
                               cell,
                               reference::Mode::sheet,
                               reference::Formulation::plain,
                               {},
                               {},
                               {},
                               pvs,
                               {}};
  map.range = range;
  for (std::uint32_t p = 0; p < map.complex.pieces.size(); ++p) {
    if (map.complex.in_cell[p]) continue;
    const auto& piece = map.complex.pieces[p];
    const auto& [a, b, c] = piece.corners;
    const std::vector<Point3> ring{map.complex.points[a], map.complex.points[b], map.complex.points[c]};
    const bool visible = std::any_of(piece.origins.begin(), piece.origins.end(), [&](const auto& o) {
      return std::binary_search(pvs.begin(), pvs.end(), o.triangle);
    });
    for (const bool front : {true, false})
      map.regions.push_back({p, front, visible, {ring}, 1, CGAL::centroid(ring[0], ring[1], ring[2])});
  }
  return reference::moved_back(std::move(map));
}

exact::Plane3 side_of(const reference::VisibilityMap& map, const Region& r) {
  return r.front ? map.complex.planes[r.piece] : map.complex.planes[r.piece].opposite();
}

bool faces_cell(const exact::Plane3& side, const exact::ConvexCell& cell) {
  return std::any_of(cell.vertices().begin(), cell.vertices().end(),
                     [&](const Point3& s) { return side.oriented_side(s) == CGAL::ON_POSITIVE_SIDE; });
}

bool strictly_inside(const validate::ExactTriangle& t, const Point3& p) {
  const auto a = CGAL::coplanar_orientation(t[0], t[1], t[2], p), b = CGAL::coplanar_orientation(t[1], t[2], t[0], p),
             c = CGAL::coplanar_orientation(t[2], t[0], t[1], p);
  return a == CGAL::POSITIVE && b == CGAL::POSITIVE && c == CGAL::POSITIVE;
}

}  // namespace

Exam::Exam(const Case& scene, const Subject& subject, Outcome& outcome)
    : scene_(scene), subject_(subject), outcome_(outcome), answer_(subject.answer(scene)) {
  compared_ = answer_.map || subject.is_compared(scene);
  if (!answer_.map) guide_ = compared_ ? guide_for(scene) : guide_by(scene, answer_.pvs);
  for (const auto& p : map().complex.pieces) {
    const auto& points = map().complex.points;
    soup_.push_back({points[p.corners[0]], points[p.corners[1]], points[p.corners[2]]});
  }
  if (compared_) count_map();
}

void Exam::count_map() {
  count_rules(scene_, map(), outcome_.counters);
  const auto& s = map().statistics;
  count("wedges SV-ME", s.sv_me);
  count("wedges SE-ME", s.se_me);
  count("wedges SE-MV", s.se_mv);
  count("compound silhouette vertices", s.csv);
  count("inside corners", s.inside_corners);
  count("parallel edges", s.parallel_edges);
  count("triangles cut by others", s.refined_triangles);
  count("first-order fallbacks", s.conservative_fallbacks);
  std::vector<std::uint8_t> state(scene_.mesh.triangles.size());
  for (const Region& r : map().regions) {
    if (!faces_cell(side_of(map(), r), cell())) continue;
    for (const auto& o : map().complex.pieces[r.piece].origins) state[o.triangle] |= r.visible ? 1 : 2;
  }
  for (const auto bits : state) {
    if (bits != 0) count(bits == 1 ? "triangles visible" : bits == 2 ? "triangles hidden" : "triangles partly visible");
  }
}

Random Exam::random(const std::string& oracle) const { return random_for(scene_, oracle); }

bool Exam::lists(std::uint32_t triangle) const {
  return std::binary_search(answer_.pvs.begin(), answer_.pvs.end(), triangle);
}

bool Exam::is_surface(std::uint32_t triangle) const {
  const auto& none = map().complex.degenerate;
  return !std::binary_search(none.begin(), none.end(), triangle);
}

std::vector<Exam::Denied> Exam::denied(std::size_t per_region) const {
  std::vector<Denied> out;
  for (const bool visible : {true, false}) {  // by the guide; in the subject's own map only hidden regions are denied
    if (answer_.map && visible) continue;
    for (const Region& r : map().regions) {
      if (r.visible != visible) continue;
      const exact::Plane3 side = side_of(map(), r);
      if (!faces_cell(side, cell())) continue;
      const auto& origins = map().complex.pieces[r.piece].origins;
      const auto origin = std::find_if(origins.begin(), origins.end(),
                                       [&](const auto& o) { return answer_.map || !lists(o.triangle); });
      if (origin == origins.end()) continue;
      for (const Point3& p : validate::interior_points(r.rings, per_region))
        out.push_back({origin->triangle, r.front == origin->same_side, side, p});
    }
  }
  return out;
}

bool in_hidden_region(const reference::VisibilityMap& map, std::uint32_t triangle, bool front, const Point3& p) {
  for (const Region& r : map.regions) {
    if (r.visible) continue;
    for (const auto& o : map.complex.pieces[r.piece].origins) {
      if (o.triangle != triangle || (r.front == o.same_side) != front) continue;
      for (validate::ExactTriangle t : validate::triangulate_region(r.rings)) {
        if (strictly_inside(t, p)) return true;
      }
    }
  }
  return false;
}

bool Exam::denies(const Witness& w) const {
  if (scene_.solid && !w.front) return false;
  return !lists(w.triangle) || (answer_.map && in_hidden_region(*answer_.map, w.triangle, w.front, w.p));
}

bool Exam::claim(const std::string& oracle, const Witness& witness, const std::string& explanation) {
  if (!denies(witness)) return false;
  const auto checked = exact::check_witness(scene_.mesh, cell(), witness.triangle, witness.front, witness.v, witness.p);
  if (!checked.valid) {
    const auto& [a, b, c] = scene_.mesh.triangles[witness.triangle];
    const auto corner = [&](std::uint32_t i) { return exact::to_exact(scene_.mesh.points[i]); };
    if (exact::meets_cell({corner(a), corner(b), corner(c)}, cell())) return false;  // visible without a witness (D3)
    contradiction(oracle, checked.reason);
    return false;
  }
  Finding f;
  f.oracle = oracle;
  f.verdict = lists(witness.triangle) ? "hidden-region/visible" : "hidden/visible";
  f.where = scene_;
  f.triangle = witness.triangle;
  f.witness = to_text(witness);
  f.explanation = explanation;
  file(std::move(f));
  return true;
}

void Exam::contradiction(const std::string& oracle, const std::string& what) {
  outcome_.contradictions.push_back(
      fmt::format("{} on {} {} of seed {}: {}", oracle, scene_.generator, scene_.index, scene_.seed, what));
}

}  // namespace clues::fuzz
