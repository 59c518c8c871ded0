// Texts of the errors that name a file and a place in it (D1 input).
#include "scene/formats/place.h"

#include <fmt/format.h>

namespace clues::scene {

std::string Place::text() const {
  return item.empty() ? fmt::format("{}:{}", file, number) : fmt::format("{}: {} {}", file, item, number);
}

void fail_at(const Place& place, ErrorCode code, const std::string& what) {
  throw Error(code, place.text() + ": " + what);
}

void fail_in(std::string_view file, ErrorCode code, const std::string& what) {
  throw Error(code, fmt::format("{}: {}", file, what));
}

std::string excerpt(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string text(token.substr(0, longest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + text + (token.size() > longest ? "...'" : "'");
}

}  // namespace clues::scene
