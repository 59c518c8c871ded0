// Four triangles in floats of the local frame: stage 1 of the segment queries (D5). It answers where its error bounds allow.
#pragma once

#include <array>
#include <cstdint>

#include "fastpath/predicates/float4.h"
#include "fastpath/queries/local_segment.h"

namespace clues::fastpath {

struct alignas(16) TriangleBlock {
  float corner[3][4];  // v0, wrong by at most 2^-25 (1 + 2^-20)
  float edge1[3][4];   // v1 - v0, v2 - v0, wrong by a relative 2^-24 (1 + 2^-20)
  float edge2[3][4];
  float size[4];        // >= every coordinate of the edges, >= kLeastSize
  std::uint32_t id[4];  // a block of fewer than four repeats its first triangle

  // Keeps the bounds, which are at least 2^-26 times its square (plane_error >= 6 c, edge_error >= 6 G d > 2^-46), above 2^-90.
  static constexpr double kLeastSize = 0x1p-30;
};

struct BlockAnswer {
  unsigned hit = 0, unsure = 0;  // one bit a lane; the other lanes are missed
};

// The line a + t along meets the plane of a triangle at t = T / den, at the barycentric coordinates W, U, V over den (local_segment.cpp has the formulas
// and their error bounds). -T and den - T tell the sides of the plane on which the ends are. The open segment crosses the triangle when these
// differ and none of U, V, W is on the other side of zero than another; all of that certainly, or stage 2 decides.
class BlockTest {
 public:
  explicit BlockTest(const LocalSegment& s)
      : edge_error_(all_lanes(s.edge_error)),
        sum_error_(all_lanes(s.sum_error)),
        sum_error_2_(all_lanes(s.sum_error_2)),
        plane_error_(all_lanes(s.plane_error)) {
    for (std::size_t i = 0; i < 3; ++i) {
      start_[i] = all_lanes(s.start[i]);
      along_[i] = all_lanes(s.along[i]);
    }
  }

  BlockAnswer operator()(const TriangleBlock& b) const {
    const Float4 cx = load4(b.corner[0]) - start_[0], cy = load4(b.corner[1]) - start_[1],
                 cz = load4(b.corner[2]) - start_[2];
    const Float4 rx = cy * along_[2] - cz * along_[1], ry = cz * along_[0] - cx * along_[2],
                 rz = cx * along_[1] - cy * along_[0];
    const Float4 fx = load4(b.edge1[0]), fy = load4(b.edge1[1]), fz = load4(b.edge1[2]);
    const Float4 gx = load4(b.edge2[0]), gy = load4(b.edge2[1]), gz = load4(b.edge2[2]);
    const Float4 nx = fy * gz - fz * gy, ny = fz * gx - fx * gz, nz = fx * gy - fy * gx;
    const Float4 den = (nx * along_[0] + ny * along_[1]) + nz * along_[2];
    const Float4 u = (rx * gx + ry * gy) + rz * gz, v = -((rx * fx + ry * fy) + rz * fz), w = (den - u) - v;
    const Float4 t = (nx * cx + ny * cy) + nz * cz, t_end = t - den;

    const Float4 size = load4(b.size);
    const Float4 edge = size * edge_error_, sum = size * (sum_error_ + sum_error_2_ * size),
                 plane = size * size * plane_error_;
    const Float4 uv_low = min4(u, v), uv_high = max4(u, v), t_low = min4(t, t_end), t_high = max4(t, t_end);
    const Mask4 missed =
        (((uv_high > edge) | (w > sum)) & ((uv_low < -edge) | (w < -sum))) | (t_low > plane) | (t_high < -plane);
    const Mask4 hit =
        (((uv_low > edge) & (w > sum)) | ((uv_high < -edge) & (w < -sum))) & (t_low < -plane) & (t_high > plane);
    BlockAnswer answer;
    answer.hit = bits_of(hit);
    answer.unsure = bits_of(~(missed | hit));
    return answer;
  }

 private:
  std::array<Float4, 3> start_{}, along_{};
  Float4 edge_error_, sum_error_, sum_error_2_, plane_error_;
};

}  // namespace clues::fastpath
