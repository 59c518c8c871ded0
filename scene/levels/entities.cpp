#include "scene/levels/entities.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clues::scene {
namespace {

struct Pair {
  std::string key, value;
};

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// Games do not tell large letters from small ones in keys.
bool is_key(const Pair& pair, std::string_view key) {
  return std::equal(pair.key.begin(), pair.key.end(), key.begin(), key.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
  });
}

// { "key" "value" ... }, up to its end or to what is something else.
std::vector<Pair> first_entity(std::string_view text) {
  const auto skip_spaces = [&] {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  };
  const auto quoted = [&]() -> std::optional<std::string> {
    skip_spaces();
    if (text.empty() || text.front() != '"') return std::nullopt;
    text.remove_prefix(1);
    const std::size_t end = text.find('"');
    if (end == std::string_view::npos) return std::nullopt;
    std::string word(text.substr(0, end));
    text.remove_prefix(end + 1);
    return word;
  };
  std::vector<Pair> pairs;
  skip_spaces();
  if (text.empty() || text.front() != '{') return pairs;
  text.remove_prefix(1);
  while (auto key = quoted()) {
    auto value = quoted();
    if (!value) break;
    pairs.push_back({*std::move(key), *std::move(value)});
  }
  return pairs;
}

}  // namespace

double far_plane_in(std::string_view entities) {
  const auto world = first_entity(entities);
  for (const char* key : {"_farplanedist", "fogclip", "distancecull"}) {
    // Of a key that is given twice the last counts.
    const auto at = std::find_if(world.rbegin(), world.rend(), [&](const Pair& p) { return is_key(p, key); });
    if (at == world.rend() || at->value.empty()) continue;
    const double distance = std::strtod(at->value.c_str(), nullptr);
    return std::isfinite(distance) && distance > 0 ? distance : 0;
  }
  return 0;
}

}  // namespace clues::scene
