// A set of points of one triangle, laid flat, as an exact planar arrangement with a label on each face. Sets are closed and regular: what has no area does
// not count, neither in a result nor in emptiness.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/planar/flat_faces.h"

namespace clues::reference {

using Face2 = std::vector<Ring2>;  // outer boundary, then holes

struct FlatSegment {
  exact::Point2 a, b;
};

class FlatSet {
 public:
  // Nothing, in a triangle of this (doubled) area.
  explicit FlatSet(const exact::FT& twice_triangle) : triangle_(twice_triangle), area_(0) {}
  // The union of faces of one arrangement: their insides are disjoint, and where two share a border they share its corners.
  FlatSet(const exact::FT& twice_triangle, const std::vector<Face2>& faces);

  bool empty() const { return !faces_; }
  bool whole() const { return area_ == triangle_; }
  exact::FT fraction() const { return area_ / triangle_; }  // of the triangle's area

  // The maximal connected faces. O(size).
  std::vector<Face2> faces() const;

  // The faces that segments, which may cross, cut it into. Those that end inside of a face stay in its rings, walked both
  // ways. Faces of one arrangement: any of them make a set again. O((n + k) log n).
  std::vector<Face2> faces_cut_by(const std::vector<FlatSegment>& segments) const;
  // Where `part` ends inside of this set. O((n + k) log n).
  std::vector<FlatSegment> borders_of(const FlatSet& part) const;

  // Sets of the same triangle. O((n + k) log n) for k crossings of their borders.
  friend FlatSet unite(const FlatSet& a, const FlatSet& b);
  friend FlatSet intersect(const FlatSet& a, const FlatSet& b);
  friend FlatSet subtract(const FlatSet& a, const FlatSet& b);

 private:
  struct Faces;  // the arrangement
  // `rule`: 1 for what is kept of what is in none, in a, in b, in both.
  static FlatSet combine(const FlatSet& a, const FlatSet& b, const std::array<unsigned, 4>& rule);
  void take(std::shared_ptr<Faces> faces);

  std::shared_ptr<const Faces> faces_;  // none: empty
  exact::FT triangle_, area_;           // doubled
};

}  // namespace clues::reference
