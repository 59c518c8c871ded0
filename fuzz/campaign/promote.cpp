#include "fuzz/campaign/promote.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/formats/file_bytes.h"
#include "validate/vectors/lint.h"
#include "validate/vectors/reader.h"
#include "validate/vectors/words.h"
#include "validate/vectors/writer.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

constexpr const char* flag = "FoundByFuzzing";

std::string this_month() {
  const std::chrono::year_month_day today(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
  return fmt::format("{:04}-{:02}", static_cast<int>(today.year()), static_cast<unsigned>(today.month()));
}

validate::VectorFile new_file() {
  validate::VectorFile file;
  file.topic = "found";
  file.definition = "D7";
  file.source = {"clues fuzz", this_month(), std::nullopt,
                 "the exhaustive visible set (computed without the first-order map) and the point-occlusion oracle"};
  file.notes[flag] = {"METHOD",
                      "A scene in which an implementation was wrong, as the fuzzer shrank it.",
                      "Something visible is called hidden, or there is no answer.",
                      {}};
  return file;
}

// The files that promotion may change, put back unless `keep` was called.
class Restored {
 public:
  explicit Restored(std::vector<fs::path> files) {
    for (auto& f : files) {
      before_.emplace_back(f, fs::exists(f) ? std::optional(scene::read_file_bytes(f)) : std::nullopt);
    }
  }
  Restored(const Restored&) = delete;
  Restored& operator=(const Restored&) = delete;
  ~Restored() {
    if (kept_) return;
    for (const auto& [file, bytes] : before_) {
      std::error_code ignored;
      try {
        bytes ? scene::write_file_atomically(file, *bytes) : void(fs::remove(file, ignored));
      } catch (const Error&) {  // the first error is the one to tell
      }
    }
  }
  void keep() { kept_ = true; }

 private:
  std::vector<std::pair<fs::path, std::optional<std::string>>> before_;
  bool kept_ = false;
};

}  // namespace

void promote(const Finding& finding, const std::string& id, const fs::path& suite) {
  if (!validate::is_slug(id))
    throw Error(ErrorCode::bad_argument, "--id " + id + ": lower-case words joined by '-' are needed");
  if (validate::read_vector_index(suite).cases.contains(id))
    throw Error(ErrorCode::bad_argument, "--id " + id + ": the suite has or had a case of this id; choose another");
  const fs::path path = suite / "found.json";
  validate::VectorFile file = fs::exists(path) ? validate::read_vector_file(path) : new_file();
  validate::VectorCase c;
  c.id = c.scene = id;
  c.comment = fmt::format("{}: {} (generator {}, seed {}, scene {}).", finding.oracle, finding.explanation,
                          finding.where.generator, finding.where.seed, finding.where.index);
  c.flags = {flag};
  c.level = validate::CaseLevel::full;
  c.mode = finding.where.solid ? validate::CaseMode::solid : validate::CaseMode::sheet;
  c.mesh = finding.where.mesh;
  c.cell = finding.where.cell;
  file.scenes[id] = {c.mesh.points, c.mesh.triangles};
  file.cases.push_back(std::move(c));
  Restored restored({path, suite / "index.json"});
  scene::write_file_atomically(path, validate::to_json_text(file));
  validate::LintOptions options;
  options.glob = id;
  options.write = true;
  const auto report = validate::lint_suite(suite, options);
  if (!report.findings.empty())
    throw Error(ErrorCode::malformed,
                suite.string() + ": " + id + " was not taken in: " + report.findings.front().message);
  restored.keep();
}

}  // namespace clues::fuzz
