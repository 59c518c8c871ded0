// A case of the fuzzer and what was found in it. Both are self-contained: coordinates as doubles, witnesses (D18) as exact
// fractions in text, so that a finding can be stored, sent and verified elsewhere. No exact arithmetic in this header.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh/flagged_mesh.h"
#include "scene/mesh/mesh.h"

namespace clues::fuzz {

// Settings of the engines and of the scene that were turned for a case, and to what (dials.h).
using CaseDials = std::map<std::string, std::int64_t>;

struct Case {
  std::string generator;
  std::uint64_t seed = 0, index = 0;
  scene::TriangleMesh mesh;
  std::vector<scene::Point> cell;
  bool solid = false;                            // asked in solid mode (D4): only fronts count
  CaseDials dials{};                             // what the scene's have done is done
  std::vector<std::uint8_t> blocks{}, counts{};  // D22, per triangle; empty: all do
};

scene::FlaggedMesh flagged(const Case& scene);

// A sight line that proves triangle `triangle` visible on its front or back side: v in int V, p on the triangle (D5, D6).
struct WitnessText {
  std::uint32_t triangle = 0;
  bool front = true;
  std::array<std::string, 3> v, p;  // "p/q"
  bool operator==(const WitnessText&) const = default;
};

struct Finding {
  std::string oracle;
  std::string verdict;  // what was answered "/" what is true: "hidden/visible", "hidden-region/visible", ...
  Case where;
  std::optional<std::uint32_t> triangle;
  std::optional<WitnessText> witness;
  std::string explanation;  // one line for a person

  // Findings with the same signature count as one defect.
  std::string signature() const { return oracle + " " + verdict + " " + where.generator; }
};

// That the subject did not answer.
Finding without_answer(const Case& scene, const std::string& why);

// The verdict of the checks of a trial: something was promised and does not hold.
inline constexpr const char* broken_promise = "promise/broken";

using Counters = std::map<std::string, std::uint64_t>;

// What came of one case.
struct Outcome {
  std::vector<Finding> findings;            // at most one of each oracle and verdict
  std::vector<std::string> contradictions;  // an oracle was wrong: claims that exact/sight/witness.h did not confirm
  Counters counters;
};

// Refuses (scene::Error malformed, "PLACE: ...") what no campaign makes: numbers of triangles and corners that the scene does not have, no cell, coordinates
// that are no numbers, an unknown verdict, and a verdict that rests on a sight line without one.
void require_whole(const Finding& finding, const std::string& place);

// JSON, keys sorted, one line; the same value gives the same text, and back. from_json_text throws scene::Error malformed.
std::string to_json_text(const Finding& finding);
Finding finding_from_json_text(const std::string& text);
std::string to_json_text(const Outcome& outcome);
Outcome outcome_from_json_text(const std::string& text);

}  // namespace clues::fuzz
