#include "validate/vectors/side_lint.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace clues::validate {

std::vector<std::filesystem::path> side_vector_files(const std::filesystem::path& folder) {
  std::error_code problem;
  if (!std::filesystem::is_directory(folder, problem)) {
    throw scene::Error(scene::ErrorCode::file_not_found, folder.string() + ": no such folder");
  }
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json" && entry.path().filename() != "schema.json") out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string to_text(const SideLintReport& report, std::string_view about) {
  std::string text;
  for (const auto& line : report.malformed) text += line + "\n";
  for (const auto& line : report.findings) text += line + "\n";
  for (const auto& file : report.written) text += "written: " + file + "\n";
  return text + fmt::format("{} cases about {}, {} looked at, {} proved\n", report.cases, about, report.selected,
                            report.proved);
}

std::string to_json_text(const SideLintReport& report, std::string_view format) {
  const nlohmann::json root{{"format", format},         {"cases", report.cases},       {"selected", report.selected},
                            {"proved", report.proved},  {"findings", report.findings}, {"malformed", report.malformed},
                            {"written", report.written}};
  return root.dump(2).append("\n");
}

}  // namespace clues::validate
