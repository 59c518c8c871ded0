#include "scene/messages/shell_word.h"

#include <fmt/format.h>

#include "scene/messages/printable.h"

namespace clues::scene {

std::string shell_word(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos && text[0] != '-' && text[0] != '=')
    return std::string(text);
  if (printable(text) != text) {
    std::string out = "$'";
    for (const char c : text) {
      if (c == '\'' || c == '\\') {
        out += std::string("\\") + c;
      } else if (c < ' ' || c > '~') {
        out += fmt::format("\\{:03o}", static_cast<unsigned>(static_cast<unsigned char>(c)));
      } else {
        out += c;
      }
    }
    return out + "'";
  }
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace clues::scene
