// Conditions (a) to (d) of umbra_certificate.h, one after the other.
#include "validate/certificates/umbra_certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "validate/windows/sight_window.h"

namespace clues::validate {
namespace {

using Corners = std::array<RVector, 3>;

std::string text(const RVector& p) {
  return fmt::format("({}, {}, {})", p[0].get_str(), p[1].get_str(), p[2].get_str());
}

RVector normal_of(const Corners& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

Corners corners_of(const scene::TriangleMesh& mesh, std::uint32_t t) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const scene::Point& p = mesh.points.at(mesh.triangles.at(t)[i]);
    corners[i] = {Rational(p[0]), Rational(p[1]), Rational(p[2])};
  }
  return corners;
}

// The closed half space normal . (x - at) <= 0.
struct Bound {
  RVector normal, at;
  int side(const RVector& x) const { return sgn(dot(normal, minus(x, at))); }
};

RVector negative(const RVector& a) { return {Rational(-a[0]), Rational(-a[1]), Rational(-a[2])}; }

// The bounds of a triangle within its plane.
std::array<Bound, 3> outline(const Corners& t) {
  const RVector n = normal_of(t);
  std::array<Bound, 3> bounds;
  for (std::size_t i = 0; i < 3; ++i) bounds[i] = {cross(minus(t[(i + 1) % 3], t[i]), n), t[i]};
  return bounds;
}

// V as half spaces: strict ones for int V, and planes that hold all of V.
struct CellBounds {
  std::vector<Bound> strict, flat;

  explicit CellBounds(const CellShape& cell) {
    if (cell.dimension == 3) {
      for (const auto& f : cell.facets) strict.push_back({f.normal, f.corners[0]});
    } else if (cell.dimension == 2) {
      const auto& f = cell.facets[0];
      flat.push_back({f.normal, f.corners[0]});
      for (std::size_t i = 0; i < f.corners.size(); ++i) {
        strict.push_back({cross(minus(f.corners[(i + 1) % f.corners.size()], f.corners[i]), f.normal), f.corners[i]});
      }
    } else {
      const RVector &a = cell.vertices.front(), &b = cell.vertices.back();
      const RVector along = minus(b, a);
      if (cell.dimension == 1) strict = {{negative(along), a}, {along, b}};
      for (std::size_t i = 0; i < 3; ++i) {
        RVector axis{};
        axis[i] = 1;
        flat.push_back({cell.dimension == 0 ? axis : cross(along, axis), a});
      }
    }
  }

  // What a convex polygon shares with the closed V.
  Polygon shared(Polygon polygon) const {
    for (const Bound& b : flat) polygon = clipped(clipped(polygon, b.normal, b.at), negative(b.normal), b.at);
    for (const Bound& b : strict) polygon = clipped(polygon, negative(b.normal), b.at);
    return polygon;
  }

