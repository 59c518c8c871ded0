// To leave out what blocks makes more visible: fine for lists, but not for an accusation. So a sight line through a level
// that accuses somebody has to be free of all sides of hulls, too, and of the brushes as the level gives them: hulls are
// rounded, and between two of them may be a crack.
#pragma once

#include <cstddef>
#include <functional>

#include "exact/cell/convex_cell.h"
#include "scene/levels/bsp_file.h"
#include "scene/levels/bsp_solids.h"
#include "scene/mesh/flagged_mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::app {

// Sight lines that prove nothing leave the judgement, and what was seen by them becomes undecided, missing or listed. How many there were.
std::size_t take_back(validate::Judgement& judgement,
                      const std::function<bool(const validate::Witness&)>& proves_nothing);

class WholeLevel {
 public:
  explicit WholeLevel(const scene::BspFile& level);

  const scene::FlaggedMesh& scene() const { return whole_; }  // with all sides of hulls

  double far_plane() const { return far_plane_; }  // as in scene/levels/bsp_file.h

  // Whether the sight line from this cell is free in the whole level: of all sides of hulls, and of the brushes, before its end.
  bool confirms(const exact::ConvexCell& cell, const validate::Witness& witness) const {
    return is_free_of_brushes(witness) && is_free_of_hulls(cell, witness);
  }
  bool is_free_of_brushes(const validate::Witness& witness) const;
  bool is_free_of_hulls(const exact::ConvexCell& cell, const validate::Witness& witness) const;

  // For who was judged in scene(): the lines that pass through brushes.
  void take_back(validate::Judgement& judgement) const;

 private:
  scene::FlaggedMesh whole_;
  scene::SolidBrushes brushes_;
  double far_plane_;
};

}  // namespace clues::app
