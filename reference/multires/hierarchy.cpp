#include "reference/multires/hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "reference/multires/overlay.h"
#include "reference/multires/stars/hole.h"
#include "reference/multires/stars/priority.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using scene::Edge;
using scene::edge_of;
using scene::StarKind;

constexpr std::size_t degree_limit = 12;

class Builder {
 public:
  Builder(const scene::TriangleMesh& mesh, const HierarchyOptions& options)
      : options_(options),
        complex_(mesh),
        overlay_(mesh),
        points_(exact::points_for_estimates(mesh)),
        features_(options.features.begin(), options.features.end()),
        tags_(mesh.points.size(), 0),
        fixed_(mesh.points.size(), false) {
    hierarchy_.input = mesh;
    for (const std::uint32_t v : options.fixed) fixed_[v] = true;
    for (const Edge& e : features_) {
      ++tags_[e[0]];
      ++tags_[e[1]];
    }
    hierarchy_.features.assign(features_.begin(), features_.end());
    for (std::uint32_t v = 0; v < fixed_.size(); ++v) {
      if (tags_[v] != 0 && (tags_[v] != 2 || complex_.ring(v).open)) fixed_[v] = true;
      if (fixed_[v]) hierarchy_.fixed.push_back(v);
    }
  }

  scene::Hierarchy build() {
    while (complex_.triangle_count() > options_.base_triangles) {
      auto level = one_level();
      if (level.removals.empty()) break;
      hierarchy_.levels.push_back(std::move(level));
    }
    const auto left = complex_.triangles_left();
    for (const std::uint32_t t : left) hierarchy_.base.push_back(complex_.triangle(t));
    overlay_.write_to(left, hierarchy_);
    return std::move(hierarchy_);
  }

