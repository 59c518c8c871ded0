// Edges by sorting.
#include "validate/motion/mesh_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "scene/messages/error.h"

namespace clues::validate {
namespace {

struct HalfEdge {
  std::uint32_t low, high;
  bool upward;
  std::uint32_t triangle;
  std::uint8_t corner;
  auto key() const { return std::tie(low, high); }
};

// Three triangles show it as well as all.
std::string tangle_of(const HalfEdge* first, const HalfEdge* last) {
  std::string triangles;
  for (const HalfEdge* edge = first; edge != last && edge - first < 3; ++edge) {
    triangles.append(triangles.empty() ? "" : ", ").append(std::to_string(edge->triangle));
  }
  return fmt::format("the edge {}-{} is in the triangles {}{}: {}", first->low, first->high, triangles,
                     last - first > 3 ? ", ..." : "",
                     last - first > 2 ? "more than two, so that none of them is across from another"
                                      : "they run through it in the same direction, so that neither is across");
}

}  // namespace

MeshPlaces::MeshPlaces(const scene::DepthMesh& mesh) : across(mesh.triangles.size(), {none, none, none}) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto from = t[k], to = t[(k + 1U) % 3U];
      edges.push_back({std::min(from, to), std::max(from, to), from < to, i, k});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last].key() == edges[first].key()) ++last;
    const auto &one = edges[first], &two = edges[last - 1];
    if (last - first != 2 || one.upward == two.upward) {
      unpaired += last - first;
      if (last - first > 1 && tangled.empty()) tangled = tangle_of(edges.data() + first, edges.data() + last);
      continue;
    }
    across[one.triangle][one.corner] = mesh.triangles[two.triangle][(two.corner + 2U) % 3U];
    across[two.triangle][two.corner] = mesh.triangles[one.triangle][(one.corner + 2U) % 3U];
  }
}

void require_one_across(const MeshPlaces& places, const scene::MotionThresholds& thresholds) {
  if (!thresholds.delaunay || places.tangled.empty()) return;
  throw scene::Error(scene::ErrorCode::bad_argument, "the Delaunay property is asked for, but " + places.tangled);
}

PlaceSamples samples_at(const scene::DepthMesh& mesh, const MeshPlaces& places, const scene::ConstraintPlace& place) {
  const auto& t = mesh.triangles[place.triangle];
  const auto corner = [&](std::size_t k) { return t[(place.corner + k) % 3]; };
  switch (place.constraint) {
    case scene::MotionConstraint::edge_length:
      return {{corner(0), corner(1), 0, 0}, 2};
    case scene::MotionConstraint::delaunay:
      return {{corner(0), corner(1), corner(2), places.across[place.triangle][place.corner]}, 4};
    case scene::MotionConstraint::facing:
    case scene::MotionConstraint::separation:
      break;
  }
  return {{corner(0), corner(1), corner(2), 0}, 3};
}

std::vector<scene::ConstraintPlace> constraints_of(const MeshPlaces& places, const scene::MotionThresholds& thresholds,
                                                   std::uint32_t triangle) {
  using scene::MotionConstraint;
  std::vector<scene::ConstraintPlace> out{{MotionConstraint::facing, triangle, 0}};
  for (const auto constraint : {MotionConstraint::edge_length, MotionConstraint::separation}) {
    for (std::uint8_t k = 0; k < 3; ++k) out.push_back({constraint, triangle, k});
  }
  for (std::uint8_t k = 0; thresholds.delaunay && k < 3; ++k) {
    if (places.across[triangle][k] != MeshPlaces::none) out.push_back({MotionConstraint::delaunay, triangle, k});
  }
  return out;
}

bool holds_at(scene::MotionConstraint constraint, const std::array<const exact::SightRow*, 4>& rows,
              const exact::ExactThresholds& thresholds) {
  switch (constraint) {
    case scene::MotionConstraint::facing:
      return exact::facing_sign(*rows[0], *rows[1], *rows[2]) > 0;
    case scene::MotionConstraint::edge_length:
      return exact::edge_length_holds(*rows[0], *rows[1], thresholds);
    case scene::MotionConstraint::separation:
      return exact::separation_holds(*rows[0], *rows[1], *rows[2], thresholds);
    case scene::MotionConstraint::delaunay:
      return exact::delaunay_sign(*rows[0], *rows[1], *rows[2], *rows[3]) >= 0;
  }
  return false;
}

bool holds_at(scene::MotionConstraint constraint, const std::array<const scene::DepthSample*, 4>& samples,
              const exact::ExactViewpoint& v, const exact::ExactThresholds& thresholds) {
  std::array<exact::SightRow, 4> rows;
  std::array<const exact::SightRow*, 4> pointers{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!samples[i]) continue;
    rows[i] = exact::sight_row(*samples[i], v);
    pointers[i] = &rows[i];
  }
  return holds_at(constraint, pointers, thresholds);
}

}  // namespace clues::validate
