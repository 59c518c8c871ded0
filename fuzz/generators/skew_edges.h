// Scenes whose visible region is bounded by EEE events: quadrics that sight lines through three mutually skew edges sweep. First-order maps show too much there,
// and refinement shows what it is worth.
#pragma once

#include "fuzz/generators/random_scenes.h"

namespace clues::fuzz {

// Two slits that cross each other at an angle, in two walls: their edges and those of the cell make the events.
GeneratedScene two_slits();

// Three half planes at different heights, whose edges are mutually skew and leave a twisted hole.
GeneratedScene three_skew_edges();

// Four slits, each across the one before: what is seen through them is a small part of what each lets through.
GeneratedScene keyhole();

}  // namespace clues::fuzz
