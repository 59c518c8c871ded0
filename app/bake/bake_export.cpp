#include "app/bake/bake_export.h"

#include <CGAL/number_utils.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "app/common.h"
#include "app/engine/clues_pvs.h"
#include "exact/cell/convex_cell.h"
#include "scene/files/atomic_file.h"
#include "scene/mesh/bounds.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/result.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Point;

using Plane = std::array<double, 4>;

// Adds n x <= d for every point of the cell, as a reader computes it: d is the largest value at the cell's points, widened
// by more than what two sums of three products may be off, 4 units of 2^-53 of the largest terms each, and of 2^-1074 where
// they underflow. Left out where that is no finite number: no point of the cell is lost by it.
void add_plane_around(std::vector<Plane>& planes, const Point& normal, const std::vector<Point>& cell) {
  double highest = -std::numeric_limits<double>::infinity();
  Point terms{};
  for (const auto& p : cell) {
    double height = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      height += normal[i] * p[i];
      terms[i] = std::max(terms[i], std::fabs(normal[i] * p[i]));
    }
    highest = std::max(highest, height);
  }
  const double distance = highest + 0x1p-48 * (terms[0] + terms[1] + terms[2]) + 0x1p-1071;
  if (std::isfinite(distance)) planes.push_back({normal[0], normal[1], normal[2], distance});
}

// Its largest component is 1 or -1. Scaled before it is rounded: components of a small or large facet are no doubles.
Point scaled(const exact::Vector3& direction) {
  const exact::FT size = std::max(
      {exact::FT(CGAL::abs(direction.x())), exact::FT(CGAL::abs(direction.y())), exact::FT(CGAL::abs(direction.z()))});
  return {CGAL::to_double(exact::FT(direction.x() / size)), CGAL::to_double(exact::FT(direction.y() / size)),
          CGAL::to_double(exact::FT(direction.z() / size))};
}

// The box of the cell, and its facets where it is no box.
std::vector<Plane> planes_around(const std::vector<Point>& points) {
  std::vector<Plane> planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Point normal{};
    normal[axis] = 1;
    add_plane_around(planes, normal, points);
    normal[axis] = -1;
    add_plane_around(planes, normal, points);
  }
  const auto cell = exact::ConvexCell::from_doubles(points);
  for (const auto& facet : cell.facets()) {
    const Point normal = scaled(facet.plane.orthogonal_vector());
    if (std::count(normal.begin(), normal.end(), 0.0) < 2) add_plane_around(planes, normal, points);
  }
  return planes;
}

struct Voxels {
  std::array<std::uint32_t, 3> grid{};
  Point low{}, per_unit{};
  std::vector<std::vector<std::uint32_t>> cells;

  // As the header computes it. Both operations are monotone, so what lies between two points is in a voxel between theirs.
  std::uint32_t at(std::size_t axis, double x) const {
    if (grid[axis] == 1) return 0;
    const double voxel = std::floor((x - low[axis]) * per_unit[axis]);
    return static_cast<std::uint32_t>(std::clamp(voxel, 0.0, static_cast<double>(grid[axis] - 1)));
  }
};

Voxels voxels_over(const std::vector<scene::BakePlace>& cells) {
  Voxels v;
  scene::Bounds all = scene::bounds_of(cells[0].points);
  for (const auto& cell : cells) all = scene::hull_of(all, scene::bounds_of(cell.points));
  const auto& [low, high] = all;
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, high[i] - low[i]);
  const double most = std::min(128.0, std::ceil(4 * std::cbrt(static_cast<double>(cells.size()))));
  for (std::size_t i = 0; i < 3; ++i) {
    const double size = high[i] - low[i];
    v.grid[i] = 1;
    v.low[i] = low[i];
    if (size > 0 && std::isfinite(most * longest) && std::isfinite(most / size)) {
      v.grid[i] = static_cast<std::uint32_t>(std::max(1.0, std::ceil(most * size / longest)));
      // So that the highest point is in the last voxel.
      v.per_unit[i] = static_cast<double>(v.grid[i]) / size * (1 - 0x1p-40);
    }  // else 0: one voxel for all
  }
  v.cells.resize(std::size_t{v.grid[0]} * v.grid[1] * v.grid[2]);
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    std::array<std::uint32_t, 3> first{}, last{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto by_axis = [i](const Point& a, const Point& b) { return a[i] < b[i]; };
      const auto [lowest, highest] = std::minmax_element(cells[c].points.begin(), cells[c].points.end(), by_axis);
      first[i] = v.at(i, (*lowest)[i]);
      last[i] = v.at(i, (*highest)[i]);
    }
    for (auto z = first[2]; z <= last[2]; ++z) {
      for (auto y = first[1]; y <= last[1]; ++y) {
        for (auto x = first[0]; x <= last[0]; ++x)
          v.cells[(std::size_t{z} * v.grid[1] + y) * v.grid[0] + x].push_back(c);
      }
    }
  }
  return v;
}

