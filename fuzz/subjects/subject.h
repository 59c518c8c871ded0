// What is tested: something that answers a scene and a cell with a PVS (D7).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/findings/finding.h"
#include "fuzz/trials/trial.h"
#include "reference/visibility/first_order.h"

namespace clues::fuzz {

struct Answer {
  std::vector<std::uint32_t> pvs;               // ascending
  std::optional<reference::VisibilityMap> map;  // where the subject computes one, its hidden regions are tested too
  // Of a subject that promises exactly the triangles of Omega (D9): those that it lists without knowing (D17b); ascending.
  std::optional<std::vector<std::uint32_t>> in_doubt;
};

// The subject gave no answer: it crashed, took too long, or wrote something that is no PVS. what() is one line.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The subject does not take such scenes: no mesh for solid mode, for instance.
class InputRefused : public NoAnswer {
 public:
  using NoAnswer::NoAnswer;
};

class Subject {
 public:
  virtual ~Subject() = default;
  virtual Answer answer(const Case& scene) const = 0;  // throws NoAnswer
  virtual std::string name() const = 0;                // make_subject(name()) is the same subject
  virtual bool takes_dials() const { return false; }   // answers as the dials of the case say (dials.h)
  // Whether the reference is asked about the case, too: a function of the case's name and dials. Where it is not, oracles have the subject's own answer as a
  // guide to the places worth looking at.
  virtual bool is_compared(const Case&) const { return true; }
  // Where it is no answer that is tested: what is. Then answer() throws NoAnswer.
  virtual const Trial* trial() const { return nullptr; }
};

// "reference": the exact reference. "fast": the fast path; "fast/N": the same, with the reference asked about one case in N. "subdivided",
// "backprojected": the reference refined to depth 2; after "fast:" the fast path to depth 3. "solids": what solids do not hide (T15). "maps", "motion", "deltas", "bakes", "streams", "levels": trials; "levels/N" with N sight lines a case. Anything else is a command line (words and quotes as in
// a shell), in which {scene}, {cell} and {pvs} stand for an OFF file, an OBJ file of the cell's points and the file that it has to write, {mode} for
// sheet or solid; without any of these words, the first three are appended. Throws scene::Error bad_argument.
std::unique_ptr<Subject> make_subject(const std::string& text);

// N of "fast/N", 1 for "fast"; none: it is another subject. N from 2 to 10^6, without zeros in front.
std::optional<std::uint64_t> cases_for_a_comparison(const std::string& name);

// Sight lines of each case of "levels/N", 4,096 of "levels"; none: it is another subject. N from 1 to 10^9, without zeros in front.
std::optional<std::uint64_t> lines_of_each_level(const std::string& name);

// Whether make_subject() takes it for a command line. What a file names is not run unless the user says so.
bool is_program(const std::string& text);

std::unique_ptr<Subject> subject_of(std::string name, std::unique_ptr<Trial> trial);

// A function of this process that returns a PVS, ascending. It may throw scene::Error: then it gave no answer.
std::unique_ptr<Subject> subject_of(std::string name, std::function<std::vector<std::uint32_t>(const Case&)> pvs);

}  // namespace clues::fuzz
