// A finding as a folder that stands on its own: scene.off, cell.obj, witness.json, picture.svg (from above), finding.json (what, how found,
// SHA-256 of the other files), command.txt, and original/ with the same before shrinking.
#pragma once

#include <filesystem>
#include <string>

#include "fuzz/campaign/shrink.h"

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

// Writes a folder of this name beside `folder` and renames it, so that it is there whole or not at all; an old one of the same name gives way.
// Throws scene::Error file_unwritable.
void save_finding(const SavedFinding& saved, const std::filesystem::path& folder);

// Reads both, and refuses what was changed after it was saved: scene::Error malformed, file_not_found, and as the readers.
SavedFinding load_finding(const std::filesystem::path& folder);

// The scene and the cell from above (x to the right, y up), the triangle in question and its sight line; rounded, for people.
std::string picture_of(const Finding& finding);

}  // namespace clues::fuzz
