// First-order visibility of one street cell in generated cities, one thread: time, memory, growth exponent, how much work it was, and where the
// time goes: refinement, wedges, regions, and the longest exact coordinate of a wedge and of a region.
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include "exact/cell/convex_cell.h"
#include "fuzz/generators/city.h"
#include "reference/visibility/first_order.h"

namespace {

// Bits of numerator and denominator of the longest coordinate.
class Longest {
 public:
  void add(const clues::exact::Point3& p) {
    for (int i = 0; i < 3; ++i) {
      const mpq_class x = p[i].exact();
      bits_ = std::max({bits_, mpz_sizeinbase(x.get_num_mpz_t(), 2), mpz_sizeinbase(x.get_den_mpz_t(), 2)});
    }
  }
  std::size_t bits() const { return bits_; }

 private:
  std::size_t bits_ = 0;
};

}  // namespace

int main() {
  constexpr std::uint64_t kSeed = 1;
  constexpr int kRepeats = 3;
  fmt::print("{:>10} {:>9} {:>8} {:>9} {:>8} {:>8} {:>8} {:>9} {:>10} {:>8} {:>8} {:>8} {:>11} {:>12}\n", "triangles",
             "median s", "growth", "visible", "wedges", "CSVs", "walks", "fallbacks", "peak MiB", "refine", "wedges",
             "regions", "wedge bits", "region bits");
  double last_time = 0, last_size = 0;
  for (const std::uint32_t size : {300U, 1000U, 3000U, 10000U}) {
    const auto mesh = clues::fuzz::make_city(size, kSeed);
    const auto cell = clues::exact::ConvexCell::from_doubles(clues::fuzz::street_cell(size, kSeed));
    clues::reference::Options options;
    options.threads = 1;
    using Clock = std::chrono::steady_clock;
    // The progress reports mark the ends of the stages.
    Clock::time_point start, refined, wedged;
    options.progress = [&](const std::string& stage, std::uint64_t, std::uint64_t) {
      if (stage == "refine") refined = Clock::now();
      if (stage != "regions") wedged = Clock::now();
    };
    std::array<double, kRepeats> seconds{};
    const auto share = [](Clock::time_point from, Clock::time_point to, double whole) {
      return 100 * std::chrono::duration<double>(to - from).count() / whole;
    };
    Longest wedge_bits, region_bits;
    double refine = 0, wedges = 0;
    clues::reference::Statistics s;
    std::size_t visible = 0;
    for (double& t : seconds) {
      start = Clock::now();
      const auto map = clues::reference::first_order_visibility(mesh, cell, options);
      t = std::chrono::duration<double>(Clock::now() - start).count();
      s = map.statistics;
      visible = map.visible.size();
      refine = share(start, refined, t);
      wedges = share(refined, wedged, t);
      for (const auto& w : map.wedges) {
        for (const auto* p : {&w.near0, &w.near1, &w.on_ray0, &w.on_ray1}) wedge_bits.add(*p);
      }
      for (const auto& r : map.regions) {
        for (const auto& ring : r.rings) {
          for (const auto& p : ring) region_bits.add(p);
        }
      }
    }
    std::sort(seconds.begin(), seconds.end());
    const double time = seconds[kRepeats / 2], n = static_cast<double>(mesh.triangles.size());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print(
        "{:>10} {:>9.2f} {:>8} {:>9} {:>8} {:>8} {:>8} {:>9} {:>10.0f} {:>7.0f}% {:>7.0f}% {:>7.0f}% {:>11} {:>12}\n",
        mesh.triangles.size(), time,
        last_size > 0 ? fmt::format("n^{:.2f}", std::log(time / last_time) / std::log(n / last_size)) : "-", visible,
        s.sv_me + s.se_me + s.se_mv, s.csv, s.walks, s.conservative_fallbacks,
        static_cast<double>(usage.ru_maxrss) / 1024, refine, wedges, 100 - refine - wedges, wedge_bits.bits(),
        region_bits.bits());
    last_time = time;
    last_size = n;
  }
}
