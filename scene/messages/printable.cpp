// UTF-8 by hand: what is not the shortest form of a character is no UTF-8.
#include "scene/messages/printable.h"

#include <fmt/format.h>

#include <cstdint>

namespace clues::scene {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  // 0: no UTF-8 here
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >> 5 == 0x6 ? 2 : lead >> 4 == 0xe ? 3 : lead >> 3 == 0x1e ? 4 : 0;
  if (bytes == 0 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (byte(i) >> 6 != 2) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < least[bytes] || code > 0x10ffff || surrogate ? Character{} : Character{code, bytes};
}

// Beyond ASCII: C1 controls (a terminal may take U+009B for the beginning of an escape sequence), and what shows nothing or changes the direction.
bool misleads(std::uint32_t code) {
  return (code >= 0x80 && code <= 0xa0) || code == 0xad || code == 0x61c || code == 0x180e ||
         (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2060 && code <= 0x206f) || (code >= 0xfe00 && code <= 0xfe0f) || code == 0xfeff ||
         (code >= 0xfff0 && code <= 0xfffb) || code == 0xfffe || code == 0xffff || (code >= 0xe0000 && code <= 0xe0fff);
}

std::string escaped(std::string_view text, bool keep_lines, std::size_t most) {
  std::string out;
  while (!text.empty()) {
    const auto [code, bytes] = first_character(text);
    std::string shown;
    if (bytes == 0) {
      shown = fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    } else if (keep_lines && text.starts_with("\r\n")) {
      // the line feed comes next
    } else if (code == '\n' || code == '\t') {
      shown = keep_lines ? std::string(1, text[0]) : code == '\n' ? "\\n" : "\\t";
    } else if (code < 0x20 || code == 0x7f) {
      shown = fmt::format("\\x{:02x}", code);
    } else if (misleads(code)) {
      shown = fmt::format("\\u{{{:04x}}}", code);
    } else {
      shown = text.substr(0, bytes);
    }
    if (out.size() + shown.size() > most) return out + "...";
    out += shown;
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) { return escaped(text, false, most); }

std::string printable_lines(std::string_view text) { return escaped(text, true, std::string_view::npos); }

}  // namespace clues::scene
