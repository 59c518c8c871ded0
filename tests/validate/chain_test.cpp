// D18: chains as certificates of first-order visible. Each chain that is found was accepted by the checker; here is how many are found, and that the
// checker accepts nothing else.
#include "validate/certificates/chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>

#include "fuzz/campaign/generators.h"
#include "validate/certificates/chain_search.h"
#include "validate/vectors/reader.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Point3;
using ::testing::HasSubstr;

struct Counters {
  std::size_t scenes = 0, first_order_only = 0, with_chain = 0, longest = 0, digits = 0;
};

void examine(const std::string& name, const scene::TriangleMesh& mesh, const reference::VisibilityMap& map,
             const std::vector<std::uint32_t>& only_first_order, Counters& total) {
  const std::vector<Chain> chains = find_chains(mesh, map, only_first_order);
  ++total.scenes;
  total.first_order_only += only_first_order.size();
  total.with_chain += chains.size();
  for (const Chain& chain : chains) {
    total.longest = std::max(total.longest, chain.links.size());
    for (const ChainLink& link : chain.links)
      total.digits = std::max(total.digits, exact::to_string_exact(link.x.x()).size());
    EXPECT_TRUE(check_chain(mesh, map.cell, chain).valid) << name;
    EXPECT_GE(chain.links.size(), 2U) << name << ": triangle " << chain.triangle << " is visible";
  }
  if (chains.size() < only_first_order.size())
    std::cout << "no chain in " << name << ": " << only_first_order.size() - chains.size() << "\n";
}

void print(const char* what, const Counters& c) {
  std::cout << what << ": " << c.scenes << " scenes, " << c.first_order_only << " triangles only first-order visible, "
            << c.with_chain << " with a chain of at most " << c.longest << " links and " << c.digits << " digits\n";
}

TEST(Chains, OfTheSuite) {
  Counters total;
  for (const VectorCase& c : read_suite(std::filesystem::path(CLUES_SOURCE_DIR) / "vectors")) {
    if (!c.is_plain()) continue;
    std::vector<std::uint32_t> rest;
    for (const Umbra& u : c.expect->umbra) {
      if (u.proof == UmbraProof::exhaustive) rest.push_back(u.triangle);
    }
    if (rest.empty()) continue;
    reference::Options options;
    options.mode = c.mode == CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet;
    const auto map = reference::first_order_visibility(c.mesh, ConvexCell::from_doubles(c.cell), options);
    examine(c.id, c.mesh, map, rest, total);
  }
  print("suite", total);
  EXPECT_GE(total.with_chain, 13U);
  EXPECT_GE(total.longest, 3U);
}

void random_scenes(std::uint64_t seed, std::uint64_t count) {
  Counters total;
  const fuzz::GivenScenes none;
  for (const auto& generator : fuzz::generators_named({}, none)) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const fuzz::Case scene = generator.make(seed, i);
      if (scene.mesh.triangles.size() > 40) continue;
      const auto map = reference::first_order_visibility(scene.mesh, ConvexCell::from_doubles(scene.cell), {});
      const Judgement judged = judge_pvs(scene.mesh, map, map.visible);
      std::vector<std::uint32_t> rest;
      for (const std::uint32_t t : map.visible) {
        if (judged.triangles[t] == TriangleVerdict::first_order) rest.push_back(t);
      }
      examine(generator.name + " " + std::to_string(seed) + " " + std::to_string(i), scene.mesh, map, rest, total);
    }
  }
  print("random", total);
}

TEST(Chains, OfRandomScenes) { random_scenes(20261121, 1); }

TEST(ChainsLong, OfRandomScenes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  random_scenes(20261121, 20);
}

// Two walls between the cell, |x| <= 1, and a target at x = 9. From (0,0,0) past the first wall's edge to (4,2,0), from there, on the ray from (-1/2,1/8,0), past the second wall
// to the target.
struct Walls {
  scene::TriangleMesh mesh;
  ConvexCell cell = ConvexCell::from_doubles(
      {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}});
  Chain chain{2, true, {{Point3(0, 0, 0), Point3(4, 2, 0)}, {Point3(FT(-1) / 2, FT(1) / 8, 0), {}}}};
  Walls() {
    mesh.points = {{2, -8, -8}, {2, -8, 8}, {2, .75, 0}, {6, 4, -8}, {6, 4, 8},
                   {6, 9, 0},   {9, 3, 0},  {9, 5, -1},  {9, 5, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 8, 7}};
    mesh.face_of = {0, 1, 2};
    const Point3 &v = chain.links[1].v, &x = chain.links[0].x;
    chain.links[1].x = v + (FT(9) - v.x()) / (x.x() - v.x()) * (x - v);
  }
  std::string reason() const { return check_chain(mesh, cell, chain).reason; }
};

