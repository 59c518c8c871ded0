// Tests of the fuzzer itself: each planted defect is found within a fixed number of cases and shrunk; a campaign that is interrupted, continued or run by more jobs finds
// the same; what was saved is verified again, and refused when it was changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "fuzz/campaign/campaign.h"
#include "fuzz/generators/random_scenes.h"
#include "fuzz/shrinking/finding_folder.h"
#include "planted_subjects.h"
#include "scene/files/temporary_folder.h"
#include "scene/messages/error.h"
#include "tests/read_all.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;

// All that a campaign left: findings as stored, every file of every finding, and the store, byte for byte.
std::string left_by(const fs::path& out, const CampaignSummary& summary) {
  std::string all = std::to_string(summary.cases);
  for (const auto& [name, value] : summary.counters) all += "\n" + name + " " + std::to_string(value);
  for (const auto& f : summary.findings) {
    all += "\n" + std::to_string(f.id) + " " + std::to_string(f.case_number) + " " + std::to_string(f.occurrences) +
           " " + to_json_text(f.finding) + " " + f.folder.value_or("none");
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) all += "\n" + fs::relative(file, out).string() + "\n" + tests::read_all(file);
  return all;
}

CampaignOptions options_for(const fs::path& out, std::uint64_t cases) {
  CampaignOptions options;
  options.seed = 7;
  options.cases = cases;
  options.out = out;
  for (const Kind kind : all_kinds) options.generators.emplace_back(name_of(kind));
  options.shrink.time = std::chrono::seconds(600);  // the steps end it
  options.shrink.steps = 150;
  return options;
}

TEST(Campaign, OneJobAndTwoLeaveTheSame) {
  const scene::TemporaryFolder folder;
  std::string left[2];
  for (int jobs = 1; jobs <= 2; ++jobs) {
    auto options = options_for(folder.path() / std::to_string(jobs), 14);
    options.jobs = jobs;
    options.shrink.steps = 30;
    left[jobs - 1] = left_by(options.out, run_campaign(options, FromTheCentre()));
  }
  EXPECT_EQ(left[0], left[1]);
  EXPECT_NE(left[0].find("finding.json"), std::string::npos);
}

TEST(Campaign, ShardsMergedAreTheWhole) {
  const scene::TemporaryFolder folder;
  auto whole = options_for(folder.path() / "whole", 10);
  whole.shrink.steps = 3;
  const std::string expected = left_by(whole.out, run_campaign(whole, FromTheCentre()));
  for (const std::uint64_t shards : {1, 2, 3, 4}) {
    SCOPED_TRACE(shards);
    auto all = whole;
    all.out = folder.path() / ("merged" + std::to_string(shards));
    std::uint64_t cases = 0;
    for (std::uint64_t i = 0; i < shards; ++i) {
      auto shard = options_for(folder.path() / (std::to_string(i) + "of" + std::to_string(shards)), 7);
      shard.shard = i;
      shard.shards = shards;
      shard.block = 2;
      run_campaign(shard, FromTheCentre());
      shard.cases = 10;  // gone on with
      cases += run_campaign(shard, FromTheCentre()).cases;
      all.merged.insert(all.merged.begin(), shard.out);
    }
    EXPECT_EQ(cases, 10U);
    EXPECT_EQ(left_by(all.out, run_campaign(all, FromTheCentre())), expected);
    if (shards == 2) {
      EXPECT_EQ(left_by(all.out, run_campaign(all, FromTheCentre())), expected) << "the same command again";
    }
  }
}

