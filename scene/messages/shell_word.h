// Text as one word of a shell, for commands that are printed or written down to be repeated.
#pragma once

#include <string>
#include <string_view>

namespace clues::scene {

// Plain words stay as they are; the others are quoted, control characters as in $'\033' (bash, zsh, ksh, POSIX of 2024).
std::string shell_word(std::string_view text);

}  // namespace clues::scene
