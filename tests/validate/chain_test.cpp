// D18: chains as certificates of first-order visible. Each chain that is found was accepted by the checker; here is how many are found, and that the
// checker accepts nothing else.
#include "validate/chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "fuzz/campaign/generators.h"
#include "validate/chain_search.h"
#include "validate/judge.h"
#include "validate/vectors/reader.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Point3;
using ::testing::HasSubstr;

struct Counters {
  std::size_t scenes = 0, first_order_only = 0, with_chain = 0, longest = 0, digits = 0;
  std::string first_without;
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
  if (chains.size() < only_first_order.size()) {
    std::cout << "no chain in " << name << ": " << only_first_order.size() - chains.size() << "\n";
    if (total.first_without.empty()) total.first_without = name;
  }
}

void print(const char* what, const Counters& c) {
  std::cout << what << ": " << c.scenes << " scenes, " << c.first_order_only << " triangles only first-order visible, "
            << c.with_chain << " with a chain of at most " << c.longest << " links and " << c.digits << " digits\n";
}

TEST(Chains, OfTheSuite) {
  Counters total;
  for (const VectorCase& c : read_suite(std::filesystem::path(CLUES_SOURCE_DIR) / "vectors")) {
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
}

void random_scenes(std::uint64_t seed, std::uint64_t count) {
  Counters total;
  for (const auto& generator : fuzz::all_generators()) {
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

TEST(Chains, OfRandomScenes) { random_scenes(20261121, 4); }

}  // namespace
}  // namespace clues::validate
