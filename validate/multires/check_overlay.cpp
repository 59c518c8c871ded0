// E4 and E6: the overlay by itself. If every piece is positive on both surfaces, every edge of a piece is met by the next piece in the opposite
// direction (or lies on the boundary of both surfaces), and the areas of the pieces sum to 1 in every triangle, then both maps from the
// overlay are coverings but for branch points at vertices, of one sheet; so they are homeomorphisms, and so is Pi.
#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "validate/multires/check_hierarchy.h"
#include "validate/multires/common_triangulation.h"

namespace clues::validate {
namespace {

using scene::CarrierPoint;
using scene::Triangle;

// Triangles, edges and vertices of a surface, to ask whether a point is on it.
class Carriers {
 public:
  explicit Carriers(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      by_corners_.emplace(sorted(triangles[t]), t);
      for (std::size_t k = 0; k < 3; ++k) {
        vertices_.insert({triangles[t][k], 1});
        ++edges_[scene::edge_of(triangles[t][k], triangles[t][(k + 1) % 3])];
      }
    }
  }
  static Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  }
  bool carries(const CarrierPoint& p) const {
    switch (p.size()) {
      case 1:
        return vertices_.count(p.corner[0]) != 0;
      case 2:
        return edges_.count({p.corner[0], p.corner[1]}) != 0;
      default:
        return by_corners_.count(p.corner) != 0;
    }
  }
  // The triangle with these three corners.
  std::optional<std::uint32_t> triangle(const Triangle& corners) const {
    const auto found = by_corners_.find(sorted(corners));
    if (found == by_corners_.end()) return std::nullopt;
    return found->second;
  }
  bool on_boundary(const CarrierPoint& a, const CarrierPoint& b) const {
    std::vector<std::uint32_t> corners;
    for (const auto& p : {a, b})
      corners.insert(corners.end(), p.corner.begin(), p.corner.begin() + static_cast<std::ptrdiff_t>(p.size()));
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() != 2) return false;
    const auto edge = edges_.find({corners[0], corners[1]});
    return edge != edges_.end() && edge->second == 1;
  }
  const Triangle& operator[](std::uint32_t t) const { return triangles_[t]; }

 private:
  const std::vector<Triangle>& triangles_;
  std::map<Triangle, std::uint32_t> by_corners_;
  std::map<scene::Edge, int> edges_;
  std::map<std::uint32_t, int> vertices_;
};

// The triangle in which three points lie, if they span one.
std::optional<std::uint32_t> common_triangle(const Carriers& surface,
                                             const std::array<const CarrierPoint*, 3>& points) {
  std::vector<std::uint32_t> corners;
  for (const auto* p : points)
    corners.insert(corners.end(), p->corner.begin(), p->corner.begin() + static_cast<std::ptrdiff_t>(p->size()));
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() != 3) return std::nullopt;
  return surface.triangle({corners[0], corners[1], corners[2]});
}

// The area of three points of a triangle as a part of it, times 2^120.
mpz_class part_of(const Triangle& t, const std::array<const CarrierPoint*, 3>& p) {
  const auto weight = [&](std::size_t k, std::size_t corner) { return mpz_class(p[k]->weight_of(t[corner])); };
  const mpz_class a = weight(1, 1) - weight(0, 1), b = weight(1, 2) - weight(0, 2);
  const mpz_class c = weight(2, 1) - weight(0, 1), d = weight(2, 2) - weight(0, 2);
  return a * d - b * c;
}

// Its place is said only where something is wrong: there are many points.
void check_point(const std::string& check, std::uint32_t number, const char* where, const Carriers& surface,
                 const CarrierPoint& point, HierarchyReport& report) {
  const auto wrong = [&](const std::string& what) {
    report.find(check, fmt::format("point {}, {}: {}", number, where, what));
  };
  mpz_class sum = 0;
  for (std::size_t k = 0; k < point.size(); ++k) {
    sum += mpz_class(point.weight[k]);
    if (point.weight[k] <= 0) wrong(fmt::format("the weight {} is not positive", point.weight[k]));
  }
  if (sum != mpz_class(scene::whole_weight)) {
    const mpz_class off = sum - mpz_class(scene::whole_weight);
    wrong(fmt::format("its weights sum to 1 {} {} * 2^-60", off > 0 ? "+" : "-", mpz_class(abs(off)).get_str()));
  }
  if (!surface.carries(point)) wrong("there is no simplex with these corners");
}

}  // namespace

