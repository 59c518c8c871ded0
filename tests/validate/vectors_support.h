// A small suite in a folder of its own, and ways to spoil it.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/files/temporary_folder.h"

namespace clues::validate::tests {

// A wall (0, 1), before it a screen (2); the target 3 right behind the screen is hidden, 4 beside it is seen, 5 touches the cell and 6 has
// no area. One case, "screen-hides-what-is-right-behind". Canonical, with expectation.
extern const char* const kScreenFile;

class SuiteFolder {
 public:
  SuiteFolder();  // kScreenFile as screens.json, and its index

  const std::filesystem::path& path() const { return folder_.path(); }
  std::string text(const std::string& file) const;
  void put(const std::string& file, const std::string& text) const;
  // Changes screens.json (or another file) and writes it canonically where it still can be read, else as it is.
  void spoil(const std::function<void(nlohmann::ordered_json&)>& change,
             const std::string& file = "screens.json") const;

 private:
  scene::TemporaryFolder folder_;
};

}  // namespace clues::validate::tests
