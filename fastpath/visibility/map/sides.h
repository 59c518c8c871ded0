// D15: which sides of which triangles light meets. A side with a trace of positive length has a visible region, beside the trace in H-. A
// side without one has one label, that of any point beside it; or one on every part between wedges in doubt, which only separate
// (T10).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "fastpath/visibility/labels/one_label.h"
#include "fastpath/visibility/scene/local_scene.h"
#include "fastpath/visibility/search/options.h"
#include "fastpath/visibility/wedges/piece_set.h"
#include "fastpath/visibility/wedges/workers.h"

namespace clues::fastpath {

class Sides {
 public:
  // Keeps references; `pieces` are complete, `wanted` has one entry for each triangle. Needs RoundedUp in scope, here and below.
  Sides(const LocalScene& scene, const PieceSet& pieces, const OneLabel& one_label, SideMode mode,
        const std::vector<bool>& wanted)
      : scene_(scene), pieces_(pieces), one_label_(one_label), mode_(mode), wanted_(wanted) {}

  void find_visible(Workers& workers);
  // D17b, where the pieces, which are those of `walker`, are the known ones: those that neither they nor single sight lines show a point of.
  std::vector<std::uint32_t> in_doubt_of(const std::vector<std::uint32_t>& listed, const Walker& walker,
                                         Workers& workers) const;

  std::vector<std::uint32_t> visible,
      lit;  // wanted triangles with a side that counts and is visible; that light meets on either side
  std::atomic<std::uint64_t> walks{0}, fallbacks{0};

 private:
  // A triangle that light meets; whether the side that it meets counts.
  struct Lit {
    std::uint32_t triangle = 0;
    bool counts = false;
  };

  // What cuts a side.
  struct Cut {
    bool lit = false;                  // a trace, beside which it is visible
    std::vector<const Plane*> planes;  // of wedges that are in doubt
  };
  using Cuts = std::vector<std::array<Cut, 2>>;  // by piece: front, back

  bool is_seen_inside(std::uint32_t t, bool front, const Walker& walker) const;
  Cuts cuts() const;
  std::vector<Lit> lit_of(const std::vector<std::uint32_t>& ids, const Cuts& cut);
  bool runs_along_an_edge(const Plane& plane, std::uint32_t t) const;
  void mark_traces(const ValidPiece& piece, Cuts& cut) const;
  bool is_visible(std::uint32_t t, bool front, const Cut& cut);
  bool whole_side_visible(std::uint32_t t, int side);
  bool part_visible(std::uint32_t t, int side, const std::vector<Exact3>& part);
  std::vector<std::vector<Exact3>> parts_between(std::uint32_t t, const std::vector<const Plane*>& planes) const;
  template <class LeavesOut>
  bool nothing_else_between(const ExactPoint& x, const ExactPoint& q, std::uint32_t t, int side,
                            const LeavesOut& leaves_out) const;

  const LocalScene& scene_;
  const PieceSet& pieces_;
  const OneLabel& one_label_;
  const SideMode mode_;
  const std::vector<bool>& wanted_;
};

}  // namespace clues::fastpath
