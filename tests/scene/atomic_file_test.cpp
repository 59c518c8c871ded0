// Whole or nothing: after a failure the folder is as it was.
#include "scene/files/atomic_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/scene/file_size_limit.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::ErrorCode;
using scene::write_file_atomically;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string long_text(5000, 'x');

TEST(AtomicFile, WritesAndReplaces) {
  const SceneFolder folder;
  const std::string bytes("a\0b\r\n", 5);
  write_file_atomically(folder.file("out"), long_text);
  write_file_atomically(folder.file("out"), bytes);
  EXPECT_EQ(read_all(folder.file("out")), bytes);
  write_file_atomically(folder.file("out"), "");
  EXPECT_EQ(read_all(folder.file("out")), "");
  EXPECT_THAT(folder.names(), ElementsAre("out"));
}

TEST(AtomicFile, ARelativeNameIsInTheCurrentFolder) {
  const SceneFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  write_file_atomically("out", "text");
  std::filesystem::current_path(before);
  EXPECT_EQ(read_all(folder.file("out")), "text");
}

TEST(AtomicFile, KeepsPermissionsAndLinks) {
  const SceneFolder folder;
  folder.write("real", "old");
  chmod(folder.file("real").c_str(), 0640);
  std::filesystem::create_symlink("real", folder.path() / "link");
  write_file_atomically(folder.file("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(read_all(folder.file("real")), "new");
  struct stat status {};
  stat(folder.file("real").c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(AtomicFile, AWriteThatFailsLeavesNoFile) {
  const SceneFolder folder;
  const FileSizeLimit limit(1000);
  const auto thrown = thrown_by([&] { write_file_atomically(folder.file("out"), long_text); });
  EXPECT_EQ(thrown.code, ErrorCode::file_unwritable);
  EXPECT_THAT(thrown.text, HasSubstr(folder.file("out")));
  EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, AWriteThatFailsLeavesTheOldFile) {
  const SceneFolder folder;
  folder.write("out", "old");
  const FileSizeLimit limit(1000);
  EXPECT_EQ(thrown_by([&] { write_file_atomically(folder.file("out"), long_text); }).code, ErrorCode::file_unwritable);
  EXPECT_EQ(read_all(folder.file("out")), "old");
  EXPECT_THAT(folder.names(), ElementsAre("out"));
}

TEST(AtomicFile, MissingFolder) {
  const SceneFolder folder;
  const auto thrown = thrown_by([&] { write_file_atomically(folder.path() / "none" / "out", "text"); });
  EXPECT_EQ(thrown.code, ErrorCode::file_unwritable);
  EXPECT_THAT(thrown.text, HasSubstr("No such file or directory"));
  EXPECT_TRUE(folder.names().empty());
}

// /proc takes no new file from anyone, root included.
TEST(AtomicFile, UnwritableFolder) {
  const auto thrown = thrown_by([] { write_file_atomically("/proc/out", "text"); });
  EXPECT_EQ(thrown.code, ErrorCode::file_unwritable);
  EXPECT_THAT(thrown.text, HasSubstr("/proc/out"));
}

TEST(AtomicFile, TargetsThatAreNoFile) {
  const SceneFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  for (const auto& path : {folder.file("sub"), folder.file("sub/"), folder.file("new/"), std::string(),
                           std::string("/dev/full"), std::string("/dev/null")}) {
    EXPECT_EQ(thrown_by([&] { write_file_atomically(path, "text"); }).code, ErrorCode::file_unwritable) << path;
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THAT(folder.names(), ElementsAre("sub"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "sub"));
}

// A rename would put a file in the place of the link.
TEST(AtomicFile, ALinkToNothingStays) {
  const SceneFolder folder;
  std::filesystem::create_symlink("nothing", folder.path() / "link");
  EXPECT_EQ(thrown_by([&] { write_file_atomically(folder.file("link"), "text"); }).code, ErrorCode::file_unwritable);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(folder.names().size(), 1u);
}

// What a killed run left behind is neither used nor removed.
TEST(AtomicFile, AnOldTemporaryIsNoObstacle) {
  const SceneFolder folder;
  folder.write(".clues-0.tmp", "left behind");
  write_file_atomically(folder.file("out"), "text");
  EXPECT_EQ(read_all(folder.file("out")), "text");
  EXPECT_EQ(read_all(folder.file(".clues-0.tmp")), "left behind");
  EXPECT_EQ(folder.names().size(), 2u);
}

}  // namespace
}  // namespace clues::tests
