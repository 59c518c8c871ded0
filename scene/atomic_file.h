// Whole-or-nothing output: the text goes to a temporary file in the same folder, is flushed and renamed over
// the target. On any failure (unwritable folder, full disk) the temporary is removed and Error
// file_unwritable is thrown; an old target stays as it was. "-" is not special here.
#pragma once

#include <filesystem>
#include <string_view>

namespace clues::scene {

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// Whether a program that was killed may have left a file of this name (without folder) behind.
bool is_temporary_name(std::string_view name);

}  // namespace clues::scene
