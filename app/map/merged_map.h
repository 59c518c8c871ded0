// D22, D15: the regions of a scene in which some triangles do not block, put together from maps of scenes in which everything blocks: that of what blocks,
// and for each triangle that counts and does not block that of what blocks and itself.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/result.h"

namespace clues::app {

class MergedMap {
 public:
  // Keeps a reference; regions, segments and mesh of `out` are filled.
  explicit MergedMap(scene::Result& out) : out_(out) {}

  // Takes what `from`, a result with regions, says of the triangles `wanted` (ascending numbers of `from`). `ids`: of all its triangles in the scene.
  // `hidden`: it is known by other means that nothing of them is seen.
  void take(const scene::Result& from, const std::vector<std::uint32_t>& ids, const std::vector<std::uint32_t>& wanted,
            bool hidden);

 private:
  using Vertex = std::array<std::string, 3>;
  std::uint64_t vertex(const Vertex& exact);
  void take_mesh(const scene::Result& from, const std::vector<std::vector<std::uint64_t>>& places, bool hidden);

  scene::Result& out_;
  std::map<Vertex, std::uint64_t> vertices_;
};

}  // namespace clues::app
