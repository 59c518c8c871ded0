// D26: maps that are found again from seeds and boundaries, region for region; and what is lost without one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "fuzz/generators/random_scenes.h"
#include "fuzz/trials/deltas_trial.h"
#include "reference/contours/flood.h"
#include "tests/delta/plates.h"
#include "tests/reference/support.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::FT;
using reference::ContourLabel;
using reference::FlatSet;

// What a cell sees of each side.
class Seen {
 public:
  explicit Seen(const scene::TriangleMesh& mesh)
      : mesh_(mesh), sides_(reference::input_sides(mesh, reference::Mode::sheet)) {}

  std::vector<FlatSet> from(const exact::ConvexCell& cell) const {
    return reference::visible_on(sides_, mesh_, map_of(mesh_, cell));
  }
  ContourLabel label(const std::vector<FlatSet>& known, const std::vector<FlatSet>& wanted) const {
    return reference::contour_label(sides_, mesh_, known, wanted);
  }
  std::vector<FlatSet> flooded(const std::vector<FlatSet>& known, const ContourLabel& label) const {
    return reference::flooded(sides_, mesh_, known, label);
  }
  // The components of a set, each as a set.
  std::vector<std::vector<FlatSet>> components(const std::vector<FlatSet>& wanted) const {
    const reference::SurfaceParts parts(sides_, mesh_, wanted, {});
    const auto number = parts.components();
    const std::size_t count = number.empty() ? 0 : *std::max_element(number.begin(), number.end()) + 1;
    std::vector<std::vector<std::vector<reference::Face2>>> faces(
        count, std::vector<std::vector<reference::Face2>>(sides_.size()));
    for (std::size_t i = 0; i < number.size(); ++i)
      faces[number[i]][parts.parts()[i].side].push_back(parts.parts()[i].face);
    std::vector<std::vector<FlatSet>> out;
    for (const auto& one : faces) {
      out.emplace_back();
      for (std::size_t s = 0; s < sides_.size(); ++s)
        out.back().emplace_back(reference::frame_of(mesh_, sides_[s].triangle).twice_area(), one[s]);
    }
    return out;
  }
  const std::vector<reference::InputSide>& sides() const { return sides_; }
  const scene::TriangleMesh& mesh() const { return mesh_; }

 private:
  const scene::TriangleMesh& mesh_;
  std::vector<reference::InputSide> sides_;
};

bool holds(const std::vector<FlatSet>& a, const std::vector<FlatSet>& b) {
  for (std::size_t s = 0; s < a.size(); ++s) {
    if (!subtract(b[s], a[s]).empty()) return false;
  }
  return true;
}
bool same(const std::vector<FlatSet>& a, const std::vector<FlatSet>& b) { return holds(a, b) && holds(b, a); }

std::vector<FlatSet> without(const std::vector<FlatSet>& a, const std::vector<FlatSet>& b) {
  std::vector<FlatSet> out;
  for (std::size_t s = 0; s < a.size(); ++s) out.push_back(subtract(a[s], b[s]));
  return out;
}

struct FloodSums {
  std::uint64_t labels = 0, seeds = 0, segments = 0, leaks = 0;
};

