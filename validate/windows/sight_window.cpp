// Windows of directions, decided by signs alone.
#include "validate/windows/sight_window.h"

#include <algorithm>
#include <utility>

#include "scene/messages/error.h"

namespace clues::validate {

RVector normal_of(const Polygon& polygon) {
  return cross(minus(polygon[1], polygon[0]), minus(polygon[2], polygon[0]));
}

Polygon clipped(const Polygon& polygon, const RVector& normal, const RVector& at) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RVector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational at_a = dot(normal, minus(a, at)), at_b = dot(normal, minus(b, at));
    if (sgn(at_a) >= 0) part.push_back(a);
    if (sgn(at_a) * sgn(at_b) < 0) part.push_back(sum(a, times(minus(b, a), Rational(at_a / (at_a - at_b)))));
  }
  return part;
}

CellShape::CellShape(const exact::ConvexCell& cell) : dimension(cell.dimension()) {
  for (const auto& v : cell.vertices()) vertices.push_back(read(v));
  for (const auto& f : cell.facets()) {
    Facet facet;
    for (const int i : f.corners) facet.corners.push_back(vertices[static_cast<std::size_t>(i)]);
    facet.normal = normal_of(facet.corners);
    if (dimension == 3) {
      const auto n = f.corners.size();
      for (std::size_t i = 0; i < n; ++i) {
        const int a = f.corners[i], b = f.corners[(i + 1) % n];
        for (std::size_t k = 0; k < cell.facets().size(); ++k) {
          const auto& other = cell.facets()[k].corners;
          for (std::size_t j = 0; j < other.size(); ++j) {
            if (other[j] == b && other[(j + 1) % other.size()] == a) facet.neighbours.push_back(k);
          }
        }
      }
      if (facet.neighbours.size() != n) {
        throw scene::Error(scene::ErrorCode::internal, "visible_set: the facets of the cell do not close");
      }
    }
    facets.push_back(std::move(facet));
  }
}

SightWindow::SightWindow(const CellShape& cell, const SightTarget& target, const SightEdge& edge, Passage passage)
    : cell_(cell),
      edge_(edge),
      passage_(passage),
      planes_(edge.origin, edge.direction),
      target_value_(planes_.add_value(target.up, target.triangle[0])),
      target_lines_(add_lines(target.triangle)) {
  if (passage != Passage::on_cell) {
    for (const auto& facet : cell.facets) {
      facets_.push_back({planes_.add_value(facet.normal, facet.corners[0]), planes_.add_constant(facet.normal),
                         add_lines(facet.corners)});
    }
  }
  for (const auto& sheet : edge.sheets) sheet_planes_.push_back(planes_.add_constant(sheet.normal));
  add_shadows(target.before, Shadow::Way::target);
  if (passage == Passage::on_cell) return;
  add_shadows(target.outside, Shadow::Way::cell);
  add_shadows(target.above, Shadow::Way::cell_above);
  add_shadows(target.below, Shadow::Way::cell_below);
}

