// clues report: what clues wrote into a folder, as one HTML page.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/view/view_data.h"
#include "app/view/viewer_page.h"
#include "fuzz/report/html_report.h"
#include "scene/files/atomic_file.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"

namespace clues::app {
namespace {

struct ReportRequest {
  std::string folder, out;
};

// What is replaced without being named must be a page of ours; -o may name anything but a result.
void require_free(const std::filesystem::path& out, bool named) {
  std::error_code ignored;
  if (!std::filesystem::exists(out, ignored)) return;
  if (named && out.extension() == ".json")
    throw scene::Error(scene::ErrorCode::bad_argument, out.string() + ": a page is no JSON; name it *.html");
  if (!named && !scene::read_file_bytes(out).starts_with(fuzz::html_begin))
    throw scene::Error(scene::ErrorCode::bad_argument,
                       out.string() + ": is no page of clues; move it away, or name another file with -o");
}

// The page of `clues view` with what of the results it can show. What a view lacks (a scene, say) is no matter of the report: it has plans there.
std::string view_of(const std::filesystem::path& folder, std::vector<fuzz::ReportSection>& sections) {
  if (!has_view_page()) return "";
  ViewData data(folder);
  bool any = false;
  for (auto& section : sections) {
    const auto shows = [](const fuzz::ReportRow& row) { return row.has_scene; };
    if (std::none_of(section.rows.begin(), section.rows.end(), shows)) continue;
    try {
      data.add_files({folder / section.title});
      section.in_view = any = true;
    } catch (const scene::Error& problem) {
      if (problem.code() == scene::ErrorCode::file_unreadable) throw;  // it is there, and the page would not have it
      section.in_view = false;
    }
  }
  return any ? view_page(data.text()) : "";
}

int run_report(const ReportRequest& request) {
  auto sections = fuzz::read_results(request.folder);
  if (sections.empty()) {
    std::fprintf(stderr,
                 "clues: %s: no results of `clues check --json`, `clues conform --json` or `clues fuzz` in it\n",
                 scene::printable(request.folder).c_str());
    return not_everything_ran;
  }
  const std::filesystem::path out =
      request.out.empty() ? std::filesystem::path(request.folder) / "report.html" : std::filesystem::path(request.out);
  require_writable_parent(out);
  require_free(out, !request.out.empty());
  const std::string view = view_of(request.folder, sections);
  scene::write_file_atomically(out, fuzz::to_html(sections, view));
  std::printf("%zu result%s in %s\n", sections.size(), sections.size() == 1 ? "" : "s",
              scene::printable(out.string()).c_str());
  return fine;
}

}  // namespace

void add_report_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("report", "One HTML page of the results in a folder");
  auto request = std::make_shared<ReportRequest>();
  command->add_option("DIR", request->folder, "The folder; folders in it count too")->required();
  command->add_option("-o,--out", request->out, "The page (default: DIR/report.html)")->type_name("FILE");
  command->footer(
      "DESCRIPTION\n"
      "  Reads what `clues check --json`, `clues conform --json` and `clues fuzz --out` wrote: every *.json of these "
      "formats in DIR\n"
      "  and below. The page needs no other file and no network: verdicts to filter, notes and proofs, and a button "
      "that\n"
      "  shows what is wrong in a view as of clues view, with the cell and the sight line, where the scene (the suite, "
      "for a\n"
      "  conformance report) can be read. A build without that page draws pictures from above instead.\n\n"
      "EXAMPLES\n"
      "  clues check town.obj --cell box:0,0,1,2,2,2 --pvs baked.txt --json results/town.json\n"
      "  clues conform --impl ./libmine.so --json results/suite.json\n"
      "  clues report results\n\n"
      "EXIT CODES\n"
      "  0 the page was written   2 bad usage, or a result cannot be read   3 there are no results in DIR");
  command->callback([request, &status] { status = run_report(*request); });
}

}  // namespace clues::app
