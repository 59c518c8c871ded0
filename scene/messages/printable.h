// What comes from outside (a file, a reply, a program's standard error) may hold NULs, escape sequences that rule a terminal, and letters
// that turn the line around. Whatever of it is shown to a person goes through these two.
#pragma once

#include <string>
#include <string_view>

namespace clues::scene {

// One line: control characters, bytes that are no UTF-8, and invisible or direction-changing characters become \n, \t, \xNN or \u{NNNN}; the
// rest, umlauts included, stays. Longer than `most` bytes: cut, with "..." at the end.
std::string printable(std::string_view text, std::size_t most = std::string_view::npos);

// The same, but ends of lines (LF, CR LF) stay ends of lines and tabs stay tabs.
std::string printable_lines(std::string_view text);

}  // namespace clues::scene
