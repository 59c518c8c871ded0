#include "reference/contours/contour_maker.h"

#include <algorithm>
#include <iterator>

#include "reference/visibility/first_order.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

bool holds(const std::vector<FlatSet>& a, const std::vector<FlatSet>& b) {
  for (std::size_t s = 0; s < a.size(); ++s) {
    if (!subtract(b[s], a[s]).empty()) return false;
  }
  return true;
}

std::vector<scene::Point> corners_of(const exact::ConvexCell& cell) {
  std::vector<scene::Point> corners;
  for (const exact::Point3& p : cell.vertices()) {
    corners.push_back(exact::to_double_estimate(p));
    if (exact::to_exact(corners.back()) != p)
      throw scene::Error(scene::ErrorCode::bad_cell, "contours: a corner of a cell is not a double");
  }
  return corners;
}

}  // namespace

ContourMaker::ContourMaker(const scene::TriangleMesh& mesh, const Options& options, double reach)
    : mesh_(mesh), options_(options), sides_(input_sides(mesh, options.mode)) {
  file_.scene_points = mesh.points.size();
  file_.scene_triangles = mesh.triangles.size();
  file_.mode = options.mode == Mode::solid ? "solid" : "sheet";
  file_.reach = reach;
}

const MadeContours& ContourMaker::add(const std::string& name, const exact::ConvexCell& cell, std::uint32_t within,
                                      bool is_around) {
  const auto map = first_order_visibility(mesh_, cell, options_);
  const auto seen = visible_on(sides_, mesh_, map);
  const std::vector<FlatSet> known = within == 0 ? whole_sides(sides_, mesh_) : seen_.at(within - 1);
  const auto wanted = within != 0 && file_.reach > 0
                          ? with_far_sides_of(sides_, mesh_, known, seen, cell, exact::FT(file_.reach))
                          : seen;
  const ContourLabel label = contour_label(sides_, mesh_, known, wanted);
  PlaneTable planes(mesh_, cell);
  planes.add_wedges(map);
  Drawings around(mesh_);
  if (within != 0) {
    for (const std::uint32_t c : scene::chain_of(file_.cells, within - 1)) around.add(file_.cells[c]);
  }
  last_ = {};
  last_.visible = map.visible;
  last_.seeds = label.seeds.size();
  last_.segments = label.segments.size();
  scene::ContourCell coded = encoded_contours(sides_, label, around, planes, last_.counts);
  coded.name = name;
  coded.within = within;
  coded.points = corners_of(cell);
  coded.fallbacks = map.statistics.conservative_fallbacks;
  auto back = flooded(sides_, mesh_, known, decoded_contours(sides_, coded, around));
  if (!holds(back, seen))
    throw scene::Error(scene::ErrorCode::internal, "contours: cell " + name + ": decoding lost what is visible");
  coded.exact = holds(seen, back);
  const auto list = list_of(sides_, back, {});
  std::set_difference(map.visible.begin(), map.visible.end(), list.begin(), list.end(),
                      std::back_inserter(coded.besides));
  file_.cells.push_back(std::move(coded));
  const auto number = static_cast<std::uint32_t>(file_.cells.size() - 1);
  last_.bytes = scene::contour_bytes(file_.cells, number).size();
  if (is_around) seen_[number] = std::move(back);
  return last_;
}

}  // namespace clues::reference
