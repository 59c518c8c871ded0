// Walks over a text file line by line, each line cut into tokens at blanks; knows its line number for errors.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/formats/place.h"

namespace clues::scene {

struct LineRules {
  bool hash_comments = true;         // '#' to the end of the line is left out
  bool backslash_continues = false;  // a line that ends in '\' goes on in the next
  bool skip_blank = true;            // lines without tokens are not reported
};

class LineReader {
 public:
  // Lines end at LF, CR LF or CR. A UTF-8 byte order mark and a Ctrl-Z at the end are skipped. The text must outlive the reader.
  LineReader(std::string_view file, std::string_view text, LineRules rules, std::uint64_t first_line = 1);

  bool next();  // false at the end of the file
  const std::vector<std::string_view>& tokens() const { return tokens_; }
  std::uint64_t line() const { return line_; }  // of the first part, where a line is continued
  Place place() const { return {file_, {}, line_}; }

 private:
  std::string_view take_physical_line();
  void add_tokens(std::string_view part);

  std::string_view file_;
  std::string_view rest_;
  LineRules rules_;
  std::uint64_t next_line_;
  std::uint64_t line_;
  std::vector<std::string_view> tokens_;
};

}  // namespace clues::scene
