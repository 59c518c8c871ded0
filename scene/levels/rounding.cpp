#include "scene/levels/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "scene/mesh/bounds.h"

namespace clues::scene {
namespace {

// The doubles next to x, from below and from above; both are x where it is one.
std::array<double, 2> neighbours(const mpq_class& x) {
  const double cut = x.get_d();  // towards zero
  const int side = cmp(x, mpq_class(cut));
  if (side == 0) return {cut, cut};
  const double infinity = std::numeric_limits<double>::infinity();
  return side > 0 ? std::array{cut, std::nextafter(cut, infinity)} : std::array{std::nextafter(cut, -infinity), cut};
}

bool is_double(const RationalPoint& p) {
  return std::all_of(p.begin(), p.end(), [](const mpq_class& x) { return cmp(x, mpq_class(x.get_d())) == 0; });
}

// Around p: by so many units in the last place, rounded, in each coordinate that is no double; the others stay. So no plane across
// an axis that p is in parts it from p.
Bounds box_around(const RationalPoint& p, int units = 1) {
  Bounds box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto [low, high] = neighbours(p[axis]);
    for (int i = 1; i < units && low != high; ++i) {
      low = std::nextafter(low, -std::numeric_limits<double>::infinity());
      high = std::nextafter(high, std::numeric_limits<double>::infinity());
    }
    box.low[axis] = low;
    box.high[axis] = high;
  }
  return box;
}

using IsWanted = std::function<bool(const Point&)>;

// The nearest point to p on the grid of multiples of 2^-exponent, a few steps around it, that is wanted. Coordinates that are doubles stay.
std::optional<Point> on_grid(const RationalPoint& p, int exponent, const IsWanted& is_wanted) {
  constexpr int around = 3;
  struct Place {
    double at, off_squared;
  };
  std::array<std::vector<Place>, 3> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (const auto [low, high] = neighbours(p[axis]); low == high) {
      places[axis] = {{low, 0}};
      continue;
    }
    const auto shift = static_cast<mp_bitcnt_t>(exponent);
    mpz_class below;  // in steps
    mpz_fdiv_q(below.get_mpz_t(), mpz_class(p[axis].get_num() << shift).get_mpz_t(), p[axis].get_den_mpz_t());
    if (mpz_sizeinbase(below.get_mpz_t(), 2) > 50) return std::nullopt;  // doubles are no finer than that
    for (int i = 1 - around; i <= around; ++i) {
      const double at = std::ldexp(mpz_class(below + i).get_d(), -exponent), off = mpq_class(at - p[axis]).get_d();
      places[axis].push_back({at, off * off});
    }
  }
  std::vector<std::pair<double, Point>> candidates;
  for (const Place& x : places[0]) {
    for (const Place& y : places[1]) {
      for (const Place& z : places[2])
        candidates.push_back({x.off_squared + y.off_squared + z.off_squared, {x.at, y.at, z.at}});
    }
  }
  std::sort(candidates.begin(), candidates.end());
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const auto& candidate) { return is_wanted(candidate.second); });
  return found == candidates.end() ? std::nullopt : std::optional(found->second);
}

// The same by units in the last place, away from p in all coordinates that are no doubles.
std::optional<Point> next_to_it(const RationalPoint& p, const IsWanted& is_wanted) {
  constexpr int most_units = 64;
  for (int units = 1; units <= most_units; units *= 2) {
    for (const Point& corner : corners_of(box_around(p, units))) {
      if (is_wanted(corner)) return corner;
    }
  }
  return std::nullopt;
}

// For each vertex a double point near it that is beyond, with the coordinates of the vertex that are doubles: their hull most often
// holds the polytope, and none of them is beyond a side across an axis that its vertex is in. A vertex without such a point has the
// corners of a box around it. `exponent`: of the grid, if one is wanted.
std::vector<Point> points_beyond(const Polytope& polytope, std::optional<int> exponent) {
  std::vector<std::vector<const HalfSpace*>> faces_at(polytope.vertices.size());
  for (const auto& face : polytope.faces) {
    for (const auto v : face.vertices) faces_at[v].push_back(&face.half_space);
  }
  std::set<Point> points;
  for (std::size_t v = 0; v < polytope.vertices.size(); ++v) {
    // In none of the half spaces of the faces at it, but on their planes.
    const auto is_beyond = [&](const Point& p) {
      const auto exact = to_rational(p);
      return std::all_of(faces_at[v].begin(), faces_at[v].end(),
                         [&](const HalfSpace* face) { return sgn(face->height(exact)) >= 0; });
    };
    std::optional<Point> found;
    if (exponent) found = on_grid(polytope.vertices[v], *exponent, is_beyond);
    if (!found) found = next_to_it(polytope.vertices[v], is_beyond);
    if (found) {
      points.insert(*found);
    } else {
      for (const auto& corner : corners_of(box_around(polytope.vertices[v]))) points.insert(corner);
    }
  }
  return {points.begin(), points.end()};
}

