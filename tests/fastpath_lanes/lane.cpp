// Prints a digest of everything that the floating-point path computes for a fixed set of segments: bits of determinants, bounds and local segments,
// answers and counts. Built twice, for the plain machine and for one with fused multiply-add: the two must print the same.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include "fastpath/queries/segment_queries.h"
#include "fastpath/queries/shaft.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random.h"

namespace {

using namespace clues::fastpath;

class Digest {  // FNV-1a over the bits of numbers
 public:
  template <class Number>
  void add(const Number& x) {
    unsigned char bytes[sizeof(Number)];
    std::memcpy(bytes, &x, sizeof x);
    for (const unsigned char b : bytes) state_ = (state_ ^ b) * 0x100000001b3ULL;
  }
  unsigned long long value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

double uniform(clues::fuzz::Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }

}  // namespace

int main() {
#if defined(__FMA__)
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2")) {
    std::puts("SKIPPED: this processor has no fused multiply-add");
    return 0;
  }
#endif
  require_float_rules();
  auto mesh = clues::fuzz::make_city(3000, 1);
  for (auto& p : mesh.points) {
    for (double& x : p) x = x * 0.1 + 0.3;
  }
  const auto cell = clues::fuzz::street_cell(3000, 1);
  const Bvh bvh(mesh);
  SegmentQueries queries(bvh);
  clues::fuzz::Random random(1);
  Digest values, answers;
  for (int i = 0; i < 20000; ++i) {
    const auto t = static_cast<std::uint32_t>(random.next() % mesh.triangles.size());
    const Corners corners = bvh.corners(t);
    const double along = random.one_in(3) ? 0 : uniform(random);
    Segment s;
    for (std::size_t k = 0; k < 3; ++k) {
      const double target = corners[0][k] + along * (corners[1][k] - corners[0][k]);
      s.a[k] = target + 10 * (uniform(random) - 0.5);
      s.b[k] = i % 2 == 0 ? 2 * target - s.a[k] : target + 10 * (uniform(random) - 0.5);
    }
    const Filtered f = orient3d_value(corners[0], corners[1], corners[2], s.a);
    values.add(f.value);
    values.add(f.bound);
    const Range range = crossing_parameter(s, corners);
    values.add(range.low);
    values.add(range.high);
    LocalSegment local;
    if (make_local(bvh.frame(), s, local) == Reach::may_meet) {
      for (std::size_t k = 0; k < 3; ++k) {
        values.add(local.near_origin[k]);
        values.add(local.far_origin[k]);
        values.add(local.inverse[k]);
      }
      values.add(local.edge_error);
      values.add(local.sum_error);
      values.add(local.plane_error);
    }
    answers.add(queries.any_hit(s));
    const auto first = queries.first_hit(s);
    answers.add(first ? *first : ~0U);
    for (const std::uint32_t hit : queries.all_hits(s)) answers.add(hit);
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); t += 10) {
    for (const std::uint32_t id : shaft_candidates_conservative(bvh, Shaft(bvh.frame(), bvh.corners(t), cell)))
      answers.add(id);
  }
  const SegmentCounts& c = queries.counts();
  std::printf("values %016llx answers %016llx queries %llu blocks %llu doubles %llu exact %llu\n", values.value(),
              answers.value(), static_cast<unsigned long long>(c.queries), static_cast<unsigned long long>(c.blocks),
              static_cast<unsigned long long>(c.doubles), static_cast<unsigned long long>(c.exact));
  return c.doubles > 0 && c.exact > 0 ? 0 : 1;
}
