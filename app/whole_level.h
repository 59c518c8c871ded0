// To leave out what blocks makes more visible: fine for lists, but not for an accusation. So a sight line through a level
// that accuses somebody has to be free of all sides of hulls, too.
#pragma once

#include <vector>

#include "scene/levels/bsp_file.h"
#include "scene/mesh/flagged_mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::app {

class WholeLevel {
 public:
  explicit WholeLevel(const scene::BspFile& level);

  // Whether the sight line from this cell is free in the whole level.
  bool confirms(const std::vector<scene::Point>& cell, const validate::Witness& witness) const;

 private:
  scene::FlaggedMesh whole_;
};

}  // namespace clues::app
