// A scene with walls and a grid of cells in it, and what is true of it: for tests of streams.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reference/streams/stream_server.h"
#include "scene/cell_spec.h"
#include "scene/stream/packets.h"
#include "validate/stream/judge_stream.h"

namespace clues::test {

class Town {
 public:
  Town(scene::TriangleMesh mesh, const std::string& grid);
  Town(const Town&) = delete;
  Town& operator=(const Town&) = delete;

  const reference::StreamStore& store(int horizon) const;
  reference::StreamServer server(int horizon) const { return reference::StreamServer(store(horizon)); }
  scene::StreamHeader header() const { return {"abc", "grid", mesh_.triangles.size(), lists_.size()}; }
  validate::StreamVerdict judge(const std::vector<scene::StreamMessage>& messages) const;
  std::vector<scene::StreamMessage> stream(const std::vector<std::uint32_t>& route, int horizon) const;

  const scene::TriangleMesh& mesh() const { return mesh_; }
  const std::vector<scene::CellSpec>& cells() const { return cells_; }
  const std::vector<std::vector<std::uint32_t>>& neighbours() const { return neighbours_; }
  const std::vector<std::vector<std::uint32_t>>& lists() const { return lists_; }

 private:
  scene::TriangleMesh mesh_;
  std::vector<scene::CellSpec> cells_;
  std::vector<std::vector<std::uint32_t>> neighbours_, lists_;
  std::vector<validate::Judgement> truth_;
  mutable std::map<int, reference::StreamStore> stores_;  // by horizon
};

// Boxes in the corners of a wide floor, and triangles behind them: 3x3x2 cells between see different ones.
const Town& town();

}  // namespace clues::test
