// The fast path in generated cities: PVS of one street cell, time and growth from 3,000 to 1,000,000 triangles; against the exact reference where that is bearable;
// and the same visible part with more and more hidden city behind it. All threads unless a number is given.
#include <fmt/core.h>
#include <sys/resource.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/parts.h"
#include "reference/visibility/first_order.h"

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::uint64_t kSeed = 1;

// Times of runs, of which the median counts.
class Times {
 public:
  // At least once, and so often that it takes about so many seconds.
  template <class Work>
  void run(double about, const Work& work) {
    for (double sum = 0; sum <= about;) {
      const auto start = Clock::now();
      work();
      seconds_.push_back(std::chrono::duration<double>(Clock::now() - start).count());
      sum += seconds_.back();
    }
  }
  double median() {
    if (seconds_.empty()) return 0;
    std::sort(seconds_.begin(), seconds_.end());
    return seconds_[seconds_.size() / 2];
  }

 private:
  std::vector<double> seconds_;
};

void cities() {
  fmt::print("{:>10} {:>8} {:>9} {:>8} {:>8} {:>7} {:>7} {:>7} {:>9} {:>9} {:>10} {:>9} {:>8}\n", "triangles", "tree s",
             "median s", "growth", "visible", "part", "passes", "boxes", "wedges", "exact", "fallbacks", "peak MiB",
             "ratio");
  double last_time = 0, last_size = 0;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  for (const std::uint32_t size : {300U, 1000U, 3000U, 10000U, 100000U, 1000000U}) {
    const auto mesh = clues::fuzz::make_city(size, kSeed);
    const auto cell = clues::fuzz::street_cell(size, kSeed);
    const auto start = Clock::now();
    const clues::fastpath::Bvh bvh(mesh);
    const double tree = std::chrono::duration<double>(Clock::now() - start).count();
    clues::fastpath::FirstOrder fast;
    clues::reference::Options options;
    options.threads = tbb::this_task_arena::max_concurrency();
    const auto exact_cell = clues::exact::ConvexCell::from_doubles(cell);
    std::vector<std::uint32_t> visible;
    Times fast_times, exact_times;
    for (int round = 0; round < 5; ++round) {  // in turn, so that both have their share of what else the machine does
      fast_times.run(0.2, [&] { fast = clues::fastpath::first_order_visibility(bvh, cell, {}); });
      if (size > 3000) continue;
      exact_times.run(0,
                      [&] { visible = clues::reference::first_order_visibility(mesh, exact_cell, options).visible; });
      if (visible != fast.visible)
        fmt::print("the two do not agree: {} and {} visible\n", visible.size(), fast.visible.size());
    }
    const double time = fast_times.median(), exact = exact_times.median();
    const auto n = static_cast<double>(mesh.triangles.size());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("{:>10} {:>8.2f} {:>9.3f} {:>8} {:>8} {:>7} {:>7} {:>7} {:>9} {:>9} {:>10} {:>9.0f} {:>8}\n", n, tree,
               time,
               last_size > 0 ? fmt::format("n^{:.2f}", std::log(time / last_time) / std::log(n / last_size)) : "-",
               fast.visible.size(), fast.closure.mapped, fast.closure.passes, fast.closure.boxes_opened,
               fast.counts.wedges, fast.counts.exact_decisions, fast.conservative_fallbacks,
               static_cast<double>(usage.ru_maxrss) / 1024, exact > 0 ? fmt::format("{:.0f}", exact / time) : "-");
    last_time = time;
    last_size = n;
  }
}

// A town under a closed roof, and beside it, wholly hidden, another that is doubled six times.
clues::scene::TriangleMesh town_beside_hidden_city(std::uint32_t hidden) {
  auto mesh = clues::fuzz::make_city(1000, kSeed);
  const auto append = [&](const clues::scene::TriangleMesh& other, double shift) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& p : other.points) mesh.points.push_back({p[0] + shift, p[1], p[2]});
    for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  clues::scene::Point low = mesh.points[0], high = low;
  for (const auto& p : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i] - 8);
      high[i] = std::max(high[i], p[i] + 8);
    }
  }
  append(clues::fuzz::closed_box(low, high), 0);
  append(clues::fuzz::make_city(hidden, kSeed), 2 * (high[0] - low[0]));
  mesh.face_of.resize(mesh.triangles.size());
  return mesh;
}

void hidden_depth() {
  fmt::print(
      "\na town of 1000 triangles under a roof, and a hidden city beside it\n{:>10} {:>9} {:>8} {:>8} {:>7} {:>8}\n",
      "triangles", "median s", "to first", "visible", "part", "wedges");
  double first = 0;
  const auto cell = clues::fuzz::street_cell(1000, kSeed);
  for (std::uint32_t hidden = 2000; hidden <= 128000; hidden *= 2) {
    const auto mesh = town_beside_hidden_city(hidden);
    const clues::fastpath::Bvh bvh(mesh);
    clues::fastpath::FirstOrder fast;
    Times times;
    times.run(0.5, [&] { fast = clues::fastpath::first_order_visibility(bvh, cell, {}); });
    const double time = times.median();
    if (first == 0) first = time;
    fmt::print("{:>10} {:>9.3f} {:>8.2f} {:>8} {:>7} {:>8}\n", mesh.triangles.size(), time, time / first,
               fast.visible.size(), fast.closure.mapped, fast.counts.wedges);
  }
}

}  // namespace

int main(int argc, char** argv) {
  tbb::task_arena arena(argc > 1 ? std::atoi(argv[1]) : tbb::task_arena::automatic);
  fmt::print("{} threads\n", arena.max_concurrency());
  arena.execute([] {
    cities();
    hidden_depth();
  });
}
