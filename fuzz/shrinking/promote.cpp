#include "fuzz/shrinking/promote.h"

#include <fmt/format.h>

#include <chrono>

#include "scene/files/atomic_file.h"
#include "scene/files/folder_update.h"
#include "scene/files/temporary_folder.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "validate/certificates/words.h"
#include "validate/vectors/lint.h"
#include "validate/vectors/reader.h"
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

// The suite's files, with found.json as given, in a folder where lint may write.
void copy_suite(const fs::path& suite, const std::string& found, const fs::path& to) {
  for (const fs::path& file : validate::vector_files(suite))
    scene::write_file_atomically(to / file.filename(), scene::read_file_bytes(file));
  scene::write_file_atomically(to / "index.json", scene::read_file_bytes(suite / "index.json"));
  scene::write_file_atomically(to / "found.json", found);
}

std::string bytes_or_none(const fs::path& file) { return fs::exists(file) ? scene::read_file_bytes(file) : ""; }

}  // namespace

void promote(const Finding& finding, const std::string& id, const fs::path& given) {
  if (!validate::is_slug(id))
    throw Error(ErrorCode::bad_argument, "--id " + id + ": lower-case words joined by '-' are needed");
  std::error_code error;
  const fs::path suite = fs::canonical(given, error);
  if (error) throw Error(ErrorCode::file_not_found, given.string() + ": no such folder; name the folder of a suite");
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
  file.scenes[id] = {c.mesh.points, c.mesh.triangles, {}, {}};
  file.cases.push_back(std::move(c));
  const std::string index_before = bytes_or_none(suite / "index.json"), found_before = bytes_or_none(path);
  const scene::TemporaryFolder copy;
  copy_suite(suite, validate::to_json_text(file), copy.path());
  validate::LintOptions options;
  options.glob = id;
  options.write = true;
  const auto report = validate::lint_suite(copy.path(), options);
  if (!report.findings.empty())
    throw Error(ErrorCode::malformed,
                suite.string() + ": " + id + " was not taken in: " + report.findings.front().message);
  scene::FolderUpdate update(suite, validate::suite_files);
  if (bytes_or_none(suite / "index.json") != index_before || bytes_or_none(path) != found_before)
    throw Error(ErrorCode::bad_argument,
                suite.string() + ": was changed while the case was proved; repeat the command");
  for (const char* name : validate::suite_files) update.put(name, scene::read_file_bytes(copy.path() / name));
  update.commit();
}

}  // namespace clues::fuzz
