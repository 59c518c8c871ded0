// One HTML page of what clues wrote: judgements, conformance reports and findings of the fuzzer. Self-contained: style, script, pictures and views are in it, nothing is
// fetched. The same files give the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clues::fuzz {

// A line of the page: a triangle, a case or a finding.
struct ReportRow {
  std::string verdict, name, note;
  bool bad = false;
  std::string details;     // preformatted text; may be empty
  std::string picture;     // an SVG element; may be empty
  bool has_scene = false;  // a view of its scene can show it
};

struct ReportSection {
  std::string title;    // the file, as seen from the folder
  std::string summary;  // lines of text
  std::vector<ReportRow> rows;
  bool in_view = false;  // the page of to_html() has it, as the file `title`
};

// What is in the folder and below it, by path. JSON files of others are passed over. Throws Error file_not_found, file_unreadable; malformed for a *.json
// that is no JSON and for a result that is not complete, unsupported for one of another version.
std::vector<ReportSection> read_results(const std::filesystem::path& folder);

// One file of the folder; nothing for what is no result of clues. `look_around`: a finding's folder, and the scene or suite that a result names, are read too,
// for pictures; where they cannot be read there are none. Throws Error as above.
std::optional<ReportSection> section_of(const std::string& bytes, const std::filesystem::path& file, bool look_around);

inline constexpr const char* html_begin =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>clues report</title>";

// `view`: a page that is shown beside the table, in place of the pictures of sections that are in it; it has a function `cluesView.showRowOf(file, name)`. Empty: pictures only.
std::string to_html(const std::vector<ReportSection>& sections, const std::string& view);

}  // namespace clues::fuzz
