#include "fastpath/solids/solids.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace clues::fastpath::solids {
namespace {

constexpr double kFarthest = 0x1p10;  // how far a solid may reach, in units of the scale
constexpr std::uint32_t kLeaf = 2;    // solids in a leaf of the tree
constexpr double kNormalUnit = 0x1p20,
                 kDistanceUnit = 0x1p20;  // to which planes are rounded: of a unit normal, of the scale

// Determinants of three of its lengths are neither too large nor too small for doubles.
bool is_in_range(const Scale& scale) { return scale.largest <= 0x1p200 && scale.largest >= 0x1p-200; }

bool reaches_too_far(const Solid& solid, const Scale& scale) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::max(std::fabs(solid.bounds.low[i]), std::fabs(solid.bounds.high[i])) > kFarthest * scale.largest)
      return true;
  }
  return false;
}

// A side that is so thin that its normal is lost.
bool has_no_normal(const Side& side) {
  return !std::all_of(side.estimate.normal.begin(), side.estimate.normal.end(), [](double x) {
    return std::isfinite(x);
  }) || !std::isfinite(side.estimate.distance);
}

struct Way {
  Point from, inverse;  // of its length along each axis; 0: it has none there
};

Way way_between(const Point& from, const Point& to) {
  Way way{from, {}};
  for (std::size_t i = 0; i < 3; ++i) way.inverse[i] = to[i] == from[i] ? 0 : 1 / (to[i] - from[i]);
  return way;
}

// Whether the segment is in the box somewhere, but for roundings.
bool passes(const Bounds& box, const Way& way) {
  double in = 0, out = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (way.inverse[i] == 0) {
      if (way.from[i] < box.low[i] || way.from[i] > box.high[i]) return false;
      continue;
    }
    const double a = (box.low[i] - way.from[i]) * way.inverse[i], b = (box.high[i] - way.from[i]) * way.inverse[i];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  return in <= out;
}

}  // namespace

Solids::Solids(std::vector<Solid> solids, const Bounds& about) : solids_(std::move(solids)), scale_(Scale::of(about)) {
  std::erase_if(solids_, [this](const Solid& solid) {
    return !is_in_range(scale_) || reaches_too_far(solid, scale_) ||
           std::any_of(solid.sides.begin(), solid.sides.end(), has_no_normal);
  });
  for (const Solid& solid : solids_) {
    first_estimate_.push_back(static_cast<std::uint32_t>(estimates_.size()));
    for (const Side& side : solid.sides) estimates_.push_back(side.estimate);
  }
  first_estimate_.push_back(static_cast<std::uint32_t>(estimates_.size()));
  build();
  number_planes();
  find_planes();
}

bool Solids::pierce(std::uint32_t solid, const Point& from, const Point& to, Pierced& hit) const {
  hit = {0, 1, solid, -1, -1};
  const std::uint32_t first = first_estimate_[solid], end = first_estimate_[solid + 1];
  for (std::uint32_t i = first; i < end; ++i) {
    const double at_from = estimates_[i].above(from), at_to = estimates_[i].above(to);
    if (at_from >= 0 && at_to >= 0) return false;
    if (at_from <= 0 && at_to <= 0) continue;
    const double share = at_from / (at_from - at_to);
    if (at_from > 0 && share > hit.in) {
      hit.in = share;
      hit.side_in = static_cast<std::int32_t>(i - first);
    } else if (at_to > 0 && share < hit.out) {
      hit.out = share;
      hit.side_out = static_cast<std::int32_t>(i - first);
    }
    if (hit.in >= hit.out) return false;
  }
  return true;
}

