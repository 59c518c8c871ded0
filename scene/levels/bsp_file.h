// A level of the IBSP 46 family (Quake 3 and its kin) as it stands in the file, after every count, index, range and number
// in it has been checked. The words are the format's: a face is a drawn surface, a brush a convex solid, a leaf a convex
// cell of the BSP tree, a cluster a group of leaves with one row of the visibility matrix.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

struct BspFile {
  struct Range {
    std::uint32_t first = 0, count = 0;
  };
  struct Shader {
    std::string name;
    std::uint32_t surface = 0, contents = 0;  // bits, see bsp_flags.h
  };
  struct Plane {
    Point normal;         // floats; not zero
    double distance = 0;  // normal * x = distance
  };
  struct Node {
    std::uint32_t plane = 0;
    std::array<std::int32_t, 2> children{};  // in front (normal * x >= distance), behind; below 0: the leaf -1 - child
  };
  struct Leaf {
    std::int32_t cluster = -1;  // -1: solid or outside
    Range faces;                // of leaf_faces
  };
  struct Model {
    Point low, high;
    Range faces, brushes;
  };
  struct Brush {
    Range sides;
    std::uint32_t shader = 0;
  };
  struct Side {
    std::uint32_t plane = 0, shader = 0;
  };
  enum class Kind { planar = 1, patch = 2, mesh = 3, billboard = 4 };
  struct Face {
    Kind kind = Kind::planar;
    std::uint32_t shader = 0;
    Range vertices, corners;                  // of points; of corners (three each; count from vertices.first)
    std::array<std::uint32_t, 2> controls{};  // of a patch: columns and rows of control points, odd and at least 3
  };
  struct Visibility {
    std::uint32_t clusters = 0, row_bytes = 0;
    std::string bits;  // cluster b is visible from a: bit b of row a; empty: everything is visible
  };

  std::string name;  // for messages
  std::vector<Shader> shaders;
  std::vector<Plane> planes;
  std::vector<Node> nodes;  // node 0 is the root; a tree
  std::vector<Leaf> leaves;
  std::vector<std::uint32_t> leaf_faces;
  std::vector<Model> models;  // the first is the world; the others move
  std::vector<Brush> brushes;
  std::vector<Side> sides;
  std::vector<Point> points;
  std::vector<std::uint32_t> corners;
  std::vector<Face> faces;
  Visibility visibility;
  double far_plane =
      0;  // the visibility leaves out what is farther away, as the level's compiler was told; 0: it does not
  std::vector<std::uint32_t>
      leaves_of_tree;  // that the root reaches, in the order of a walk that takes the front first

  bool sees(std::uint32_t from_cluster, std::uint32_t cluster) const;
};

// Throws Error: malformed, unsupported (another version), non_finite, index_out_of_range; the message names lump and record.
// O(size of the file).
BspFile parse_bsp(std::string_view bytes, const std::string& file);

}  // namespace clues::scene
