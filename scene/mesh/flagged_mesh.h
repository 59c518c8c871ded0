// D22: a scene of which some triangles do not block, or do not count. Whatever takes a TriangleMesh takes all of its triangles for
// opaque and asks about each; it never gets to see one of these by accident, because the types differ.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// What a run of triangles is called where it comes from: the node, mesh and primitive of a glTF file, the face or brush of a level.
struct MeshPart {
  std::uint32_t first_triangle = 0;
  std::string name;
};

struct FlaggedMesh {
  TriangleMesh mesh;
  // Per triangle; empty: all do. A triangle that does neither is not there.
  std::vector<std::uint8_t> blocks, counts;
  std::vector<MeshPart> parts;  // ascending; the first begins at triangle 0; empty: nothing has a name

  bool blocking(std::uint32_t triangle) const { return blocks.empty() || blocks[triangle] != 0; }
  bool counting(std::uint32_t triangle) const { return counts.empty() || counts[triangle] != 0; }
  bool is_plain() const;                              // all block and count
  std::string name_of(std::uint32_t triangle) const;  // empty: it has none
};

// Ids of the triangles that block, ascending: the scene S of D22.
std::vector<std::uint32_t> blocking_ids(const FlaggedMesh& scene);

// The triangles of these ids (ascending), with all points.
TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids);

// The same, with their flags and without names.
FlaggedMesh part_of(const FlaggedMesh& scene, const std::vector<std::uint32_t>& ids);

// Triangles that may repeat points, with their flags, one after the other. Points with the same 192 bits share an index.
class FlaggedMeshBuilder {
 public:
  struct Flags {
    bool blocks = true, counts = true;
  };
  void add(const std::array<Point, 3>& corners, std::uint32_t face, Flags flags);
  void begin_part(std::string name);
  std::size_t triangle_count() const { return mesh_.mesh.triangles.size(); }
  FlaggedMesh take();

 private:
  std::uint32_t index_of(const Point& point);
  void grow();

  FlaggedMesh mesh_;
  std::vector<std::uint32_t> table_;  // open addressing; index + 1, 0 is free
};

}  // namespace clues::scene
