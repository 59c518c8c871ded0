// The share of one machine of many, as --shard says it.
#pragma once

#include <cstdint>
#include <string>

namespace clues::app {

// Of things with numbers those whose number leaves `index` when it is divided by `count`.
struct Shard {
  std::uint32_t index = 0, count = 1;
};

Shard parse_shard(const std::string& text);  // "I/N", I from 1; empty: all. Throws scene::Error bad_argument.

}  // namespace clues::app
