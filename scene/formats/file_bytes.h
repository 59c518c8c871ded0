// A whole file as bytes: the only door through which the content of a file comes in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace clues::scene {

inline constexpr std::uint64_t most_file_bytes = std::uint64_t{4} << 30;

// Regular files only, also at the end of a link: a pipe, a device or a folder is refused at once, and none of them is waited for. Throws Error
// file_not_found, or file_unreadable (no regular file, longer than `most`, no permission, a read error) with the system's reason.
std::string read_file_bytes(const std::filesystem::path& path, std::uint64_t most = most_file_bytes);

}  // namespace clues::scene
