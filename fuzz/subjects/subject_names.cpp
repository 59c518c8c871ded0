// Apart from subject.cpp, which needs all of clues.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "fuzz/subjects/subject.h"
#include "fuzz/trials/levels_trial.h"
#include "scene/formats/number.h"

namespace clues::fuzz {

namespace {

// N of "begin/N", from `least` to `most`, without zeros in front.
std::optional<std::uint64_t> number_in(const std::string& name, std::string_view begin, std::int64_t least,
                                       std::int64_t most) {
  if (!name.starts_with(begin)) return std::nullopt;
  const auto n = scene::parse_integer(name.substr(begin.size()));
  if (!n || *n < least || *n > most || name != fmt::format("{}{}", begin, *n)) return std::nullopt;
  return static_cast<std::uint64_t>(*n);
}

}  // namespace

std::optional<std::uint64_t> cases_for_a_comparison(const std::string& name) {
  if (name == "fast") return 1;
  return number_in(name, "fast/", 2, 1'000'000);
}

std::optional<std::uint64_t> lines_of_each_level(const std::string& name) {
  if (name == "levels") return lines_of_a_level;
  const auto n = number_in(name, "levels/", 1, 1'000'000'000);
  return n == lines_of_a_level ? std::nullopt : n;  // that has another name
}

bool is_program(const std::string& text) {
  constexpr std::array names{"reference",       "subdivided",         "backprojected",
                             "fast:subdivided", "fast:backprojected", "solids"};
  const auto has = [&](const auto& all) { return std::find(all.begin(), all.end(), text) != all.end(); };
  return !cases_for_a_comparison(text) && !lines_of_each_level(text) && !has(names) && !has(trial_names);
}

}  // namespace clues::fuzz
