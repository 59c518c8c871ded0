// Stage 1: the bounds of local_segment.cpp recomputed in rationals without leaving anything out, and held against errors seen.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fastpath/queries/local_segment.h"
#include "fastpath/queries/triangle_block.h"
#include "oracle.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

using Q = mpq_class;

// A value of size at most `size`, computed with an error of at most `error`.
struct Rough {
  Q size, error;
};

const Q kU(0x1p-24);

// Exact sizes times errors of both, then one rounding of the largest computed value.
Rough rounded(const Rough& x) { return {x.size, x.error + kU * (x.size + x.error)}; }
Rough product(const Rough& x, const Rough& y) {
  return rounded({x.size * y.size, x.error * y.size + y.error * x.size + x.error * y.error});
}
Rough sum(const Rough& x, const Rough& y) { return rounded({x.size + y.size, x.error + y.error}); }
Rough dot(const Rough& x, const Rough& y) {
  const Rough p = product(x, y);
  return sum(sum(p, p), p);
}
Rough cross(const Rough& x, const Rough& y) {
  const Rough p = product(x, y);
  return sum(p, p);
}

TEST(Bounds, AreAtLeastWhatRunningErrorAnalysisGives) {
  fuzz::Random random(kSeed);
  for (int i = 0; i < 400; ++i) {
    LocalErrors e;
    e.along_size = std::ldexp(1.0, -random.between(0, 40)) * 2;
    e.start_size = 1.001 * (1 + random_double(random)) / 2;
    e.along_error = 0x1p-24 * e.along_size + 0x1p-48;
    e.start_error = 0x1p-24 * e.start_size + 0x1p-49;
    LocalSegment s;
    set_triangle_bounds(e, s);
    // Edges from the least size to the diameter of the scene.
    const Q size(std::ldexp(1.0, 1 - random.between(0, 31)));
    const Q edge_unit = kU * (1 + Q(0x1p-20));
    const Rough edge{size, size * edge_unit};
    const Rough start{Q(e.start_size), Q(e.start_error)}, along{Q(e.along_size), Q(e.along_error)};
    const Rough corner{Q(1), Q(0x1p-25) * (1 + Q(0x1p-20))};
    const Rough c = sum(corner, start), r = cross(c, along), n = cross(edge, edge);
    const Rough u = dot(r, edge), den = dot(n, along), t = dot(n, c), w = sum(sum(den, u), u), t_end = sum(t, den);
    EXPECT_GE(Q(s.edge_error) * size, u.error);
    EXPECT_GE(Q(s.plane_error) * size * size, t.error);
    EXPECT_GE(Q(s.plane_error) * size * size, t_end.error);
    EXPECT_GE((Q(s.sum_error) + Q(s.sum_error_2) * size) * size, w.error);
    // ... and not twice as much.
    EXPECT_LE(Q(s.edge_error) * size, 2 * u.error);
    EXPECT_LE(Q(s.plane_error) * size * size, 2 * t_end.error);
    // Above what underflow can do (local_segment.cpp).
    EXPECT_GE(s.edge_error, 0x1p-46F);
    EXPECT_GE(s.plane_error, 0x1p-26F);
  }
}

// The float segment against exact local coordinates, for end points inside and outside the scene.
TEST(Bounds, TheFloatSegmentIsWithinItsErrors) {
  fuzz::Random random(kSeed);
  int clipped = 0;
  for (int i = 0; i < 3000; ++i) {
    const double offset = i % 4 == 0 ? 1e7 : 0.1;
    const double width = std::ldexp(1.0, random.between(-8, 8));
    const LocalFrame frame =
        LocalFrame::of_box({offset, offset, offset}, {offset + width, offset + width, offset + 0.7 * width});
    Segment s;
    const double reach = i % 3 == 0 ? 1000 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      s.a[k] = offset + width * (0.5 + 0.5 * reach * random_double(random));
      s.b[k] = offset + width * (0.5 + 0.5 * random_double(random));
    }
    LocalSegment local;
    ASSERT_EQ(make_local(frame, s, local), Reach::may_meet);
    clipped += local.begin > 0 || local.end < 1 ? 1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto exact = [&](double x) { return Q((Q(x) - Q(frame.center[k])) * Q(frame.scale)); };
      for (const double part : {0.0, 0.3, 1.0}) {
        const Q where = Q(local.begin) + Q(part) * (Q(local.end) - Q(local.begin));
        const Q meant = exact(s.a[k]) + where * (exact(s.b[k]) - exact(s.a[k]));
        // What the box test takes: between the origins, along 1 / inverse.
        const Q along = (local.forward[k] ? 1 : -1) * abs(1 / Q(local.inverse[k]));
        const Q near = Q(local.near_origin[k]) + Q(part) * along, far = Q(local.far_origin[k]) + Q(part) * along;
        ASSERT_LE(std::min(near, far), meant) << i;
        ASSERT_GE(std::max(near, far), meant) << i;
        ASSERT_LE(abs(near - far), Q(0x1p-20)) << i;  // not much wider than needed
      }
    }
  }
  EXPECT_GT(clipped, 300);
}

TEST(Bounds, TheFrameHoldsTheScene) {
  fuzz::Random random(kSeed);
  for (int power = -1074; power <= 1023; ++power) {
    const double size = std::ldexp(1.0, power), low = -size * (1 + random_double(random)) / 2, high = size;
    const LocalFrame frame = LocalFrame::of_box({low, 0, 0}, {high, 0, size / 4});
    for (const double x : {low, high}) {
      const Q local = (Q(x) - Q(frame.center[0])) * Q(frame.scale);
      ASSERT_LE(abs(local), 1) << "2^" << power;
      if (power > -1000 && power < 1000) {
        ASSERT_GT(abs(local), Q(0.2)) << "2^" << power;
      }
      ASSERT_LE(abs(Q(frame.to_local(x, 0)) - local), abs(local) * Q(0x1p-53) + Q(0x1p-1074)) << "2^" << power;
    }
  }
}

}  // namespace
}  // namespace clues::fastpath