std::vector<int> SightWindow::add_lines(const Polygon& polygon) {
  std::vector<int> lines;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    lines.push_back(planes_.add_line(polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return lines;
}

void SightWindow::add_shadows(const std::vector<Polygon>& polygons, Shadow::Way way) {
  for (const Polygon& polygon : polygons) {
    shadows_.push_back({&polygon, way, planes_.add_value(normal_of(polygon), polygon[0]), {}, 0, std::nullopt});
  }
}

// The planes (y, edge) of a polygon as a cone: forward where its corners turn counter-clockwise about the directions.
SightWindow::Cone SightWindow::cone_of(const std::vector<int>& lines, bool forward) const {
  Cone cone;
  for (const int line : lines) cone.push_back({line, forward ? 1 : -1});
  if (!forward) std::reverse(cone.begin(), cone.end());
  return cone;
}

// On which side of a plane ray `ray` lies: the intersection of faces ray - 1 and ray.
int SightWindow::side(const Cone& cone, std::size_t ray, const Face& face, bool certain) {
  const Face &a = cone[(ray + cone.size() - 1) % cone.size()], &b = cone[ray];
  return a.sign * b.sign * face.sign * planes_.sign(a.plane, b.plane, face.plane, certain);
}

// The part on the positive side of a plane, as in exact/cell/direction_cone.cpp; none without interior.
std::optional<SightWindow::Cone> SightWindow::clip(const Cone& cone, const Face& face, bool certain) {
  const std::size_t n = cone.size();
  std::vector<int> sides;
  bool any_positive = false, any_negative = false;
  for (std::size_t i = 0; i < n; ++i) {
    sides.push_back(side(cone, i, face, certain));
    any_positive = any_positive || sides.back() > 0;
    any_negative = any_negative || sides.back() < 0;
  }
  if (!any_positive) return std::nullopt;
  if (!any_negative) return cone;
  std::size_t first = 0;
  while (sides[first] > 0 || sides[(first + 1) % n] <= 0) ++first;
  Cone part;
  for (std::size_t i = first; i < first + n && (sides[i % n] > 0 || sides[(i + 1) % n] > 0); ++i) {
    part.push_back(cone[i % n]);
  }
  part.push_back(face);
  return part;
}

// Adds convex cones that make up cone minus taken; false when they have no interior in common.
bool SightWindow::take_away(const Cone& cone, const Cone& taken, std::vector<Cone>& rest) {
  std::vector<Cone> pieces;
  Cone now = cone;
  for (const Face& face : taken) {
    if (auto outside = clip(now, {face.plane, -face.sign}, true)) pieces.push_back(std::move(*outside));
    auto inside = clip(now, face, true);
    if (!inside) return false;
    now = std::move(*inside);
  }
  for (Cone& piece : pieces) rest.push_back(std::move(piece));
  return true;
}

// A direction inside the cone, another for each attempt; the extreme rays count about the same.
IVector SightWindow::inner(const Cone& cone, int attempt) {
  std::vector<IVector> rays;
  std::size_t longest = 0;
  const auto bits = [](const IVector& ray) {
    std::size_t most = 0;
    for (const Integer& x : ray) most = std::max(most, mpz_sizeinbase(x.get_mpz_t(), 2));
    return most;
  };
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Face &a = cone[(i + cone.size() - 1) % cone.size()], &b = cone[i];
    rays.push_back(times(cross(planes_.normal(a.plane), planes_.normal(b.plane)), Integer(a.sign * b.sign)));
    longest = std::max(longest, bits(rays.back()));
  }
  IVector total{};
  Integer weight = 1;
  for (const IVector& ray : rays) {
    total = sum(total, times(ray, Integer(weight << (longest - bits(ray)))));
    weight *= attempt;
  }
  return total;
}

int SightWindow::where(const Cone& cone, const IVector& d) {
  bool on = false;
  for (const Face& face : cone) {
    const int s = face.sign * sgn(dot(planes_.normal(face.plane), d));
    if (s < 0) return -1;
    on = on || s == 0;
  }
  return on ? 0 : 1;
}

bool SightWindow::in_the_way(const Shadow& shadow) const {
  switch (shadow.way) {
    case Shadow::Way::target:
      return true;
    case Shadow::Way::cell:
      return !on_boundary_;
    case Shadow::Way::cell_above:
      return facets_[0].side > 0;
    case Shadow::Way::cell_below:
      return facets_[0].side < 0;
  }
  return false;
}

const SightWindow::Cone* SightWindow::shadow_cone(Shadow& shadow) {
  if (!shadow.cone) {
    const int s = planes_.value_sign(shadow.value, false);
    if (s == 0) return nullptr;
    if (shadow.lines.empty()) shadow.lines = add_lines(*shadow.polygon);
    shadow.cone = cone_of(shadow.lines, (s > 0) == (shadow.way == Shadow::Way::target));
  }
  return &*shadow.cone;
}

// Whether the line in a direction of the shadow and of the cell meets the polygon before a solid cell. The polygon is
// convex and outside int V, so the answer is the same for all of them.
bool SightWindow::is_before(Shadow& shadow, const IVector& d) {
  if (shadow.way != Shadow::Way::cell) return true;
  if (shadow.before == 0) {
    const RVector line{d[0], d[1], d[2]};
    const auto reach = [&](const RVector& normal, const RVector& at) {
      return Rational(dot(normal, minus(at, y_)) / dot(normal, line));
    };
    Rational entry = 0;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      if (facets_[i].side <= 0) continue;
      entry = std::max(entry, reach(cell_.facets[i].normal, cell_.facets[i].corners[0]));
    }
    shadow.before = reach(normal_of(*shadow.polygon), (*shadow.polygon)[0]) <= entry ? 1 : -1;
  }
  return shadow.before > 0;
}

// The directions from the target. None: nothing to see from y.
std::vector<SightWindow::Cone> SightWindow::start() {
  if (planes_.value_sign(target_value_, true) <= 0) return {};
  return {cone_of(target_lines_, true)};
}

