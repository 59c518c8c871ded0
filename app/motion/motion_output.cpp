// Frames as text.
#include "app/motion/motion_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/ply_text.h"

namespace clues::app {
namespace {

double share(std::uint64_t part, std::uint64_t of) {
  return of == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(of);
}

struct Curve {
  const char *name, *colour;
  double (*value)(const FrameReport&);
};

constexpr std::array<Curve, 4> curves{{
    {"examined", "#1f77b4", [](const FrameReport& f) { return share(f.examined, f.triangles); }},
    {"tested", "#2ca02c", [](const FrameReport& f) { return share(f.tested, f.triangles); }},
    {"changed", "#ff7f0e", [](const FrameReport& f) { return share(f.triangles - f.reused, f.triangles); }},
    {"removed samples", "#d62728", [](const FrameReport& f) { return share(f.removed, f.triangles); }},
}};

}  // namespace

std::string to_csv(const std::vector<FrameReport>& frames) {
  std::string text =
      "frame,x,y,z,odometer,triangles,samples,examined,tested,removed,flipped,inserted,reinserted,reused,rays,exact,"
      "rebuilt\n";
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const FrameReport& f = frames[k];
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", k, f.at[0], f.at[1], f.at[2],
                        f.odometer, f.triangles, f.samples, f.examined, f.tested, f.removed, f.flipped, f.inserted,
                        f.reinserted, f.reused, f.rays, f.exact, f.rebuilt ? 1 : 0);
  }
  return text;
}

// From 0.001 % at the bottom to 100 % at the top; less than that lies at the bottom. The first frame, in which everything is made, is left out.
std::string to_svg(const std::vector<FrameReport>& frames) {
  constexpr double left = 70, top = 30, width = 760, height = 350;
  const auto y_of = [&](double percent) {
    return top + height * (2 - std::log10(std::clamp(percent, 1e-3, 100.0))) / 5;
  };
  const std::size_t count = frames.size() > 1 ? frames.size() - 1 : 1;
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" height=\"430\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"1000\" height=\"430\" fill=\"white\"/>\n";
  for (int power = -3; power <= 2; ++power) {
    const double y = y_of(std::pow(10.0, power));
    svg += fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n", left, y,
                       left + width, y);
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{} %</text>\n", left - 8, y + 4,
                       power >= 0 ? fmt::format("{:.0f}", std::pow(10.0, power))
                                  : fmt::format("{:.{}f}", std::pow(10.0, power), -power));
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" points=\"", curves[c].colour);
    for (std::size_t k = 1; k < frames.size(); ++k) {
      svg += fmt::format("{:.1f},{:.1f} ", left + width * static_cast<double>(k) / static_cast<double>(count),
                         y_of(curves[c].value(frames[k])));
    }
    svg += "\"/>\n";
    svg += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", left + width + 12, 50 + 20 * c,
                       curves[c].colour, curves[c].name);
  }
  svg += fmt::format("<text x=\"{}\" y=\"{}\">frames 1 to {}; percent of the triangles of the mesh</text>\n</svg>\n",
                     left, top + height + 30, frames.size() > 1 ? frames.size() - 1 : 0);
  return svg;
}

WalkSummary summary_of(const std::vector<FrameReport>& frames) {
  WalkSummary s;
  if (frames.empty()) return s;
  s.triangles = frames.back().triangles;
  s.samples = frames.back().samples;
  s.way = frames.back().odometer;
  s.frames = frames.size() - 1;
  if (s.frames == 0) return s;
  double removed = 0, examined = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const FrameReport& f = frames[k];
    s.examined += share(f.examined, f.triangles);
    s.tested += share(f.tested, f.triangles);
    s.reused += share(f.reused, f.triangles);
    examined += static_cast<double>(f.examined);
    removed += static_cast<double>(f.removed);
    s.flipped += static_cast<double>(f.flipped);
    s.inserted += static_cast<double>(f.inserted);
    s.reinserted += static_cast<double>(f.reinserted);
    s.rays += static_cast<double>(f.rays);
    s.exact += static_cast<double>(f.exact);
    s.rebuilt += f.rebuilt ? 1 : 0;
  }
  const auto n = static_cast<double>(s.frames);
  for (double* x : {&s.examined, &s.tested, &s.reused, &s.flipped, &s.inserted, &s.reinserted, &s.rays, &s.exact})
    *x /= n;
  s.removed = removed / n;
  s.removed_of_examined = examined > 0 ? 100 * removed / examined : 0;
  return s;
}

std::string to_json_text(const std::vector<FrameReport>& frames, const fastpath::motion::WalkOptions& options,
                         const std::string& scene, const std::string& path) {
  using nlohmann::json;
  using Bounds = fastpath::motion::WalkOptions::Bounds;
  json list = json::array();
  for (const FrameReport& f : frames) {
    list.push_back({{"at", f.at},
                    {"odometer", f.odometer},
                    {"triangles", f.triangles},
                    {"samples", f.samples},
                    {"examined", f.examined},
                    {"tested", f.tested},
                    {"removed", f.removed},
                    {"flipped", f.flipped},
                    {"inserted", f.inserted},
                    {"reinserted", f.reinserted},
                    {"reused", f.reused},
                    {"rays", f.rays},
                    {"exact", f.exact},
                    {"rebuilt", f.rebuilt}});
  }
  const WalkSummary s = summary_of(frames);
  const char* bounds = options.bounds == Bounds::sound     ? "sound"
                       : options.bounds == Bounds::none    ? "none"
                       : options.bounds == Bounds::rebuild ? "rebuild"
                                                           : "sketch-unsound";
  return json{{"format", "clues-motion/1"},
              {"scene", scene},
              {"path", path},
              {"bounds", bounds},
              {"samples", options.samples},
              {"seed", options.seed},
              {"thresholds",
               {{"kappa", options.thresholds.kappa},
                {"sigma", options.thresholds.sigma},
                {"delaunay", options.thresholds.delaunay}}},
              {"mean",
               {{"examined_percent", s.examined},
                {"tested_percent", s.tested},
                {"reused_percent", s.reused},
                {"removed", s.removed},
                {"flipped", s.flipped},
                {"inserted", s.inserted},
                {"rays", s.rays}}},
              {"rebuilt", s.rebuilt},
              {"frames", std::move(list)}}
             .dump(2) +
         "\n";
}

std::string to_ply(const scene::DepthMesh& mesh, const scene::MotionPoint& at) {
  double furthest = 1;
  for (const auto& s : mesh.samples) {
    if (!s.is_direction) furthest = std::max(furthest, fastpath::motion::distance_up(s.at, at));
  }
  const std::string comment = fmt::format("a depth mesh around {} {} {}", at[0], at[1], at[2]);
  scene::PlyText text(mesh.samples.size(), mesh.triangles.size(),
                      {.comment = comment, .of_vertex = "property uchar kind\n"});
  for (const auto& s : mesh.samples) {
    scene::MotionPoint p = s.at;
    if (s.is_direction) {
      const double length = std::sqrt(s.at[0] * s.at[0] + s.at[1] * s.at[1] + s.at[2] * s.at[2]);
      for (std::size_t i = 0; i < 3; ++i) p[i] = at[i] + s.at[i] / length * (2 * furthest);
    }
    text.vertex(p, {s.is_base ? 2U : s.is_direction ? 1U : 0U});
  }
  for (const auto& t : mesh.triangles) text.face({t[0], t[1], t[2]});
  return text.take();
}

}  // namespace clues::app
