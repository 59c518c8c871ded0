// clues query: can these points be seen from the cell? (D14, D18)
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/progress.h"
#include "scene/cell_spec.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"
#include "validate/certificates/point_query.h"
#include "validate/certificates/points_file.h"
#include "validate/certificates/segment_query.h"
#include "validate/verdicts/judge_report.h"

namespace clues::app {
namespace {

using nlohmann::json;

struct QueryRequest {
  std::string scene, cell, points;
  JsonOutput json;
  MethodOptions method;
};

struct Asked {
  validate::LinePoint at;
  validate::PointReport report;
  std::vector<validate::SegmentPart> parts;  // of a segment; then there is no report
};

// D22: the engines know what blocks only; its numbers there and in the scene.
void name_as_in_scene(validate::PointReport& report, const std::vector<std::uint32_t>& ids) {
  for (validate::PointAnswer& a : report.answers) {
    if (a.triangle) a.triangle = ids[*a.triangle];
    for (std::uint32_t& t : a.covered_by) t = ids[t];
  }
}

void move_back(Asked& q, const exact::StandardRange& range) {
  for (validate::PointAnswer& a : q.report.answers) {
    if (a.v) a.v = range.moved_back(*a.v);
  }
  for (validate::SegmentPart& part : q.parts) {
    if (part.v) part.v = range.moved_back(*part.v);
    part.at = range.moved_back(part.at);
  }
}

std::string sight_word(const validate::PointAnswer& a) { return a.v ? "visible" : "occluded"; }

json exact_json(const exact::Point3& p) {
  return {exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())};
}

json to_json(const validate::PointAnswer& a) {
  json out = {{"sight", sight_word(a)},
              {"first_order", a.first_order ? "visible" : "hidden"},
              {"fallback", a.fallback},
              {"triangle", nullptr},
              {"side", nullptr}};
  if (a.triangle) {
    out["triangle"] = *a.triangle;
    out["side"] = a.front ? "front" : "back";
  }
  if (a.v) {
    out["v"] = exact_json(*a.v);
  } else {
    out["covered_by"] = a.covered_by;
    out["faces_away"] = a.faces_away;
  }
  return out;
}

const char* word_of(validate::PartSight sight) {
  switch (sight) {
    case validate::PartSight::visible:
      return "visible";
    case validate::PartSight::undecided:
      return "undecided";
    case validate::PartSight::hidden:
      return "hidden";
  }
  return "?";
}

json segment_json(const Asked& q) {
  json parts = json::array();
  for (const auto& part : q.parts) {
    json out = {{"from", exact::to_string_exact(part.from)},
                {"to", exact::to_string_exact(part.to)},
                {"sight", word_of(part.sight)}};
    if (part.sight == validate::PartSight::visible) {
      out["at"] = exact_json(part.at);
      out["v"] = part.v ? exact_json(*part.v) : json();
    }
    parts.push_back(std::move(out));
  }
  return {{"line", q.at.line}, {"ends", {exact_json(q.at.point), exact_json(*q.at.end)}}, {"parts", std::move(parts)}};
}

std::string to_json_text(const std::vector<Asked>& all) {
  json points = json::array(), segments = json::array();
  for (const Asked& q : all) {
    if (q.at.end) {
      segments.push_back(segment_json(q));
      continue;
    }
    json answers = json::array();
    for (const auto& a : q.report.answers) answers.push_back(to_json(a));
    const bool surface = !q.report.answers.empty() && q.report.answers.front().triangle;
    points.push_back({{"line", q.at.line},
                      {"point", exact_json(q.at.point)},
                      {"place", q.report.in_cell ? "cell"
                                : surface        ? "surface"
                                                 : "space"},
                      {"answers", std::move(answers)}});
  }
  return json{{"format", "clues-query/1"}, {"points", std::move(points)}, {"segments", std::move(segments)}}.dump(2) +
         "\n";
}

std::string proof_of(const validate::PointAnswer& a) {
  std::string text;
  if (a.contradiction) text += "CONTRADICTION, please report: ";
  if (a.v) return text + "free sight line from " + validate::to_string_exact(*a.v);
  if (a.faces_away) return text + "this side faces away from the cell";
  text += "the cell is covered by triangle";
  text += a.covered_by.size() > 1 ? "s " : " ";
  for (std::size_t i = 0; i < a.covered_by.size(); ++i) text += fmt::format("{}{}", i ? ", " : "", a.covered_by[i]);
  if (a.first_order) text += a.fallback ? " (first-order: visible, by a limit)" : " (first-order: visible)";
  return text;
}

std::string part_line(std::uint64_t line, const validate::SegmentPart& part) {
  const std::string where = fmt::format("{} to {}", exact::to_string_exact(part.from), exact::to_string_exact(part.to));
  std::string proof = "no point is first-order visible";
  if (part.sight == validate::PartSight::undecided) proof = "first-order visible; no free sight line was found";
  if (part.sight == validate::PartSight::visible) {
    const std::string at = validate::to_string_exact(part.at);
    proof = part.v ? fmt::format("{} is seen from {}", at, validate::to_string_exact(*part.v))
                   : fmt::format("{} is in the cell", at);
  }
  return fmt::format("{:>6}  {:<18}  {:<9}  {}{}\n", line, where, word_of(part.sight),
                     part.contradiction ? "CONTRADICTION, please report: " : "", proof);
}

std::string to_text(const std::vector<Asked>& all) {
  std::string text = fmt::format("{:>6}  {:<18}  {:<9}  proof\n", "line", "where", "sight");
  for (const Asked& q : all) {
    for (const auto& part : q.parts) text += part_line(q.at.line, part);
    if (q.report.in_cell)
      text += fmt::format("{:>6}  {:<18}  {:<9}  the point is in the cell\n", q.at.line, "cell", "visible");
    for (const auto& a : q.report.answers) {
      const std::string where =
          a.triangle ? fmt::format("triangle {} {}", *a.triangle, a.front ? "front" : "back") : "space";
      text += fmt::format("{:>6}  {:<18}  {:<9}  {}\n", q.at.line, where, sight_word(a), proof_of(a));
    }
  }
  return text;
}

int run_query(const QueryRequest& request) {
  auto options = request.method.to_reference();
  require_writable_parent(request.json.file());
  require_apart({&request.json.file()}, {&request.scene, &request.cell, &request.points});
  const auto scene = scene::read_scene(request.scene);
  if (!scene.is_plain() && request.method.mode == "solid")
    throw scene::Error(scene::ErrorCode::unsupported,
                       request.scene + ": some triangles do not block or do not count; leave out --mode solid");
  const auto blocking = scene::blocking_ids(scene);
  const auto mesh = scene::part_of(scene.mesh, blocking);
  const auto cell = exact::ConvexCell::from_doubles(scene::parse_cell(request.cell).points);
  const auto points = validate::read_points(request.points);
  std::vector<Asked> all;
  {
    ProgressBar bar("clues query");
    options.progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
      bar.show(stage, done, total);
    };
    const reference::Omega omega(mesh, cell, options);
    const exact::StandardRange& range = omega.map().range;
    const scene::TriangleMesh mesh_in_range = range.moved_in(mesh);
    std::vector<exact::Point3> from, to;
    CGAL::Bbox_3 bounds;
    for (const auto& p : points) {
      from.push_back(range.moved_in(p.point));
      to.push_back(p.end ? range.moved_in(*p.end) : from.back());
      bounds += from.back().bbox() + to.back().bbox();
    }
    const validate::PointQuery query(mesh_in_range, omega, bounds);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].end) {
        all.push_back({points[i], {}, validate::ask_segment(query, omega, from[i], to[i])});
      } else {
        all.push_back({points[i], query.ask(from[i]), {}});
      }
      move_back(all.back(), range);
      name_as_in_scene(all.back().report, blocking);
      bar.show("points", all.size(), points.size());
    }
  }
  if (request.json.asked()) request.json.write(to_json_text(all));
  if (!request.json.on_stdout()) std::fputs(to_text(all).c_str(), stdout);
  const bool contradiction = std::any_of(all.begin(), all.end(), [](const Asked& q) {
    const auto bad = [](const auto& a) { return a.contradiction; };
    return std::any_of(q.report.answers.begin(), q.report.answers.end(), bad) ||
           std::any_of(q.parts.begin(), q.parts.end(), bad);
  });
  return contradiction ? oracle_contradiction : fine;
}

}  // namespace

