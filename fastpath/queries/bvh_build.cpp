// Binned surface-area heuristic (Wald 2007), eight children a node: the largest child that is not a leaf is split until there are eight.
#include "fastpath/queries/bvh_build.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

#include "fastpath/queries/bvh.h"

namespace clues::fastpath {
namespace {

constexpr std::size_t kLeafSize = 4;
constexpr std::size_t kBins = 32;
constexpr std::size_t kParallel = 8192;  // fewer items are one task
constexpr int kSurfaceAreaLevels = 64;   // below, halves: at most 32 more levels, and kDeepest holds

float twice_center(const LocalBox& box, std::size_t axis) { return box.low[axis] + box.high[axis]; }

struct Bounds {
  LocalBox boxes;    // of the items
  LocalBox centers;  // of twice their centers
};

void add(Bounds& bounds, const BoxedTriangle& item) {
  bounds.boxes.add(item.box);
  for (std::size_t i = 0; i < 3; ++i) {
    const float c = twice_center(item.box, i);
    bounds.centers.low[i] = std::min(bounds.centers.low[i], c);
    bounds.centers.high[i] = std::max(bounds.centers.high[i], c);
  }
}

// Runs `add_item(part, item)` over all items, joins parts by `join`; the result must not depend on the grouping.
template <class Part, class AddItem, class Join>
Part gathered(std::span<const BoxedTriangle> items, const AddItem& add_item, const Join& join) {
  const auto run = [&](const tbb::blocked_range<std::size_t>& range, Part part) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) add_item(part, items[i]);
    return part;
  };
  const tbb::blocked_range<std::size_t> all(0, items.size(), kParallel);
  if (items.size() < 2 * kParallel) return run(all, Part{});
  return tbb::parallel_reduce(all, Part{}, run, [&](Part a, const Part& b) {
    join(a, b);
    return a;
  });
}

struct ItemRange {
  std::span<BoxedTriangle> items;
  Bounds bounds;
  std::size_t offset = 0;  // of items in the whole
};

ItemRange range_of(std::span<BoxedTriangle> items, std::size_t offset) {
  return {items,
          gathered<Bounds>(items, add,
                           [](Bounds& a, const Bounds& b) {
                             a.boxes.add(b.boxes);
                             a.centers.add(b.centers);
                           }),
          offset};
}

struct Bin {
  LocalBox box;
  std::size_t count = 0;
};
using Bins = std::array<std::array<Bin, kBins>, 3>;

struct Binning {
  std::array<float, 3> low{}, per_unit{};

  explicit Binning(const LocalBox& centers) {
    for (std::size_t i = 0; i < 3; ++i) {
      const float width = centers.high[i] - centers.low[i];
      low[i] = centers.low[i];
      per_unit[i] = width > 0x1p-100F ? static_cast<float>(kBins) / width : 0;
    }
  }
  std::size_t bin_of(const LocalBox& box, std::size_t axis) const {
    const float x = (twice_center(box, axis) - low[axis]) * per_unit[axis];
    return std::min(kBins - 1, static_cast<std::size_t>(x));
  }
};

// Full blocks of four are what a leaf costs.
float blocks_for(std::size_t n) { return static_cast<float>((n + kLeafSize - 1) / kLeafSize); }

// Where to cut: items with bin_of(axis) < bin go left. bin 0: no cut separates anything.
struct Cut {
  std::size_t axis = 0, bin = 0;
};

Cut best_cut(const Bins& bins) {
  Cut best;
  float least = INFINITY;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, kBins> right_cost{};
    Bin sum;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      sum.box.add(bins[axis][i].box);
      sum.count += bins[axis][i].count;
      right_cost[i] = sum.count == 0 ? INFINITY : sum.box.half_area() * blocks_for(sum.count);
    }
    sum = {};
    for (std::size_t i = 1; i < kBins; ++i) {
      sum.box.add(bins[axis][i - 1].box);
      sum.count += bins[axis][i - 1].count;
      if (sum.count == 0) continue;
      const float cost = sum.box.half_area() * blocks_for(sum.count) + right_cost[i];
      if (cost < least) {
        least = cost;
        best = {axis, i};
      }
    }
  }
  return best;
}

