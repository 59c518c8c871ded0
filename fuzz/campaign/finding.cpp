// Findings as JSON: what the store keeps and what workers send.
#include "fuzz/campaign/finding.h"

#include <nlohmann/json.hpp>

#include "scene/error.h"

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
  in.at("seed").get_to(f.where.seed);
  in.at("index").get_to(f.where.index);
  in.at("points").get_to(f.where.mesh.points);
  in.at("triangles").get_to(f.where.mesh.triangles);
  in.at("cell").get_to(f.where.cell);
  in.at("explanation").get_to(f.explanation);
  f.where.solid = in.value("solid", false);
  f.where.dials = in.value("dials", CaseDials{});
  for (const auto& t : f.where.mesh.triangles) {
    f.where.mesh.face_of.push_back(static_cast<std::uint32_t>(f.where.mesh.face_of.size()));
    for (const auto corner : t) {
      if (corner >= f.where.mesh.points.size())
        throw scene::Error(scene::ErrorCode::malformed, "a finding has a triangle corner that is no point");
    }
  }
  if (in.contains("triangle")) f.triangle = in.at("triangle").get<std::uint32_t>();
  if (in.contains("witness")) {
    const json& w = in.at("witness");
    f.witness = WitnessText{w.at("triangle").get<std::uint32_t>(), w.at("front").get<bool>(),
                            w.at("v").get<std::array<std::string, 3>>(), w.at("p").get<std::array<std::string, 3>>()};
  }
  return f;
}

template <class Read>
auto parsed(const std::string& text, const Read& read) {
  try {
    return read(json::parse(text));
  } catch (const json::exception& error) {
    throw scene::Error(scene::ErrorCode::malformed, std::string("this is not a finding: ") + error.what());
  }
}

}  // namespace

std::string to_json_text(const Finding& finding) { return to_json(finding).dump(); }

Finding finding_from_json_text(const std::string& text) { return parsed(text, to_finding); }

std::string to_json_text(const Outcome& outcome) {
  json out{{"findings", json::array()}, {"contradictions", outcome.contradictions}, {"counters", outcome.counters}};
  for (const Finding& f : outcome.findings) out["findings"].push_back(to_json(f));
  return out.dump();
}

Outcome outcome_from_json_text(const std::string& text) {
  return parsed(text, [](const json& in) {
    Outcome outcome;
    in.at("contradictions").get_to(outcome.contradictions);
    in.at("counters").get_to(outcome.counters);
    for (const json& f : in.at("findings")) outcome.findings.push_back(to_finding(f));
    return outcome;
  });
}

}  // namespace clues::fuzz