TEST(Campaign, ShardsThatAreNotAllOrNotDoneAreRefused) {
  const scene::TemporaryFolder folder;
  const auto shard = [&](const std::string& name, std::uint64_t index, std::uint64_t cases) {
    auto options = options_for(folder.path() / name, cases);
    options.shard = index;
    options.shards = 2;
    run_campaign(options, HidesOneTriangle());
    return options.out;
  };
  const auto first = shard("first", 0, 2), second = shard("second", 1, 2), further = shard("further", 1, 4);
  const auto why_not = [&](std::vector<fs::path> merged) -> std::string {
    auto options = options_for(folder.path() / "all", 2);
    options.merged = std::move(merged);
    try {
      run_campaign(options, HidesOneTriangle());
    } catch (const scene::Error& error) {
      EXPECT_FALSE(fs::exists(options.out / "findings.sqlite"));
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why_not({first}).find("no shard of 1 of this campaign"), std::string::npos);
  EXPECT_NE(why_not({first, first}).find("a shard that was named already"), std::string::npos);
  EXPECT_NE(why_not({first, further}).find("repeat their commands with the same --cases"), std::string::npos);
  EXPECT_NE(why_not({first, folder.path() / "none"}).find("no such file"), std::string::npos);
  EXPECT_EQ(why_not({second, first}), "");
}

// Kills the campaign (and with it its workers) the moment `progress` has been called `calls` times; no time is involved.
void run_and_be_killed(CampaignOptions options, int calls) {
  const pid_t pid = fork();
  ASSERT_GE(pid, 0);
  if (pid == 0) {
    options.progress = [calls, n = 0](const std::string&, std::uint64_t, std::uint64_t) mutable {
      if (++n == calls) raise(SIGKILL);
    };
    try {
      run_campaign(options, FromTheCentre());
    } catch (...) {
    }
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(pid, &status, 0), pid);
  EXPECT_TRUE(WIFSIGNALED(status));
}

TEST(Campaign, GoesOnAfterKillAsIfNothingHadHappened) {
  const scene::TemporaryFolder folder;
  auto whole = options_for(folder.path() / "whole", 14);
  whole.block = 3;
  whole.shrink.steps = 30;
  const std::string expected = left_by(whole.out, run_campaign(whole, FromTheCentre()));
  auto parts = whole;
  parts.out = folder.path() / "parts";
  parts.jobs = 2;
  run_and_be_killed(parts, 5);  // among the cases
  run_and_be_killed(parts, 4);
  run_and_be_killed(parts, 7);
  EXPECT_EQ(left_by(parts.out, run_campaign(parts, FromTheCentre())), expected);
}

TEST(Campaign, StopsWhenAskedAndGoesOn) {
  const scene::TemporaryFolder folder;
  auto options = options_for(folder.path() / "out", 12);
  options.shrink.steps = 30;
  std::atomic<bool> stop{false};
  options.stop = &stop;
  options.progress = [&](const std::string&, std::uint64_t, std::uint64_t) { stop = true; };
  const CampaignSummary first = run_campaign(options, FromTheCentre());
  EXPECT_TRUE(first.interrupted);
  EXPECT_LT(first.cases, 12U);
  options.stop = nullptr;
  options.progress = nullptr;
  const CampaignSummary second = run_campaign(options, FromTheCentre());
  EXPECT_EQ(second.cases, 12U);
  EXPECT_EQ(second.cases_now, 12U - first.cases);
}

TEST(Campaign, AnotherPlanIsRefused) {
  const scene::TemporaryFolder folder;
  auto options = options_for(folder.path() / "out", 1);
  options.generators = {"loose_triangles"};
  run_campaign(options, HidesOneTriangle());
  options.seed = 8;
  EXPECT_THROW(run_campaign(options, HidesOneTriangle()), scene::Error);
  options.generators = {"no_such_generator"};
  EXPECT_THROW(run_campaign(options, HidesOneTriangle()), scene::Error);
}

TEST(Campaign, WhatNeverOccurredIsSaid) {
  const scene::TemporaryFolder folder;
  auto options = options_for(folder.path() / "out", 1);  // five generators of six never come
  const auto subject = make_subject("reference");
  options.require_coverage = true;
  const CampaignSummary summary = run_campaign(options, *subject);
  EXPECT_EQ(summary.exit_code(), 3);
  EXPECT_FALSE(summary.never_occurred.empty());
}

TEST(Campaign, IsJudgedByWhatNeverOccurredOnceItIsLongEnough) {
  CampaignSummary summary;
  summary.generators = 25;
  summary.enough = 100;
  summary.cases = summary.cases_now = 24;
  summary.seconds_now = 55;
  summary.never_occurred = {"wedges SE-ME"};
  EXPECT_EQ(summary.exit_code(), 0);
  EXPECT_EQ(to_text(summary, "out"),
            "24 cases of 25 generators' 100; nothing found yet; run 3 min or more to be told what was covered\n");
  summary.cases_now = 0;
  summary.findings.resize(1);
  EXPECT_EQ(summary.exit_code(), 1);
  EXPECT_THAT(to_text(summary, "out"),
              testing::EndsWith(
                  "24 cases of 25 generators' 100; 1 finding; go on to --cases 100 to be told what was covered\n"));
  summary.findings.clear();
  summary.interrupted = true;
  EXPECT_EQ(summary.exit_code(), 3);
  EXPECT_THAT(to_text(summary, "out"), testing::EndsWith("; interrupted: the same command goes on\n"));
  summary.interrupted = false;
  summary.judged = true;
  EXPECT_EQ(summary.exit_code(), 3);
  EXPECT_THAT(to_text(summary, "out"), testing::HasSubstr("NEVER OCCURRED: wedges SE-ME\n"));
  summary.never_occurred.clear();
  EXPECT_EQ(summary.exit_code(), 0);
}

class Crashes : public Subject {
 public:
  Answer answer(const Case&) const override {
    raise(SIGKILL);
    return {};
  }
  std::string name() const override { return "crashes"; }
};

TEST(Campaign, ACrashIsAFindingAndNotTheEnd) {
  const scene::TemporaryFolder folder;
  auto options = options_for(folder.path() / "out", 4);
  const CampaignSummary summary = run_campaign(options, Crashes());
  EXPECT_EQ(summary.cases, 4U);
  ASSERT_EQ(summary.findings.size(), 4U);
  EXPECT_EQ(summary.findings[0].finding.verdict, "crash/answer");
}

// A program that writes an empty PVS is found out; one that fails gives no answer.
TEST(Campaign, ProgramsAreAskedThroughFiles) {
  const scene::TemporaryFolder folder;
  auto options = options_for(folder.path() / "hides", 1);
  options.shrink.steps = 20;
  const auto hides = make_subject("sh -c 'test -s {scene} && test -s {cell} && : > {pvs}'");
  const CampaignSummary hidden = run_campaign(options, *hides);
  ASSERT_FALSE(hidden.findings.empty());
  EXPECT_EQ(hidden.findings[0].finding.verdict, "hidden/visible");
  options.out = folder.path() / "fails";
  const auto fails = make_subject("false");
  const CampaignSummary failed = run_campaign(options, *fails);
  ASSERT_EQ(failed.findings.size(), 1U);
  EXPECT_EQ(failed.findings[0].finding.verdict, "no-answer/answer");
}

class AFinding : public testing::Test {
 protected:
  void SetUp() override {
    auto options = options_for(folder_.path() / "out", 1);
    options.errors = 1;
    options.oracles = {"sight-lines"};
    const CampaignSummary summary = run_campaign(options, EverythingHidden());
    ASSERT_EQ(summary.findings.size(), 1U);
    saved_ = options.out / summary.findings[0].folder.value();
  }
  void change(const fs::path& file, const std::string& from, const std::string& to) const {
    std::string text = tests::read_all(file);
    const auto at = text.find(from);
    ASSERT_NE(at, text.npos);
    std::ofstream(file, std::ios::binary) << text.replace(at, from.size(), to);
  }
  scene::TemporaryFolder folder_;
  fs::path saved_;
};

TEST_F(AFinding, IsRefusedWhenItsFilesWereChanged) {
  for (const char* file : {"scene.off", "cell.obj", "witness.json", "original/scene.off", "original/witness.json"}) {
    const std::string before = tests::read_all(saved_ / file);
    std::ofstream(saved_ / file, std::ios::binary) << before << "\n";
    EXPECT_THROW(load_finding(saved_), scene::Error) << file;
    std::ofstream(saved_ / file, std::ios::binary) << before;
    EXPECT_EQ(flaw_of(load_finding(saved_).finding, EverythingHidden()), "");
  }
  change(saved_ / "finding.json", "\"format\": \"clues", "\"format\": \"blues");
  EXPECT_THROW(load_finding(saved_), scene::Error);
}

TEST_F(AFinding, DoesNotReplayWithAWitnessThatIsNone) {
  Finding f = load_finding(saved_).finding;
  ASSERT_TRUE(f.witness.has_value());
  std::swap(f.witness->v, f.witness->p);
  EXPECT_NE(flaw_of(f, EverythingHidden()), "");
}

class EverythingVisible : public Subject {
 public:
  Answer answer(const Case& scene) const override {
    Answer out;
    for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) out.pvs.push_back(t);
    return out;
  }
  std::string name() const override { return "everything-visible"; }
};

TEST_F(AFinding, DoesNotReplayOnASoundSubject) {
  EXPECT_NE(flaw_of(load_finding(saved_).finding, EverythingVisible()), "");
}

TEST_F(AFinding, ShrinksToTheSameEveryTime) {
  const SavedFinding saved = load_finding(saved_);
  ShrinkLimits limits{80, std::chrono::seconds(600)};
  const Shrunk once = shrink(saved.original, EverythingHidden(), limits),
               twice = shrink(saved.original, EverythingHidden(), limits);
  EXPECT_EQ(to_json_text(once.finding), to_json_text(twice.finding));
  EXPECT_EQ(once.finding.signature(), saved.original.signature());
  EXPECT_LE(once.steps, 80U);
}

}  // namespace
}  // namespace clues::fuzz
