// A scene to look at from two cells that share a face.
#pragma once

#include "scene/mesh/mesh.h"

namespace clues::test {

// A plate below a receiver, under which two cells lie side by side, and an edge of the scene at which what is seen ends.
scene::TriangleMesh plates_and_a_box();

}  // namespace clues::test
