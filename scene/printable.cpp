#include "scene/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clues::scene {
namespace {

// Bytes of the UTF-8 character at the front of `text`, and which it is; 0 bytes: it is none.
std::size_t utf8_at(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xc2 ? 0
                           : first < 0xe0 ? 2
                           : first < 0xf0 ? 3
                           : first < 0xf5 ? 4
                                          : 0;
  if (size == 0 || size > text.size()) return 0;
  code = size == 1 ? first : first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  return too_long || code > 0x10ffff || (0xd800 <= code && code < 0xe000) ? 0 : size;
}

// Whether a terminal shows it where it stands.
bool is_shown(std::uint32_t code) {
  return code >= 0x20 && !(0x7f <= code && code < 0xa0) && !(0x200b <= code && code <= 0x200f) &&
         !(0x2028 <= code && code <= 0x202e) && !(0x2060 <= code && code <= 0x206f) && code != 0xfeff;
}

std::string escaped(std::string_view text, bool lines) {
  std::string out;
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_at(text, code);
    const char c = text[0];
    if (size > 0 && (is_shown(code) || (lines && c == '\n'))) {
      out += text.substr(0, size);
    } else if (c == '\n' || c == '\t' || c == '\r') {
      out += c == '\n' ? "\\n" : c == '\t' ? "\\t" : "\\r";
    } else {
      for (std::size_t i = 0; i < std::max<std::size_t>(size, 1); ++i)
        out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(text[i])));
    }
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  const bool cut = most > 0 && text.size() > most;
  return escaped(cut ? text.substr(0, most) : text, false) + (cut ? "..." : "");
}

std::string printable_lines(std::string_view text) { return escaped(text, true); }

std::string shell_word(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos && text[0] != '-' && text[0] != '=')
    return std::string(text);
  if (printable(text) != text) {  // $'...': bash, zsh, ksh and POSIX of 2024
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

std::string percent(double part, double whole, int decimals) {
  const double share = whole > 0 ? 100 * part / whole : whole == 0 ? 0 : std::nan("");
  return std::isfinite(share) ? fmt::format("{:.{}f}", share, decimals) : "-";
}

}  // namespace clues::scene
