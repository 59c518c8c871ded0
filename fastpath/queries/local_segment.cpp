// Where the error bounds of stage 1 come from. u = 2^-24 is the unit of float; everything here is computed in double, with a factor to
// spare for its own roundings.
#include "fastpath/queries/local_segment.h"

#include <algorithm>
#include <cmath>

#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

// Every bound is raised by this factor: it pays for the roundings of the bound itself (some 20 of a relative 2^-24 at most), for second-order
// terms that the derivation leaves out (products of two relative errors below 2^-20), and for underflow in the lanes: bounds are
// at least 2^-90 (see triangle_block.h), a 2^-10 of that is 2^-100, and 40 operations that lose 2^-126 each, times factors
// below 2^6, lose 2^-114.
constexpr double kSpare = 1 + 0x1p-10;

constexpr double kReach = 0x1p20;      // beyond: no floats
constexpr double kClip = 1 + 0x1p-10;  // segments are clipped to [-kClip, kClip]^3; the scene is in [-1,1]^3

// A segment about which stage 1 knows nothing: it meets every box, and every bound is larger than every value.
void make_unknown(LocalSegment& out) {
  out = LocalSegment{};
  for (std::size_t i = 0; i < 3; ++i) {
    out.near_origin[i] = 4;
    out.far_origin[i] = -4;
    out.inverse[i] = 0.25F;
    out.forward[i] = true;
  }
  out.edge_error = out.sum_error = out.plane_error = 0x1p80F;
}

}  // namespace

// C = v0 - start, R = C x along, N = e1 x e2, den = N.along, U = R.e2, V = -R.e1, W = den - U - V, T = N.C, as triangle_block.h computes
// them. Write G >= |C|, D >= |along|, E >= |e1|, |e2| (largest coordinates; rounded and exact values), and c, d for the errors of C and along; v0
// is wrong by at most 2^-25 (1 + 2^-20), an edge by a relative u(1 + 2^-20) of E.
//   C:    c = 2^-25 + start_error + u G
//   R:    two products each: 2 (c D + G d), rounded: u G D each and 2 u G D for their difference: 4 u G D; |R| <= 2 G D
//   U, V: three products: 3 (r E + 2 G D u E), rounded: each term of 2 G D E at most three times: 18 u G D E
//   N:    two products: 4 u E^2, rounded 4 u E^2: n = 8 u E^2; |N| <= 2 E^2
//   den:  three products: 3 (n D + 2 E^2 d) + 18 u E^2 D = E^2 (42 u D + 6 d)
//   T:    3 (n G + 2 E^2 c) + 18 u E^2 G = E^2 (42 u G + 6 c)
//   T - den: both, and u |T - den| <= 6 u E^2 (G + D)
//   W:    den, U and V, and two differences: u (2 |den| + 2 |U| + |V|) <= 12 u E^2 D + 18 u G D E
void set_triangle_bounds(const LocalErrors& e, LocalSegment& out) {
  constexpr double u = kFloatUnit;
  const double start_error = e.start_error * kSpare, d = e.along_error * kSpare;
  const double G = e.start_size + 1.001, D = e.along_size;
  const double c = (0x1p-25 + start_error + u * G) * kSpare;
  const double r = 2 * (c * D + G * d) + 4 * u * G * D;
  const double edge = 3 * (r + 2 * u * G * D) + 18 * u * G * D;
  const double den = 42 * u * D + 6 * d, t = 42 * u * G + 6 * c;
  out.edge_error = static_cast<float>(edge * kSpare);
  out.plane_error = static_cast<float>((den + t + 6 * u * (G + D)) * kSpare);
  out.sum_error = static_cast<float>((2 * edge + 18 * u * G * D) * kSpare);
  out.sum_error_2 = static_cast<float>((den + 12 * u * D) * kSpare);
}

Reach make_local(const LocalFrame& frame, const Segment& s, LocalSegment& out) {
  std::array<double, 3> a{}, b{};
  double size = 0;
  bool near = true;  // false for anything that is not a number, too
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = frame.to_local(s.a[i], i);
    b[i] = frame.to_local(s.b[i], i);
    near = near && std::fabs(a[i]) <= kReach && std::fabs(b[i]) <= kReach;
    size = std::max({size, std::fabs(a[i]), std::fabs(b[i])});
  }
  if (!near) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::isfinite(s.a[i]) || !std::isfinite(s.b[i])) {
        throw scene::Error(scene::ErrorCode::non_finite, "an end point of a segment is not finite");
      }
    }
    make_unknown(out);
    return Reach::may_meet;
  }
  // Rounded coordinates are within 2^-53 size of exact ones (and 2^-1074), their difference b - a within 2^-51 size. A point a + t (b - a),
  // 0 <= t <= 1, computed so, is within 2^-50 size <= 2^-30 of the exact one; so is the parameter of a side of the clip box from where the exact
  // segment passes that side, measured along the axis. The clip box leaves 2^-10 for that.
  out.begin = 0;
  out.end = 1;
  std::array<double, 3> from = a, to = b;
  if (size > kClip) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = b[i] - a[i];
      if (along == 0) {
        if (std::fabs(a[i]) > kClip) return Reach::misses;
        continue;
      }
      const double low = (-kClip - a[i]) / along, high = (kClip - a[i]) / along;
      out.begin = std::max(out.begin, std::min(low, high));
      out.end = std::min(out.end, std::max(low, high));
    }
    if (out.begin > out.end) return Reach::misses;
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = a[i] + out.begin * (b[i] - a[i]);
      to[i] = out.end == 1 ? b[i] : a[i] + out.end * (b[i] - a[i]);
    }
  }
  const double rounding = 0x1p-49 * std::max(size, 1.0);

  LocalErrors e;
  for (std::size_t i = 0; i < 3; ++i) {
    out.start[i] = static_cast<float>(from[i]);
    const double along = to[i] - from[i];
    out.along[i] = static_cast<float>(along);
    e.start_size = std::max(e.start_size, std::fabs(from[i]));
    e.along_size = std::max(e.along_size, std::fabs(along));
  }
  e.start_error = kFloatUnit * e.start_size + rounding;
  e.along_error = kFloatUnit * e.along_size + 2 * rounding;
  e.start_size += e.start_error;
  e.along_size += e.along_error;
  set_triangle_bounds(e, out);

  // |float point - exact point| <= start_error + along_error. A component of `along` nearer to zero than that is replaced by it, which moves points by
  // as much again; then quotients stay below 2^26 and nothing is infinite. Rounding the origins costs u each.
  const double position = static_cast<float>((e.start_error + e.along_error) * kSpare);
  const double reach = (2 * position + kFloatUnit * (e.start_size + 1)) * kSpare;
  for (std::size_t i = 0; i < 3; ++i) {
    float along = out.along[i];
    if (std::fabs(static_cast<double>(along)) < position) along = std::copysign(static_cast<float>(position), along);
    out.forward[i] = along > 0;
    const double toward = along > 0 ? reach : -reach;
    out.near_origin[i] = static_cast<float>(static_cast<double>(out.start[i]) + toward);
    out.far_origin[i] = static_cast<float>(static_cast<double>(out.start[i]) - toward);
    out.inverse[i] = 1.0F / along;
  }
  return Reach::may_meet;
}

}  // namespace clues::fastpath
