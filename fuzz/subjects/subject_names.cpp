// Apart from subject.cpp, which needs all of clues.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "fuzz/subjects/subject.h"
#include "scene/formats/number.h"

namespace clues::fuzz {

std::optional<std::uint64_t> cases_for_a_comparison(const std::string& name) {
  if (name == "fast") return 1;
  constexpr std::string_view begin = "fast/";
  if (!name.starts_with(begin)) return std::nullopt;
  const auto n = scene::parse_integer(name.substr(begin.size()));
  if (!n || *n < 2 || *n > 1'000'000 || name != fmt::format("{}{}", begin, *n)) return std::nullopt;
  return static_cast<std::uint64_t>(*n);
}

bool is_program(const std::string& text) {
  constexpr std::array names{"reference", "subdivided", "backprojected", "fast:subdivided", "fast:backprojected"};
  const auto has = [&](const auto& all) { return std::find(all.begin(), all.end(), text) != all.end(); };
  return !cases_for_a_comparison(text) && !has(names) && !has(trial_names);
}

}  // namespace clues::fuzz
