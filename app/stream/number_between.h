// A check of an option: CLI::Range lets through what is no number, because that is neither below nor above.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace clues::app {

inline CLI::Validator number_between(double from, double to) {
  const auto why_not = [from, to](const std::string& text) -> std::string {
    double x = 0;
    if (CLI::detail::lexical_cast(text, x) && x >= from && x <= to) return {};
    return fmt::format("Value {} not in range [{} - {}]", text, from, to);
  };
  return CLI::Validator(why_not, fmt::format("FLOAT in [{} - {}]", from, to));
}

}  // namespace clues::app