std::pair<ItemRange, ItemRange> split(const ItemRange& range, int level) {
  std::size_t left = 0;
  if (level < kSurfaceAreaLevels) {
    const Binning binning(range.bounds.centers);
    const Bins bins = gathered<Bins>(
        range.items,
        [&](Bins& all, const BoxedTriangle& item) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            Bin& bin = all[axis][binning.bin_of(item.box, axis)];
            bin.box.add(item.box);
            ++bin.count;
          }
        },
        [](Bins& a, const Bins& b) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < kBins; ++i) {
              a[axis][i].box.add(b[axis][i].box);
              a[axis][i].count += b[axis][i].count;
            }
          }
        });
    const Cut cut = best_cut(bins);
    if (cut.bin != 0) {
      const auto middle = std::partition(range.items.begin(), range.items.end(), [&](const BoxedTriangle& item) {
        return binning.bin_of(item.box, cut.axis) < cut.bin;
      });
      left = static_cast<std::size_t>(middle - range.items.begin());
    }
  }
  if (left == 0 || left == range.items.size()) left = range.items.size() / 2;
  ItemRange a, b;
  const auto do_left = [&] { a = range_of(range.items.first(left), range.offset); };
  const auto do_right = [&] { b = range_of(range.items.subspan(left), range.offset + left); };
  if (range.items.size() < kParallel) {
    do_left();
    do_right();
  } else {
    tbb::parallel_invoke(do_left, do_right);
  }
  return {a, b};
}

void set_lane(BoxLanes& node, std::size_t lane, const LocalBox& box) {
  for (std::size_t i = 0; i < 3; ++i) {
    node.side[i][lane] = box.low[i];
    node.side[i + 3][lane] = box.high[i];
  }
}

// The numbers of nodes and leaves in `part` become those they have behind the ones of `tree`.
void append(Tree& tree, Tree&& part) {
  const auto nodes = static_cast<std::uint32_t>(tree.nodes.size()),
             leaves = static_cast<std::uint32_t>(tree.leaves.size());
  for (BoxLanes& node : part.nodes) {
    for (std::uint32_t& child : node.child) {
      if (child != BoxLanes::kEmpty) child += (child & BoxLanes::kLeaf) != 0 ? leaves : nodes;
    }
    tree.nodes.push_back(node);
  }
  tree.leaves.insert(tree.leaves.end(), part.leaves.begin(), part.leaves.end());
  tree.leaf_sizes.insert(tree.leaf_sizes.end(), part.leaf_sizes.begin(), part.leaf_sizes.end());
}

void build(const ItemRange& range, int level, Tree& tree) {
  std::array<ItemRange, BoxLanes::kWidth> part{range};
  std::size_t parts = 1;
  while (parts < part.size()) {
    std::size_t largest = parts;
    for (std::size_t i = 0; i < parts; ++i) {
      if (part[i].items.size() <= kLeafSize) continue;
      if (largest == parts || part[i].bounds.boxes.half_area() > part[largest].bounds.boxes.half_area()) largest = i;
    }
    if (largest == parts) break;
    auto [a, b] = split(part[largest], level);
    part[largest] = a;
    part[parts++] = b;
  }
  const std::size_t self = tree.nodes.size();
  tree.nodes.emplace_back();
  std::fill(std::begin(tree.nodes[self].child), std::end(tree.nodes[self].child), BoxLanes::kEmpty);
  for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane)
    set_lane(tree.nodes[self], lane, lane < parts ? part[lane].bounds.boxes : LocalBox{});

  const auto build_child = [&](std::size_t lane, Tree& into) -> std::uint32_t {
    if (part[lane].items.size() <= kLeafSize) {
      into.leaves.push_back(static_cast<std::uint32_t>(part[lane].offset));
      into.leaf_sizes.push_back(static_cast<std::uint8_t>(part[lane].items.size()));
      return BoxLanes::kLeaf | static_cast<std::uint32_t>(into.leaves.size() - 1);
    }
    const auto number = static_cast<std::uint32_t>(into.nodes.size());
    build(part[lane], level + 1, into);
    return number;
  };
  if (range.items.size() < kParallel) {
    for (std::size_t lane = 0; lane < parts; ++lane) {
      const std::uint32_t child = build_child(lane, tree);
      tree.nodes[self].child[lane] = child;
    }
    return;
  }
  std::array<Tree, BoxLanes::kWidth> sub;
  std::array<std::uint32_t, BoxLanes::kWidth> child{};
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t lane) { child[lane] = build_child(lane, sub[lane]); });
  for (std::size_t lane = 0; lane < parts; ++lane) {
    const auto base =
        static_cast<std::uint32_t>((child[lane] & BoxLanes::kLeaf) != 0 ? tree.leaves.size() : tree.nodes.size());
    append(tree, std::move(sub[lane]));
    tree.nodes[self].child[lane] = child[lane] + base;
  }
}

}  // namespace

void LocalBox::add(const LocalBox& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

float LocalBox::half_area() const {
  const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  return x * y + y * z + z * x;
}

Tree build_tree(std::span<BoxedTriangle> items) {
  Tree tree;
  if (!items.empty()) build(range_of(items, 0), 0, tree);
  return tree;
}

}  // namespace clues::fastpath
