// Scenes whose cell lies in the plane of geometry (D5, T10): a floor in several triangles, walls on its seams, and small things right above and below it.
#include <cmath>
#include <utility>

#include "fuzz/generators/parts.h"
#include "fuzz/generators/touching_scenes.h"

namespace clues::fuzz {
namespace {

using scene::Point;

class Floors {
 public:
  Floors(std::uint64_t seed, std::uint64_t index) : random_(random_of(seed, index, 14)), dial_(dial_of(index)) {}

  // The floor is at 0 on the third axis, the seam runs along the first; then the axes are exchanged.
  GeneratedScene make() {
    add_floor();
    for (int n = random_.between(1, 2); n > 0; --n) add_wall();
    for (int n = dial_ < 4 ? random_.between(1, 4) : hidden_; n > 0; --n) add_small(upper_);
    for (int n = random_.between(1, 2); n > 0; --n) add_small(random_.one_in(4) ? upper_ : -upper_);
    add_cell();
    turn();
    return std::move(scene_);
  }

 private:
  static constexpr int hidden_ = 66;  // with them the scene is too large to be mapped as it is

  double quarter(int low, int high) { return random_.between(4 * low, 4 * high) / 4.0; }

  // Two triangles that share the seam, or only part of it; then perhaps one more beyond.
  void add_floor() {
    const Point a{-wide_, seam_, 0}, b{wide_, seam_, 0};
    add(scene_.mesh, a, b, {quarter(-2, 2), -wide_, 0});
    const double by = random_.one_in(3) ? quarter(-2, 2) : 0;
    const Point far{quarter(-8, 8), seam_ + random_.between(2, 40), 0};
    add(scene_.mesh, {a[0] + by, seam_, 0}, {b[0] + by, seam_, 0}, far);
    if (random_.one_in(3)) add(scene_.mesh, {b[0] + by, seam_, 0}, far, {wide_, far[1] + 4, 0});
  }

  // On the seam or part of it, on one side of the floor; seldom through it.
  void add_wall() {
    const bool part = random_.one_in(3);
    const double left = part ? -quarter(1, 6) : -wide_, right = part ? quarter(1, 6) : wide_;
    const double foot = random_.one_in(8) ? -upper_ : 0;
    add(scene_.mesh, {left, seam_, foot}, {right, seam_, foot},
        {quarter(-2, 2), seam_ + quarter(-1, 1), upper_ * random_.between(1, 64)});
  }

  void add_small(double side) {
    const Point at{quarter(-2, 2), seam_ + random_.between(1, 32) / 4.0, side * std::ldexp(1, -random_.between(0, 8))};
    const double size = 0.0625;
    const double tip = random_.one_in(8) ? -at[2] : at[2];  // through the floor
    add(scene_.mesh, at, {at[0] + size, at[1], at[2]}, {at[0], at[1] + size, tip});
  }

  void add_cell() {
    const double x = random_.one_in(4) ? 0 : random_.between(1, 8) / 4.0,
                 y = random_.one_in(3) ? 0 : random_.between(1, 8) / 4.0;
    scene_.cell =
        distinct_corners({-x, -y, 0}, {x, y, random_.one_in(8) ? 1.0 : 0.0});  // seldom a solid that stands on it
  }

  void turn() {
    const auto axes = shuffled_axes(random_);
    for (auto* points : {&scene_.mesh.points, &scene_.cell}) {
      for (Point& p : *points) {
        const Point q = p;
        for (std::size_t i = 0; i < 3; ++i) p[axes[i]] = q[i];
      }
    }
  }

  Random random_;
  int dial_;
  double wide_ = std::ldexp(1, random_.between(2, 6)), seam_ = random_.between(1, 4);
  double upper_ = random_.one_in(2) ? 1 : -1;
  GeneratedScene scene_;
};

}  // namespace

GeneratedScene floors_under_cells(std::uint64_t seed, std::uint64_t index) { return Floors(seed, index).make(); }

}  // namespace clues::fuzz
