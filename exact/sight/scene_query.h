// Exact segment queries on the complex: which pieces does an open segment cross, and where. All contacts that are not a clean
// crossing of a piece's interior are reported as degenerate: callers choose their segments and can choose again (definition, section 5).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "exact/box_tree.h"
#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "exact/sight/point_occlusion.h"

namespace clues::exact {

struct Hit {
  std::uint32_t piece = 0;
  FT t;  // 0 at the first end, 1 at the second; strictly between
};

struct SegmentAnswer {
  bool degenerate = false;          // touches an edge, a vertex, or runs in a plane: choose another segment
  std::optional<std::uint32_t> at;  // then mostly: a piece where
  std::vector<Hit> hits;            // ascending in t; complete unless degenerate

  bool is_clear() const { return !degenerate && hits.empty(); }  // surely nothing in between
};

// Whether the closed triangle meets the closed cell (D3), exactly. One without area is no surface and meets nothing (D1). A flat cell is bounded by its plane (both sides) and by its edges.
bool meets_cell(const TriangleCorners& triangle, const ConvexCell& cell);

// Whether an occluder holds v: then what v sees says nothing of what is seen from beside it.
bool is_touched(const Complex& complex, const Point3& v);

class SceneQuery {
 public:
  // Keeps references: complex and cell must outlive it. `occluders`, one for each piece, leaves the others out of all queries; empty: all pieces
  // outside int V.
  SceneQuery(const Complex& complex, const ConvexCell& cell, const std::vector<bool>& occluders = {});

  // The clean crossings of the open segment (v,p), v in int V. A piece whose plane contains p is not crossed (it can only be met
  // at p). Crossings inside int V do not count (D3). A piece in whose plane the segment runs, and meets it, is degenerate - or
  // not met at all, if p stands for points just off that plane (`off_planes`). `first`, an occluder, is looked at before the
  // others: where it is degenerate they do not matter. O(log n + boxes met).
  SegmentAnswer crossings(const Point3& v, const Point3& p, bool off_planes = false,
                          std::optional<std::uint32_t> first = std::nullopt) const;

  // Whether crossings(v, p) finds something at that occluder: a hit, or what is degenerate. O(1).
  bool meets(const Point3& v, const Point3& p, std::uint32_t occluder) const;

  // Whether the open segment (v,p) meets no closed piece outside int V (D5): exact for every two points, never degenerate.
  bool is_free(const Point3& v, const Point3& p) const;

  // Occluders whose boxes the test cannot exclude.
  template <class Test>
  std::vector<std::uint32_t> candidates(const Test& may_meet) const {
    std::vector<std::uint32_t> found = tree_.candidates(may_meet);
    for (std::uint32_t& t : found) t = occluders_[t];
    return found;
  }

  // Whether all pieces of the complex are occluders.
  bool is_whole() const { return occluders_.size() == complex_->pieces.size(); }
  // Whether piece t meets the closed cell (D3).
  bool meets_cell(std::uint32_t piece) const { return meets_cell_[piece]; }
  const CGAL::Bbox_3& bounds() const { return bounds_; }  // of scene and cell
  const Complex& complex() const { return *complex_; }
  const ConvexCell& cell() const { return *cell_; }

 private:
  std::optional<Hit> hit_outside(const Point3& v, const Point3& p, std::uint32_t crossed) const;  // none in int V

  const Complex* complex_;
  const ConvexCell* cell_;
  BoxTree tree_;                          // over occluders_
  std::vector<std::uint32_t> occluders_;  // ascending
  std::vector<bool> meets_cell_;
  CGAL::Bbox_3 bounds_;
};

}  // namespace clues::exact
