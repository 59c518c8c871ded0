#include "app/shard.h"

#include "scene/formats/number.h"
#include "scene/messages/error.h"

namespace clues::app {

Shard parse_shard(const std::string& text) {
  if (text.empty()) return {};
  const auto slash = text.find('/');
  const auto index = scene::parse_integer(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : scene::parse_integer(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > 1000000)
    throw scene::Error(scene::ErrorCode::bad_argument, "--shard " + text + ": expected I/N, with I from 1 to N");
  return {static_cast<std::uint32_t>(*index - 1), static_cast<std::uint32_t>(*count)};
}

}  // namespace clues::app
