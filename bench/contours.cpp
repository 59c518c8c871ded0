// Contours (D26): what a cell sees, decoded from a file, against mapping it anew; deltas from cell to cell; and bytes, of contours one
// level deep and of a tree of cells, against packed lists. In generated cities, and in what a leaf of a level can see. One thread.
//
// Usage: clues_bench_contours [LEVEL.bsp...]
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/contours/contour_decoder.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/city.h"
#include "reference/contours/contour_maker.h"
#include "reference/delta/delta.h"
#include "reference/visibility/first_order.h"
#include "scene/bakes/packed_list.h"
#include "scene/cell_spec.h"
#include "scene/levels/bsp_scene.h"
#include "scene/scenes/scene_io.h"
#include "validate/stream/compare_contours.h"

namespace {

using Clock = std::chrono::steady_clock;
using clues::exact::ConvexCell;
using clues::scene::Point;

struct BenchScene {
  std::string name;
  clues::scene::TriangleMesh mesh;
  std::array<Point, 2> box;  // the parent, from corner to corner
};

class Medians {
 public:
  template <class Work>
  void run(const Work& work) {
    const auto start = Clock::now();
    work();
    seconds_.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  double median() {
    std::sort(seconds_.begin(), seconds_.end());
    return seconds_.empty() ? 0 : seconds_[seconds_.size() / 2];
  }

 private:
  std::vector<double> seconds_;
};

std::string box_text(const BenchScene& scene) {
  const auto& [a, b] = scene.box;
  return fmt::format("box:{},{},{},{},{},{}", a[0], a[1], a[2], b[0], b[1], b[2]);
}

std::vector<clues::scene::CellSpec> grid(const BenchScene& scene, int n) {
  return clues::scene::parse_cells(fmt::format("grid:{}x{}x1:{}", n, n, box_text(scene)));
}

// Of n x n cells, the one of the grid half as fine that holds cell i.
std::size_t around(std::size_t i, std::size_t n) { return i / n / 2 * (n / 2) + i % n / 2; }

struct Sizes {
  std::size_t contours = 0, packed = 0, list = 0, minus = 0;
  void add(const clues::scene::ContourFile& file, const clues::reference::MadeContours& made,
           const std::vector<std::uint32_t>& before) {
    const auto triangles = static_cast<std::uint32_t>(file.scene_triangles);
    const auto bytes = clues::scene::contour_bytes(file.cells, static_cast<std::uint32_t>(file.cells.size() - 1));
    contours += bytes.size();
    packed += clues::scene::packed_bytes(bytes).size();
    list += clues::scene::packed_list(made.visible, triangles).size();
    minus += clues::scene::packed_list(clues::reference::packets_of(before, made.visible).minus, triangles).size();
  }
  std::string row(const BenchScene& scene, const char* what, std::size_t transitions) const {
    const auto mean = [&](std::size_t sum) { return static_cast<double>(sum) / static_cast<double>(transitions); };
    return fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", scene.name, what, transitions,
                       mean(contours), mean(packed), mean(list), mean(minus));
  }
};

// The parent, 2 x 2 children, and 4 x 4 grandchildren: within the children, and within the parent at once.
clues::scene::ContourFile measure_sizes(const BenchScene& scene, std::string& rows) {
  const auto parent = ConvexCell::from_doubles(clues::scene::parse_cell(box_text(scene)).points);
  clues::reference::ContourMaker tree(scene.mesh, {}, 0), flat(scene.mesh, {}, 0);
  Sizes root, children, grandchildren, at_once;
  std::vector<std::vector<std::uint32_t>> lists{tree.add("parent", parent, 0, true).visible};
  flat.add("parent", parent, 0, true);
  root.contours = clues::scene::contour_bytes(tree.file().cells, 0).size();
  root.packed = clues::scene::packed_bytes(clues::scene::contour_bytes(tree.file().cells, 0)).size();
  root.list = clues::scene::packed_list(lists[0], static_cast<std::uint32_t>(scene.mesh.triangles.size())).size();
  for (const auto& cell : grid(scene, 2)) {
    const auto& made = tree.add(cell.name, ConvexCell::from_doubles(cell.points), 1, true);
    children.add(tree.file(), made, lists[0]);
    lists.push_back(made.visible);
  }
  const auto leaves = grid(scene, 4);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const auto cell = ConvexCell::from_doubles(leaves[i].points);
    const auto within = static_cast<std::uint32_t>(2 + around(i, 4));
    grandchildren.add(tree.file(), tree.add(leaves[i].name, cell, within, false), lists[within - 1]);
    at_once.add(flat.file(), flat.add(leaves[i].name, cell, 1, false), lists[0]);
  }
  rows += root.row(scene, "parent, in whole triangles", 1) + children.row(scene, "parent to child", 4) +
          grandchildren.row(scene, "child to grandchild", 16) + at_once.row(scene, "parent to grandchild", 16);
  return tree.file();
}

