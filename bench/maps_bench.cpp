// Hierarchies of surfaces (D31 to D33): the reference, the fast path, and the fast path without an overlay, side by side on one mesh; processor time.
//
//   clues_bench_maps_bench                      generated balls and frames of 12,000 to 100,000 triangles
//   CLUES_MESHES=a.off:b.off clues_bench_...    these meshes instead
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "fastpath/multires/build.h"
#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "scene/mesh_io.h"

namespace {

using clues::scene::TriangleMesh;

void report(benchmark::State& state, const clues::scene::Hierarchy& h) {
  state.counters["levels"] = static_cast<double>(h.levels.size());
  state.counters["base"] = static_cast<double>(h.base.size());
  state.counters["pieces"] = static_cast<double>(h.pieces.size());
}

void reference(benchmark::State& state, const TriangleMesh& mesh) {
  clues::scene::Hierarchy h;
  for (auto _ : state) h = clues::reference::build_hierarchy(mesh, {});
  report(state, h);
}

void fast(benchmark::State& state, const TriangleMesh& mesh, bool overlay, int threads) {
  clues::fastpath::multires::BuildOptions options;
  options.overlay = overlay;
  options.threads = threads;
  clues::scene::Hierarchy h;
  for (auto _ : state) h = clues::fastpath::multires::build_hierarchy(mesh, options);
  report(state, h);
}

struct Named {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Named> meshes() {
  std::vector<Named> out;
  const char* files = std::getenv("CLUES_MESHES");
  if (files == nullptr) {
    for (const int n : {39, 63, 112}) out.push_back({"ball", clues::fuzz::ball(n)});
    for (const int n : {14, 22, 40}) out.push_back({"torus", clues::fuzz::frame(1, n)});
    return out;
  }
  std::string list = files;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    const std::string file = list.substr(begin, end - begin);
    out.push_back({file.substr(file.rfind('/') + 1), clues::scene::read_mesh(file)});
    begin = end + 1;
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const Named& named : meshes()) {
    const auto mesh = std::make_shared<const TriangleMesh>(named.mesh);
    const auto add = [&](const char* who, auto run) {
      const std::string name = fmt::format("{}/{}/{}", named.name, mesh->triangles.size(), who);
      benchmark::RegisterBenchmark(name.c_str(), run)
          ->MeasureProcessCPUTime()
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    };
    add("reference", [mesh](benchmark::State& state) { reference(state, *mesh); });
    add("fast, one thread", [mesh](benchmark::State& state) { fast(state, *mesh, true, 1); });
    add("fast, all threads", [mesh](benchmark::State& state) { fast(state, *mesh, true, 0); });
    add("levels and places, one thread", [mesh](benchmark::State& state) { fast(state, *mesh, false, 1); });
    add("levels and places, all threads", [mesh](benchmark::State& state) { fast(state, *mesh, false, 0); });
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