template <class T>
std::uint64_t append(std::string& file, const std::vector<T>& values) {
  file.resize((file.size() + 7) / 8 * 8);
  const auto offset = file.size();
  file.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return offset;
}

}  // namespace

std::string engine_file(const scene::FinishedBake& bake) {
  const auto& cells = bake.plan().cells;
  const auto voxels = voxels_over(cells);
  clues_pvs header{};
  std::memcpy(header.magic, "CLUESPVS", 8);
  header.version = 1;
  header.triangles = bake.plan().triangles;
  header.cells = static_cast<std::uint32_t>(cells.size());
  for (std::size_t i = 0; i < 3; ++i) {
    header.grid[i] = voxels.grid[i];
    header.low[i] = voxels.low[i];
    header.per_unit[i] = voxels.per_unit[i];
  }
  std::vector<std::uint32_t> voxel_starts{0}, voxel_cells, plane_starts{0}, lists;
  std::vector<Plane> planes;
  std::vector<std::uint64_t> list_starts{0};
  for (const auto& there : voxels.cells) {
    voxel_cells.insert(voxel_cells.end(), there.begin(), there.end());
    voxel_starts.push_back(static_cast<std::uint32_t>(voxel_cells.size()));
  }
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const auto around = planes_around(cells[c].points);
    planes.insert(planes.end(), around.begin(), around.end());
    plane_starts.push_back(static_cast<std::uint32_t>(planes.size()));
    const auto list = bake.cell(c).list;
    lists.insert(lists.end(), list.begin(), list.end());
    list_starts.push_back(lists.size());
  }
  if (std::max(voxel_cells.size(), planes.size()) > std::numeric_limits<std::uint32_t>::max())
    throw scene::Error(scene::ErrorCode::unsupported, "too many cells for one flat file; bake parts of the scene");
  std::string file(sizeof header, '\0');
  header.voxel_starts = append(file, voxel_starts);
  header.voxel_cells = append(file, voxel_cells);
  header.plane_starts = append(file, plane_starts);
  header.planes = append(file, planes);
  header.list_starts = append(file, list_starts);
  header.lists = append(file, lists);
  header.bytes = file.size();
  std::memcpy(file.data(), &header, sizeof header);
  return file;
}

void require_exportable(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error))) return make_empty_folder(folder);  // it is there: nothing is made
  require_writable_parent(folder.has_filename() ? folder : folder.parent_path());
}

void export_bake(const fs::path& folder, const scene::FinishedBake& bake, const scene::FlaggedMesh& scene) {
  make_empty_folder(folder);
  make_folder(folder / "pvs");
  make_folder(folder / "cells");
  std::string list = "# number name cluster (-1: none)\n";
  for (std::uint32_t c = 0; c < bake.plan().cells.size(); ++c) {
    const auto& cell = bake.plan().cells[c];
    list += fmt::format("{} {} {}\n", c, scene::printable(cell.name), cell.group);
    scene::write_file_atomically(folder / "cells" / fmt::format("{}.obj", c), points_text(cell.points));
    scene::write_file_atomically(folder / "pvs" / fmt::format("{}.txt", c), scene::to_pvs_text(bake.cell(c).list));
  }
  if (!scene.parts.empty()) {
    std::string parts = "# first triangle, name\n";
    for (const auto& part : scene.parts)
      parts += fmt::format("{} {}\n", part.first_triangle, scene::printable(part.name));
    scene::write_file_atomically(folder / "parts.txt", parts);
  }
  scene::write_file_atomically(folder / "engine.cluespvs", engine_file(bake));
  scene::write_file_atomically(folder / "cells.txt", list);
}

}  // namespace clues::app
