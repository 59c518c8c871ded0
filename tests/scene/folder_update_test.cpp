// Files of a folder change together or not at all; what clues did not write stays.
#include "scene/files/folder_update.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "scene/files/atomic_file.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

namespace fs = std::filesystem;
using scene::ErrorCode;
using scene::FolderLock;
using scene::FolderUpdate;
using testing::UnorderedElementsAre;

constexpr const char* names[] = {"about", "data", "sub/data"};

class FolderUpdates : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("about", "old");
    folder_.write("data", "old");
    folder_.write("mine", "mine");
  }
  // What a program leaves that was killed after the commit, when `moved` of the three files were in place.
  void be_killed(int moved, bool committed = true) const {
    fs::create_directory(folder_.path() / ".clues-pending");
    fs::create_directory(folder_.path() / "sub");
    folder_.write(moved > 0 ? "sub/data" : ".clues-pending/sub+data", "new");
    folder_.write(moved > 1 ? "data" : ".clues-pending/data", "new");
    folder_.write(moved > 2 ? "about" : ".clues-pending/about", "new");
    if (committed) folder_.write(".clues-pending/commit", "");
    folder_.write(".clues-pending/.clues-3.tmp", "half");
  }
  std::string all() const {
    return read_all(folder_.file("about")) + " " + read_all(folder_.file("data")) + " " +
           (fs::exists(folder_.path() / "sub/data") ? read_all(folder_.file("sub/data")) : "none");
  }
  SceneFolder folder_;
};

TEST_F(FolderUpdates, ChangeAllOrNothing) {
  {
    FolderUpdate update(folder_.path(), names);
    for (const char* name : names) update.put(name, "new");
    EXPECT_EQ(all(), "old old none");
  }
  EXPECT_EQ(all(), "old old none");
  {
    FolderUpdate update(folder_.path(), names);
    for (const char* name : names) update.put(name, "new");
    update.commit();
  }
  EXPECT_EQ(all(), "new new new");
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("about", "data", "mine", "sub"));
}

TEST_F(FolderUpdates, AreFinishedByWhoComesNext) {
  for (int moved = 0; moved <= 3; ++moved) {
    SetUp();
    fs::remove_all(folder_.path() / "sub");
    be_killed(moved);
    scene::finish_update(folder_.path(), names);
    EXPECT_EQ(all(), "new new new") << moved;
    EXPECT_THAT(folder_.names(), UnorderedElementsAre("about", "data", "mine", "sub"));
  }
}

TEST_F(FolderUpdates, CountForNothingWithoutACommit) {
  be_killed(0, false);
  scene::finish_update(folder_.path(), names);
  EXPECT_EQ(all(), "old old none");
  {
    FolderUpdate update(folder_.path(), names);
    update.put("data", "newer");
    update.commit();
  }
  EXPECT_EQ(all(), "old newer none");
  EXPECT_FALSE(fs::exists(folder_.path() / ".clues-pending"));
}

TEST_F(FolderUpdates, LeaveAloneWhatIsNotOurs) {
  fs::remove(folder_.path() / "data");
  fs::create_symlink("mine", folder_.path() / "data");
  EXPECT_EQ(thrown_by([&] { const FolderUpdate update(folder_.path(), names); }).code, ErrorCode::bad_argument);
  fs::remove(folder_.path() / "data");
  const SceneFolder outside;
  outside.write("data", "precious");
  be_killed(0);
  fs::remove(folder_.path() / "sub");
  fs::create_symlink(outside.path(), folder_.path() / "sub");
  EXPECT_EQ(thrown_by([&] { scene::finish_update(folder_.path(), names); }).code, ErrorCode::bad_argument);
  EXPECT_EQ(read_all(outside.file("data")), "precious");
  EXPECT_EQ(read_all(folder_.file("mine")), "mine");
}

TEST(FolderLocks, AreHeldByOneProcessAndGoWithIt) {
  const SceneFolder folder;
  int ready[2], end[2];
  ASSERT_EQ(pipe(ready), 0);
  ASSERT_EQ(pipe(end), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const FolderLock lock(folder.path());
    char byte = 'x';
    if (write(ready[1], &byte, 1) != 1) _exit(1);
    close(end[1]);
    if (read(end[0], &byte, 1) < 0) _exit(1);
    _exit(0);  // without the destructor, like a kill
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  const auto refused = thrown_by([&] { const FolderLock lock(folder.path()); });
  EXPECT_EQ(refused.code, ErrorCode::bad_argument);
  EXPECT_NE(refused.text.find("another clues"), std::string::npos) << refused.text;
  close(end[1]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(fs::exists(folder.path() / ".clues-lock"));
  { const FolderLock lock(folder.path()); }
  EXPECT_TRUE(folder.names().empty());
}

TEST(FolderLocks, NeedAFile) {
  const SceneFolder folder;
  fs::create_symlink("elsewhere", folder.path() / ".clues-lock");
  EXPECT_EQ(thrown_by([&] { const FolderLock lock(folder.path()); }).code, ErrorCode::file_unwritable);
  EXPECT_FALSE(fs::exists(folder.path() / "elsewhere"));
}

}  // namespace
}  // namespace clues::tests