  // Whether it meets int V. A relatively inner point of what it shares with V is in int V if any point of it
  // is.
  bool interior_meets(const Polygon& given) const {
    const Polygon polygon = shared(given);
    if (polygon.empty()) return false;
    RVector middle{};
    for (const RVector& p : polygon) middle = sum(middle, p);
    middle = times(middle, Rational(Rational(1) / static_cast<unsigned long>(polygon.size())));
    return std::all_of(strict.begin(), strict.end(), [&](const Bound& b) { return b.side(middle) < 0; });
  }
};

// --- (c): no border ---------------------------------------------------------------------------------------------------------------

struct DirectedEdge {
  Rational from, to;  // places along the line
  const RVector *a, *b;
  std::size_t facet;
};

using LineKey = std::tuple<IVector, RVector>;  // direction, moment

IVector direction_of_line(const RVector& a, const RVector& b) {
  IVector d = primitive(minus(b, a));
  const auto lead = std::find_if(d.begin(), d.end(), [](const Integer& x) { return sgn(x) != 0; });
  if (sgn(*lead) < 0) {
    for (Integer& x : d) x = -x;
  }
  return d;
}

std::string complaint(const std::vector<DirectedEdge>& edges, const Rational& lo, const Rational& hi,
                      const std::string& segment) {
  std::vector<std::size_t> forward, backward;
  for (const DirectedEdge& e : edges) {
    if (std::min(e.from, e.to) > lo || std::max(e.from, e.to) < hi) continue;
    (e.from < e.to ? forward : backward).push_back(e.facet);
  }
  std::string list;
  for (const auto* side : {&forward, &backward}) {
    for (const std::size_t f : *side) list += fmt::format("{}{}", list.empty() ? "" : ", ", f);
  }
  if ((forward.size() + backward.size()) % 2 == 0) {
    return fmt::format("facets {} meet along {} and do not run opposite ways there: one of them is turned over", list,
                       segment);
  }
  return fmt::format("the boundary has a gap along {}, where facet{} {} end{}", segment,
                     list.find(',') == std::string::npos ? "" : "s", list,
                     list.find(',') == std::string::npos ? "s" : "");
}

std::string find_border(const UmbraCertificate& facets) {
  std::map<LineKey, std::vector<DirectedEdge>> lines;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const RVector &a = facets[f].corners[i], &b = facets[f].corners[(i + 1) % 3];
      const IVector d = direction_of_line(a, b);
      const RVector along{Rational(d[0]), Rational(d[1]), Rational(d[2])};
      lines[{d, cross(a, along)}].push_back({dot(a, along), dot(b, along), &a, &b, f});
    }
  }
  for (const auto& [line, edges] : lines) {
    std::map<Rational, std::pair<int, const RVector*>> begins;  // less those that end
    for (const DirectedEdge& e : edges) {
      begins.try_emplace(e.from, 0, e.a).first->second.first += 1;
      begins.try_emplace(e.to, 0, e.b).first->second.first -= 1;
    }
    for (auto at = begins.begin(); at != begins.end(); ++at) {
      if (at->second.first == 0) continue;
      const auto next = std::next(at);  // there is one: what begins here ends behind
      return complaint(edges, at->first, next->first,
                       fmt::format("{} - {}", text(*at->second.second), text(*next->second.second)));
    }
  }
  return "";
}

// --- w ------------------------------------------------------------------------------------------------------------------------------

enum class RayMeets { inward, nothing, outward, border };

// The ray from p towards d, without p.
RayMeets meets(const Corners& t, const RVector& p, const RVector& d) {
  const Corners at{minus(t[0], p), minus(t[1], p), minus(t[2], p)};
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int s = sgn(dot(d, cross(at[i], at[(i + 1) % 3])));
    left += s > 0;
    right += s < 0;
  }
  if (left > 0 && right > 0) return RayMeets::nothing;
  const RVector n = normal_of(t);
  const int height = sgn(dot(n, at[0])), slope = sgn(dot(n, d));
  if (slope != 0 && height * slope < 0) return RayMeets::nothing;  // behind p
  if (left < 3 && right < 3) return RayMeets::border;
  if (height == 0) return RayMeets::border;
  return slope > 0 ? RayMeets::outward : RayMeets::inward;
}

// The i-th of a list of directions; no plane holds more than a few.
RVector direction(int i) { return {Rational(101 + 7 * i * i), Rational(57 - 31 * i), Rational(211 + 13 * i)}; }

constexpr int kDirectionsTried = 64;

}  // namespace

CertificateVerdict check_umbra_certificate(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                           const UmbraCertificate& facets) {
  const CellShape shape(cell);
  const CellBounds bounds(shape);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Corners& corners = facets[f].corners;
    const RVector n = normal_of(corners);
    if (is_zero(n)) return {false, fmt::format("facet {} has no area", f)};
    if (facets[f].triangle) {
      const std::uint32_t t = *facets[f].triangle;
      if (t >= mesh.triangles.size()) return {false, fmt::format("facet {}: the scene has no triangle {}", f, t)};
      const Corners triangle = corners_of(mesh, t);
      const Bound plane{normal_of(triangle), triangle[0]};
      if (is_zero(plane.normal)) return {false, fmt::format("facet {}: triangle {} has no area", f, t)};
      const auto sides = outline(triangle);
      for (const RVector& p : corners) {
        const bool on = plane.side(p) == 0 &&
                        std::all_of(sides.begin(), sides.end(), [&](const Bound& b) { return b.side(p) <= 0; });
        if (!on) return {false, fmt::format("facet {} leaves triangle {} at {}", f, t, text(p))};
      }
    } else {
      const Bound plane{n, corners[0]};
      for (const RVector& s : shape.vertices) {
        if (plane.side(s) > 0) {
          return {false,
                  fmt::format("facet {} has the corner {} of the cell on its outer side, so sight lines may come in", f,
                              text(s))};
        }
      }
    }
    if (bounds.interior_meets({corners.begin(), corners.end()}))
      return {false, fmt::format("facet {} meets the inside of the cell", f)};
  }
  if (std::string border = find_border(facets); !border.empty()) return {false, std::move(border)};
  const std::optional<int> around = winding_number(facets, read(cell.center()));
  if (!around || *around != 0) return {false, "the region holds the cell"};
  return {true, ""};
}