std::vector<std::uint32_t> check_common_triangulation(const CommonTriangulation& c, HierarchyReport& report) {
  const Carriers input(c.first), base(c.second);
  const auto wrong = [&](const std::string& what) { report.find(c.cover_check, what); };
  for (std::uint32_t p = 0; p < c.points.size(); ++p) {
    check_point(c.weight_check, p, "source", input, c.points[p].source, report);
    check_point(c.weight_check, p, "image", base, c.points[p].image, report);
  }
  const mpz_class one = mpz_class(scene::whole_weight) * mpz_class(scene::whole_weight);
  std::vector<mpz_class> covered(c.first.size()), covered_base(c.second.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
  std::vector<std::uint32_t> spanned;
  std::vector<bool> used(c.points.size(), false);
  for (std::uint32_t i = 0; i < c.pieces.size(); ++i) {
    const auto& piece = c.pieces[i];
    std::array<const CarrierPoint*, 3> source{}, image{};
    for (std::size_t k = 0; k < 3; ++k) {
      used[piece.corners[k]] = true;
      source[k] = &c.points[piece.corners[k]].source;
      image[k] = &c.points[piece.corners[k]].image;
      if (!edges.try_emplace({piece.corners[k], piece.corners[(k + 1) % 3]}, i).second) {
        wrong(fmt::format("pieces {} and {} lie on the same side of an edge",
                          edges[{piece.corners[k], piece.corners[(k + 1) % 3]}], i));
      }
    }
    const auto in = common_triangle(input, source), on = common_triangle(base, image);
    spanned.push_back(on.value_or(scene::no_vertex));
    if (!in || *in != piece.input) {
      wrong(fmt::format("piece {} does not lie in triangle {} of {}", i, piece.input, c.first_name));
      continue;
    }
    if (!on) {
      wrong(fmt::format("piece {} does not lie in one triangle of {}", i, c.second_name));
      continue;
    }
    const mpz_class a = part_of(input[*in], source), b = part_of(base[*on], image);
    if (a <= 0) wrong(fmt::format("piece {} is flipped or flat on {} (triangle {})", i, c.first_name, *in));
    if (b <= 0) wrong(fmt::format("piece {} is flipped or flat on {} (triangle {})", i, c.second_name, *on));
    covered[*in] += a;
    covered_base[*on] += b;
  }
  for (const auto& [edge, i] : edges) {
    if (edges.count({edge.second, edge.first}) != 0) continue;
    const auto &p = c.points[edge.first], &q = c.points[edge.second];
    if (!input.on_boundary(p.source, q.source) || !base.on_boundary(p.image, q.image)) {
      wrong(fmt::format("piece {} has no neighbour at the edge from point {} to point {}", i, edge.first, edge.second));
    }
  }
  // Of a point beside the pieces nothing is proved: it could say anything.
  for (std::uint32_t p = 0; p < used.size(); ++p) {
    if (!used[p]) wrong(fmt::format("point {} is a corner of no piece", p));
  }
  const auto sums = [&](const std::vector<mpz_class>& parts, const std::string& name) {
    for (std::size_t t = 0; t < parts.size(); ++t) {
      if (parts[t] != one)
        wrong(fmt::format("triangle {} of {}: its pieces have {:.17g} of its area", t, name,
                          mpq_class(parts[t], one).get_d()));
    }
  };
  sums(covered, c.first_name);
  sums(covered_base, c.second_name);
  return spanned;
}

void check_overlay(const scene::Hierarchy& h, HierarchyReport& report) {
  for (std::uint32_t p = 0; p < h.input.points.size(); ++p) {
    if (!(h.points[p].source == scene::at_vertex(p)))
      report.find("E6", fmt::format("point {} is not vertex {} of the input", p, p));
  }
  check_common_triangulation(
      {h.input.triangles, h.base, h.points, h.pieces, "the input", "the base domain", "E4", "E6"}, report);
  const Carriers base(h.base);
  // (a) of E6: what would flip without the overlay.
  for (const auto& t : h.input.triangles) {
    std::array<const CarrierPoint*, 3> image{};
    for (std::size_t k = 0; k < 3; ++k) image[k] = &h.points[t[k]].image;
    const auto on = common_triangle(base, image);
    if (!on) continue;
    ++report.linear_judged;
    if (part_of(base[*on], image) <= 0) ++report.linear_flips;
  }
  report.input_triangles = h.input.triangles.size();
  report.base_triangles = h.base.size();
  report.points = h.points.size();
  report.pieces = h.pieces.size();
}

}  // namespace clues::validate
