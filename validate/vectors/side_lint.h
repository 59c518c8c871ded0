// What `clues lint` does with the suites beside the one about visibility (vectors/motion, vectors/multires): read each topic, fill in
// what is missing, prove each case, hold files to their canonical form.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "scene/files/atomic_file.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "validate/vectors/reader.h"

namespace clues::validate {

struct SideLintOptions {
  std::string glob = "*";
  bool write = false;   // fill in what is missing, and write the canonical text
  bool accept = false;  // with write: replace expectations that proved wrong
};

struct SideLintReport {
  std::vector<std::string> findings;  // "file: case 'id': what"
  std::vector<std::string> malformed;
  std::vector<std::string> written;
  std::uint64_t cases = 0, selected = 0, proved = 0;
};

// *.json but schema.json, sorted. Throws Error file_not_found.
std::vector<std::filesystem::path> side_vector_files(const std::filesystem::path& folder);

std::string to_text(const SideLintReport& report, std::string_view about);        // "motion"
std::string to_json_text(const SideLintReport& report, std::string_view format);  // "clues-motion-lint/1"

// `Suite` names the functions of a suite: parse(text, file, drafts), which throws Error and gives a topic with `topic` and `cases`;
// has_expectation(case), fill_in(case), flaws_of(case), to_json_text(topic). Cases have an id.
template <class Suite>
SideLintReport lint_side_suite(const std::filesystem::path& folder, const SideLintOptions& options) {
  SideLintReport report;
  std::set<std::string> ids;
  for (const auto& path : side_vector_files(folder)) {
    decltype(Suite::parse("", "", false)) topic;
    std::string text;
    try {
      text = scene::read_file_bytes(path);
      topic = Suite::parse(text, path.string(), options.write);
    } catch (const scene::Error& e) {
      report.malformed.push_back(e.what());
      continue;
    }
    if (path.stem() != topic.topic)
      report.findings.push_back(path.string() + ": the topic is not the name of the file");
    bool complete = true;  // else there is nothing to be written
    for (auto& test : topic.cases) {
      ++report.cases;
      const auto say = [&](const std::string& what) {
        report.findings.push_back(fmt::format("{}: case '{}': {}", path.string(), test.id, what));
      };
      if (!ids.insert(test.id).second) say("the id is there twice");
      if (!matches_glob(test.id, options.glob)) continue;
      ++report.selected;
      try {
        if (!Suite::has_expectation(test)) Suite::fill_in(test);
        auto flaws = Suite::flaws_of(test);
        if (!flaws.empty() && options.write && options.accept) {
          Suite::fill_in(test);
          flaws = Suite::flaws_of(test);
        }
        for (const auto& flaw : flaws) say(flaw);
        report.proved += flaws.empty() ? 1 : 0;
      } catch (const scene::Error& error) {
        say(error.what());
        complete = false;
      }
    }
    if (!complete) continue;
    const auto canonical = Suite::to_json_text(topic);
    if (canonical == text) continue;
    if (options.write) {
      scene::write_file_atomically(path, canonical);
      report.written.push_back(path.string());
    } else {
      report.findings.push_back(path.string() + ": not in its canonical form; `clues lint --write` brings it into it");
    }
  }
  if (report.cases == 0 && report.malformed.empty()) {
    report.malformed.push_back(folder.string() + ": there is no case");
  }
  return report;
}

}  // namespace clues::validate
