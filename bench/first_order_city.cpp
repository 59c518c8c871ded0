// First-order visibility of one street cell in generated cities, one thread: time, memory, growth exponent, and how much work it was.
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "exact/convex_cell.h"
#include "fuzz/generators/city.h"
#include "reference/visibility/first_order.h"

int main() {
  constexpr std::uint64_t kSeed = 1;
  constexpr int kRepeats = 3;
  fmt::print("{:>10} {:>9} {:>8} {:>9} {:>8} {:>8} {:>8} {:>9} {:>10}\n", "triangles", "median s", "growth", "visible",
             "wedges", "CSVs", "walks", "fallbacks", "peak MiB");
  double last_time = 0, last_size = 0;
  for (const std::uint32_t size : {300U, 1000U, 3000U, 10000U}) {
    const auto mesh = clues::fuzz::make_city(size, kSeed);
    const auto cell = clues::exact::ConvexCell::from_doubles(clues::fuzz::street_cell(size, kSeed));
    clues::reference::Options options;
    options.threads = 1;
    std::array<double, kRepeats> seconds{};
    clues::reference::Statistics s;
    std::size_t visible = 0;
    for (double& t : seconds) {
      const auto start = std::chrono::steady_clock::now();
      const auto map = clues::reference::first_order_visibility(mesh, cell, options);
      t = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      s = map.statistics;
      visible = map.visible.size();
    }
    std::sort(seconds.begin(), seconds.end());
    const double time = seconds[kRepeats / 2], n = static_cast<double>(mesh.triangles.size());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("{:>10} {:>9.2f} {:>8} {:>9} {:>8} {:>8} {:>8} {:>9} {:>10.0f}\n", mesh.triangles.size(), time,
               last_size > 0 ? fmt::format("n^{:.2f}", std::log(time / last_time) / std::log(n / last_size)) : "-",
               visible, s.sv_me + s.se_me + s.se_mv, s.csv, s.walks, s.conservative_fallbacks,
               static_cast<double>(usage.ru_maxrss) / 1024);
    last_time = time;
    last_size = n;
  }
}
