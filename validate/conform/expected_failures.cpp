// A closed format: whatever is not understood is an error.
#include "validate/conform/expected_failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "scene/json_reader.h"
#include "scene/messages/error.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw scene::Error(scene::ErrorCode::malformed, file.string() + ": " + what + " (docs/protocol.md has an example)");
}

bool is_day(const std::string& text) {
  int year = 0;
  unsigned month = 0, day = 0;
  int read = 0;
  if (text.size() != 10 || text.find_first_not_of("0123456789-") != std::string::npos) return false;
  if (std::sscanf(text.c_str(), "%4d-%2u-%2u%n", &year, &month, &day, &read) != 3 || read != 10) return false;
  return std::chrono::year_month_day(std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)).ok();
}

bool is_address(const std::string& text) {
  for (const std::string scheme : {"http://", "https://"}) {
    if (text.starts_with(scheme) && text.size() > scheme.size()) return true;
  }
  return false;
}

}  // namespace

ExpectedFailures read_expected_failures(const std::filesystem::path& file, const std::vector<VectorCase>& suite) {
  const Json json = scene::read_json_file(file);
  if (!json.is_object() || json.size() != 2 || !json.contains("format") || !json.contains("cases") ||
      !json["cases"].is_array()) {
    fail(file, "not an object with just \"format\" and the list \"cases\"");
  }
  if (json["format"] != "clues-expected-failures/1") fail(file, "\"format\" is not \"clues-expected-failures/1\"");
  ExpectedFailures failures;
  for (const auto& entry : json["cases"]) {
    const auto text = [&](const char* key) {
      if (!entry.is_object() || entry.size() != 3 || !entry.contains(key) || !entry[key].is_string()) {
        fail(file, fmt::format("cases, entry {}: not an object with just the strings \"case\", \"issue\" and \"date\"",
                               failures.size()));
      }
      return entry[key].get<std::string>();
    };
    const auto id = text("case");
    const ExpectedFailure failure{text("issue"), text("date")};
    if (!is_address(failure.issue))
      fail(file, id + ": \"issue\" is not an http(s) address; say where the defect is followed up");
    if (!is_day(failure.date)) fail(file, id + ": \"date\" is not a day; write it as 2026-11-21");
    if (std::none_of(suite.begin(), suite.end(), [&](const VectorCase& test) { return test.id == id; })) {
      fail(file, id + ": the suite has no such case; take the entry out, or correct the id");
    }
    if (!failures.emplace(id, failure).second) fail(file, id + ": is listed twice; take one out");
  }
  return failures;
}

}  // namespace clues::validate
