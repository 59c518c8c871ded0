// Findings as JSON: what the store keeps and what workers send.
#include "fuzz/findings/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "fuzz/findings/dials.h"
#include "fuzz/findings/json_fields.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "validate/certificates/words.h"

namespace clues::fuzz {
namespace {

using nlohmann::json;

json to_json(const Finding& f) {
  json out{{"oracle", f.oracle},
           {"verdict", f.verdict},
           {"generator", f.where.generator},
           {"seed", f.where.seed},
           {"index", f.where.index},
           {"points", f.where.mesh.points},
           {"cell", f.where.cell},
           {"triangles", f.where.mesh.triangles},
           {"explanation", f.explanation}};
  if (f.where.solid) out["solid"] = true;
  if (!f.where.dials.empty()) out["dials"] = f.where.dials;
  if (const json flags = flags_json(f.where); !flags.empty()) out["flags"] = flags;
  if (f.triangle) out["triangle"] = *f.triangle;
  if (f.witness) {
    out["witness"] = {
        {"triangle", f.witness->triangle}, {"front", f.witness->front}, {"v", f.witness->v}, {"p", f.witness->p}};
  }
  return out;
}

Finding to_finding(const json& in) {
  Finding f;
  in.at("oracle").get_to(f.oracle);
  in.at("verdict").get_to(f.verdict);
  in.at("generator").get_to(f.where.generator);
  f.where.seed = whole_number<std::uint64_t>(in, "seed");
  f.where.index = whole_number<std::uint64_t>(in, "index");
  for (const char* name : {"points", "cell"}) {
    auto& points = std::string_view(name) == "cell" ? f.where.cell : f.where.mesh.points;
    for (const json& p : in.at(name)) points.push_back(three<double>(p, [](const json& x) { return x.get<double>(); }));
  }
  for (const json& t : in.at("triangles"))
    f.where.mesh.triangles.push_back(three<std::uint32_t>(t, [](const json& x) { return whole<std::uint32_t>(x); }));
  in.at("explanation").get_to(f.explanation);
  f.where.solid = in.value("solid", false);
  f.where.dials = numbers_by_name(in, "dials");
  for (std::uint32_t t = 0; t < f.where.mesh.triangles.size(); ++t) f.where.mesh.face_of.push_back(t);
  if (in.contains("flags")) take_flags(in.at("flags"), f.where);
  if (in.contains("triangle")) f.triangle = whole_number<std::uint32_t>(in, "triangle");
  if (in.contains("witness")) {
    const json& w = in.at("witness");
    f.witness = WitnessText{whole_number<std::uint32_t>(w, "triangle"), w.at("front").get<bool>(),
                            three_texts(w.at("v")), three_texts(w.at("p"))};
  }
  require_whole(f, "a finding");
  return f;
}

template <class Read>
auto parsed(const std::string& text, const Read& read) {
  return reading_fields([&] { return read(scene::parse_json_text(text)); },
                        [](const std::string& what) {
                          return scene::Error(scene::ErrorCode::malformed, "this is not a finding: " + what);
                        });
}

bool rests_on_a_sight_line(const std::string& verdict) {
  return verdict == "hidden/visible" || verdict == "hidden-region/visible";
}

bool is_about_a_triangle(const std::string& verdict) {
  return rests_on_a_sight_line(verdict) || verdict == "hidden/meets-cell" || verdict == "hidden/first-order-visible" ||
         verdict == "hidden/seen-through" || verdict == "visible/first-order-hidden";
}

bool is_about_the_answer(const std::string& verdict) {
  return verdict == "answer/other-answer" || verdict == "label/other-label" || verdict == "no-answer/answer" ||
         verdict == "crash/answer" || verdict == "no-end/answer" || verdict == broken_promise;
}

}  // namespace

scene::FlaggedMesh flagged(const Case& scene) { return {scene.mesh, scene.blocks, scene.counts, {}}; }

Finding without_answer(const Case& scene, const std::string& why) {
  Finding f;
  f.oracle = "subject";
  f.verdict = "no-answer/answer";
  f.where = scene;
  f.explanation = why;
  return f;
}

void require_whole(const Finding& f, const std::string& place) {
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds)
      throw scene::Error(scene::ErrorCode::malformed,
                         place + ": " + what + "; it was changed, or is of another version");
  };
  const auto finite = [](const std::vector<scene::Point>& points) {
    return std::all_of(points.begin(), points.end(), [](const scene::Point& p) {
      return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    });
  };
  const auto& mesh = f.where.mesh;
  require(is_about_a_triangle(f.verdict) || is_about_the_answer(f.verdict),
          fmt::format("'{}' is no verdict of the fuzzer", scene::printable(f.verdict, 40)));
  require(!mesh.triangles.empty() && !f.where.cell.empty(), "the scene has no triangle, or the cell no point");
  for (const auto& [name, value] : f.where.dials)
    require(is_a_setting(name, value),
            fmt::format("no dial '{}' can be turned to {}", scene::printable(name, 40), value));
  require(finite(mesh.points) && finite(f.where.cell), "a coordinate is not finite");
  for (const auto& t : mesh.triangles)
    require(std::all_of(t.begin(), t.end(), [&](std::uint32_t corner) { return corner < mesh.points.size(); }),
            "a triangle has a corner that is no point");
  for (const auto* flags : {&f.where.blocks, &f.where.counts})
    require(flags->empty() || flags->size() == mesh.triangles.size(), "there are not as many flags as triangles");
  require(!f.triangle || *f.triangle < mesh.triangles.size(), "it names a triangle that the scene does not have");
  require(f.triangle || !is_about_a_triangle(f.verdict), "the verdict is about a triangle, and none is named");
  require(f.witness || !rests_on_a_sight_line(f.verdict), "the verdict rests on a sight line, and there is none");
  if (!f.witness) return;
  require(f.triangle && f.witness->triangle == *f.triangle, "the sight line ends on another triangle");
  for (const auto* point : {&f.witness->v, &f.witness->p})
    for (const auto& x : *point)
      require(validate::is_rational(x), fmt::format("'{}' is no fraction in lowest terms", scene::printable(x, 40)));
}

std::string to_json_text(const Finding& finding) { return dumped(to_json(finding)); }

Finding finding_from_json_text(const std::string& text) { return parsed(text, to_finding); }

std::string to_json_text(const Outcome& outcome) {
  json out{{"findings", json::array()}, {"contradictions", outcome.contradictions}, {"counters", outcome.counters}};
  for (const Finding& f : outcome.findings) out["findings"].push_back(to_json(f));
  return dumped(out);
}

Outcome outcome_from_json_text(const std::string& text) {
  return parsed(text, [](const json& in) {
    Outcome outcome;
    in.at("contradictions").get_to(outcome.contradictions);
    for (const auto& [name, value] : in.at("counters").items()) outcome.counters[name] = whole<std::uint64_t>(value);
    for (const json& f : in.at("findings")) outcome.findings.push_back(to_finding(f));
    return outcome;
  });
}

}  // namespace clues::fuzz
