// Campaigns that choose their cases: what still finds new pairs of rules comes more often, the rest by turns, and the order depends on nothing but what came of the cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/pair_seeker.h"
#include "fuzz/findings/store_content.h"
#include "scene/files/temporary_folder.h"
#include "scene/messages/error.h"
#include "tests/read_all.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t three = 3, arms = 8 * three;  // generators; with their strengths

CaseDials no_dials(std::uint64_t) { return {}; }
Counters pair_named(std::uint64_t number) { return {{"pair A + " + std::to_string(number), 1}}; }

// The numbers of so many rounds of cases, each told as it comes.
std::vector<std::uint64_t> rounds(std::uint64_t count, const PairSeeker::DialsOf& dials_of,
                                  const std::function<Counters(std::uint64_t)>& outcome) {
  PairSeeker seeker(three, dials_of);
  std::vector<std::uint64_t> numbers;
  while (numbers.size() < count * seeker.round()) {
    numbers.push_back(seeker.number(numbers.size()));
    seeker.tell(outcome(numbers.back()));
  }
  return numbers;
}

TEST(PairSeeker, NoCaseComesTwiceAndAllComeByTurnsWhereNothingIsFound) {
  const auto numbers = rounds(40, no_dials, [](std::uint64_t) { return Counters{}; });
  EXPECT_EQ(std::set(numbers.begin(), numbers.end()).size(), numbers.size());
  for (std::uint64_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], i);
}

TEST(PairSeeker, PrefersTheGeneratorAndStrengthThatFind) {
  // Generator 2 at strength 5.
  const auto finds = [](std::uint64_t number) { return number % arms == 5 * three + 2; };
  const auto numbers =
      rounds(40, no_dials, [&](std::uint64_t number) { return finds(number) ? pair_named(number) : Counters{}; });
  const auto many = std::count_if(numbers.begin(), numbers.end(), finds);
  EXPECT_GT(many, static_cast<std::ptrdiff_t>(numbers.size() / 2)) << "one in 24 in the usual order";
  std::set<std::uint64_t> others;
  for (const auto n : numbers) others.insert(n % arms);
  EXPECT_EQ(others.size(), arms) << "none is left out";
}

// The first cases of a campaign meet most pairs, whatever they are: that says nothing of strengths that had none yet.
TEST(PairSeeker, EachGeneratorAndStrengthHasACaseBeforeAnyIsPreferred) {
  const auto numbers = rounds(8, no_dials, pair_named);
  std::set<std::uint64_t> first;
  for (std::size_t i = 0; i < arms; ++i) first.insert(numbers[i] % arms);
  EXPECT_EQ(first.size(), arms);
}

