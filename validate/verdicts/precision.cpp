#include "validate/verdicts/precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/visibility/refinement/backprojection.h"
#include "scene/messages/percent.h"

namespace clues::validate {

using reference::AreaEstimate;
using reference::DepthFigures;

PrecisionReport refine(reference::Bounds& bounds, Refinement refinement, const reference::RefineOptions& options) {
  PrecisionReport report{refinement, {}, {}, 0, {}};
  if (refinement == Refinement::backprojection || refinement == Refinement::both) {
    report.depths = reference::refine_by_backprojection(bounds, options);
  }
  if (refinement != Refinement::backprojection) {
    reference::RefineOptions cells = options;
    if (refinement == Refinement::none) cells.max_depth = 0;
    const std::vector<DepthFigures> more = reference::refine_by_cells(bounds, cells);
    report.depths.insert(report.depths.end(), more.begin(), more.end());
  }
  report.triangles = bounds.by_triangle();
  report.range = bounds.range();
  report.fallbacks = bounds.first_order().statistics.conservative_fallbacks + bounds.fallbacks();
  return report;
}

const char* name_of(Refinement refinement) {
  switch (refinement) {
    case Refinement::none:
      return "none";
    case Refinement::cells:
      return "cell";
    case Refinement::backprojection:
      return "backprojection";
    case Refinement::both:
      break;
  }
  return "both";
}

std::string to_table(const PrecisionReport& report) {
  std::string text =
      "depth  cells   maps  backprojections  viewpoints       witnessed         refined          excess  of facing\n";
  for (const DepthFigures& d : report.depths) {
    const std::string share = scene::percent(d.area.excess(), d.area.facing, 3);
    text +=
        fmt::format("{:>5}  {:>5}  {:>5}  {:>15}  {:>10}  {:>14.6g}  {:>14.6g}  {:>14.6g}  {:>7} %\n", d.depth, d.cells,
                    d.maps, d.backprojections, d.viewpoints, report.range.area_moved_back(d.area.lower),
                    report.range.area_moved_back(d.area.upper), report.range.area_moved_back(d.area.excess()), share);
  }
  const auto decided =
      std::count_if(report.triangles.begin(), report.triangles.end(), [](const auto& t) { return t.lower == t.upper; });
  const auto hidden = std::count_if(report.triangles.begin(), report.triangles.end(),
                                    [](const auto& t) { return t.upper == exact::FT(0); });
  return text +
         fmt::format(
             "sides of triangles visible to first order: {}; of these exactly known: {}, among them hidden after "
             "all: {}\n",
             report.triangles.size(), decided, hidden);
}

std::string to_json_text(const PrecisionReport& report, const std::string& scene_file,
                         const std::string& scene_sha256) {
  using nlohmann::json;
  json depths = json::array(), triangles = json::array();
  const auto area = [&](double x) { return report.range.area_moved_back(x); };
  for (const DepthFigures& d : report.depths) {
    depths.push_back({{"depth", d.depth},
                      {"cells", d.cells},
                      {"maps", d.maps},
                      {"viewpoints", d.viewpoints},
                      {"backprojections", d.backprojections},
                      {"area",
                       {{"facing", area(d.area.facing)},
                        {"witnessed", area(d.area.lower)},
                        {"refined", area(d.area.upper)},
                        {"first_order", area(d.area.first_order)},
                        {"excess", area(d.area.excess())}}}});
  }
  for (const auto& t : report.triangles) {
    triangles.push_back({{"triangle", t.triangle},
                         {"side", t.front ? "front" : "back"},
                         {"witnessed", exact::to_string_exact(t.lower)},
                         {"refined", exact::to_string_exact(t.upper)},
                         {"first_order", exact::to_string_exact(t.first_order)}});
  }
  const json out{{"format", "clues-precision/1"},
                 {"scene", {{"file", scene_file}, {"sha256", scene_sha256}}},
                 {"refinement", name_of(report.refinement)},
                 {"conservative_fallbacks", report.fallbacks},
                 {"depths", depths},
                 {"triangles", triangles}};
  return out.dump(2) + "\n";
}

std::string to_svg(const PrecisionReport& report) {
  constexpr double width = 480, height = 300, left = 80, right = 20, top = 30, bottom = 45;
  double most = 0;
  for (const DepthFigures& d : report.depths) most = std::max(most, d.area.excess());
  const auto x = [&](std::size_t i) {
    const double n = std::max<double>(1, static_cast<double>(report.depths.size()) - 1);
    return left + (width - left - right) * static_cast<double>(i) / n;
  };
  const auto y = [&](double v) { return height - bottom - (height - top - bottom) * (most > 0 ? v / most : 0); };
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"18\">area not known to be visible or hidden, by depth of refinement ({3})</text>\n",
      width, height, left, name_of(report.refinement));
  for (int k = 0; k <= 4; ++k) {
    const double v = most * k / 4;
    text += fmt::format("<line x1=\"{0}\" y1=\"{1:.2f}\" x2=\"{2}\" y2=\"{1:.2f}\" stroke=\"#ccc\"/>\n", left, y(v),
                        width - right);
    text += fmt::format("<text x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{:.4g}</text>\n", left - 6, y(v) + 4,
                        report.range.area_moved_back(v));
    if (most == 0) break;
  }
  std::string line;
  for (std::size_t i = 0; i < report.depths.size(); ++i) {
    const DepthFigures& d = report.depths[i];
    line += fmt::format("{:.2f},{:.2f} ", x(i), y(d.area.excess()));
    text += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3\" fill=\"#1a5fb4\"/>\n", x(i), y(d.area.excess()));
    text += fmt::format("<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x(i), height - bottom + 18,
                        d.depth);
  }
  text += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#1a5fb4\"/>\n", line);
  return text + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">depth</text>\n</svg>\n",
                            (left + width - right) / 2, height - 8);
}

}  // namespace clues::validate
