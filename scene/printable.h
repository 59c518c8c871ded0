// How text that came from a file, a name or another program is shown: one line, without anything that a terminal or a shell would obey. Nothing of the sort
// is printed in another way.
#pragma once

#include <string>
#include <string_view>

namespace clues::scene {

// Control characters, DEL, what is no UTF-8, C1 controls and the marks that turn the direction of text round become \xNN, \n, \t; a backslash
// stays as it is. Longer than `most` bytes: shortened, with "..." at the end; 0: never.
std::string printable(std::string_view text, std::size_t most = 0);

// The same for text of several lines that are ours: line ends stay.
std::string printable_lines(std::string_view text);

// As one word of a shell, for commands that are printed or written down. Plain words stay as they are.
std::string shell_word(std::string_view text);

// 100 * part / whole with so many decimals; "-" where that is no number (nothing to see, or areas past the range of doubles).
std::string percent(double part, double whole, int decimals);

}  // namespace clues::scene
