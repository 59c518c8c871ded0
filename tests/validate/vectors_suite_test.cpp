// The published suite: complete, well formed, and sharp enough to catch the planted bugs of the reference. That its expectations are
// true is the business of `clues lint`, which runs as a test of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "reference/visibility/first_order.h"
#include "validate/vectors/reader.h"
#include "validate/vectors/writer.h"

namespace clues::validate {
namespace {

const std::filesystem::path kSuite = std::filesystem::path(CLUES_SOURCE_DIR) / "vectors";

TEST(Suite, HoldsItsTopicsAndEnoughCases) {
  std::map<std::string, int> topics;
  for (const auto& c : read_suite(kSuite)) {
    ++topics[c.topic];
    EXPECT_GE(c.comment.size(), 20U) << c.id;
    EXPECT_LE(c.mesh.triangles.size(), c.level == CaseLevel::core ? 64U : 400U) << c.id;
  }
  int total = 0;
  for (const auto& [topic, count] : topics) {
    total += count;
    EXPECT_GE(count, 9) << topic;
  }
  EXPECT_GE(total, 300);
  EXPECT_GE(topics.size(), 19U);
}

TEST(Suite, NamesEveryHazardThatCanHideVisibleGeometry) {
  std::set<std::string> named;
  for (const auto& path : vector_files(kSuite)) {
    for (const auto& [flag, note] : read_vector_file(path).notes)
      named.insert(note.hazards.begin(), note.hazards.end());
  }
  for (const char* hazard : {"A-3",  "A-4",  "A-5",  "A-6",  "A-7",  "A-8",  "A-10", "A-12", "A-14", "A-16", "A-27",
                             "A-28", "A-30", "A-32", "B-1",  "B-2",  "B-3",  "B-5",  "B-6",  "B-7",  "B-8",  "B-9",
                             "B-10", "B-11", "B-15", "B-16", "B-17", "B-18", "B-19", "B-21", "B-27", "B-31"}) {
    EXPECT_TRUE(named.contains(hazard)) << hazard;
  }
}

TEST(Suite, EveryCaseWouldFailSomebody) {
  // Who answers "everything" must be loose somewhere and who answers "nothing" unsound nearly everywhere.
  std::size_t hidden = 0, without_visible = 0, total = 0;
  for (const auto& c : read_suite(kSuite)) {
    ++total;
    hidden += c.expect->umbra.empty() ? 0 : 1;
    without_visible += c.expect->must_be_visible.empty() ? 1 : 0;
  }
  EXPECT_GE(hidden, total / 3);
  EXPECT_LE(without_visible, 5U);
}

// The first case that exposes the bug by a visible triangle that is missing from its answer.
std::string first_unsound_case(reference::PlantedBug bug, const std::vector<std::string>& topics) {
  for (const auto& c : read_suite(kSuite)) {
    if (std::find(topics.begin(), topics.end(), c.topic) == topics.end() || c.level != CaseLevel::core) continue;
    reference::Options options;
    options.planted_bug = bug;
    options.mode = c.mode == CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet;
    std::vector<std::uint32_t> answer;
    try {
      answer = reference::first_order_visibility(c.mesh, exact::ConvexCell::from_doubles(c.cell), options).visible;
    } catch (const std::exception&) {  // a bug may also stop the reference; a wrong answer is wanted here
      continue;
    }
    for (const auto& seen : c.expect->must_be_visible) {
      if (!std::binary_search(answer.begin(), answer.end(), seen.triangle)) return c.id;
    }
  }
  return "";
}

TEST(Suite, CatchesThePlantedBugsOfTheReference) {
  using reference::PlantedBug;
  const std::vector<std::string> topics{"hazards", "grazing", "fusion", "portals", "coordinates"};
  EXPECT_EQ(first_unsound_case(PlantedBug::none, topics), "");
  for (const auto bug : {PlantedBug::wrong_wedge_side, PlantedBug::retested_csv, PlantedBug::no_rule_3,
                         PlantedBug::rounded_comparison}) {
    const auto found = first_unsound_case(bug, topics);
    EXPECT_NE(found, "") << static_cast<int>(bug);
    std::printf("planted bug %d: unsound on %s\n", static_cast<int>(bug), found.c_str());
  }
}

}  // namespace
}  // namespace clues::validate