 private:
  scene::HierarchyLevel one_level() {
    const auto weight = removal_weights_estimate(complex_, points_);
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < weight.size(); ++v) {
      if (complex_.has_vertex(v) && !fixed_[v]) order.push_back(v);
    }
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return weight[a] != weight[b] ? weight[a] < weight[b] : a < b; });
    std::vector<bool> blocked(weight.size(), false);
    scene::HierarchyLevel level;
    std::vector<scene::Kept> kept;
    for (const std::uint32_t v : order) {
      if (blocked[v] || complex_.star(v).size() >= degree_limit || complex_.degree(v) >= degree_limit) continue;
      scene::KeptFor reason = scene::KeptFor::link;
      auto removal = try_to_remove(v, reason);
      if (!removal) {
        kept.push_back({v, reason});
        continue;
      }
      for (const std::uint32_t w : removal->ring) blocked[w] = true;
      level.removals.push_back(std::move(*removal));
      if (options_.progress && level.removals.size() % 256 == 0) options_.progress(complex_.triangle_count());
    }
    for (const auto& k : kept) {
      if (!blocked[k.vertex]) level.kept.push_back(k);  // one that a neighbour blocks now needs no reason
    }
    if (options_.progress) options_.progress(complex_.triangle_count());
    return level;
  }

  StarShape shape_of(std::uint32_t v) const {
    StarShape shape;
    shape.ring = complex_.ring(v);
    if (shape.ring.open) {
      shape.kind = StarKind::boundary;
    } else if (tags_[v] == 2) {
      shape.kind = StarKind::feature;
      auto& ring = shape.ring;
      std::vector<std::size_t> tagged;
      for (std::size_t k = 0; k < ring.vertices.size(); ++k) {
        if (features_.count(edge_of(v, ring.vertices[k])) != 0) tagged.push_back(k);
      }
      const auto first = static_cast<std::ptrdiff_t>(tagged[0]);
      std::rotate(ring.vertices.begin(), ring.vertices.begin() + first, ring.vertices.end());
      std::rotate(ring.triangles.begin(), ring.triangles.begin() + first, ring.triangles.end());
      shape.across = static_cast<std::uint32_t>(tagged[1] - tagged[0]);
    }
    return shape;
  }

  // The triangles that close the hole, by D31; none where topology forbids all.
  std::optional<std::vector<scene::Triangle>> closing_of(const StarShape& shape, const FlatStar& flat) const {
    const auto& ring = shape.ring.vertices;
    const std::size_t n = ring.size();
    const auto forbidden = [this](std::uint32_t a, std::uint32_t b) { return complex_.has_edge(a, b); };
    if (shape.kind == StarKind::boundary && complex_.has_edge(ring.front(), ring.back())) return std::nullopt;
    if (shape.kind == StarKind::feature && complex_.has_edge(ring[0], ring[shape.across])) return std::nullopt;
    std::vector<HolePolygon> polygons(1);
    for (std::size_t k = 0; k < n; ++k) {
      if (shape.kind == StarKind::feature && k == shape.across) {
        polygons[0].points.push_back(flat.ring[k]);
        polygons[0].vertices.push_back(ring[k]);
        polygons.emplace_back();
      }
      polygons.back().points.push_back(flat.ring[k]);
      polygons.back().vertices.push_back(ring[k]);
    }
    if (shape.kind == StarKind::feature) {
      polygons.back().points.push_back(flat.ring[0]);
      polygons.back().vertices.push_back(ring[0]);
    }
    std::vector<scene::Triangle> all;
    for (const HolePolygon& polygon : polygons) {
      const auto triangles = triangulated(polygon, forbidden);
      if (!triangles) return std::nullopt;
      all.insert(all.end(), triangles->begin(), triangles->end());
    }
    for (const auto& t : all) {
      if (complex_.has_face(t[0], t[1], t[2])) return std::nullopt;
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  std::optional<scene::Removal> try_to_remove(std::uint32_t v, scene::KeptFor& reason) {
    const StarShape shape = shape_of(v);
    const auto proposals = flattenings(shape, v, points_);
    reason = proposals.empty() ? scene::KeptFor::flat : scene::KeptFor::link;
    for (const FlatStar& flat : proposals) {
      const auto closing = closing_of(shape, flat);
      if (!closing) continue;
      if (!overlay_.carry(v, shape, flat, *closing)) {
        reason = scene::KeptFor::numbers;
        continue;
      }
      complex_.replace(v, *closing);
      if (shape.kind == StarKind::feature) {
        const std::uint32_t p = shape.ring.vertices[0], q = shape.ring.vertices[shape.across];
        features_.erase(edge_of(v, p));
        features_.erase(edge_of(v, q));
        features_.insert(edge_of(p, q));
      }
      return scene::Removal{v, shape.kind, shape.ring.vertices, shape.across, flat.ring, *closing};
    }
    return std::nullopt;
  }

  const HierarchyOptions& options_;
  StarComplex complex_;
  Overlay overlay_;
  std::vector<scene::Point> points_;
  std::set<Edge> features_;  // as they are now
  std::vector<std::uint32_t>
      tags_;  // how many of them end at a vertex: removals do not change that of vertices that stay
  std::vector<bool> fixed_;
  scene::Hierarchy hierarchy_;
};

}  // namespace

scene::Hierarchy build_hierarchy(const scene::TriangleMesh& mesh, const HierarchyOptions& options,
                                 const std::string& name) {
  checked_surface(mesh, name);
  HierarchyOptions checked = options;
  for (const std::uint32_t v : options.fixed) {
    if (v >= mesh.points.size())
      throw scene::Error(scene::ErrorCode::bad_argument, fmt::format("feature: vertex {} does not exist", v));
  }
  const StarComplex complex(mesh);
  checked.features.clear();
  for (const Edge& e : options.features) {
    if (e[0] >= mesh.points.size() || e[1] >= mesh.points.size() || !complex.has_edge(e[0], e[1])) {
      throw scene::Error(scene::ErrorCode::bad_argument,
                         fmt::format("feature: vertices {} and {} are not joined by an edge", e[0], e[1]));
    }
    std::size_t sides = 0;
    for (const std::uint32_t t : complex.star(e[0])) {
      const auto& corners = complex.triangle(t);
      sides += std::find(corners.begin(), corners.end(), e[1]) != corners.end() ? 1U : 0U;
    }
    if (sides == 2) checked.features.push_back(edge_of(e[0], e[1]));  // the boundary stays anyway
  }
  return Builder(mesh, checked).build();
}

}  // namespace clues::reference
