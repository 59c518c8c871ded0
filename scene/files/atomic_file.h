// Whole-or-nothing output: the text goes to a temporary file in the same folder, is flushed and renamed over
// the target. On any failure (unwritable folder, full disk) the temporary is removed and Error
// file_unwritable is thrown; an old target stays as it was. "-" is not special here.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace clues::scene {

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// So that the new names in a folder outlive a power cut. Some file systems cannot do it; the files themselves are complete
// anyway.
void flush_folder(const std::filesystem::path& folder);

// Throws Error file_unwritable: what could not be done with the path, and why, by errno.
[[noreturn]] void fail_unwritable(const std::filesystem::path& path, const std::string& what, int error);

// Whether a program that was killed may have left a file of this name (without folder) behind.
bool is_temporary_name(std::string_view name);

}  // namespace clues::scene
