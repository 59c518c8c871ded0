// The runner of vectors/motion, and the program that answers with the reference.
#include "validate/motion/motion_conform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "reference/motion/mesh.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/motion/motion_files.h"
#include "validate/motion/judge_bounds.h"
#include "validate/processes/child_process.h"
#include "validate/vectors/reader.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;
using Clock = ChildProcess::Clock;

constexpr std::size_t longest_answer = std::size_t{1} << 20;

[[noreturn]] void fail(const std::string& what) { throw scene::Error(scene::ErrorCode::malformed, what); }

Json parsed(const std::string& line) {
  try {
    return scene::parse_json_text(line);
  } catch (const scene::JsonError& e) {
    fail(e.what());
  }
}

const char* name_of(MotionGrade grade) {
  switch (grade) {
    case MotionGrade::sound:
      return "sound";
    case MotionGrade::unsound:
      return "unsound";
    case MotionGrade::undecided:
      return "undecided";
    case MotionGrade::failed:
      break;
  }
  return "failed";
}

}  // namespace

std::string question_of(const MotionVector& test) {
  std::string line = "{\"case\": " + Json(test.id).dump() + ", \"format\": \"clues-motion-question/1\", \"samples\": [";
  for (std::size_t i = 0; i < test.mesh.samples.size(); ++i) {
    line.append(i == 0 ? "" : ", ").append(scene::to_text(test.mesh.samples[i]));
  }
  line += "], \"thresholds\": " + scene::to_text(test.thresholds) + ", \"triangles\": [";
  for (std::size_t i = 0; i < test.mesh.triangles.size(); ++i) {
    const auto& t = test.mesh.triangles[i];
    line.append(i == 0 ? "" : ", ").append(fmt::format("[{}, {}, {}]", t[0], t[1], t[2]));
  }
  return line + "], \"viewpoint\": " + scene::to_text(test.viewpoint) + "}";
}

std::vector<double> parse_motion_answer(const std::string& line, const MotionVector& test) {
  const auto root = parsed(line);
  if (!root.is_object() || root.size() != 3 || root.value("format", Json()) != "clues-motion-answer/1" ||
      !root.contains("case") || !root.contains("bounds")) {
    fail(R"(an answer is {"format": "clues-motion-answer/1", "case": ID, "bounds": [...]})");
  }
  if (root["case"] != test.id) fail("answers " + scene::json_excerpt(root["case"]) + ", not '" + test.id + "'");
  const auto& list = root["bounds"];
  if (!list.is_array() || list.size() != test.mesh.triangles.size()) {
    fail(fmt::format("\"bounds\" must be a list of {}, one a triangle", test.mesh.triangles.size()));
  }
  std::vector<double> bounds;
  for (const auto& value : list) bounds.push_back(scene::bound_of(value, fmt::format("bound {}", bounds.size())));
  return bounds;
}

MotionResult graded(const MotionVector& test, const std::vector<double>& bounds) {
  MotionResult out;
  out.id = test.id;
  // What is not more than what is known to be sound needs no proof again.
  auto claims = bounds;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (claims[i] <= test.sound[i]) claims[i] = 0;
  }
  const auto report = judge_motion_bounds(test.mesh, test.thresholds, test.viewpoint, claims);
  out.grade = report.refuted != 0     ? MotionGrade::unsound
              : report.undecided != 0 ? MotionGrade::undecided
                                      : MotionGrade::sound;
  if (out.grade != MotionGrade::sound) out.what = to_text(report, test.mesh);
  double sum = 0;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (test.sound[i] == 0) continue;
    ++out.weighed;
    sum += bounds[i] >= test.sound[i] ? 1 : std::isinf(test.sound[i]) ? 0 : bounds[i] / test.sound[i];
  }
  out.tightness = out.weighed == 0 ? 0 : sum / static_cast<double>(out.weighed);
  return out;
}

