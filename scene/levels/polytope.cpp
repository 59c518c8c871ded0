// D23: intersection with one half space. Faces are clipped one by one; the new face is put together from all vertices on
// the plane, which are in convex position, by sorting them around one of them.
#include "scene/levels/polytope.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace clues::scene {
namespace {

using Loop = std::vector<std::uint32_t>;

class Cut {
 public:
  Cut(const Polytope& polytope, const HalfSpace& half_space) : polytope_(polytope), half_space_(half_space) {
    for (const auto& v : polytope.vertices) heights_.push_back(half_space.height(v));
  }

  bool all(int sign) const {  // no vertex has the other sign
    return std::all_of(heights_.begin(), heights_.end(), [&](const mpq_class& h) { return sgn(h) * sign >= 0; });
  }

  Polytope result() {
    new_index_.assign(polytope_.vertices.size(), none);
    for (const auto& face : polytope_.faces) {
      auto loop = clipped(face.vertices);
      if (loop.size() >= 3) cut_.faces.push_back({face.half_space, std::move(loop)});
    }
    auto cap = ordered(std::move(on_plane_));
    if (cap.size() >= 3) cut_.faces.push_back({half_space_, std::move(cap)});
    return std::move(cut_);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  std::uint32_t kept(std::uint32_t vertex) {
    auto& index = new_index_[vertex];
    if (index == none) {
      index = add(polytope_.vertices[vertex]);
      if (sgn(heights_[vertex]) == 0) on_plane_.push_back(index);
    }
    return index;
  }

  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = crossings_.try_emplace(std::minmax(a, b), none);
    if (!is_new) return entry->second;
    const auto &p = polytope_.vertices[a], &q = polytope_.vertices[b];
    const mpq_class share = heights_[a] / (heights_[a] - heights_[b]);
    RationalPoint point;
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = p[axis] + share * (q[axis] - p[axis]);
    entry->second = add(std::move(point));
    on_plane_.push_back(entry->second);
    return entry->second;
  }

  std::uint32_t add(RationalPoint point) {
    cut_.vertices.push_back(std::move(point));
    return static_cast<std::uint32_t>(cut_.vertices.size() - 1);
  }

  // Faces of which the half space leaves an edge or a corner have none left: with two or fewer distinct vertices.
  Loop clipped(const Loop& loop) {
    const bool any_inside =
        std::any_of(loop.begin(), loop.end(), [&](std::uint32_t v) { return sgn(heights_[v]) < 0; });
    if (!any_inside) return {};  // at most its rim is left, which belongs to other faces too
    Loop out;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto a = loop[i], b = loop[(i + 1) % loop.size()];
      if (sgn(heights_[a]) <= 0) out.push_back(kept(a));
      if (sgn(heights_[a]) * sgn(heights_[b]) < 0) out.push_back(crossing(a, b));
    }
    return out;
  }

  // Around the corner that is first in the order of the projection, all others lie within less than half a turn.
  Loop ordered(Loop loop) const {
    std::size_t dropped = 0;  // the axis along which the plane is projected; the normal is not zero there
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (abs(half_space_.normal[axis]) > abs(half_space_.normal[dropped])) dropped = axis;
    }
    const std::size_t x = (dropped + 1) % 3, y = (dropped + 2) % 3;
    const auto& points = cut_.vertices;
    if (loop.size() < 3) return {};
    std::iter_swap(loop.begin(), std::min_element(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) {
                     return std::tie(points[a][x], points[a][y]) < std::tie(points[b][x], points[b][y]);
                   }));
    const auto& origin = points[loop[0]];
    std::sort(loop.begin() + 1, loop.end(), [&](std::uint32_t a, std::uint32_t b) {
      const mpq_class turn = (points[a][x] - origin[x]) * (points[b][y] - origin[y]) -
                             (points[a][y] - origin[y]) * (points[b][x] - origin[x]);
      return sgn(turn) > 0;
    });
    return loop;
  }

  const Polytope& polytope_;
  const HalfSpace& half_space_;
  std::vector<mpq_class> heights_;
  std::vector<std::uint32_t> new_index_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
  Loop on_plane_;
  Polytope cut_;
};

}  // namespace

mpq_class HalfSpace::height(const RationalPoint& p) const {
  mpq_class sum = -offset;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (sgn(normal[axis]) != 0) sum += normal[axis] * p[axis];
  }
  return sum;
}

HalfSpace HalfSpace::opposite() const {
  return {{mpq_class(-normal[0]), mpq_class(-normal[1]), mpq_class(-normal[2])}, mpq_class(-offset)};
}

std::optional<HalfSpace> plane_through(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  HalfSpace plane;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
    plane.normal[axis] = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
    plane.offset += plane.normal[axis] * a[axis];
  }
  if (sgn(plane.normal[0]) == 0 && sgn(plane.normal[1]) == 0 && sgn(plane.normal[2]) == 0) return std::nullopt;
  return plane;
}

bool Polytope::holds(const RationalPoint& p) const {
  return std::all_of(faces.begin(), faces.end(), [&](const Face& face) { return face.half_space.holds(p); });
}

Polytope box_polytope(const RationalPoint& low, const RationalPoint& high) {
  Polytope box;
  for (std::size_t i = 0; i < 8; ++i) {
    box.vertices.push_back(
        {(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto x = std::uint32_t{1} << ((axis + 1) % 3), y = std::uint32_t{1} << ((axis + 2) % 3);
    HalfSpace below, above;
    above.normal[axis] = 1;
    above.offset = high[axis];
    below.normal[axis] = -1;
    below.offset = -low[axis];
    const auto far = std::uint32_t{1} << axis;
    box.faces.push_back({std::move(below), {0, x, x + y, y}});
    box.faces.push_back({std::move(above), {far, far + x, far + x + y, far + y}});
  }
  return box;
}

std::optional<Polytope> intersection(const Polytope& polytope, const HalfSpace& half_space) {
  Cut cut(polytope, half_space);
  if (cut.all(1)) return std::nullopt;  // at most a face is left
  if (cut.all(-1)) return polytope;
  return cut.result();
}

RationalPoint to_rational(const Point& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }

Point to_doubles(const RationalPoint& p) { return {p[0].get_d(), p[1].get_d(), p[2].get_d()}; }

}  // namespace clues::scene
