// Where in a file something is wrong: "FILE:12" for text, "FILE: face 3" for binary (counted from 0, as D1 does).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/messages/error.h"

namespace clues::scene {

// Cheap to make for every value read; the text is composed only when an error is thrown. The views must outlive it.
struct Place {
  std::string_view file;
  std::string_view item;  // "vertex", "face", ...; empty: `number` is a line
  std::uint64_t number = 0;

  std::string text() const;
};

// Throws Error(code, "PLACE: what").
[[noreturn]] void fail_at(const Place& place, ErrorCode code, const std::string& what);
[[noreturn]] void fail_in(std::string_view file, ErrorCode code, const std::string& what);

// A piece of a file for a one-line message: in quotes, shortened, unprintable bytes as '?'.
std::string excerpt(std::string_view token);

}  // namespace clues::scene