void measure_times(const BenchScene& scene, const clues::scene::ContourFile& file, std::string& transitions,
                   std::string& deltas) {
  constexpr int rounds = 5;
  const auto& mesh = scene.mesh;
  const clues::fastpath::Bvh bvh(mesh);
  const clues::fastpath::ContourDecoder decoder(mesh);
  clues::reference::Options options;
  options.threads = 1;
  const auto sides = clues::reference::input_sides(mesh, options.mode);
  clues::reference::ContourMaps of_parent;
  clues::reference::decoded_map(sides, mesh, file, 0, &of_parent);
  Medians fast, fast_regions, exact, decode_all, decode, doubles;
  double exact_area = 0, area = 0;
  std::uint64_t points = 0, unsure = 0;
  const auto cells = grid(scene, 2);
  for (std::uint32_t c = 1; c <= cells.size(); ++c) {
    const auto& corners = cells[c - 1].points;
    const auto cell = ConvexCell::from_doubles(corners);
    std::vector<clues::reference::FlatSet> sets;
    clues::fastpath::ContourDecoding decoding;
    for (int round = 0; round < rounds;
         ++round) {  // in turn, so that all have their share of what else the machine does
      fast.run([&] { clues::fastpath::first_order_visibility(bvh, corners, {}); });
      fast_regions.run([&] { clues::fastpath::first_order_visibility(bvh, corners, {}, {.regions = true}); });
      exact.run([&] {
        clues::reference::visible_on(sides, mesh, clues::reference::first_order_visibility(mesh, cell, options));
      });
      decode_all.run([&] { clues::reference::decoded_map(sides, mesh, file, c); });
      auto kept = of_parent;
      decode.run([&] { sets = clues::reference::decoded_map(sides, mesh, file, c, &kept); });
      doubles.run([&] { decoding = decoder.decode(file, c); });
    }
    const auto compared = clues::validate::compare_contours(mesh, file, c, sides, sets, decoding);
    for (const auto& finding : compared.findings) fmt::print("WRONG: {}\n", finding);
    exact_area += compared.exact_area;
    area += compared.area;
    points += decoding.points;
    unsure += decoding.unbounded + decoding.wild;
  }
  const auto ms = [](Medians& m) { return fmt::format("{:.3f}", 1000 * m.median()); };
  transitions += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} of {} | {:.6f} |\n", scene.name,
                             mesh.triangles.size(), ms(exact), ms(fast_regions), ms(fast), ms(decode_all), ms(decode),
                             ms(doubles), unsure, points, area / exact_area);

  const auto a = ConvexCell::from_doubles(cells[0].points), b = ConvexCell::from_doubles(cells[1].points);
  Medians mapped, from_contours, lists_mapped, lists_in_doubles;
  for (int round = 0; round < rounds; ++round) {
    mapped.run([&] { clues::reference::delta_of(mesh, a, b, options); });
    auto kept = of_parent;
    from_contours.run([&] {
      const auto from = clues::reference::decoded_map(sides, mesh, file, 1, &kept);
      clues::reference::unified_map(sides, mesh, from, clues::reference::decoded_map(sides, mesh, file, 2, &kept));
    });
    lists_mapped.run([&] {
      clues::reference::packets_of(clues::fastpath::first_order_visibility(bvh, cells[0].points, {}).visible,
                                   clues::fastpath::first_order_visibility(bvh, cells[1].points, {}).visible);
    });
    lists_in_doubles.run(
        [&] { clues::reference::packets_of(decoder.decode(file, 1).list, decoder.decode(file, 2).list); });
  }
  const auto each_second = [](Medians& m) { return fmt::format("{:.1f}", 1 / m.median()); };
  deltas += fmt::format("| {} | {} | {} | {} | {} |\n", scene.name, each_second(mapped), each_second(from_contours),
                        each_second(lists_mapped), each_second(lists_in_doubles));
}

