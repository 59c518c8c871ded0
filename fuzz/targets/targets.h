// The doors through which bytes of strangers come in, each as a function that a coverage-guided fuzzer can call (docs/fuzzing.md). The same functions
// replay fuzz/corpus/ in the tests, with any compiler.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clues::fuzz {

// A reader kept no promise: it accepted what it must refuse, or what it accepted does not survive writing and reading.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

struct Target {
  const char* name;  // also of its folder in fuzz/corpus/
  const char* what;  // one line
  // Whether the bytes were accepted. What is refused with the error that the door announces is fine; any other exception, and BrokenPromise, is a defect.
  bool (*run)(std::string_view bytes);
};

const std::vector<Target>& all_targets();
const Target& target_named(const std::string& name);  // throws scene::Error bad_argument

bool scene_to_verdict(std::string_view bytes);  // scene_to_verdict.cpp
bool motion_files(std::string_view bytes);      // motion_files.cpp
bool map_files(std::string_view bytes);         // map_files.cpp
bool contour_files(std::string_view bytes);     // contour_files.cpp
bool list_files(std::string_view bytes);        // contour_files.cpp

}  // namespace clues::fuzz
