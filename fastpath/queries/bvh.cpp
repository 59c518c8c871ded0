// From a mesh to boxes and blocks: rounding outward, bounds of sizes.
#include "fastpath/queries/bvh.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "exact/dials.h"
#include "fastpath/predicates/exact_segment.h"
#include "fastpath/queries/bvh_build.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

constexpr std::size_t kGrain = 4096;

void check(const scene::TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) {
      if (corner >= mesh.points.size()) {
        throw scene::Error(scene::ErrorCode::index_out_of_range, "triangle " + std::to_string(i) + " has corner " +
                                                                     std::to_string(corner) + ", but there are " +
                                                                     std::to_string(mesh.points.size()) + " points");
      }
      const Point& p = mesh.points[corner];
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
        throw scene::Error(scene::ErrorCode::non_finite,
                           "triangle " + std::to_string(i) + " has a corner that is not finite");
      }
    }
  }
  if (mesh.triangles.size() >= BoxLanes::kLeaf) {
    throw scene::Error(scene::ErrorCode::unsupported, "a scene of 2^31 triangles or more is too large");
  }
}

// One minor of the cross product of two edges certainly differs from zero: four products and differences, (1+u)^4 - 1 < 2^-50, and
// no underflow where a product that counts is above 2^-900.
bool certainly_has_area(const Corners& t) {
  std::array<double, 3> e{}, f{};
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = t[1][i] - t[0][i];
    f[i] = t[2][i] - t[0][i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double x = e[i] * f[j], y = e[j] * f[i], size = std::fabs(x) + std::fabs(y);
    if (size > 0x1p-900 && size < 0x1p900 && std::fabs(x - y) > 0x1p-50 * size) return true;
  }
  return false;
}

// Local coordinates are wrong by a relative 2^-53 and 2^-1074.
LocalBox box_of(const LocalFrame& frame, const Corners& t) {
  LocalBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = frame.to_local(std::min({t[0][i], t[1][i], t[2][i]}), i);
    const double high = frame.to_local(std::max({t[0][i], t[1][i], t[2][i]}), i);
    box.low[i] = rounded_down(low - (0x1p-52 * std::fabs(low) + 0x1p-1070));
    box.high[i] = rounded_up(high + (0x1p-52 * std::fabs(high) + 0x1p-1070));
  }
  return box;
}

void set_lane(TriangleBlock& block, std::size_t lane, const LocalFrame& frame, const Corners& t, std::uint32_t id) {
  double size = TriangleBlock::kLeastSize;
  for (std::size_t i = 0; i < 3; ++i) {
    // The difference is rounded once, in world coordinates; it overflows only in scenes of nearly the largest doubles.
    const double e = (t[1][i] - t[0][i]) * frame.scale, f = (t[2][i] - t[0][i]) * frame.scale;
    const bool fits = std::fabs(e) <= 4 && std::fabs(f) <= 4;
    block.corner[i][lane] = static_cast<float>(frame.to_local(t[0][i], i));
    block.edge1[i][lane] = fits ? static_cast<float>(e) : 0.0F;
    block.edge2[i][lane] = fits ? static_cast<float>(f) : 0.0F;
    size = fits ? std::max({size, std::fabs(e), std::fabs(f)}) : 0x1p60;  // 2^60: stage 1 never decides
  }
  block.size[lane] = rounded_up(size * (1 + 0x1p-20));
  block.id[lane] = id;
}

// Every child has the box of all.
void let_cull_nothing(std::vector<BoxLanes>& nodes) {
  LocalBox all;
  const auto each_child = [&](const auto& visit) {
    for (BoxLanes& node : nodes) {
      for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
        if (node.child[lane] != BoxLanes::kEmpty) visit(node, lane);
      }
    }
  };
  each_child([&](const BoxLanes& node, std::size_t lane) {
    for (std::size_t i = 0; i < 3; ++i) {
      all.low[i] = std::min(all.low[i], node.side[i][lane]);
      all.high[i] = std::max(all.high[i], node.side[i + 3][lane]);
    }
  });
  each_child([&](BoxLanes& node, std::size_t lane) {
    for (std::size_t i = 0; i < 3; ++i) {
      node.side[i][lane] = all.low[i];
      node.side[i + 3][lane] = all.high[i];
    }
  });
}

}  // namespace

Bvh::Bvh(const scene::TriangleMesh& mesh) : mesh_(&mesh) {
  require_float_rules();
  check(mesh);
  std::vector<std::uint8_t> has_area(mesh.triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, has_area.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Corners t = corners(static_cast<std::uint32_t>(i));
      has_area[i] = certainly_has_area(t) || !degenerate_exact(t) ? 1 : 0;
    }
  });
  std::vector<BoxedTriangle> items;
  items.reserve(mesh.triangles.size());
  Point low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (std::uint32_t i = 0; i < has_area.size(); ++i) {
    if (has_area[i] == 0) {
      degenerate_.push_back(i);
      continue;
    }
    for (const std::uint32_t corner : mesh.triangles[i]) {
      const Point& p = mesh.points[corner];
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    items.push_back({LocalBox{}, i});
  }
  if (items.empty()) return;
  frame_ = LocalFrame::of_box(low, high);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      items[i].box = box_of(frame_, corners(items[i].triangle));
  });
  Tree tree = build_tree(items);
  nodes_ = std::move(tree.nodes);
  if (exact::process_dials::is_on(exact::process_dials::flat_trees)) let_cull_nothing(nodes_);
  blocks_.resize(tree.leaves.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks_.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      for (std::size_t lane = 0; lane < 4; ++lane) {
        const std::uint32_t t = items[tree.leaves[i] + (lane < tree.leaf_sizes[i] ? lane : 0)].triangle;
        set_lane(blocks_[i], lane, frame_, corners(t), t);
      }
    }
  });
}

// The local box contains the exact triangles in exact local coordinates; dividing by a power of two is exact (or overflows to infinity, which is outward), the sum is rounded once.
scene::Bounds Bvh::child_bounds(const BoxLanes& node, std::size_t lane) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  scene::Bounds box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::nextafter(static_cast<double>(node.side[i][lane]) / frame_.scale + frame_.center[i], -kInfinity);
    box.high[i] =
        std::nextafter(static_cast<double>(node.side[i + 3][lane]) / frame_.scale + frame_.center[i], kInfinity);
  }
  return box;
}

}  // namespace clues::fastpath
