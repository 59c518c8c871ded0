#include "found_and_shrunk.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <iostream>

#include "fuzz/generators/random_scenes.h"
#include "fuzz/shrinking/finding_folder.h"
#include "scene/files/temporary_folder.h"

namespace clues::fuzz {
namespace {

double cpu_seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

}  // namespace

void is_found_and_shrunk(CampaignOptions options, const Subject& subject) {
  const scene::TemporaryFolder folder;
  options.out = folder.path() / "out";
  options.errors = 1;
  options.shrink.time = std::chrono::seconds(600);  // the steps end it
  options.shrink.steps = 150;
  const double before = cpu_seconds_of_children();
  double found_after = 0;
  options.progress = [&](const std::string& stage, std::uint64_t, std::uint64_t) {
    if (stage == "findings shrunk" && found_after == 0) found_after = cpu_seconds_of_children() - before;
  };
  const CampaignSummary summary = run_campaign(options, subject);
  EXPECT_EQ(summary.exit_code(), 1);
  EXPECT_TRUE(summary.contradictions.empty()) << summary.contradictions.front();
  ASSERT_FALSE(summary.findings.empty()) << subject.name();
  EXPECT_LE(found_after, 60);
  for (const auto& f : summary.findings) {
    ASSERT_TRUE(f.folder.has_value());
    const SavedFinding saved = load_finding(options.out / *f.folder);
    EXPECT_EQ(flaw_of(saved.finding, subject), "");
    EXPECT_EQ(saved.finding.signature(), f.finding.signature());
    EXPECT_LE(saved.finding.where.mesh.triangles.size(), 12U);
    std::cout << subject.name() << ": case " << f.case_number << " after " << found_after << " s, "
              << f.finding.signature() << ", " << saved.original.where.mesh.triangles.size() << " -> "
              << saved.finding.where.mesh.triangles.size() << " triangles in " << saved.steps << " steps\n";
  }
}

void is_found_soon(const Subject& subject, std::uint64_t within) {
  CampaignOptions options;
  options.seed = 7;
  options.cases = within;
  for (const Kind kind : all_kinds) options.generators.emplace_back(name_of(kind));
  is_found_and_shrunk(options, subject);
}

}  // namespace clues::fuzz
