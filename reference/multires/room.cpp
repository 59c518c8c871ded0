#include "reference/multires/room.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/multires/grid.h"
#include "reference/multires/pieces_around.h"

namespace clues::reference {
namespace {

using exact::Wide;
using scene::CarrierPoint;
using Place = CarrierPoint scene::OverlayVertex::*;  // on the input, or on the base domain

constexpr int kRounds = 8;
constexpr Wide kRoom = Wide{1} << (2 * scene::weight_bits - 30);  // 2^-30 of a triangle: a piece as large need not grow

bool lies_within(const CarrierPoint& point, const CarrierPoint& carrier) {
  for (std::size_t k = 0; k < point.size(); ++k) {
    if (carrier.weight_of(point.corner[k]) == 0) return false;
  }
  return true;
}

class Room {
 public:
  explicit Room(scene::Hierarchy& hierarchy) : h_(hierarchy), around_(hierarchy) {}

  void make(const std::set<std::uint32_t>& base_triangles) {
    std::set<std::uint32_t> points;
    for (std::uint32_t i = 0; i < h_.pieces.size(); ++i) {
      if (base_triangles.count(around_.base[i]) != 0)
        points.insert(h_.pieces[i].corners.begin(), h_.pieces[i].corners.end());
    }
    for (int round = 0; round < kRounds; ++round) {
      for (const std::uint32_t p : points) {
        move(p, &scene::OverlayVertex::image);
        move(p, &scene::OverlayVertex::source);
      }
    }
  }

 private:
  // What the piece has of its triangle there, in units of 2^-120.
  Wide area(std::uint32_t piece, Place place) const {
    const auto& c = h_.pieces[piece].corners;
    const scene::Triangle& whole = place == &scene::OverlayVertex::image ? h_.base[around_.base[piece]]
                                                                         : h_.input.triangles[h_.pieces[piece].input];
    return exact::area_in(whole, h_.points[c[0]].*place, h_.points[c[1]].*place, h_.points[c[2]].*place);
  }
  Wide least_around(std::uint32_t p, Place place) const {
    Wide least = area(around_.pieces[p].front(), place);
    for (const std::uint32_t i : around_.pieces[p]) least = std::min(least, area(i, place));
    return least;
  }

  // The middle of those neighbours that lie in what carries the point; it stays in there, since that is convex.
  std::array<double, 3> middle(std::uint32_t p, Place place) const {
    const CarrierPoint& at = h_.points[p].*place;
    std::set<std::uint32_t> neighbours;
    for (const std::uint32_t i : around_.pieces[p]) {
      for (const std::uint32_t q : h_.pieces[i].corners) {
        if (q != p && lies_within(h_.points[q].*place, at)) neighbours.insert(q);
      }
    }
    std::array<double, 3> sum{};
    for (const std::uint32_t q : neighbours) {
      for (std::size_t k = 0; k < at.size(); ++k)
        sum[k] += static_cast<double>((h_.points[q].*place).weight_of(at.corner[k]));
    }
    for (double& x : sum) x /= static_cast<double>(neighbours.size());
    return sum;
  }

  void move(std::uint32_t p, Place place) {
    CarrierPoint& at = h_.points[p].*place;
    if (at.size() == 1) return;
    const CarrierPoint old = at;
    const Wide was = least_around(p, place);
    const std::array<double, 3> to = middle(p, place);
    for (const double part : {1.0, 0.5, 0.25, 0.125}) {
      CarrierPoint moved = old;
      std::int64_t left = scene::whole_weight;
      std::size_t largest = 0;
      for (std::size_t k = 0; k < old.size(); ++k) {
        moved.weight[k] += std::llround(part * (to[k] - static_cast<double>(old.weight[k])));
        left -= moved.weight[k];
        if (moved.weight[k] > moved.weight[largest]) largest = k;
      }
      moved.weight[largest] += left;
      if (*std::min_element(moved.weight.begin(), moved.weight.begin() + static_cast<std::ptrdiff_t>(old.size())) <= 0)
        continue;
      at = moved;
      const Wide now = least_around(p, place);
      if (now > was || now >= kRoom) return;
      at = old;
    }
  }

  scene::Hierarchy& h_;
  const PiecesAround around_;
};

}  // namespace

void make_room(scene::Hierarchy& hierarchy, const std::set<std::uint32_t>& base_triangles) {
  Room(hierarchy).make(base_triangles);
}

}  // namespace clues::reference
