#include "support.h"

#include <filesystem>

namespace clues::tests {

std::string planted(const std::string& mode, const std::string& only) {
  return "'" CLUES_PLANTED "' " + mode + (only.empty() ? "" : " " + only);
}

Conformed conform(const std::vector<std::string>& arguments, const std::string& suite) {
  const TestFolder folder;
  std::vector<std::string> words{"conform", "--suite", suite, "--json", folder.file("report.json")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Conformed result;
  result.ran = run_clues(words, folder.path());
  if (!std::filesystem::exists(folder.file("report.json"))) return result;
  result.report = nlohmann::json::parse(read_all(folder.file("report.json")));
  for (const auto& test : result.report["cases"]) result.outcomes[test["id"]] = test["outcome"];
  return result;
}

}  // namespace clues::tests