void Solids::build() {
  order_.resize(solids_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (!solids_.empty()) build(0, static_cast<std::uint32_t>(solids_.size()));
}

std::uint32_t Solids::build(std::uint32_t first, std::uint32_t count) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({solids_[order_[first]].bounds, first, count, 0, 0});
  for (std::uint32_t i = 1; i < count; ++i)
    nodes_[at].bounds = scene::hull_of(nodes_[at].bounds, solids_[order_[first + i]].bounds);
  if (count <= kLeaf) return at;
  const Bounds box = nodes_[at].bounds;
  const std::size_t axis = longest_axis(box);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = solids_[a].bounds.low[axis] + solids_[a].bounds.high[axis];
    const double at_b = solids_[b].bounds.low[axis] + solids_[b].bounds.high[axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  const std::uint32_t left = build(first, count / 2), right = build(first + count / 2, count - count / 2);
  nodes_[at].left = left;
  nodes_[at].right = right;
  return at;
}

void Solids::number_planes() {
  std::map<std::array<mpq_class, 4>, std::int32_t> numbers;
  for (Solid& solid : solids_) {
    for (Side& side : solid.sides)
      side.plane = numbers.try_emplace(side.exact_plane(), static_cast<std::int32_t>(numbers.size())).first->second;
  }
}

void Solids::find_planes() {
  std::map<std::array<double, 4>, std::uint32_t> numbers;
  const double unit = scale_.largest / kDistanceUnit;
  for (const Solid& solid : solids_) {
    auto& planes = planes_of_.emplace_back();
    for (const Side& side : solid.sides) {
      double lowest = 0;
      for (const Point& p : solid.corners) lowest = std::min(lowest, side.estimate.above(p));
      SectionPlane plane;
      for (std::size_t i = 0; i < 3; ++i)
        plane.normal[i] = std::round(side.estimate.normal[i] * kNormalUnit) / kNormalUnit;
      plane.distance = std::round((side.estimate.distance - std::min(scale_.depth(), -lowest / 2)) / unit) * unit;
      const auto first = std::find_if(plane.normal.begin(), plane.normal.end(), [](double x) { return x != 0; });
      if (first != plane.normal.end() && *first < 0) {  // the same plane from its other side
        for (double& x : plane.normal) x = 0 - x;
        plane.distance = 0 - plane.distance;
      }
      const auto number = static_cast<std::uint32_t>(planes_.size());
      const auto [at, is_new] =
          numbers.try_emplace({plane.normal[0], plane.normal[1], plane.normal[2], plane.distance}, number);
      if (is_new) planes_.push_back(plane);
      planes.push_back(at->second);
    }
  }
  sections_ = std::make_unique<LazySection[]>(planes_.size());
}

const Section& Solids::section(std::uint32_t plane) const {
  LazySection& lazy = sections_[plane];
  std::call_once(lazy.made, [&] { lazy.section = std::make_unique<const Section>(planes_[plane], solids_, scale_); });
  return *lazy.section;
}

const FilledPlane& Solids::filled(const FacetPlane& plane) const {
  LazyFilled* lazy = nullptr;
  {
    const std::lock_guard lock(filled_mutex_);
    lazy = &filled_[plane.key()];
  }
  std::call_once(lazy->made, [&] { lazy->filled = std::make_unique<const FilledPlane>(plane, solids_); });
  return *lazy->filled;
}

// Calls visit(solid) for those whose boxes the segment passes, until it says that this is enough.
template <typename Visit>
void Solids::walk(const Point& from, const Point& to, const Visit& visit) const {
  if (nodes_.empty()) return;
  const Way way = way_between(from, to);
  static thread_local std::vector<std::uint32_t> open;
  open.assign(1, 0);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!passes(node.bounds, way)) continue;
    if (node.left != 0) {
      open.push_back(node.left);
      open.push_back(node.right);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (visit(order_[i])) return;
    }
  }
}

void Solids::find_pierced(const Point& from, const Point& to, std::vector<Pierced>& out) const {
  out.clear();
  walk(from, to, [&](std::uint32_t solid) {
    Pierced hit;
    if (pierce(solid, from, to, hit)) out.push_back(hit);
    return false;
  });
  std::sort(out.begin(), out.end(),
            [](const Pierced& a, const Pierced& b) { return a.in < b.in || (a.in == b.in && a.solid < b.solid); });
}

bool Solids::pierces_any(const Point& from, const Point& to, std::uint32_t& likely) const {
  Pierced hit;
  if (likely < solids_.size() && pierce(likely, from, to, hit)) return true;
  bool any = false;
  walk(from, to, [&](std::uint32_t solid) {
    any = pierce(solid, from, to, hit);
    if (any) likely = solid;
    return any;
  });
  return any;
}

std::vector<std::uint32_t> Solids::touching(const Bounds& box) const {
  std::vector<std::uint32_t> found, open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!scene::touch(node.bounds, box)) continue;
    if (node.left != 0) {
      open.push_back(node.left);
      open.push_back(node.right);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (scene::touch(solids_[order_[i]].bounds, box)) found.push_back(order_[i]);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace clues::fastpath::solids
