// A decimal number, and perhaps one letter.
#include "scene/duration.h"

#include <charconv>
#include <cmath>

#include "scene/messages/error.h"

namespace clues::scene {

std::chrono::milliseconds parse_duration(const std::string& option, const std::string& text, std::chrono::hours most) {
  const char* const end = text.data() + text.size();
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  const std::string unit(stop, end);
  const double seconds = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  const auto allowed = static_cast<double>(std::chrono::seconds(most).count());
  if (error == std::errc::invalid_argument || seconds == 0 || !std::isfinite(number))
    throw Error(ErrorCode::bad_argument, option + " " + text + ": is no time; write it as 90 or 90s, 10m, 2h");
  if (error != std::errc() || !(number > 0) || number * seconds > allowed) {
    throw Error(ErrorCode::bad_argument,
                option + " " + text + ": give more than 0, and at most " + std::to_string(most.count()) + "h");
  }
  return std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(number * seconds * 1000)));
}

}  // namespace clues::scene
