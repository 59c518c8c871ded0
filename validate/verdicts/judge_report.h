// What a judgement looks like: as lines for a person, as JSON for a program.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "validate/verdicts/judge.h"
#include "validate/verdicts/measures.h"

namespace clues::validate {

const char* to_string(Verdict verdict);
const char* to_string(TriangleVerdict verdict);

// "(x, y, z)" with exact "p/q" coordinates.
std::string to_string_exact(const exact::Point3& p);

// What is reported besides the verdicts.
struct Surroundings {
  std::string scene;               // file
  std::vector<scene::Point> cell;  // its points
  Weights counts, areas;           // measures.h
  std::vector<std::array<exact::FT, 2>> first_order_fractions;
};

// Some lines, the verdict first; at most `limit` witnesses and ids of each kind are spelled out.
std::string to_text(const Judgement& judgement, const Surroundings& around, std::size_t limit = 10);

// Format "clues-judgement/1" (docs/formats.md): keys sorted, two-space indent, trailing newline, same bytes for the same judgement.
std::string to_json_text(const Judgement& judgement, const Surroundings& around);

}  // namespace clues::validate
