// Motion bounds: the predicates, the bounds, and a frame of a walk - with bounds, examining all, and made anew - by the number of triangles.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <vector>

#include "exact/motion/constraints.h"
#include "fastpath/motion/walk.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random.h"

namespace {

using namespace clues::fastpath::motion;

// Four samples of a wall, as a mesh of 22,000 triangles sees it.
struct Quadrangle {
  std::array<DepthSample, 4> samples;
  std::array<Row, 4> rows;
};

std::vector<Quadrangle> quadrangles() {
  clues::fuzz::Random random(1);
  const auto jitter = [&] { return 0.01 * static_cast<double>(random.between(-1000, 1000)) / 1000; };
  std::vector<Quadrangle> all(1024);
  for (Quadrangle& q : all) {
    constexpr std::array<std::array<double, 2>, 4> square{{{0, 0}, {0.04, 0}, {0, 0.04}, {0.05, 0.05}}};
    for (std::size_t i = 0; i < 4; ++i) {
      q.samples[i].at = {square[i][0] + jitter(), square[i][1] + jitter(), 1 + jitter()};
      q.rows[i] = row_of(q.samples[i], {0, 0, 0});
    }
  }
  return all;
}

void delaunay_sign_filtered(benchmark::State& state) {
  const auto all = quadrangles();
  std::size_t k = 0;
  for (auto _ : state) {
    const auto& r = all[k++ % all.size()].rows;
    benchmark::DoNotOptimize(delaunay_filtered(r[0], r[1], r[2], r[3]));
  }
}
BENCHMARK(delaunay_sign_filtered);

void delaunay_sign_filtered_from_points(benchmark::State& state) {
  const auto all = quadrangles();
  std::size_t k = 0;
  for (auto _ : state) {
    const auto& s = all[k++ % all.size()].samples;
    const MotionPoint at{1e-3, 0, 0};
    benchmark::DoNotOptimize(delaunay_filtered(row_of(s[0], at), row_of(s[1], at), row_of(s[2], at), row_of(s[3], at)));
  }
}
BENCHMARK(delaunay_sign_filtered_from_points);

void delaunay_sign_exact(benchmark::State& state) {
  const auto all = quadrangles();
  std::size_t k = 0;
  for (auto _ : state) {
    const auto& s = all[k++ % all.size()].samples;
    const auto row = [&](std::size_t i) { return clues::exact::sight_row(s[i], MotionPoint{0, 0, 0}); };
    benchmark::DoNotOptimize(clues::exact::delaunay_sign(row(0), row(1), row(2), row(3)));
  }
}
BENCHMARK(delaunay_sign_exact);

void bound_of_triangle(benchmark::State& state) {
  const auto all = quadrangles();
  const BoundThresholds thresholds({});
  std::size_t k = 0;
  for (auto _ : state) {
    const auto& r = all[k++ % all.size()].rows;
    benchmark::DoNotOptimize(triangle_bound(r[0], r[1], r[2], thresholds));
  }
}
BENCHMARK(bound_of_triangle);

void bound_of_delaunay(benchmark::State& state) {
  const auto all = quadrangles();
  std::size_t k = 0;
  for (auto _ : state) {
    const auto& r = all[k++ % all.size()].rows;
    benchmark::DoNotOptimize(delaunay_bound(r[0], r[1], r[2], r[3]));
  }
}
BENCHMARK(bound_of_delaunay);

// Down a street of a city of 20,000 triangles, 1.5 m a second at 60 frames a second.
void frame(benchmark::State& state, WalkOptions::Bounds bounds, bool delaunay) {
  const auto mesh = clues::fuzz::make_city(20000, 1);
  const clues::fastpath::Bvh bvh(mesh);
  WalkOptions options;
  options.samples = static_cast<std::uint32_t>(state.range(0));
  options.bounds = bounds;
  options.thresholds.delaunay = delaunay;
  const auto cell = clues::fuzz::street_cell(20000, 1);
  MotionPoint at{cell[0][0] - 1.5, cell[0][1], cell[0][2]};
  Walk walk(bvh, options, at);
  std::uint64_t examined = 0, triangles = 0;
  for (auto _ : state) {
    at[1] += 0.025;
    const FrameReport report = walk.move_to(at);
    examined += report.examined;
    triangles += report.triangles;
  }
  state.counters["examined"] = static_cast<double>(examined) / static_cast<double>(triangles);
}
using Bounds = WalkOptions::Bounds;
BENCHMARK_CAPTURE(frame, bounds, Bounds::sound, false)->Arg(2750)->Arg(11000)->Arg(44000)->Arg(100000)->Iterations(300);
BENCHMARK_CAPTURE(frame, examine_all, Bounds::none, false)->Arg(11000)->Iterations(100);
BENCHMARK_CAPTURE(frame, rebuild, Bounds::rebuild, false)->Arg(11000)->Iterations(10);
BENCHMARK_CAPTURE(frame, delaunay_bounds, Bounds::sound, true)
    ->Arg(2750)
    ->Arg(11000)
    ->Arg(44000)
    ->Arg(100000)
    ->Iterations(300);
BENCHMARK_CAPTURE(frame, delaunay_examine_all, Bounds::none, true)->Arg(11000)->Iterations(100);
BENCHMARK_CAPTURE(frame, delaunay_rebuild, Bounds::rebuild, true)->Arg(11000)->Iterations(10);

}  // namespace

BENCHMARK_MAIN();
