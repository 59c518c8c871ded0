// The cases of vectors/motion: proved, enough of them, and able to tell wrong programs from right ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "exact/motion/compare_bounds.h"
#include "reference/motion/mesh.h"
#include "scene/messages/error.h"
#include "validate/motion/lint_motion.h"
#include "validate/motion/mesh_places.h"
#include "validate/motion/motion_conform.h"

namespace clues {
namespace {

using validate::MotionGrade;
using validate::MotionVector;

const std::vector<MotionVector>& suite() {
  static const auto cases = validate::read_motion_suite(CLUES_SOURCE_DIR "/vectors/motion");
  return cases;
}

const std::vector<double>& reference_bounds(const MotionVector& test) {
  static std::map<std::string, std::vector<double>> known;
  auto& bounds = known[test.id];
  if (bounds.empty()) {
    bounds = reference::motion_bounds(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
  }
  return bounds;
}

TEST(MotionSuite, IsProved) {
  EXPECT_TRUE(validate::is_motion_suite(CLUES_SOURCE_DIR "/vectors/motion"));
  EXPECT_FALSE(validate::is_motion_suite(CLUES_SOURCE_DIR "/vectors"));
  const auto report = validate::lint_motion_suite(CLUES_SOURCE_DIR "/vectors/motion", {});
  EXPECT_TRUE(report.findings.empty() && report.malformed.empty()) << validate::to_text(report, "motion");
  EXPECT_EQ(report.proved, report.cases);
  EXPECT_GE(report.cases, 40U);
}

TEST(MotionSuite, TakesEveryBranchAndEveryConstraint) {
  std::set<exact::EdgeBranch> branches;
  std::set<scene::MotionConstraint> violated;
  for (const auto& test : suite()) {
    const exact::ExactThresholds thresholds(test.thresholds);
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const auto& t = test.mesh.triangles[0];
    branches.insert(exact::edge_branch(test.mesh.samples[t[0]], test.mesh.samples[t[1]], v, thresholds));
    for (const auto& place : test.violated) violated.insert(place.constraint);
  }
  EXPECT_EQ(branches.size(), 6U);
  EXPECT_EQ(violated.size(), 4U);
}

// Grades of a program that answers with f(bound of the reference).
template <class Change>
std::uint64_t unsound_cases(const Change& change) {
  std::uint64_t out = 0;
  for (const auto& test : suite()) {
    auto bounds = reference_bounds(test);
    for (double& bound : bounds) bound = change(bound);
    out += validate::graded(test, bounds).grade == MotionGrade::unsound ? 1U : 0U;
  }
  return out;
}

TEST(MotionSuite, TellsWrongProgramsFromRightOnes) {
  EXPECT_EQ(unsound_cases([](double bound) { return bound; }), 0U);
  EXPECT_EQ(unsound_cases([](double) { return 0.0; }), 0U);
  EXPECT_GT(unsound_cases([](double) { return std::numeric_limits<double>::infinity(); }), suite().size() * 9 / 10);
  // A little beyond what is exact.
  EXPECT_GT(unsound_cases([](double bound) { return bound * (1 + 1e-12); }), 15U);
  // Where nothing is left, a little.
  EXPECT_GT(unsound_cases([](double bound) { return std::max(bound, 1e-9); }), 20U);
}

TEST(MotionSuite, ReadsAndWritesItsOwnText) {
  for (const auto& path : validate::side_vector_files(CLUES_SOURCE_DIR "/vectors/motion")) {
    const auto topic = validate::read_motion_topic(path);
    const auto text = validate::to_json_text(topic);
    EXPECT_EQ(text, validate::to_json_text(validate::parse_motion_topic(text, path.string()))) << path;
  }
}

TEST(MotionSuite, RefusesDelaunayCasesWhereNothingSaysWhatIsAcross) {
  validate::MotionTopic topic;
  topic.topic = "tangled";
  topic.cases.push_back(suite().front());
  auto& test = topic.cases.front();
  test.mesh = {{{{1, 0, 3}}, {{0, 1, 3}}, {{-1, 0, 3}}, {{0, -1, 3}}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 3}}};
  test.has_expectation = false;
  test.thresholds.delaunay = false;
  EXPECT_EQ(validate::parse_motion_topic(validate::to_json_text(topic), "tangled", true).cases.size(), 1U);
  test.thresholds.delaunay = true;
  EXPECT_THROW(validate::parse_motion_topic(validate::to_json_text(topic), "tangled", true), scene::Error);
}

// Planted: expectations that are wrong in one way each.
TEST(MotionSuite, WrongExpectationsAreFound) {
  const auto& all = suite();
  const auto find = [&](const char* id) {
    return *std::find_if(all.begin(), all.end(), [&](const MotionVector& test) { return test.id == id; });
  };
  auto test = find("edge-tube-beside-its-centre");
  EXPECT_TRUE(validate::flaws_of(test).empty());
  test.exact[0].square = "25/63";
  EXPECT_EQ(validate::flaws_of(test).size(), 1U);
  test = find("facing-plane-at-distance-three");
  test.sound[0] = test.unsound[0];
  EXPECT_FALSE(validate::flaws_of(test).empty());
  test.sound[0] = 2.5;  // the reference claims more
  EXPECT_FALSE(validate::flaws_of(test).empty());
  test = find("facing-plane-at-distance-three");
  test.unsound[0] = test.sound[0];
  EXPECT_FALSE(validate::flaws_of(test).empty());
  test = find("delaunay-flip");
  test.violated.pop_back();
  EXPECT_FALSE(validate::flaws_of(test).empty());
}

TEST(MotionProtocol, AnswersGoThereAndBack) {
  std::string questions;
  for (const auto& test : suite()) questions += validate::question_of(test) + "\n";
  std::istringstream in(questions);
  std::ostringstream out;
  validate::answer_motion_questions(in, out);
  std::istringstream answers(out.str());
  std::string line;
  for (const auto& test : suite()) {
    ASSERT_TRUE(std::getline(answers, line));
    EXPECT_EQ(validate::parse_motion_answer(line, test), reference_bounds(test)) << test.id;
  }
  EXPECT_FALSE(std::getline(answers, line));
}

TEST(MotionProtocol, AnswersThatAreNoneAreRefused) {
  const auto& test = suite().front();
  const std::string begin = R"({"format": "clues-motion-answer/1", "case": ")" + test.id + R"(", "bounds": )";
  EXPECT_THROW(validate::parse_motion_answer("", test), scene::Error);
  EXPECT_THROW(validate::parse_motion_answer("[]", test), scene::Error);
  EXPECT_THROW(validate::parse_motion_answer(begin + "[]}", test), scene::Error);
  EXPECT_THROW(validate::parse_motion_answer(begin + "[-1, 1]}", test), scene::Error);
  EXPECT_THROW(validate::parse_motion_answer(begin + "[1, 1, 1]}", test), scene::Error);
  EXPECT_THROW(
      validate::parse_motion_answer(R"({"format": "clues-motion-answer/1", "case": "other", "bounds": [1, 1]})", test),
      scene::Error);
}

}  // namespace
}  // namespace clues
