#include "tests/differential/scene_shrinking.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "exact/cell/convex_cell.h"

namespace clues::tests {
namespace {

bool is_box(const std::vector<scene::Point>& points, scene::Point& lo, scene::Point& hi) {
  lo = hi = points.front();
  for (const scene::Point& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  std::set<scene::Point> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.insert({i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]});
  return std::all_of(corners.begin(), corners.end(),
                     [&](const scene::Point& c) { return std::find(points.begin(), points.end(), c) != points.end(); });
}

}  // namespace

fuzz::Case shrunk(const fuzz::Case& scene, const JudgeSettings& settings, const std::string& category) {
  fuzz::Case best = scene;
  // Only what the flaw is about is asked.
  JudgeSettings asked = settings;
  for (const char* kernel : {"plain reference", "traversal", "fast path", "subdivided reference",
                             "backprojected reference", "subdivided fast path", "backprojected fast path"}) {
    if (category.find(kernel) != category.npos) asked.kernels.emplace_back(kernel);
  }
  if (category.find("area") == 0 || category.find("walks") == 0) asked.kernels = {"plain reference", "fast path"};
  asked.truth = category.find("fallback") != 0 && category.find("exception of") != 0 && category.find("slow") != 0 &&
                category.find("list") != 0;
  const auto keeps = [&](const fuzz::Case& smaller) {
    const Judgement j = judge_scene(smaller, asked);
    return std::any_of(j.flaws.begin(), j.flaws.end(), [&](const Flaw& f) { return f.category == category; });
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t t = best.mesh.triangles.size(); t-- > 0 && best.mesh.triangles.size() > 1;) {
      fuzz::Case smaller = best;
      smaller.mesh.triangles.erase(smaller.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      smaller.mesh.face_of.erase(smaller.mesh.face_of.begin() + static_cast<std::ptrdiff_t>(t));
      if (!keeps(smaller)) continue;
      best = std::move(smaller);
      changed = true;
    }
    const int dimension = exact::ConvexCell::from_doubles(best.cell).dimension();
    for (std::size_t i = best.cell.size(); i-- > 0 && best.cell.size() > 1;) {
      fuzz::Case smaller = best;
      smaller.cell.erase(smaller.cell.begin() + static_cast<std::ptrdiff_t>(i));
      if (exact::ConvexCell::from_doubles(smaller.cell).dimension() != dimension || !keeps(smaller)) continue;
      best = std::move(smaller);
      changed = true;
    }
  }
  return best;
}

std::string to_obj_text(const fuzz::Case& scene) {
  std::ostringstream text;
  text.precision(17);
  std::map<scene::Point, std::size_t> numbers;
  std::vector<std::array<std::size_t, 3>> faces;
  for (const scene::Triangle& t : scene.mesh.triangles) {
    std::array<std::size_t, 3> face{};
    for (std::size_t i = 0; i < 3; ++i) {
      const scene::Point& p = scene.mesh.points[t[i]];
      const auto known = numbers.find(p);
      if (known == numbers.end()) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      face[i] = known == numbers.end() ? numbers.emplace(p, numbers.size() + 1).first->second : known->second;
    }
    faces.push_back(face);
  }
  for (const auto& f : faces) text << "f " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  for (const auto& [name, value] : scene.dials) text << "# dial " << name << ' ' << value << '\n';
  scene::Point lo, hi;
  if (is_box(scene.cell, lo, hi)) {
    text << "--cell box:" << lo[0] << ',' << lo[1] << ',' << lo[2] << ',' << hi[0] << ',' << hi[1] << ',' << hi[2]
         << '\n';
  } else {
    text << "--cell cell.obj:\n";
    for (const scene::Point& p : scene.cell) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  return text.str();
}

}  // namespace clues::tests