// All seeds, all but one, all segments, all but one.
void expect_floods(const Seen& seen, const std::vector<FlatSet>& known, const std::vector<FlatSet>& wanted,
                   FloodSums& sums) {
  ASSERT_TRUE(holds(known, wanted));
  const ContourLabel label = seen.label(known, wanted);
  EXPECT_TRUE(same(seen.flooded(known, label), wanted));
  const auto components = seen.components(wanted);
  ASSERT_EQ(components.size(), label.seeds.size());
  for (std::size_t i = 0; i < label.seeds.size(); ++i) {
    ContourLabel less = label;
    less.seeds.erase(less.seeds.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_TRUE(same(seen.flooded(known, less), without(wanted, components[i]))) << "without seed " << i;
  }
  for (std::size_t i = 0; i < label.segments.size(); ++i) {
    ContourLabel less = label;
    less.segments.erase(less.segments.begin() + static_cast<std::ptrdiff_t>(i));
    const auto more = seen.flooded(known, less);
    EXPECT_TRUE(holds(more, wanted)) << "without segment " << i;
    sums.leaks += holds(wanted, more) ? 0 : 1;
  }
  ++sums.labels;
  sums.seeds += label.seeds.size();
  sums.segments += label.segments.size();
}

// Parent to child, and both rows of Table XIV within what the parent of both sees.
void expect_table_xiv(const scene::TriangleMesh& mesh, const exact::ConvexCell& parent, FloodSums& sums) {
  const auto halves = fuzz::halves_of(parent);
  if (halves.empty()) return;
  const Seen seen(mesh);
  const auto known = seen.from(parent), a = seen.from(halves[0]), b = seen.from(halves[1]);
  expect_floods(seen, known, a, sums);
  expect_floods(seen, known, without(b, a), sums);  // occluded from A, not from B
  expect_floods(seen, known, without(a, b), sums);  // occluded from B, not from A
}

TEST(Flood, FindsScenePAgainAndLosesWhatItShould) {
  FloodSums sums;
  const auto mesh = plates_and_a_box();
  expect_table_xiv(mesh, box_cell(-2, -1, -1, 2, 1, 0), sums);
  EXPECT_EQ(sums.labels, 3U);
  EXPECT_GT(sums.segments, 6U);
  EXPECT_GT(sums.leaks, 0U);
}

// What is hidden from B alone has the border of B's map on its occluded side, and that of A's on its exposed one.
TEST(Flood, BordersOfARowOfTableXIVAreThoseOfTheTwoCells) {
  const auto mesh = plates_and_a_box();
  const Seen seen(mesh);
  const auto known = seen.from(box_cell(-2, -1, -1, 2, 1, 0)), a = seen.from(box_cell(-2, -1, -1, 0, 1, 0)),
             b = seen.from(box_cell(0, -1, -1, 2, 1, 0));
  const auto of_row = seen.label(known, without(a, b)), of_a = seen.label(known, a), of_b = seen.label(known, b);
  EXPECT_FALSE(of_row.segments.empty());
  const auto lies_on = [](const reference::SideSegment& s, const ContourLabel& label) {
    const exact::Point2 middle = CGAL::midpoint(s.at.a, s.at.b);
    return std::any_of(label.segments.begin(), label.segments.end(), [&](const reference::SideSegment& t) {
      return t.side == s.side && CGAL::collinear(t.at.a, t.at.b, middle) &&
             CGAL::collinear_are_ordered_along_line(t.at.a, middle, t.at.b);
    });
  };
  std::uint64_t on_a = 0, on_b = 0;
  for (const auto& s : of_row.segments) {
    EXPECT_TRUE(lies_on(s, of_a) || lies_on(s, of_b));
    on_a += lies_on(s, of_a);
    on_b += lies_on(s, of_b);
  }
  EXPECT_GT(on_a, 0U);
  EXPECT_GT(on_b, 0U);
}

// FIG. 42B: from a small cell, what is far away is left to its parent.
TEST(Flood, WhatIsFarIsHandledByTheParent) {
  const auto mesh = plates_and_a_box();
  const Seen seen(mesh);
  const auto parent = box_cell(-2, -1, -1, 2, 1, 0), child = box_cell(-2, -1, -1, 0, 1, 0);
  const auto known = seen.from(parent), exactly = seen.from(child);
  for (const int reach : {0, 1, 3, 100}) {
    const auto wanted = reference::with_far_sides_of(seen.sides(), mesh, known, exactly, child, FT(reach));
    EXPECT_TRUE(holds(wanted, exactly));
    EXPECT_TRUE(same(seen.flooded(known, seen.label(known, wanted)), wanted));
    EXPECT_EQ(same(wanted, exactly), reach >= 3);  // the receiver is 8 above a cell of diameter 3
    EXPECT_EQ(same(wanted, known), reach < 3);
  }
}

void expect_floods_on_random_scenes(std::uint64_t first, std::uint64_t end) {
  FloodSums sums;
  for (const fuzz::Kind kind :
       {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra, fuzz::Kind::open_sheets, fuzz::Kind::interpenetrating}) {
    for (std::uint64_t i = first; i < end; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      expect_table_xiv(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), sums);
    }
  }
  std::cout << sums.labels << " labels, " << sums.seeds << " seeds, " << sums.segments << " segments, without "
            << sums.leaks << " of which more is reached\n";
  EXPECT_GT(sums.leaks, 0U);
}

TEST(Flood, EverySeedAndSegmentOfRandomScenes) { expect_floods_on_random_scenes(0, 2); }

TEST(FloodLong, EverySeedAndSegmentOfFiftyScenes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_floods_on_random_scenes(0, 13);
}

}  // namespace
}  // namespace clues::test
