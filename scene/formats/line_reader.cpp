// Lines and tokens of the text formats (D1 input). No copy is made: tokens are views of the file's text.
#include "scene/formats/line_reader.h"

namespace clues::scene {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

LineReader::LineReader(std::string_view file, std::string_view text, LineRules rules, std::uint64_t first_line)
    : file_(file), rest_(text), rules_(rules), next_line_(first_line), line_(first_line) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  constexpr char end_of_text = '\x1a';  // Ctrl-Z, of DOS and its heirs
  if (rest_.ends_with(end_of_text)) rest_.remove_suffix(1);
}

std::string_view LineReader::take_physical_line() {
  std::size_t end = 0;
  while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
  const auto line = rest_.substr(0, end);
  if (rest_.substr(end).starts_with("\r\n")) ++end;
  rest_.remove_prefix(end < rest_.size() ? end + 1 : end);
  ++next_line_;
  return line;
}

void LineReader::add_tokens(std::string_view part) {
  std::size_t i = 0;
  while (i < part.size()) {
    if (is_blank(part[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < part.size() && !is_blank(part[end])) ++end;
    tokens_.push_back(part.substr(i, end - i));
    i = end;
  }
}

bool LineReader::next() {
  while (!rest_.empty()) {
    tokens_.clear();
    line_ = next_line_;
    bool continued = true;
    while (continued && (line_ == next_line_ || !rest_.empty())) {
      auto part = take_physical_line();
      if (rules_.hash_comments) part = part.substr(0, part.find('#'));
      while (!part.empty() && is_blank(part.back())) part.remove_suffix(1);
      continued = rules_.backslash_continues && part.ends_with('\\');
      if (continued) part.remove_suffix(1);
      add_tokens(part);
    }
    if (!tokens_.empty() || !rules_.skip_blank) return true;
  }
  tokens_.clear();
  line_ = next_line_;
  return false;
}

}  // namespace clues::scene
