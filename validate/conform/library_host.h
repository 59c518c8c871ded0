// A shared library with the function of validate/clues_iut.h, made a speaker of the protocol. Runs in a process of its own (`clues iut
// --library`), where a library may crash or hang as it likes.
#pragma once

#include <filesystem>
#include <istream>

namespace clues::validate {

// Serves until 'stop'. The protocol has the process's standard output to itself: what the library prints goes to standard error. Throws
// scene::Error file_not_found, bad_argument (not a library, no such function), and as serve().
void serve_library(const std::filesystem::path& library, std::istream& in);

}  // namespace clues::validate