TEST(ChainChecker, AcceptsAChain) { EXPECT_EQ(Walls().reason(), ""); }

TEST(ChainChecker, ASightLineIsAChainOfOneLink) {
  Walls w;
  w.chain = {0, true, {{Point3(0, 0, 0), Point3(2, -2, 0)}}};
  EXPECT_EQ(w.reason(), "");
  w.chain.front = false;
  EXPECT_THAT(w.reason(), HasSubstr("link 0: v is not strictly on the back side"));
}

// D6: the first point has to be seen from an open part of int V.
TEST(ChainChecker, TheFirstViewpointOnAFlatCellIsOnNoTriangle) {
  Walls w;
  w.cell = ConvexCell::from_doubles({{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}});
  w.chain = {0, true, {{Point3(0, 0, 0), Point3(2, -2, 0)}}};
  EXPECT_EQ(w.reason(), "");
  w.mesh.points.insert(w.mesh.points.end(), {{0, 0, 0}, {-1, 1, 0}, {-1, -1, 0}});
  w.mesh.triangles.push_back({9, 10, 11});
  EXPECT_EQ(w.reason(), "link 0: v lies on triangle 3: choose another viewpoint");
}

TEST(ChainChecker, RefusesEveryBrokenChain) {
  const auto refused = [](const std::function<void(Walls&)>& spoil, const char* because) {
    Walls w;
    spoil(w);
    EXPECT_THAT(w.reason(), HasSubstr(because));
  };
  refused([](Walls& w) { w.chain.links.clear(); }, "the chain has no link");
  refused([](Walls& w) { w.chain.triangle = 3; }, "link 1: there is no triangle 3");
  refused([](Walls& w) { w.chain.front = false; }, "link 1: the point before is not strictly on the back side");
  refused([](Walls& w) { w.chain.links[0].v = Point3(1, 0, 0); }, "link 0: v is not in the relative interior");
  refused([](Walls& w) { w.chain.links[1].v = Point3(-2, 0, 0); }, "link 1: v is not in the relative interior");
  refused([](Walls& w) { w.chain.links[0].x = Point3(4, 1, 0); }, "link 0: triangle 0 blocks");
  refused([](Walls& w) { w.chain.links[0].x = Point3(FT(1) / 2, 0, 0); }, "link 0: x is in the cell");
  refused([](Walls& w) { w.chain.links[1].v = Point3(0, 0, 0); },
          "link 1: v, the point before and x are not on one line");
  refused([](Walls& w) { w.chain.links[1].x = Point3(9, 8, 0); }, "link 1: p is not in the relative interior");
  refused([](Walls& w) { std::swap(w.chain.links[0].x, w.chain.links[1].x); },
          "link 1: p is not in the relative interior");
  refused(
      [](Walls& w) {  // the surface that is touched by the way, here in the point before, blocks
        w.mesh.points.insert(w.mesh.points.end(), {{4, 2, 0}, {4, 9, 1}, {4, 9, -1}});
        w.mesh.triangles.push_back({9, 10, 11});
      },
      "link 1: triangle 3 blocks");
  refused(
      [](Walls& w) {  // the way on is blocked
        w.mesh.points.insert(w.mesh.points.end(), {{5, 0, -9}, {5, 0, 9}, {5, 9, 0}});
        w.mesh.triangles.push_back({9, 10, 11});
      },
      "link 1: triangle 3 blocks");
  refused(
      [](Walls& w) {  // what lies beyond the point before, back towards the cell, does not count for a continuation
        w.chain.links[1].x = w.chain.links[0].x + FT(-1) / 8 * (w.chain.links[0].x - w.chain.links[1].v);
      },
      "link 1: p is not in the relative interior");
}

}  // namespace
}  // namespace clues::validate
