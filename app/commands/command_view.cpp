// clues view: results, verdicts and findings as a page to look at in a browser.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/view/view_data.h"
#include "app/view/viewer_page.h"
#include "scene/files/atomic_file.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

constexpr const char* default_page = "clues-view.html";

struct ViewRequest {
  std::vector<std::string> files;
  std::string out;
};

// What is replaced must be a page of ours, or a page that was named.
void require_page(const std::filesystem::path& out, bool named) {
  std::error_code ignored;
  if (named && out.extension() != ".html" && out.extension() != ".htm")
    throw scene::Error(scene::ErrorCode::bad_argument, out.string() + ": browsers want pages named *.html");
  if (named || !std::filesystem::exists(out, ignored)) return;
  if (scene::read_file_bytes(out).find(view_page_mark) == std::string::npos) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       out.string() + ": is no page of `clues view`; move it away, or name another file with -o");
  }
}

int run_view(const ViewRequest& request) {
  const std::filesystem::path out = request.out.empty() ? default_page : request.out;
  const std::string out_text = out.string();
  std::vector<const std::string*> inputs;
  for (const auto& file : request.files) inputs.push_back(&file);
  require_writable_parent(out);
  require_apart({&out_text}, inputs);
  require_page(out, !request.out.empty());
  if (!has_view_page()) view_page("");  // says why
  ViewData data;
  data.add_files({request.files.begin(), request.files.end()});
  const std::string page = view_page(request.files.empty() ? "" : data.text());
  scene::write_file_atomically(out, page);
  print(fmt::format("{}: {} kB{}; open it in a browser\n", out_text, (page.size() + 999) / 1000,
                    request.files.empty() ? ", for files to be dropped into" : ""));
  return fine;
}

}  // namespace

void add_view_command(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("view", "A page to look at results, bakes, verdicts and findings, in a browser");
  auto request = std::make_shared<ViewRequest>();
  command->add_option(
      "FILE", request->files,
      "Results, bakes, deltas, walks, hierarchies, judgements, umbrae, conformance reports, folders of findings\n"
      "or of `clues fuzz`, scenes");
  command->add_option("-o,--out", request->out, "The page (default: clues-view.html)")->type_name("PAGE.html");
  command->footer(
      "DESCRIPTION\n"
      "  One page without anything to fetch, for any browser that has WebGL 2: what is visible and what is hidden in "
      "colours, the\n"
      "  cell, event surfaces and umbrae, what is missing from a list and the proof, and what the list draws from "
      "viewpoints in the\n"
      "  cell; bakes, deltas, walks (clues motion --walk-out) and hierarchies (clues maps -o) step by step. Files are "
      "known by what\n"
      "  is in them. The scene of a file is found beside it, or is named too. Without FILE the page waits for files to "
      "be dropped.\n\n"
      "EXAMPLES\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --map -o town.clues.json\n"
      "  clues view town.clues.json -o town.html\n"
      "  clues check town.obj --cell box:0,0,1,2,2,2 --pvs baked.txt --json verdict.json\n"
      "  clues view town.clues.json verdict.json -o verdict.html\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,8,8,2 -o town.bake\n"
      "  clues view town.bake -o bake.html\n"
      "  clues view -o empty.html\n\n"
      "EXIT CODES\n"
      "  0 the page was written   2 bad usage or input, or this build has no page");
  command->callback([request, &status] { status = run_view(*request); });
}

}  // namespace clues::app
