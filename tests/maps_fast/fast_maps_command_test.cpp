// clues maps --kernel as a user types it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fuzz/multires/surfaces.h"
#include "scene/mesh_io.h"
#include "scene/scenes/scene_io.h"
#include "tests/app/program.h"

namespace clues {
namespace {

TEST(FastMapsCommand, WritesTheSameFile) {
  const tests::TestFolder folder;
  folder.write("frame.off", scene::to_off_text(fuzz::frame(1, 6)));
  std::vector<std::string> files;
  for (const char* kernel : {"exact", "fast"}) {
    const auto ran = tests::run_clues({"maps", "frame.off", "--base", "20", "--features", "40", "--kernel", kernel,
                                       "--uniform", "1", "--remesh", "r.ply", "-o", std::string(kernel) + ".maps"},
                                      folder.path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, testing::HasSubstr("verified: a homeomorphism"));
    files.push_back(tests::read_all(folder.path() / (std::string(kernel) + ".maps")));
  }
  EXPECT_TRUE(files[0] == files[1]);
  EXPECT_EQ(tests::run_clues({"maps", "frame.off", "--kernel", "quick"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace clues
