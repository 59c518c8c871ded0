// The published suite: complete and well formed. That it is sharp enough to catch a wrong reference is tested in tests/planted; that its
// expectations are true is the business of `clues lint`, which runs as a test of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "first_unsound_case.h"
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

TEST(Suite, FindsNothingUnsoundInTheReference) { EXPECT_EQ(first_unsound_case(kSuite), ""); }

}  // namespace
}  // namespace clues::validate