// Around the middle of a leaf, as large as it can be.
std::array<Point, 2> box_in(const ConvexCell& leaf) {
  const Point at = clues::exact::to_double_estimate(leaf.center());
  for (double half = 4096;; half /= 2) {
    const std::array<Point, 2> box{Point{at[0] - half, at[1] - half, at[2] - half},
                                   Point{at[0] + half, at[1] + half, at[2] + half}};
    bool inside = true;
    for (unsigned i = 0; i < 8; ++i)
      inside &= leaf.contains(clues::exact::to_exact({box[i & 1][0], box[i >> 1 & 1][1], box[i >> 2 & 1][2]}));
    if (inside) return box;
  }
}

// What blocks, as far as the first leaf that sees 100 to 300 triangles of it can see. By T6 the map of a cell in there is that in the whole level.
std::optional<BenchScene> part_of(const std::string& file) {
  const auto level = clues::scene::read_level(file);
  if (!level) return std::nullopt;
  const auto flagged = clues::scene::scene_of_level(*level).scene;
  clues::scene::TriangleMesh blocking = flagged.mesh;
  blocking.triangles.clear();
  for (std::uint32_t t = 0; t < flagged.mesh.triangles.size(); ++t) {
    if (flagged.blocking(t)) blocking.triangles.push_back(flagged.mesh.triangles[t]);
  }
  blocking.face_of.assign(blocking.triangles.size(), 0);
  const clues::fastpath::Bvh bvh(blocking);
  for (const auto& cell : clues::scene::cells_of_level(*level)) {
    if (cell.outer.empty() || cell.inner.empty()) continue;
    const auto seen = clues::fastpath::first_order_visibility(bvh, cell.outer, {});
    if (seen.visible.size() < 100 || seen.visible.size() > 300) continue;
    BenchScene scene{fmt::format("{}, leaf {}", std::filesystem::path(file).stem().string(), cell.leaf), {}, {}};
    std::vector<std::uint32_t> number(blocking.points.size(), ~0U);
    for (const std::uint32_t t : seen.visible) {
      auto triangle = blocking.triangles[t];
      for (auto& corner : triangle) {
        if (number[corner] == ~0U) {
          number[corner] = static_cast<std::uint32_t>(scene.mesh.points.size());
          scene.mesh.points.push_back(blocking.points[corner]);
        }
        corner = number[corner];
      }
      scene.mesh.triangles.push_back(triangle);
      scene.mesh.face_of.push_back(t);
    }
    scene.box = box_in(ConvexCell::from_doubles(cell.inner));
    return scene;
  }
  return std::nullopt;
}

}  // namespace

int main(int count, char** words) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::vector<BenchScene> scenes;
  for (const std::uint32_t size : {300U, 1000U}) {
    const auto corners = clues::fuzz::street_cell(size, 1);
    scenes.push_back(
        {fmt::format("city of {}", size),
         clues::fuzz::make_city(size, 1),
         {*std::min_element(corners.begin(), corners.end()), *std::max_element(corners.begin(), corners.end())}});
  }
  for (int i = 1; i < count; ++i) {
    if (auto scene = part_of(words[i])) {
      scenes.push_back(std::move(*scene));
    } else {
      fmt::print(stderr, "{}: is no level, or has no leaf that sees 100 to 300 triangles\n", words[i]);
      return 2;
    }
  }
  std::string sizes, transitions, deltas;
  for (const BenchScene& scene : scenes) {
    const auto file = measure_sizes(scene, sizes);
    measure_times(scene, file, transitions, deltas);
    fmt::print("{}: cell {}\n", scene.name, box_text(scene));
  }
  fmt::print(
      "\nparent to child, ms\n"
      "| scene | triangles | mapped: exact | fast, regions | fast, list | decoded: exact, with the parent | exact | "
      "doubles, with "
      "the parent | not told | area |\n|---|---|---|---|---|---|---|---|---|---|\n{}"
      "\ndeltas each second\n"
      "| scene | regions, mapped | regions, decoded | lists, mapped (fast) | lists, decoded (doubles) "
      "|\n|---|---|---|---|---|\n{}"
      "\nbytes for each transition\n"
      "| scene | transition | how many | contours | packed | list, packed | what goes, packed "
      "|\n|---|---|---|---|---|---|---|\n{}",
      transitions, deltas, sizes);
}
