// A whole file as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace clues::scene {

// Throws Error file_not_found, or file_unreadable (a folder, no permission, a read error) with the system's reason.
std::string read_file_bytes(const std::filesystem::path& path);

}  // namespace clues::scene
