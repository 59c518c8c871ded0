// The cases of vectors/multires: proved, enough of them, and able to tell wrong expectations from right ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scene/messages/error.h"
#include "validate/multires/lint_multires.h"

namespace clues {
namespace {

const std::string folder = CLUES_SOURCE_DIR "/vectors/multires";

std::vector<validate::MultiresVector> suite() {
  std::vector<validate::MultiresVector> out;
  for (const auto& path : validate::side_vector_files(folder)) {
    for (auto& test : validate::read_multires_topic(path).cases) out.push_back(std::move(test));
  }
  return out;
}

TEST(MultiresSuite, IsProved) {
  EXPECT_TRUE(validate::is_multires_suite(folder));
  EXPECT_FALSE(validate::is_multires_suite(CLUES_SOURCE_DIR "/vectors/motion"));
  const auto report = validate::lint_multires_suite(folder, {});
  EXPECT_TRUE(report.findings.empty() && report.malformed.empty()) << validate::to_text(report, "maps");
  EXPECT_EQ(report.proved, report.cases);
  EXPECT_GE(report.cases, 40U);
}

TEST(MultiresSuite, HasEveryWordAndEveryCheck) {
  std::set<std::string> words, checks, verdicts;
  std::set<int> places;
  for (const auto& test : suite()) {
    if (test.facts) words.insert(test.facts->vertices.begin(), test.facts->vertices.end());
    if (test.findings) checks.insert(test.findings->begin(), test.findings->end());
    if (test.kind == validate::MultiresKind::plain) verdicts.insert(test.verdict);
    if (test.refused) places.insert(test.refused->edge ? 0 : (test.refused->vertex ? 1 : 2));
  }
  EXPECT_EQ(words.size(), 5U);
  EXPECT_EQ(checks.size(), 6U);
  EXPECT_EQ(verdicts.size(), 3U);
  EXPECT_EQ(places.size(), 3U);
}

// Planted: one expectation of each kind made wrong.
TEST(MultiresSuite, WrongExpectationsAreFound) {
  std::size_t planted = 0;
  for (auto& test : suite()) {
    if (test.facts) {
      auto wrong = test;
      ++wrong.facts->genus;
      EXPECT_FALSE(validate::flaws_of(wrong).empty()) << test.id;
      wrong = test;
      auto& word = wrong.facts->vertices[0];
      word = word == "link" ? "removable" : "link";
      EXPECT_FALSE(validate::flaws_of(wrong).empty()) << test.id;
      if (++planted > 3) break;
    }
  }
  EXPECT_GT(planted, 3U);
  for (auto& test : suite()) {
    if (test.refused && test.refused->vertex) {
      test.refused->vertex = *test.refused->vertex == 0 ? 1U : 0U;
      EXPECT_FALSE(validate::flaws_of(test).empty()) << test.id;
    } else if (test.findings) {
      test.findings = test.findings->empty() ? std::vector<std::string>{"E1"} : std::vector<std::string>{};
      EXPECT_FALSE(validate::flaws_of(test).empty()) << test.id;
    }
  }
}

// Vertex 0 of none was taken for one.
TEST(MultiresSuite, RefusesTrianglesWithoutVertices) {
  for (const char* mesh : {R"("vertices":[],"triangles":[[0,0,0]])", R"("vertices":[[0,0,0]],"triangles":[[0,0,1]])"}) {
    const std::string text =
        std::string(R"({"format":"clues-multires-vectors/1","topic":"a","cases":[{"id":"none","comment":"None.",)") +
        R"("kind":"surface",)" + mesh + "}]}";
    EXPECT_THROW(validate::parse_multires_topic(text, "a.json", true), scene::Error) << mesh;
  }
}

TEST(MultiresSuite, ReadsAndWritesItsOwnText) {
  for (const auto& path : validate::side_vector_files(folder)) {
    const auto topic = validate::read_multires_topic(path);
    const auto text = validate::to_json_text(topic);
    EXPECT_EQ(text, validate::to_json_text(validate::parse_multires_topic(text, path.string()))) << path;
  }
}

}  // namespace
}  // namespace clues
