#include "tests/levels/real_levels.h"

#include <fmt/format.h>

#include <cstdlib>

namespace clues::tests {

RealLevels real_levels(const TestFolder& folder) {
  if (const char* given = std::getenv("CLUES_LEVELS")) return {given, {}};
  const std::filesystem::path package = "/usr/share/games/openarena/baseoa/pak1-maps.pk3";
  if (!std::filesystem::exists(package))
    return {{}, package.string() + " is not there: install openarena-081-maps, or set CLUES_LEVELS"};
  const auto command = fmt::format("{} -m zipfile -e {} {}", PYTHON, package.string(), folder.path().string());
  if (std::system(command.c_str()) != 0) return {{}, package.string() + " was not unpacked"};
  return {folder.path() / "maps", {}};
}

}  // namespace clues::tests
