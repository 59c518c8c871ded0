// The witness checker (D5, D6, D18): the conditions of a sight line, one after the other.
#include "exact/sight/witness.h"

#include <utility>

#include "exact/sight/plain_sight.h"

namespace clues::exact {
namespace {

WitnessVerdict refuse(std::string reason, bool special = false) { return {false, std::move(reason), special}; }

}  // namespace

WitnessVerdict check_witness(const scene::TriangleMesh& mesh, const ConvexCell& cell, std::uint32_t triangle,
                             bool front, const Point3& v_point, const Point3& p_point) {
  const plain::Vec v = plain::read(v_point), p = plain::read(p_point);
  const plain::Scene scene(mesh);
  if (std::string flaw = scene.flaw_of_target(triangle, front, p, v, "v"); !flaw.empty())
    return refuse(std::move(flaw));
  const plain::Cell own(cell);
  if (!own.fault().empty()) return refuse(own.fault());
  if (!own.interior_contains(v)) return refuse("v is not in the relative interior of the cell");
  if (const auto outside = own.outside_of(v, p)) {
    if (const auto t = scene.blocker(v, p, *outside))
      return refuse("triangle " + std::to_string(*t) + " blocks the sight line");
  }
  if (std::string flaw = scene.flaw_beside(triangle, p); !flaw.empty()) return refuse(std::move(flaw), true);
  if (const auto t = scene.spoiler(own, v, p))
    return refuse("v lies on triangle " + std::to_string(*t) + ": choose another viewpoint", true);
  return {true, "", false};
}

SightLine check_sight_line(const scene::TriangleMesh& mesh, const ConvexCell& cell, const Point3& v_point,
                           const Point3& p_point) {
  SightLine out;
  const plain::Vec v = plain::read(v_point), p = plain::read(p_point);
  const plain::Cell own(cell);
  if (!own.fault().empty() || !own.interior_contains(v) || v == p) return out;
  out.valid = true;
  const plain::Scene scene(mesh);
  if (const auto outside = own.outside_of(v, p)) out.blockers = scene.blockers(v, p, *outside);
  out.spoiler = scene.spoiler(own, v, p);
  return out;
}

}  // namespace clues::exact