void add_query_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("query", "Ask whether single points can be seen from the cell, with a proof");
  auto request = std::make_shared<QueryRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cell", request->cell, "The view cell")->type_name("SPEC")->required();
  command
      ->add_option(
          "--points", request->points,
          "The points: x y z a line, or the two ends of a segment; decimals or exact fractions p/q,\n# comments")
      ->type_name("FILE")
      ->required();
  request->method.add_to(*command);
  request->json.add_to(*command, "The answers");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  visible    a point of the cell is printed, as fractions, from which nothing lies before the point.\n"
          "  occluded   triangles are printed that cover the whole cell when it is looked at from the point; none can "
          "be\n"
          "             left out. \"first-order: visible\" marks points that clues map counts as visible all the "
          "same.\n"
          "  A point in free space has one answer, a point of a surface one for each side; a point of an edge or a "
          "vertex has\n"
          "  the answers of all triangles there. A point of the cell is visible.\n"
          "  What does not block (glass, curves: docs/real-levels.md) is air: its points are points of space, and "
          "nothing is\n"
          "  hidden behind it.\n"
          "  A segment is cut into parts (from 0 at its first end to 1): visible at a point that is named, hidden as a "
          "whole, or\n"
          "  undecided: visible to the first-order method, but no free sight line was found.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  echo '3 1/3 0.5' > points.txt\n"
      "  clues query town.obj --cell box:0,0,1,2,2,2 --points points.txt\n"
      "  clues query town.obj --cell box:0,0,1,2,2,2 --points points.txt --json\n\n"
      "EXIT CODES\n"
      "  0 all answered   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_query(*request); });
}

}  // namespace clues::app
