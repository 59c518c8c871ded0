// A finding as a folder that stands on its own: scene.off, cell.obj, witness.json, picture.svg (from above), finding.json (what, how found,
// SHA-256 of the other files and of itself), command.txt, and original/ with the same before shrinking. Other files in the folder are not ours: they stay.
#pragma once

#include <filesystem>
#include <string>

#include "fuzz/shrinking/shrink.h"

namespace clues::fuzz {

struct SavedFinding {
  Finding finding;  // shrunk, or as it was found
  Finding original;
  std::string subject;              // make_subject() knows it, or it is a test's own
  std::vector<std::string> scenes;  // --scenes of the campaign
  std::uint64_t steps = 0;
};

// A name for a folder: the signature in letters, digits, - and _.
std::string folder_name(const Finding& finding);

// Writes the files into `folder`, which is made where it does not exist; all of them or, whatever fails, none (scene/files/folder_update.h). Throws scene::Error
// file_unwritable; bad_argument where something lies there that clues did not make, or another process is at work.
void save_finding(const SavedFinding& saved, const std::filesystem::path& folder);

// Whether save_finding() may use this name: nothing is there, an empty folder, or a folder that it made.
bool is_free_for_a_finding(const std::filesystem::path& folder);
bool holds_a_finding(const std::filesystem::path& folder);

// Reads both, and refuses what was changed after it was saved: scene::Error malformed, file_not_found, unsupported (another version), and as the readers.
SavedFinding load_finding(const std::filesystem::path& folder);

// What load_finding() makes of the texts of the files, once their hashes are compared; `place` is for messages.
struct CaseTexts {
  std::string scene_off, cell_obj, witness_json;
};
SavedFinding finding_of_texts(const std::string& finding_json, const CaseTexts& now, const CaseTexts& original,
                              const std::filesystem::path& place);

// The scene and the cell from above (x to the right, y up), the triangle in question and its sight line; rounded, for people.
std::string picture_of(const Finding& finding);

}  // namespace clues::fuzz