TEST(PairSeeker, GoesBackToTurnsWhereNothingMoreIsFound) {
  // The first eight cases of generator 0 find something, and those after them the same again.
  const auto numbers = rounds(400, no_dials, [](std::uint64_t number) {
    return number % three == 0 ? pair_named(std::min<std::uint64_t>(number, 24)) : Counters{};
  });
  std::map<std::uint64_t, int> late;
  for (std::size_t i = numbers.size() - 10 * arms; i < numbers.size(); ++i) ++late[numbers[i] % arms];
  const auto [least, most] =
      std::minmax_element(late.begin(), late.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  EXPECT_EQ(late.size(), arms);
  EXPECT_LE(most->second - least->second, 3);
}

TEST(PairSeeker, PrefersTheDialThatFinds) {
  const auto dials_of = [](std::uint64_t number) {
    return number % 7 == 0 ? CaseDials{{"csv_limit", 2}} : number % 2 == 0 ? CaseDials{{"batch", 1}} : CaseDials{};
  };
  const auto finds = [](std::uint64_t number) { return number % 7 == 0; };
  const auto numbers =
      rounds(40, dials_of, [&](std::uint64_t number) { return finds(number) ? pair_named(number) : Counters{}; });
  EXPECT_GT(std::count_if(numbers.begin(), numbers.end(), finds), static_cast<std::ptrdiff_t>(numbers.size() / 5))
      << "one in seven in the usual order";
}

TEST(PairSeeker, TellsACaseLateAndHasTheSameOrder) {
  const auto outcome = [](std::uint64_t number) { return number % 5 == 0 ? pair_named(number) : Counters{}; };
  const auto at_once = rounds(9, no_dials, outcome);
  PairSeeker late(three, no_dials);
  std::vector<std::uint64_t> numbers;
  std::uint64_t told = 0;
  while (numbers.size() < at_once.size()) {
    while (late.knows(numbers.size())) numbers.push_back(late.number(numbers.size()));
    EXPECT_GT(numbers.size(), told + late.round()) << "more than a round can be worked on";
    late.tell(outcome(numbers[told++]));
  }
  numbers.resize(at_once.size());
  EXPECT_EQ(numbers, at_once);
}

TEST(PairSeeker, GoesOnWhereItEndedAndRefusesAnotherOrder) {
  const auto outcome = [](std::uint64_t number) { return number % 5 < 2 ? pair_named(number / 2) : Counters{}; };
  const auto whole = rounds(12, no_dials, outcome);
  for (const std::size_t before : {std::size_t{0}, std::size_t{1}, std::size_t{6}, std::size_t{31}}) {
    PairSeeker first(three, no_dials);
    std::vector<SoughtCase> known;
    Counters counters;
    for (std::size_t i = 0; i < before; ++i) {
      const auto number = first.number(i);
      known.push_back({number, first.tell(outcome(number))});
      for (const auto& [name, value] : outcome(number)) counters[name] += value;
    }
    PairSeeker second(three, no_dials);
    second.resume(known, counters);
    for (std::size_t i = before; i < whole.size(); ++i) {
      ASSERT_EQ(second.number(i), whole[i]);
      second.tell(outcome(whole[i]));
    }
    if (known.empty()) continue;
    known.back().number += 1000;
    EXPECT_THROW(PairSeeker(three, no_dials).resume(known, counters), scene::Error);
  }
}

CampaignOptions seeking(const fs::path& out, std::uint64_t cases) {
  CampaignOptions options;
  options.seed = 7;
  options.cases = cases;
  options.out = out;
  options.seek_pairs = true;
  options.dials = true;
  options.block = 2;
  options.generators = {"rim_fans", "cell_contacts", "flat_cells"};
  options.oracles = {"cell-contact"};
  return options;
}

TEST(PairSeeker, CampaignsOfOneJobAndTwoAndInPartsLeaveTheSame) {
  const scene::TemporaryFolder folder;
  const auto reference = make_subject("reference");
  auto one = seeking(folder.path() / "one", 20);
  const auto summary = run_campaign(one, *reference);
  EXPECT_EQ(summary.cases, 20U);
  auto two = seeking(folder.path() / "two", 20);
  two.jobs = 2;
  run_campaign(two, *reference);
  auto parts = seeking(folder.path() / "parts", 0);
  for (const std::uint64_t cases : {3, 14, 20}) {
    parts.cases = cases;
    EXPECT_EQ(run_campaign(parts, *reference).cases, cases);
  }
  const std::string expected = tests::read_all(one.out / "findings.sqlite");
  EXPECT_EQ(tests::read_all(two.out / "findings.sqlite"), expected);
  EXPECT_EQ(tests::read_all(parts.out / "findings.sqlite"), expected);
  const auto sought = read_store(one.out / "findings.sqlite").sought;
  ASSERT_EQ(sought.size(), 20U);
  std::uint64_t found = 0, pairs = 0;
  for (const auto& c : sought) found += c.new_pairs;
  for (const auto& [name, value] : summary.counters) pairs += name.starts_with("pair ") ? 1 : 0;
  EXPECT_EQ(found, pairs) << "each pair has a case that was the first";
}

TEST(PairSeeker, RefusesShardsAndSubjectsWithoutMapsBeforeAnythingIsMade) {
  const scene::TemporaryFolder folder;
  const auto why_not = [&](CampaignOptions options, const char* subject) -> std::string {
    try {
      run_campaign(options, *make_subject(subject));
    } catch (const scene::Error& error) {
      EXPECT_FALSE(fs::exists(options.out));
      return error.what();
    }
    return "";
  };
  auto shard = seeking(folder.path() / "shard", 4);
  shard.shards = 2;
  EXPECT_NE(why_not(shard, "reference").find("--seek-pairs: which case comes next depends on all"), std::string::npos);
  auto trial = seeking(folder.path() / "trial", 4);
  trial.generators.clear();
  trial.oracles.clear();
  EXPECT_NE(why_not(trial, "maps").find("--seek-pairs: no map says which rules"), std::string::npos);
  auto few = seeking(folder.path() / "few", 4);
  EXPECT_NE(why_not(few, "fast/16").find("leave out --agreement"), std::string::npos);
  // A campaign in the usual order is another one.
  auto usual = seeking(folder.path() / "usual", 4);
  usual.seek_pairs = false;
  run_campaign(usual, *make_subject("reference"));
  usual.seek_pairs = true;
  EXPECT_THROW(run_campaign(usual, *make_subject("reference")), scene::Error);
}

}  // namespace
}  // namespace clues::fuzz