// A grid that is fine beside the polytope and beside what planes in a file of floats are off, and coarse beside doubles.
int grid_exponent(const Polytope& polytope) {
  constexpr int coarsest = 14, finer_than_it = 18;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(polytope.vertices.begin(), polytope.vertices.end(),
                            [axis](const RationalPoint& a, const RationalPoint& b) { return a[axis] < b[axis]; });
    least = std::min(least, mpq_class((*high)[axis] - (*low)[axis]).get_d());
  }
  return std::max(coarsest, finer_than_it - std::ilogb(least));
}

RationalPoint center_of(const Polytope& polytope) {
  RationalPoint center;
  for (const auto& v : polytope.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) center[axis] += v[axis];
  }
  for (auto& x : center) x /= static_cast<unsigned long>(polytope.vertices.size());
  return center;
}

// from + share * (to - from)
RationalPoint between(const RationalPoint& from, const RationalPoint& to, const mpq_class& share) {
  RationalPoint p;
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = from[axis] + share * (to[axis] - from[axis]);
  return p;
}

mpq_class power_of_half(unsigned exponent) { return {mpz_class(1), mpz_class(1) << exponent}; }

// Every half space that is bounded by three of the points and holds all of them holds the polytope's vertices. For points that are
// not all in one plane: their hull holds the polytope. O(n^4), for the few corners of a cell.
bool hull_holds(const std::vector<Point>& points, const Polytope& polytope) {
  std::vector<RationalPoint> corners;
  for (const auto& p : points) corners.push_back(to_rational(p));
  const auto holds_all = [](const HalfSpace& plane, const std::vector<RationalPoint>& all) {
    return std::all_of(all.begin(), all.end(), [&](const RationalPoint& p) { return plane.holds(p); });
  };
  bool any = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        const auto plane = plane_through(corners[i], corners[j], corners[k]);
        if (!plane) continue;
        for (const auto& half_space : {*plane, plane->opposite()}) {
          if (!holds_all(half_space, corners)) continue;
          any = true;
          if (!holds_all(half_space, polytope.vertices)) return false;
        }
      }
    }
  }
  return any && !are_coplanar(points);
}

}  // namespace

bool are_coplanar(const std::vector<Point>& points) {
  std::vector<RationalPoint> all;
  for (const auto& p : points) all.push_back(to_rational(p));
  for (std::size_t j = 1; j < all.size(); ++j) {
    for (std::size_t k = j + 1; k < all.size(); ++k) {
      const auto plane = plane_through(all[0], all[j], all[k]);
      if (!plane) continue;
      return std::all_of(all.begin(), all.end(), [&](const RationalPoint& p) { return sgn(plane->height(p)) == 0; });
    }
  }
  return true;
}

std::optional<std::vector<Point>> inner_vertices(const Polytope& polytope, std::optional<int> grid) {
  constexpr unsigned finest = 60;  // of the way to the middle, as a power of 1/2
  const RationalPoint center = center_of(polytope);
  std::vector<Point> points;
  for (const auto& v : polytope.vertices) {
    std::optional<Point> found;
    if (is_double(v)) {
      found = to_doubles(v);
    } else if (grid) {
      found = on_grid(v, *grid, [&](const Point& p) { return polytope.holds(to_rational(p)); });
    }
    for (const auto& corner : found ? std::vector<Point>{} : corners_of(box_around(v))) {
      if (!found && polytope.holds(to_rational(corner))) found = corner;
    }
    for (unsigned exponent = finest; !found && exponent > 0; --exponent) {
      const Point p = to_doubles(between(v, center, power_of_half(exponent)));
      if (polytope.holds(to_rational(p))) found = p;
    }
    if (!found) return std::nullopt;
    points.push_back(*found);
  }
  return points;
}

std::vector<Point> outer_points(const Polytope& polytope) {
  constexpr std::size_t most_for_hull = 24;  // beyond, a box around each vertex is cheaper than a proof
  if (std::all_of(polytope.vertices.begin(), polytope.vertices.end(), is_double)) {
    std::set<Point> exact;
    for (const auto& v : polytope.vertices) exact.insert(to_doubles(v));
    return {exact.begin(), exact.end()};
  }
  if (polytope.vertices.size() <= most_for_hull) {
    for (const std::optional<int> exponent : {std::optional(grid_exponent(polytope)), std::optional<int>{}}) {
      const auto points = points_beyond(polytope, exponent);
      if (points.size() <= most_for_hull && hull_holds(points, polytope)) return points;
    }
  }
  std::set<Point> corners;
  for (const auto& v : polytope.vertices) {
    for (const auto& corner : corners_of(box_around(v))) corners.insert(corner);
  }
  return {corners.begin(), corners.end()};
}

}  // namespace clues::scene
