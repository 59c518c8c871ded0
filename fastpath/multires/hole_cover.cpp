// As D31 and D32 say: any triangulation of the hole that avoids edges which are there, by chains of its border that a triangle closes; then flips
// until every diagonal is the wanted one. Where no edge is in the way the result is the only one; else the order of the flips decides, and it
// is that of the triangles, each flip taking the first that can be made.
#include <algorithm>

#include "fastpath/multires/grid_signs.h"
#include "fastpath/multires/surface_star.h"

namespace clues::fastpath::multires {
namespace {

constexpr std::size_t most_corners = most_neighbours + 1;

// Places in the ring of the corners of a polygon, in order.
struct Polygon {
  std::size_t size = 0;
  std::array<std::uint8_t, most_corners> place;
};
using Corners = std::array<std::uint8_t, 3>;  // of the polygon

class Cover {
 public:
  Cover(const SurfaceStar& star, const DiskLayout& layout, const RingEdges& joined, bool sure, const Polygon& polygon)
      : star_(star), joined_(joined), sure_(sure), n_(polygon.size) {
    for (std::size_t k = 0; k < n_; ++k) {
      place_[k] = polygon.place[k];
      at_[k] = layout.ring_[place_[k]];
    }
  }
  bool make() {
    for (std::size_t width = 2; width < n_; ++width) {
      for (std::size_t i = 0; i + width < n_; ++i) {
        const std::size_t j = i + width;
        middle_[i][j] = none;
        if (width + 1 < n_ && forbidden(i, j)) continue;
        for (std::size_t k = i + 1; k < j && middle_[i][j] == none; ++k) {
          if (closes(i, k) && closes(k, j) && short_orientation(at_[i], at_[k], at_[j]) > 0) {
            middle_[i][j] = static_cast<std::uint8_t>(k);
          }
        }
      }
    }
    if (!closes(0, n_ - 1)) return false;
    collect(0, n_ - 1);
    while (flip_one()) {
    }
    return true;
  }
  void append_to(HoleCover& cover) const {
    const auto ring = star_.ring();
    for (std::size_t k = 0; k < count_; ++k) {
      const Corners& t = triangles_[k];
      scene::Triangle numbers{ring[place_[t[0]]], ring[place_[t[1]]], ring[place_[t[2]]]};
      std::rotate(numbers.begin(), std::min_element(numbers.begin(), numbers.end()), numbers.end());
      cover.triangles_[cover.size++] = numbers;
    }
  }

 private:
  static constexpr std::uint8_t none = 0xff;
  bool closes(std::size_t i, std::size_t j) const { return j == i + 1 || middle_[i][j] != none; }
  bool forbidden(std::size_t i, std::size_t j) const { return (joined_[place_[i]] >> place_[j] & 1U) != 0; }
  std::uint32_t number(std::size_t i) const { return star_.ring_[place_[i]]; }

  void collect(std::size_t i, std::size_t j) {
    if (j == i + 1) return;
    const std::size_t k = middle_[i][j];
    triangles_[count_++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(j)};
    collect(i, k);
    collect(k, j);
  }

  // Of a, b, c, d, where the triangles on the edge from a to b are a b c and b a d: whether that of c and d is wanted.
  bool is_wanted(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    int sign = sure_ ? in_circle_filtered(at_[a], at_[b], at_[c], at_[d]) : unsure;
    if (sign == unsure) sign = exact::in_circle(at_[a], at_[b], at_[c], at_[d]);
    if (sign == 0) sign = std::min(number(c), number(d)) < std::min(number(a), number(b)) ? 1 : -1;
    return sign > 0;
  }

  bool flip_one() {
    for (std::size_t s = 0; s < count_; ++s) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint8_t a = triangles_[s][k], b = triangles_[s][(k + 1) % 3], c = triangles_[s][(k + 2) % 3];
        for (std::size_t t = s + 1; t < count_; ++t) {
          std::uint8_t d = none;
          for (std::size_t i = 0; i < 3; ++i) {
            if (triangles_[t][i] == b && triangles_[t][(i + 1) % 3] == a) d = triangles_[t][(i + 2) % 3];
          }
          if (d == none || !is_wanted(a, b, c, d) || forbidden(c, d) ||
              short_orientation(at_[d], at_[b], at_[c]) <= 0 || short_orientation(at_[d], at_[c], at_[a]) <= 0) {
            continue;
          }
          triangles_[s] = {d, b, c};
          triangles_[t] = {d, c, a};
          return true;
        }
      }
    }
    return false;
  }

  const SurfaceStar& star_;
  const RingEdges& joined_;
  bool sure_;
  std::size_t n_, count_ = 0;
  std::array<std::uint8_t, most_corners> place_;
  std::array<exact::DiskPoint, most_corners> at_;
  std::array<std::array<std::uint8_t, most_corners>, most_corners>
      middle_;  // of the chain from i to j: the third corner over its end
  std::array<Corners, most_corners> triangles_;
};

}  // namespace

bool cover_hole(const SurfaceStar& star, const DiskLayout& layout, const RingEdges& joined, bool sure,
                HoleCover& cover) {
  cover.size = 0;
  const std::size_t n = star.size;
  if (star.kind == scene::StarKind::boundary && (joined[0] >> (n - 1) & 1U) != 0) return false;
  if (star.kind == scene::StarKind::feature && (joined[0] >> star.across & 1U) != 0) return false;
  const auto add = [&](std::size_t begin, std::size_t end) {  // places from begin to end, counted on round the ring
    Polygon polygon;
    for (std::size_t k = begin; k <= end; ++k) polygon.place[polygon.size++] = static_cast<std::uint8_t>(k % n);
    Cover made(star, layout, joined, sure, polygon);
    if (!made.make()) return false;
    made.append_to(cover);
    return true;
  };
  if (star.kind == scene::StarKind::feature) {
    if (!add(0, star.across) || !add(star.across, n)) return false;
  } else if (!add(0, n - 1)) {
    return false;
  }
  std::sort(cover.triangles_.begin(), cover.triangles_.begin() + static_cast<std::ptrdiff_t>(cover.size));
  return true;
}

}  // namespace clues::fastpath::multires
