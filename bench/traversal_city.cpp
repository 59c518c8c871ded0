// The traversal against the plain formulation, one street cell in generated cities, one thread: time, ratio, growth exponents, and what each looked at.
// Rounds are interleaved and times are of the processor, so that the ratio survives a busy machine. The maps must be the same.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <string>

#include "exact/cell/convex_cell.h"
#include "fuzz/generators/city.h"
#include "reference/visibility/first_order.h"

namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

// An argument is the largest size to try (default 10000).
int main(int argc, char** argv) {
  using clues::reference::Formulation;
  constexpr std::uint64_t kSeed = 1;
  constexpr std::size_t kRepeats = 3;
  const unsigned long largest = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 10000;
  fmt::print("{:>10} {:>9} {:>9} {:>7} {:>8} {:>8} {:>8} {:>8} {:>7} {:>11} {:>11} {:>12} {:>14}\n", "triangles",
             "plain s", "trav. s", "ratio", "growth", "growth", "visited", "seen", "passes", "sight lines",
             "shaft tests", "wedges built", "walks");
  std::array<double, 2> last{};
  double last_size = 0;
  for (const std::uint32_t size : {300U, 1000U, 3000U, 10000U}) {
    if (size > largest) break;
    const auto mesh = clues::fuzz::make_city(size, kSeed);
    const auto cell = clues::exact::ConvexCell::from_doubles(clues::fuzz::street_cell(size, kSeed));
    std::array<std::array<double, kRepeats>, 2> seconds{};
    std::array<clues::reference::Statistics, 2> s;
    std::array<std::vector<std::uint32_t>, 2> visible;
    for (std::size_t round = 0; round < kRepeats; ++round) {
      for (std::size_t which = 0; which < 2; ++which) {
        clues::reference::Options options;
        options.threads = 1;
        options.formulation = which == 0 ? Formulation::plain : Formulation::traversal;
        const double start = processor_seconds();
        const auto map = clues::reference::first_order_visibility(mesh, cell, options);
        seconds[which][round] = processor_seconds() - start;
        s[which] = map.statistics;
        visible[which] = map.visible;
      }
    }
    if (visible[0] != visible[1] || s[0].regions_visible != s[1].regions_visible) {
      fmt::print("the maps differ\n");
      return 1;
    }
    std::array<double, 2> time{};
    std::array<std::string, 2> growth{"-", "-"};
    const double n = static_cast<double>(mesh.triangles.size());
    for (std::size_t which = 0; which < 2; ++which) {
      std::sort(seconds[which].begin(), seconds[which].end());
      time[which] = seconds[which][kRepeats / 2];
      if (last_size > 0)
        growth[which] = fmt::format("n^{:.2f}", std::log(time[which] / last[which]) / std::log(n / last_size));
    }
    fmt::print(
        "{:>10} {:>9.2f} {:>9.2f} {:>7.2f} {:>8} {:>8} {:>8} {:>8} {:>7} {:>11} {:>11} {:>5}/{:<6} {:>6}/{:<7}\n",
        mesh.triangles.size(), time[0], time[1], time[1] / time[0], growth[0], growth[1], s[1].surfaces_visited,
        s[1].surfaces_seen, s[1].passes, s[1].sight_lines, s[1].shaft_tests, s[1].wedges_built, s[0].wedges_built,
        s[1].walks, s[0].walks);
    std::fflush(stdout);
    last = time;
    last_size = n;
  }
  return 0;
}
