// Without a protocol: cases out as files, answers in as files. For tools that are run by hand or by a script of their own.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "validate/conform/subject.h"

namespace clues::validate {

// ID.clues.json, ID.pvs or ID.txt in a folder. No such file: errored; two of them, one that cannot be read, or a result that says that it is of another scene
// (than the one that export_cases() writes), cell or mode: malformed_output.
class ResultFiles : public Subject {
 public:
  // Throws scene::Error file_not_found when there is no such folder.
  explicit ResultFiles(std::filesystem::path folder);

  const Implementation& about() const override { return about_; }
  std::vector<Answer> answer(std::span<const VectorCase* const> cases, const GoOn& go_on) const override;

 private:
  std::filesystem::path folder_;
  Implementation about_;
};

// Writes ID.scene.off, ID.cell.off and, last, cases.json, which lists them with their modes; every double survives. Makes the folder where it
// does not exist. Throws scene::Error file_unwritable; then there is no new cases.json.
void export_cases(std::span<const VectorCase* const> cases, const std::filesystem::path& folder);

}  // namespace clues::validate
