#include "scene/files/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "scene/messages/error.h"

namespace clues::scene {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  const auto fail = [](const std::string& what, const std::string& why) {
    throw Error(ErrorCode::file_unwritable,
                what + ": cannot make a temporary folder: " + why + "; set TMPDIR to a folder that can be written");
  };
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) fail("TMPDIR", error.message());
  std::string pattern = (parent / "clues-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) fail(pattern, std::generic_category().message(errno));
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace clues::scene
