// The published suite, put to the reference that a program of tests is linked with.
#pragma once

#include <filesystem>
#include <string>

namespace clues::validate {

// Of a few topics, the first core case of the suite in this folder with a visible triangle that the reference leaves out; "" where there is none.
std::string first_unsound_case(const std::filesystem::path& suite);

}  // namespace clues::validate
