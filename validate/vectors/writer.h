// The one canonical text of a vector file and of the index: fixed key order, two spaces of indent, what fits on a line of 120 columns on
// one line, newline at the end. parse_vector_file(to_json_text(f)) is f.
#pragma once

#include <string>

#include "validate/vectors/suite.h"

namespace clues::validate {

std::string to_json_text(const VectorFile& file);
std::string to_json_text(const VectorIndex& index);
std::string to_json_text(const Expectation& expect);

// C99: "0x1.8p+1", "-0x0p+0"; reads back as the same double, bit for bit.
std::string to_hex_float(double x);

}  // namespace clues::validate
