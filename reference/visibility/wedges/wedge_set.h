// The valid wedge pieces found so far, and the two questions D14 asks of them: does a leg of a walk cross one from H+ to H-, and
// does one lie upon a surface at a point.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "exact/box_tree.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/wedges/on_wedge.h"
#include "reference/visibility/wedges/wedge.h"

namespace clues::reference {

enum class Meets : std::uint8_t { no, yes, degenerate };

// One valid piece with what is needed to test it.
struct ValidPiece {
  Wedge wedge;
  std::shared_ptr<const OnWedge> on_wedge;
  Strip strip;
  bool holds_cell = false;  // all of V lies in its plane: no sight line crosses it, it only separates (T10)
};

// Whether x, a point of the piece's plane, lies in the piece: degenerate on its outline.
Meets covers(const ValidPiece& piece, const exact::Point3& x);

// Whether the segment from m to p crosses the piece from H+ to H-; p and m not both in its plane. Degenerate when it meets the outline,
// or when an end lies on the piece. With `off` the segment stands for one just off it on that side: then what meets the outline is inside or outside.
Meets crosses(const ValidPiece& piece, const exact::Point3& m, const exact::Point3& p,
              const exact::Vector3& off = CGAL::NULL_VECTOR);

class WedgeSet {
 public:
  // For sight lines within `bounds`; of scene and cell, unless given.
  explicit WedgeSet(const exact::SceneQuery& scene) : WedgeSet(scene, scene.bounds()) {}
  WedgeSet(const exact::SceneQuery& scene, const CGAL::Bbox_3& bounds) : scene_(&scene), bounds_(bounds) {}

  // Adds a batch and indexes it. The pieces keep their order of arrival as indices.
  void add(std::vector<ValidPiece> batch);

  const std::vector<ValidPiece>& pieces() const { return pieces_; }

  // Over the pieces from index `first` on (which must be the start of a batch): yes if any says yes, else degenerate if any does.
  // `skip(piece)` leaves a piece out.
  template <class Skip>
  Meets crossed(const exact::Point3& m, const exact::Point3& p, std::size_t first, const Skip& skip,
                const exact::Vector3& off = CGAL::NULL_VECTOR) const {
    Meets worst = Meets::no;
    const exact::SegmentBoxTest test(m, p);
    for (const Batch& b : batches_) {
      if (b.begin < first) continue;
      for (const std::uint32_t i : b.tree.candidates(test)) {
        const ValidPiece& piece = pieces_[b.begin + i];
        if (piece.holds_cell || skip(piece)) continue;
        const Meets r = crosses(piece, m, p, off);
        if (r == Meets::yes) return r;
        if (r == Meets::degenerate) worst = r;
      }
    }
    return worst;
  }

  // The pieces whose boxes the test cannot exclude, ascending.
  template <class Test>
  std::vector<std::uint32_t> candidates(const Test& may_meet) const {
    std::vector<std::uint32_t> found;
    for (const Batch& b : batches_) {
      for (const std::uint32_t i : b.tree.candidates(may_meet))
        found.push_back(static_cast<std::uint32_t>(b.begin) + i);
    }
    return found;
  }

  // The pieces lying in the plane of complex piece t whose H- is t's front (or back) side.
  const std::vector<std::uint32_t>& upon(std::uint32_t t, bool front) const;
  // The pieces whose plane contains edge e.
  const std::vector<std::uint32_t>& along(std::uint32_t e) const;

 private:
  struct Batch {
    std::size_t begin;
    exact::BoxTree tree;
  };
  const exact::SceneQuery* scene_;
  CGAL::Bbox_3 bounds_;
  std::vector<ValidPiece> pieces_;
  std::vector<Batch> batches_;
  std::map<std::pair<std::uint32_t, bool>, std::vector<std::uint32_t>> upon_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> along_;
};

}  // namespace clues::reference
