#pragma once

#include <string>
#include <vector>

namespace clues::app {

// `clues demo` with these options; its exit code.
int demo_alone(std::vector<std::string> options);

}  // namespace clues::app
