// What lists draw: pictures by a software rasteriser (OSMesa), in which each pixel holds the number of the triangle drawn there. Two lists with the same
// visible triangles draw the same pixels from every point of the cell, up to what a rasteriser rounds.
#pragma once

#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::tests {

// One picture at a time; each is a square with a field of view of 90 degrees, so that six of them show all around.
class Pictures {
 public:
  // Throws std::runtime_error where the library gives no context. `nearest`: what is nearer than that is not drawn.
  Pictures(int pixels, double nearest, double farthest);

  // Triangles `coloured`, then `plain` ones in one colour, looking along an axis (0 to 5: -x, x, -y, y, -z, z). A pixel is 0 where nothing is drawn, 1 for a
  // plain triangle, and t + 2 for triangle t.
  std::vector<std::uint32_t> draw(const scene::TriangleMesh& mesh, const std::vector<std::uint32_t>& coloured,
                                  const std::vector<std::uint32_t>& plain, const scene::Point& eye, int direction);

 private:
  struct Destroy {
    void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
  };

  int pixels_;
  double nearest_, farthest_;
  std::vector<std::uint32_t> frame_;
  std::unique_ptr<osmesa_context, Destroy> context_;
};

}  // namespace clues::tests