bool SightWindow::clip_to_cell(std::vector<Cone>& cones) {
  std::vector<Face> faces;
  if (cell_.dimension == 2) {
    if (facets_[0].side == 0) return false;
    for (const int line : facets_[0].lines) faces.push_back({line, facets_[0].side < 0 ? 1 : -1});
  } else {
    bool outside = false;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      if (facets_[i].side <= 0) continue;
      outside = true;
      for (std::size_t k = 0; k < facets_[i].lines.size(); ++k) {
        if (facets_[cell_.facets[i].neighbours[k]].side <= 0) faces.push_back({facets_[i].lines[k], -1});
      }
    }
    if (!outside) {
      for (const CellFacet& facet : facets_) {
        if (facet.side == 0) faces.push_back({facet.plane, -1});
      }
      if (faces.empty()) return false;  // y in int V
      on_boundary_ = true;
    }
  }
  for (const Face& face : faces) {
    std::vector<Cone> kept;
    for (const Cone& cone : cones) {
      if (auto part = clip(cone, face, true)) kept.push_back(std::move(*part));
    }
    cones = std::move(kept);
  }
  return !cones.empty();
}

// All sheets at y on one side of the plane (edge, d). On the boundary of the cell a sheet that leads into it is no surface.
bool SightWindow::clip_to_sheets(std::vector<Cone>& cones, int wedge) {
  bool any = false;
  for (std::size_t i = 0; i < sheet_planes_.size(); ++i) {
    bool leads_inside = on_boundary_;
    for (std::size_t k = 0; k < facets_.size() && leads_inside; ++k) {
      leads_inside = facets_[k].side < 0 || sgn(dot(cell_.facets[k].normal, edge_.sheets[i].into)) < 0;
    }
    if (leads_inside) continue;
    any = true;
    std::vector<Cone> kept;
    for (const Cone& cone : cones) {
      if (auto part = clip(cone, {sheet_planes_[i], wedge}, true)) kept.push_back(std::move(*part));
    }
    cones = std::move(kept);
  }
  return any && !cones.empty();
}

SightWindow::Answer SightWindow::search(std::vector<Cone> cones, int wedge) {
  while (!cones.empty()) {
    const Cone cone = std::move(cones.back());
    cones.pop_back();
    Shadow* best = nullptr;
    std::size_t best_count = 0;
    for (int attempt = 1; !best; ++attempt) {
      const IVector d = inner(cone, attempt);
      bool blocked = false;
      for (Shadow& shadow : shadows_) {
        if (!in_the_way(shadow)) continue;
        const Cone* taken = shadow_cone(shadow);
        if (!taken) {  // seen edge-on: it can stop this line, but no cone of lines
          blocked = blocked || sgn(dot(normal_of(*shadow.polygon), RVector{d[0], d[1], d[2]})) == 0;
          continue;
        }
        const int at = where(*taken, d);
        if (at < 0 || !is_before(shadow, d)) continue;
        blocked = true;
        if (at == 0) continue;
        std::size_t count = 0;
        for (std::size_t i = 0; i < cone.size(); ++i) {
          count += std::all_of(taken->begin(), taken->end(),
                               [&](const Face& face) { return side(cone, i, face, false) >= 0; });
        }
        if (!best || count > best_count) {
          best = &shadow;
          best_count = count;
        }
        if (best_count == cone.size()) break;
      }
      if (blocked) continue;
      const RVector u = edge_.direction, line{d[0], d[1], d[2]};
      const bool nudged = passage_ == Passage::edge;
      opening_ = {planes_.parameter(), y_, d, nudged ? times(cross(u, line), Rational(-wedge)) : RVector{}};
      return Answer::open;
    }
    planes_.value_sign(best->value, true);
    if (!take_away(cone, *best->cone, cones)) {
      throw scene::Error(scene::ErrorCode::internal, "visible_set: a shadow misses the line that it blocks");
    }
  }
  return planes_.on_event() ? Answer::on_event : Answer::covered;
}

SightWindow::Answer SightWindow::decide(const Rational& s, int wedge) {
  planes_.move_to(s);
  y_ = planes_.position();
  on_boundary_ = false;
  for (Shadow& shadow : shadows_) {
    shadow.before = 0;
    shadow.cone.reset();
  }
  for (CellFacet& facet : facets_) facet.side = planes_.value_sign(facet.value, true);
  std::vector<Cone> cones = start();
  bool any = !cones.empty();
  if (any && passage_ == Passage::edge) any = clip_to_cell(cones) && clip_to_sheets(cones, wedge);
  if (!any) return planes_.on_event() ? Answer::on_event : Answer::covered;
  return search(std::move(cones), wedge);
}

}  // namespace clues::validate
