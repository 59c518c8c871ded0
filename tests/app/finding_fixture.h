// A finding to be tampered with.
#pragma once

#include <filesystem>

namespace clues::tests {

// Triangle 4 of screen_scene is hidden, says a program that hides everything.
void make_finding(const std::filesystem::path& folder);

}  // namespace clues::tests
