// D25, judged by what the client holds and by nothing else: is every triangle that the viewer can see there, at every
// step? Believes nobody: a triangle is missing only with a sight line that is checked, or because it meets the cell (D3).
//
// A stream is unsound where
//   - a `cell` message comes while something visible from that cell, or from the one that the viewer comes from, is not
//     there (he is on the face between them), or a later message takes away what is visible from his cell;
//   - there is a contour for the cell, and something visible from it is not drawn with it;
//   - a triangle is sent that is there, or taken away though it is not there;
//   - a slot is given to two triangles, or to none (slot 0); a vertex is sent into a slot that is in use; a slot is
//     called unused while a triangle uses it, or not called unused though none does, be it after `+` or after `-`;
//   - a triangle has corners other than the scene's, bit for bit;
//   - the viewer steps into a cell that is no neighbour of his: in a grid, one with a whole face in common, or that holds
//     it or is held by it; in a bake, one that touches it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"
#include "scene/stream/stream_file.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

// A client's display list, made of nothing but the messages.
class StreamClient {
 public:
  explicit StreamClient(const scene::TriangleMesh& mesh) : mesh_(&mesh) {}  // keeps a reference

  // What is wrong with the message; it is carried out as far as it makes sense.
  std::vector<std::string> apply(const scene::StreamMessage& message);

  std::size_t size() const { return triangles_.size(); }
  bool holds(std::uint32_t triangle) const { return triangles_.contains(triangle); }
  bool has_contour(std::uint32_t cell) const { return contours_.contains(cell); }
  // D26, FIG. 54: what is drawn in the cell; none: there is no contour for it, and so all is drawn. O(n log n).
  std::optional<std::set<std::uint32_t>> drawn_in(std::uint32_t cell) const;
  std::string bytes() const;  // as DisplayList::bytes

 private:
  void apply_plus(const scene::StreamMessage& message, std::vector<std::string>& wrong);
  void apply_minus(const scene::StreamMessage& message, std::vector<std::string>& wrong);
  using EdgeEnds = std::array<scene::Point, 2>;
  std::optional<EdgeEnds> edge_of(const scene::StreamTriangle& triangle, std::size_t k) const;
  bool has_right_corner(std::uint32_t id, std::size_t corner) const;
  void look_at_corners(std::uint32_t id);
  void put(const scene::StreamTriangle& triangle);
  void take_away(std::uint32_t id);
  void require_used(std::vector<std::string>& wrong) const;

  const scene::TriangleMesh* mesh_;
  std::map<std::uint32_t, scene::StreamTriangle> triangles_;  // by id
  std::map<std::uint32_t, std::uint32_t> slots_;              // of triangles: ids
  std::map<std::uint32_t, scene::Point> vertices_;            // by slot
  std::map<std::uint32_t, scene::CellContour> contours_;      // by cell
  // What follows from these, so that a message costs what it says and not what the client holds.
  std::map<std::uint32_t, std::set<std::uint32_t>> users_;  // of slots of vertices: ids; none is empty
  std::set<std::uint32_t> idle_;                            // slots of vertices that no triangle uses
  std::set<std::uint32_t> astray_;                          // ids: a corner is missing, or not that of the scene
};

struct StreamFinding {
  std::uint64_t message = 0;       // from 1; in a file it is on the line after that
  std::string what;                // one line
  std::optional<Witness> witness;  // of a missing triangle
};

// A triangle that was missing, and of which nothing is proved.
struct StreamDoubt {
  std::uint64_t message = 0;
  std::uint32_t cell = 0, triangle = 0;
};

struct StreamVerdict {
  std::vector<StreamFinding> findings;  // none: nothing visible was ever missing
  std::uint64_t cells_entered = 0;
  std::vector<StreamDoubt> undecided;
  std::uint64_t sent = 0, taken = 0, most_held = 0, contours = 0;
};

// What is visible from a cell: the judgement of an empty list (judge.h).
using CellTruth = std::function<const Judgement&(std::uint32_t cell)>;

// At most `most_findings`. `neighbours`: of each cell, ascending. O(messages + triangles of a cell at each step); and where
// it has a contour, all that is held at each message.
StreamVerdict judge_stream(const scene::TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& neighbours,
                           const std::vector<scene::StreamMessage>& messages, const CellTruth& truth,
                           std::size_t most_findings = 20);

}  // namespace clues::validate
