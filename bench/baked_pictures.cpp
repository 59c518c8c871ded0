// Do baked lists draw what the level draws? From random viewpoints in random cells, all around, by a software rasteriser:
//
//   clues_bench_baked_pictures LEVEL.bsp LEVEL.bake [CELLS [VIEWPOINTS]]
//
// A rasteriser rounds: between faces that meet without sharing a vertex it may leave a pixel through which something hidden shows. So for each pixel
// that differs sight lines through it are decided exactly: one that is free proves a hole in the list (exit code 1). A list that lacks a face differs by
// whole patches, which the last line shows: the same with the face left out that most of the first picture shows.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>

#include "exact/cell/convex_cell.h"
#include "exact/sight/witness.h"
#include "scene/bakes/bake_store.h"
#include "scene/levels/bsp_scene.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"
#include "tests/bake/pictures.h"
#include "validate/see_through/layers.h"

namespace {

using namespace clues;
using Ids = std::vector<std::uint32_t>;

constexpr int kPixels = 128;

scene::Point random_point_in(const std::vector<scene::Point>& corners, std::mt19937& random) {
  std::exponential_distribution<double> weight;
  scene::Point p{};
  double sum = 0;
  for (const auto& corner : corners) {
    const double w = weight(random) + 0.02;
    sum += w;
    for (std::size_t i = 0; i < 3; ++i) p[i] += w * corner[i];
  }
  for (double& x : p) x /= sum;
  return p;
}

Ids different(const Ids& a, const Ids& b) {
  Ids places;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i]) places.push_back(i);
  }
  return places;
}

// Whether the triangle is seen from the eye through the pixel: 49 sight lines, against all that blocks.
bool is_seen(const scene::FlaggedMesh& scene, std::uint32_t triangle, const scene::Point& eye, int direction,
             std::size_t pixel) {
  const auto alone = validate::asked_alone(scene, triangle);
  const auto corner = [&](std::size_t i) {
    return exact::to_exact(scene.mesh.points[scene.mesh.triangles[triangle][i]]);
  };
  const exact::Plane3 plane(corner(0), corner(1), corner(2));
  const exact::Point3 v = exact::to_exact(eye);
  const exact::FT height = plane.a() * v.x() + plane.b() * v.y() + plane.c() * v.z() + plane.d();
  const auto cell = exact::ConvexCell::from_doubles({eye});
  const auto ahead = static_cast<std::size_t>(direction / 2);
  const auto across = [](std::size_t at, int step) { return (static_cast<double>(at) + step / 6.0) * 2 / kPixels - 1; };
  for (int i = 0; i < 49; ++i) {
    scene::Point d{};
    d[ahead] = direction % 2 == 0 ? -1 : 1;
    d[(ahead + 1) % 3] = across(pixel % kPixels, i % 7);
    d[(ahead + 2) % 3] = across(pixel / kPixels, i / 7);
    const exact::Vector3 ray(d[0], d[1], d[2]);
    const exact::FT slope = plane.orthogonal_vector() * ray;
    if (slope == 0) continue;
    const exact::Point3 p = v - ray * exact::FT(height / slope);
    if (exact::check_witness(alone.mesh, cell, alone.triangle, height > 0, v, p).valid) return true;
  }
  return false;
}

// How many pixels prove a hole.
std::size_t compare(const std::string& file, const std::string& bake_file, std::size_t cells, int viewpoints) {
  const auto level = scene::read_level(file);
  if (!level) throw scene::Error(scene::ErrorCode::bad_argument, file + ": no level (.bsp)");
  const auto scene = scene::scene_of_level(*level, scene::HullSides::all).scene;
  const scene::FinishedBake bake(bake_file);
  Ids all, hulls;
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) (scene.counting(t) ? all : hulls).push_back(t);
  tests::Pictures pictures(kPixels, 0.0625, 65536);
  std::mt19937 random(1);
  std::vector<std::uint32_t> order(bake.plan().cells.size());
  for (std::uint32_t c = 0; c < order.size(); ++c) order[c] = c;
  std::shuffle(order.begin(), order.end(), random);
  order.resize(std::min(order.size(), cells));
  std::size_t views = 0, other_views = 0, other_pixels = 0, holes = 0, without = 0;
  for (const auto c : order) {
    const auto& cell = bake.plan().cells[c];
    const Ids list = bake.cell(c).list;
    for (int i = 0; i < viewpoints; ++i) {
      const auto eye = random_point_in(cell.inner.empty() ? cell.points : cell.inner, random);
      for (int direction = 0; direction < 6; ++direction, ++views) {
        const auto whole = pictures.draw(scene.mesh, all, hulls, eye, direction);
        const auto found = different(whole, pictures.draw(scene.mesh, list, hulls, eye, direction));
        other_pixels += found.size();
        other_views += found.empty() ? 0 : 1;
        for (const auto pixel : found)
          holes += whole[pixel] >= 2 && is_seen(scene, whole[pixel] - 2, eye, direction, pixel) ? 1 : 0;
        if (views > 0) continue;
        std::map<std::uint32_t, std::size_t> shown;
        for (const auto pixel : whole) shown[pixel] += pixel >= 2 ? 1 : 0;
        const auto most = std::max_element(shown.begin(), shown.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        Ids fewer = list;
        std::erase(fewer, most->first - 2);
        without = different(whole, pictures.draw(scene.mesh, fewer, hulls, eye, direction)).size();
      }
    }
  }
  const auto pixels = static_cast<double>(std::max<std::size_t>(views, 1)) * kPixels * kPixels;
  fmt::print("{} cells, {} pictures of {} pixels: {} differ, in {} pixels ({:.2g} of all); {} of these are holes\n",
             order.size(), views, kPixels * kPixels, other_views, other_pixels,
             static_cast<double>(other_pixels) / pixels, holes);
  fmt::print("the first picture without the face that most of it shows differs in {} pixels\n", without);
  return holes;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    fmt::print("clues_bench_baked_pictures LEVEL.bsp LEVEL.bake [CELLS [VIEWPOINTS]]: nothing to draw\n");
    return 0;
  }
  try {
    return compare(words[1], words[2], count > 3 ? std::strtoul(words[3], nullptr, 10) : 50,
                   count > 4 ? std::atoi(words[4]) : 200) > 0
               ? 1
               : 0;
  } catch (const scene::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
