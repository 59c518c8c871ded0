// The fast path on geometry that was not made for it: generated families unlike our city, and any mesh that is named, from cells beside its walls.
// For each cell: what was mapped, what was decided exactly, the median time; with --exact the time of the exact kernel, and whether the lists agree.
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/world_scenes.h"
#include "exact/cell/convex_cell.h"
#include "fastpath/visibility/first_order.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh_io.h"

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::uint64_t kSeed = 1;

struct Settings {
  int threads = tbb::this_task_arena::max_concurrency();
  std::size_t cells = 6;
  int rounds = 3;
  bool exact = false;
  std::string only;  // families whose name begins so
  std::vector<std::string> files;
};

double seconds_of(const auto& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median_of(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void measure(const clues::bench::WorldScene& scene, const Settings& settings) {
  const clues::fastpath::Bvh bvh(scene.mesh);
  std::vector<double> medians;
  for (const auto& cell : scene.cells) {
    clues::fastpath::FirstOrder fast;
    std::vector<double> times;
    for (int i = 0; i < settings.rounds; ++i)
      times.push_back(seconds_of([&] { fast = clues::fastpath::first_order_visibility(bvh, cell, {}); }));
    medians.push_back(median_of(times));
    std::string against;
    if (settings.exact) {
      clues::reference::Options options;
      options.threads = settings.threads;
      std::vector<std::uint32_t> visible;
      const double exact = seconds_of([&] {
        visible =
            clues::reference::first_order_visibility(scene.mesh, clues::exact::ConvexCell::from_doubles(cell), options)
                .visible;
      });
      against = fmt::format(" {:.2f} | {:.0f} | {} |", exact, exact / medians.back(),
                            visible == fast.visible ? "same" : "DIFFERENT");
    }
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.3f} | {:.2f} |{}\n", scene.name,
               scene.mesh.triangles.size(), fast.visible.size(), fast.closure.mapped, fast.closure.passes,
               fast.counts.rounds, fast.counts.wedges, fast.counts.exact_decisions, fast.conservative_fallbacks,
               medians.back(),
               1000 * medians.back() / static_cast<double>(std::max<std::uint64_t>(1, fast.closure.mapped)), against);
  }
  if (medians.size() > 1)
    fmt::print("| {}: median, worst | | | | | | | | | {:.3f}, {:.3f} | |\n", scene.name, median_of(medians),
               *std::max_element(medians.begin(), medians.end()));
}

[[noreturn]] void usage() {
  fmt::print(stderr,
             "usage: clues_bench_world [--threads N] [--cells N] [--rounds N] [--exact] [--only NAME] [MESH...]\n"
             "Without meshes: the generated families, or those whose name begins with NAME. Cells (default 6 a mesh)\n"
             "stand beside walls.\n");
  std::exit(2);
}

Settings settings_of(int count, char** words) {
  Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto number = [&] {
      const int n = i + 1 < count ? std::atoi(words[++i]) : 0;
      if (n < 1) usage();
      return n;
    };
    if (word == "--threads") {
      settings.threads = number();
    } else if (word == "--cells") {
      settings.cells = static_cast<std::size_t>(number());
    } else if (word == "--rounds") {
      settings.rounds = number();
    } else if (word == "--exact") {
      settings.exact = true;
    } else if (word == "--only" && i + 1 < count) {
      settings.only = words[++i];
    } else if (word.starts_with("--")) {
      usage();
    } else {
      settings.files.push_back(word);
    }
  }
  return settings;
}

}  // namespace

int main(int count, char** words) {
  const Settings settings = settings_of(count, words);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(settings.threads));
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  fmt::print(
      "| scene | triangles | visible | mapped | passes | rounds | wedges | exact decisions | fallbacks | time s | ms a "
      "mapped |{}\n",
      settings.exact ? " exact kernel s | ratio | lists |" : "");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|{}\n", settings.exact ? "---|---|---|" : "");
  for (const std::string& file : settings.files) {
    clues::bench::WorldScene scene{std::filesystem::path(file).stem().string(), clues::scene::read_mesh(file), {}};
    scene.cells = clues::bench::cells_beside_walls(scene.mesh, settings.cells, kSeed);
    measure(scene, settings);
  }
  if (!settings.files.empty()) return 0;
  using clues::bench::WorldScene;
  const auto measure_family = [&](const std::string& name, WorldScene (*make)(std::uint32_t, std::uint64_t),
                                  std::uint32_t size) {
    if (name.starts_with(settings.only)) measure(make(size, kSeed), settings);
  };
  for (const std::uint32_t scale : {1U, 2U}) {
    measure_family("turned boxes", clues::bench::turned_boxes, 200 * scale);
    measure_family("axis grid", clues::bench::axis_grid, 10 * scale);
    measure_family("honeycomb", clues::bench::honeycomb, 16 * scale);
    measure_family("blinds", clues::bench::blinds, 25 * scale);
    measure_family("terrain", clues::bench::terrain, 10 * scale);
    measure_family("loose triangles", clues::bench::loose_triangles, 100 * scale);
  }
}
