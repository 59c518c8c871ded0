#include "pictures.h"

#include <GL/gl.h>

#include <stdexcept>

#ifdef __SANITIZE_ADDRESS__
// What Mesa keeps to its end is no leak of ours.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace clues::tests {
namespace {

// Corners seen from the eye, which is where rounding to floats does least harm, and a colour that is a number.
struct Drawing {
  std::vector<std::array<float, 3>> corners;
  std::vector<std::uint32_t> colours;

  void add(const scene::TriangleMesh& mesh, std::uint32_t triangle, const scene::Point& eye, std::uint32_t number) {
    for (const auto corner : mesh.triangles[triangle]) {
      const auto& p = mesh.points[corner];
      corners.push_back(
          {static_cast<float>(p[0] - eye[0]), static_cast<float>(p[1] - eye[1]), static_cast<float>(p[2] - eye[2])});
      colours.push_back(number | 0xff000000U);
    }
  }
};

// The axis that is looked along becomes -z of the eye; another one becomes y.
std::array<float, 16> view_along(int direction) {
  const auto ahead = static_cast<std::size_t>(direction / 2);
  const float sign = direction % 2 == 0 ? -1.0F : 1.0F;
  std::array<float, 16> view{};  // by columns
  view[4 * ahead + 2] = -sign;
  view[4 * ((ahead + 1) % 3)] = 1;
  view[4 * ((ahead + 2) % 3) + 1] = 1;
  view[15] = 1;
  return view;
}

}  // namespace

Pictures::Pictures(int pixels, double nearest, double farthest)
    : pixels_(pixels),
      nearest_(nearest),
      farthest_(farthest),
      frame_(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels)),
      context_(OSMesaCreateContextExt(OSMESA_RGBA, 32, 0, 0, nullptr)) {
  if (!context_ || OSMesaMakeCurrent(context_.get(), frame_.data(), GL_UNSIGNED_BYTE, pixels, pixels) == GL_FALSE)
    throw std::runtime_error("OSMesa gives no context");
}

std::vector<std::uint32_t> Pictures::draw(const scene::TriangleMesh& mesh, const std::vector<std::uint32_t>& coloured,
                                          const std::vector<std::uint32_t>& plain, const scene::Point& eye,
                                          int direction) {
  Drawing drawing;
  for (const auto t : coloured) drawing.add(mesh, t, eye, t + 2);
  for (const auto t : plain) drawing.add(mesh, t, eye, 1);
  OSMesaMakeCurrent(context_.get(), frame_.data(), GL_UNSIGNED_BYTE, pixels_, pixels_);
  glViewport(0, 0, pixels_, pixels_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_DITHER);
  glShadeModel(GL_FLAT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-nearest_, nearest_, -nearest_, nearest_, nearest_, farthest_);
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixf(view_along(direction).data());
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, 0, drawing.corners.data());
  glColorPointer(4, GL_UNSIGNED_BYTE, 0, drawing.colours.data());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(drawing.corners.size()));
  glFinish();
  std::vector<std::uint32_t> picture = frame_;
  for (auto& pixel : picture) pixel &= 0xffffffU;
  return picture;
}

}  // namespace clues::tests