std::optional<int> winding_number(const UmbraCertificate& facets, const RVector& p) {
  for (int i = 0; i < kDirectionsTried; ++i) {
    const RVector d = direction(i);
    int w = 0;
    bool clean = true;
    for (const CertificateFacet& f : facets) {
      const RayMeets m = meets(f.corners, p, d);
      clean = clean && m != RayMeets::border;
      if (!clean) break;
      w += m == RayMeets::outward ? 1 : m == RayMeets::inward ? -1 : 0;
    }
    if (clean) return w;
  }
  return std::nullopt;
}

CertificateVerdict check_umbra_certificate(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell,
                                           const UmbraCertificate& facets) {
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const auto& triangle = facets[i].triangle;
    if (triangle && *triangle < scene.mesh.triangles.size() && !scene.blocking(*triangle))
      return {false, fmt::format("facet {} lies in triangle {}, which does not block", i, *triangle)};
  }
  return check_umbra_certificate(scene.mesh, cell, facets);
}

bool proves_hidden(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const UmbraCertificate& facets,
                   std::uint32_t triangle, bool front) {
  const Corners t = corners_of(mesh, triangle);
  RVector up = normal_of(t);
  if (is_zero(up)) return false;
  const CellShape shape(cell);
  if (!CellBounds(shape).shared({t.begin(), t.end()}).empty()) return false;
  if (!front) up = negative(up);
  const Bound plane{up, t[0]};  // side(): +1 on the side asked for
  if (std::none_of(shape.vertices.begin(), shape.vertices.end(), [&](const RVector& s) { return plane.side(s) > 0; }))
    return true;

  const RVector middle = times(sum(sum(t[0], t[1]), t[2]), Rational(Rational(1) / 3));
  const auto sides = outline(t);
  UmbraCertificate apart;  // from the plane, as far as `middle` is concerned
  for (const CertificateFacet& f : facets) {
    int most = 0, least = 0;
    for (const RVector& p : f.corners) {
      most = std::max(most, plane.side(p));
      least = std::min(least, plane.side(p));
    }
    if (most == 0 && least == 0) continue;  // in the plane: what it does, it does behind us
    if (most > 0) {
      Polygon trace = clipped(clipped({f.corners.begin(), f.corners.end()}, up, t[0]), negative(up), t[0]);
      for (const Bound& b : sides) trace = clipped(trace, negative(b.normal), b.at);
      RVector inner{};
      for (const RVector& p : trace) inner = sum(inner, p);
      if (!trace.empty()) {
        inner = times(inner, Rational(Rational(1) / static_cast<unsigned long>(trace.size())));
        if (std::all_of(sides.begin(), sides.end(), [&](const Bound& b) { return b.side(inner) < 0; })) return false;
      }
    }
    if (most > 0) apart.push_back(f);
  }
  // Rays from `middle` to that side meet what is there, and nothing at `middle` itself.
  for (int i = 0; i < kDirectionsTried; ++i) {
    const RVector d = direction(i);
    const int slope = sgn(dot(up, d));
    if (slope == 0) continue;
    int w = 0;
    bool clean = true;
    for (const CertificateFacet& f : apart) {
      const RayMeets m = meets(f.corners, middle, slope > 0 ? d : negative(d));
      clean = clean && m != RayMeets::border;
      w += m == RayMeets::outward ? 1 : m == RayMeets::inward ? -1 : 0;
    }
    if (clean) return w > 0;
  }
  return false;
}

}  // namespace clues::validate
