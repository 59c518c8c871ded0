// What is tested: something that answers a scene and a cell with a PVS (D7).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "exact/convex_cell.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh.h"

namespace clues::fuzz {

struct Answer {
  std::vector<std::uint32_t> pvs;               // ascending
  std::optional<reference::VisibilityMap> map;  // where the subject computes one, its hidden regions are tested too
};

// The subject gave no answer: it crashed, took too long, or wrote something that is no PVS. what() is one line.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Subject {
 public:
  virtual ~Subject() = default;
  virtual Answer answer(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) const = 0;
  virtual std::string name() const = 0;  // make_subject(name()) is the same subject
};

// "reference": the exact reference. "reference:BUG": with a planted bug, for the tests. Anything else is a command line (words and quotes as in
// a shell), in which {scene}, {cell} and {pvs} stand for an OFF file, an OBJ file of the cell's points and the file that it has to write;
// without any of these words, the three are appended. Throws scene::Error bad_argument.
std::unique_ptr<Subject> make_subject(const std::string& text);

}  // namespace clues::fuzz
