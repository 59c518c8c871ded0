// Cases and answers as files (docs/protocol.md, "Without a protocol").
#include "validate/conform/result_files.h"

#include <nlohmann/json.hpp>

#include "scene/files/atomic_file.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/result.h"

namespace clues::validate {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

namespace {

Answer read_answer(const VectorCase& test, const fs::path& folder) {
  Answer answer;
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const char* ending : {".clues.json", ".pvs", ".txt"}) {
    auto path = folder / (test.id + ending);
    if (fs::exists(path, ignored)) found.push_back(std::move(path));
  }
  if (found.empty() && !test.is_plain()) {
    answer.kind = AnswerKind::unsupported;
    answer.message = "triangles that do not block or do not count";
  } else if (found.empty()) {
    answer.kind = AnswerKind::errored;
    answer.message = "no result file " + test.id + ".clues.json, .pvs or .txt";
  } else if (found.size() > 1) {
    answer.kind = AnswerKind::malformed_output;
    answer.message = "two result files: " + found[0].filename().string() + " and " + found[1].filename().string();
  } else {
    try {
      answer.visible =
          scene::read_pvs(found[0], {test.mesh.triangles.size(), scene::sha256_of(scene::to_off_text(test.mesh)),
                                     test.mode == CaseMode::solid ? "solid" : "sheet", test.cell});
    } catch (const Error& error) {
      answer.kind = AnswerKind::malformed_output;
      answer.message = error.what();
    }
  }
  return answer;
}

}  // namespace

ResultFiles::ResultFiles(fs::path folder) : folder_(std::move(folder)) {
  std::error_code ignored;
  if (!fs::is_directory(folder_, ignored)) {
    throw Error(ErrorCode::file_not_found, folder_.string() + ": no such folder; give the one with the result files");
  }
  about_.name = "result files";
}

std::vector<Answer> ResultFiles::answer(std::span<const VectorCase* const> cases, const GoOn& go_on) const {
  std::vector<Answer> answers;
  for (const auto* test : cases) {
    answers.push_back(read_answer(*test, folder_));
    if (!go_on(answers.size() - 1, answers.back())) break;
  }
  return answers;
}

void export_cases(std::span<const VectorCase* const> cases, const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (!fs::is_directory(folder)) {
    throw Error(ErrorCode::file_unwritable, folder.string() + ": cannot make this folder" +
                                                (error ? " (" + error.message() + ")" : "") +
                                                "; make it, or choose another");
  }
  auto list = nlohmann::json::array();
  for (const auto* test : cases) {
    if (!test->is_plain()) continue;  // an OFF file would call panes walls
    const auto scene_file = test->id + ".scene.off", cell_file = test->id + ".cell.off";
    scene::write_file_atomically(folder / scene_file, scene::to_off_text(test->mesh));
    scene::TriangleMesh cell;
    cell.points = test->cell;
    scene::write_file_atomically(folder / cell_file, scene::to_off_text(cell));
    list.push_back({{"id", test->id},
                    {"mode", test->mode == CaseMode::solid ? "solid" : "sheet"},
                    {"scene", scene_file},
                    {"cell", cell_file},
                    {"triangles", test->mesh.triangles.size()}});
  }
  const nlohmann::json all = {{"format", "clues-cases/1"}, {"cases", list}};
  scene::write_file_atomically(folder / "cases.json", all.dump(2) + "\n");
}

}  // namespace clues::validate
