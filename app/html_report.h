// One HTML page of what clues wrote: judgements, conformance reports and findings of the fuzzer. Self-contained: style, script and pictures are in it, nothing is
// fetched. The same files give the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace clues::app {

// A line of the page: a triangle, a case or a finding.
struct ReportRow {
  std::string verdict, name, note;
  bool bad = false;
  std::string details;  // preformatted text; may be empty
  std::string picture;  // an SVG element; may be empty
};

struct ReportSection {
  std::string title;    // the file, as seen from the folder
  std::string summary;  // lines of text
  std::vector<ReportRow> rows;
};

// What is in the folder and below it, by path. Files that are no results of clues are passed over. Throws Error file_not_found; malformed for a result that cannot be read.
std::vector<ReportSection> read_results(const std::filesystem::path& folder);

std::string to_html(const std::vector<ReportSection>& sections);

}  // namespace clues::app
