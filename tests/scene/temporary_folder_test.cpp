// A temporary folder is there, is nobody else's, and leaves nothing behind.
#include "scene/files/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/scene/support.h"

namespace clues::tests {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, IsFreshAndGoesWithWhatIsInIt) {
  fs::path path;
  {
    const scene::TemporaryFolder one, other;
    path = one.path();
    EXPECT_NE(path, other.path());
    EXPECT_TRUE(fs::is_empty(path));
    EXPECT_EQ(fs::status(path).permissions() & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
    fs::create_directory(one.file("inner"));
    std::ofstream(path / "inner" / "file") << "text";
    EXPECT_TRUE(fs::exists(one.file("inner/file")));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, SaysWhereItCannotBeMade) {
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before != nullptr ? before : "";
  setenv("TMPDIR", "/proc", 1);
  const Thrown thrown = thrown_by([] { const scene::TemporaryFolder folder; });
  if (before != nullptr) {
    setenv("TMPDIR", kept.c_str(), 1);
  } else {
    unsetenv("TMPDIR");
  }
  EXPECT_EQ(thrown.code, scene::ErrorCode::file_unwritable);
  EXPECT_NE(thrown.text.find("/proc/clues-"), std::string::npos);
}

}  // namespace
}  // namespace clues::tests
