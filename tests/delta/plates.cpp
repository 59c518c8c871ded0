#include "tests/delta/plates.h"

#include "tests/reference/support.h"

namespace clues::test {

scene::TriangleMesh plates_and_a_box() {
  SceneBuilder scene;
  scene.plate(-1, -1, 1, 1, 4);
  scene.plate(-20, -20, 20, 20, 8);
  scene.box({5, -1, 1}, {7, 1, 3});
  return scene.mesh();
}

}  // namespace clues::test