MotionConformReport conform_motion(const std::vector<MotionVector>& cases, const std::vector<std::string>& command,
                                   const MotionConformOptions& options) {
  MotionConformReport report;
  std::unique_ptr<ChildProcess> program;
  double sum = 0;
  std::uint64_t weighed = 0;
  for (const auto& test : cases) {
    if (!matches_glob(test.id, options.glob)) continue;
    if (!program) program = std::make_unique<ChildProcess>(command, 0);
    MotionResult result;
    result.id = test.id;
    const auto deadline = Clock::now() + options.time;
    std::string line;
    auto io = program->write_line(question_of(test), deadline);
    if (io == ChildProcess::Io::ok) io = program->read_line(line, deadline, longest_answer);
    if (io != ChildProcess::Io::ok) {
      const auto end = program->finish(Clock::now());
      result.what = io == ChildProcess::Io::late       ? "no answer in time"
                    : io == ChildProcess::Io::too_long ? "an answer without end"
                                                       : "it " + describe(end);
      if (const auto errors = program->stderr_tail(); !errors.empty()) result.what += "; it wrote: " + errors;
      program.reset();
    } else {
      try {
        result = graded(test, parse_motion_answer(line, test));
      } catch (const scene::Error& e) {
        result.what = e.what();
        program->finish(Clock::now());
        program.reset();
      }
    }
    ++(result.grade == MotionGrade::sound       ? report.sound
       : result.grade == MotionGrade::unsound   ? report.unsound
       : result.grade == MotionGrade::undecided ? report.undecided
                                                : report.failed);
    if (result.grade == MotionGrade::sound) {
      sum += result.tightness * static_cast<double>(result.weighed);
      weighed += result.weighed;
    }
    report.results.push_back(std::move(result));
  }
  if (program) program->finish(Clock::now() + options.time);
  report.tightness = weighed == 0 ? 0 : sum / static_cast<double>(weighed);
  return report;
}

void answer_motion_questions(std::istream& in, std::ostream& out) {
  std::string line;
  while (std::getline(in, line)) {
    const auto root = parsed(line);
    if (!root.is_object() || root.value("format", Json()) != "clues-motion-question/1") {
      fail("this is no clues-motion-question/1");
    }
    for (const char* key : {"case", "samples", "triangles", "thresholds", "viewpoint"}) {
      if (!root.contains(key)) fail(fmt::format("the field \"{}\" is missing", key));
    }
    const auto mesh = scene::depth_mesh_of(root["samples"], root["triangles"], "question");
    const auto thresholds = scene::thresholds_of(root["thresholds"], "question: thresholds");
    const auto viewpoint = scene::motion_point_of(root["viewpoint"], "question: viewpoint");
    const auto bounds = reference::motion_bounds(mesh, thresholds, exact::exact_viewpoint(viewpoint));
    out << "{\"bounds\": [";
    for (std::size_t i = 0; i < bounds.size(); ++i) out << (i == 0 ? "" : ", ") << scene::bound_to_text(bounds[i]);
    out << "], \"case\": " << root["case"].dump() << ", \"format\": \"clues-motion-answer/1\"}" << std::endl;
  }
}

std::string to_text(const MotionConformReport& report, bool all) {
  std::string text;
  for (const auto& result : report.results) {
    if (!all && result.grade == MotionGrade::sound) continue;
    text += fmt::format("{:<10} {}", name_of(result.grade), result.id);
    if (result.grade == MotionGrade::sound && result.weighed != 0)
      text += fmt::format("  tightness {:.3f}", result.tightness);
    text += "\n";
    if (!result.what.empty()) text += "    " + result.what + (result.what.ends_with('\n') ? "" : "\n");
  }
  text += fmt::format("{} cases: {} sound, {} unsound, {} undecided, {} failed\n", report.results.size(), report.sound,
                      report.unsound, report.undecided, report.failed);
  return text + fmt::format("tightness of the sound ones: {:.3f} of what is known to be sound\n", report.tightness);
}

std::string to_json_text(const MotionConformReport& report) {
  auto results = Json::array();
  for (const auto& result : report.results) {
    Json item{{"case", result.id}, {"grade", name_of(result.grade)}, {"tightness", result.tightness}};
    if (!result.what.empty()) item["what"] = result.what;
    results.push_back(std::move(item));
  }
  const Json root{{"format", "clues-motion-conform/1"}, {"sound", report.sound},   {"unsound", report.unsound},
                  {"undecided", report.undecided},      {"failed", report.failed}, {"tightness", report.tightness},
                  {"results", std::move(results)}};
  return root.dump(2).append("\n");
}

}  // namespace clues::validate
