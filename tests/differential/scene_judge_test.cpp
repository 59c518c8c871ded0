// The judge of scenes finds what is planted: each thing that an answer can get wrong, and a kernel that throws.
#include "tests/differential/scene_judge.h"
#include "tests/differential/scene_shrinking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "fuzz/generators/parts.h"
#include "fuzz/generators/touching_scenes.h"

namespace clues::tests {
namespace {

// A screen before a wall that is larger, and a triangle that the screen hides; beside them one that nothing hides.
fuzz::Case screen_and_wall() {
  fuzz::Case scene{"by hand", 1, 0, {}, {}, false};
  fuzz::add(scene.mesh, {2, -4, -4}, {2, 4, -4}, {2, 0, 4});
  fuzz::add(scene.mesh, {6, -9, -9}, {6, 9, -9}, {6, 0, 12});
  fuzz::add(scene.mesh, {3, 0, 0}, {3, 0.5, 0}, {3, 0, 0.5});
  fuzz::add(scene.mesh, {-3, 0, 0}, {-3, 1, 0}, {-3, 0, 1});
  scene.cell = {{0, -0.5, -0.5}, {0, 0.5, -0.5}, {0, 0, 0.5}};
  return scene;
}

bool has(const Judgement& j, const std::string& category) {
  return std::any_of(j.flaws.begin(), j.flaws.end(), [&](const Flaw& f) { return f.category == category; });
}

Judgement judged_with(const std::string& kernel, const std::function<void(KernelAnswer&)>& bug) {
  JudgeSettings settings;
  settings.visible_set = settings.no_fallbacks = true;
  settings.planted_bug = [&](KernelAnswer& a) {
    if (a.kernel == kernel) bug(a);
  };
  return judge_scene(screen_and_wall(), settings);
}

TEST(SceneJudge, AGoodSceneHasNoFlaw) {
  JudgeSettings settings;
  settings.visible_set = settings.refined = true;
  const Judgement j = judge_scene(screen_and_wall(), settings);
  for (const Flaw& f : j.flaws) ADD_FAILURE() << f.category << ": " << f.detail;
  for (const char* what : {"hidden regions", "hidden points put to the oracle", "sight lines to hidden points",
                           "triangles that somebody does not list", "sight lines to triangles that are not listed",
                           "scenes whose areas were compared", "scenes decided completely"})
    EXPECT_EQ(j.counts.count(what), 1U) << what;
}

TEST(SceneJudge, FindsATriangleThatIsMissing) {
  for (const char* kernel : {"plain reference", "traversal", "fast path"}) {
    const Judgement j = judged_with(kernel, [](KernelAnswer& a) { a.visible.pop_back(); });
    EXPECT_TRUE(has(j, std::string("WRONG: a visible triangle is missing from the ") + kernel)) << kernel;
  }
  EXPECT_TRUE(has(judged_with("fast path", [](KernelAnswer& a) { a.visible.pop_back(); }),
                  "list: plain reference knows a triangle that is missing from fast path"));
}

TEST(SceneJudge, FindsATriangleTooMany) {
  const Judgement j = judged_with("fast path", [](KernelAnswer& a) { a.visible = {0, 1, 2, 3}; });
  EXPECT_TRUE(has(j, "list: fast path knows a triangle that is missing from plain reference"));
}

TEST(SceneJudge, FindsAHiddenRegionThatIsSeen) {
  for (const char* kernel : {"plain reference", "traversal"}) {
    const Judgement j = judged_with(kernel, [](KernelAnswer& a) {
      for (reference::Region& r : a.map->regions) r.visible = false;
    });
    EXPECT_TRUE(has(j, std::string("WRONG: a hidden region of the ") + kernel + " is seen")) << kernel;
  }
  const Judgement j = judged_with("fast path", [](KernelAnswer& a) {
    for (fastpath::LocalRegion& r : *a.regions) r.visible = false;
  });
  EXPECT_TRUE(has(j, "WRONG: a hidden region of the fast path is seen"));
  EXPECT_TRUE(has(j, "area: the fast path has less than the reference"));
}

TEST(SceneJudge, FindsAreasThatDiffer) {
  const Judgement j = judged_with("fast path", [](KernelAnswer& a) {
    for (fastpath::LocalRegion& r : *a.regions) r.area_estimate *= 1 + 1e-7;
  });
  EXPECT_TRUE(has(j, "area: the fast path has more than the reference"));
}

TEST(SceneJudge, CountsFallbacksAndExceptions) {
  EXPECT_TRUE(has(judged_with("traversal", [](KernelAnswer& a) { a.fallbacks = 2; }), "fallback of traversal"));
  const Judgement j = judged_with("plain reference", [](KernelAnswer&) { throw std::logic_error("planted"); });
  EXPECT_TRUE(has(j, "exception of plain reference: planted"));
  EXPECT_EQ(j.counts.at("exceptions of plain reference"), 1U);
  EXPECT_EQ(j.flaws.size(), 1U);  // the other kernels are judged as ever
}

TEST(SceneJudge, FindsATriangleOnTheCellThatIsMissing) {
  fuzz::Case scene = screen_and_wall();
  fuzz::add(scene.mesh, {0, 0.5, -0.5}, {1, 3, -0.5}, {1, 2, -3});  // with a corner on a corner of the cell
  JudgeSettings settings;
  settings.planted_bug = [](KernelAnswer& a) { std::erase(a.visible, 4U); };
  EXPECT_TRUE(has(judge_scene(scene, settings), "WRONG: a triangle that meets the cell is missing from the fast path"));
}

TEST(SceneJudge, ShrinksToWhatTheFlawNeeds) {
  JudgeSettings settings;
  settings.planted_bug = [](KernelAnswer& a) {
    if (a.kernel == "fast path") a.visible.clear();
  };
  const std::string category = "WRONG: a visible triangle is missing from the fast path";
  const fuzz::Case small = shrunk(screen_and_wall(), settings, category);
  EXPECT_EQ(small.mesh.triangles.size(), 1U);
  EXPECT_EQ(small.cell.size(), 3U);  // still a polygon
  EXPECT_TRUE(has(judge_scene(small, settings), category));
}

TEST(SceneJudge, WritesScenesAsFilesAndCells) {
  fuzz::Case scene{"by hand", 1, 0, {}, {{0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}}, false};
  fuzz::add(scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 0.5, 0});
  fuzz::add(scene.mesh, {0, 0, 0}, {0, 0.5, 0}, {-1, 0, 0});
  EXPECT_EQ(to_obj_text(scene), "v 0 0 0\nv 1 0 0\nv 0 0.5 0\nv -1 0 0\nf 1 2 3\nf 1 3 4\n--cell box:0,0,1,2,3,1\n");
  scene.cell.pop_back();
  EXPECT_NE(to_obj_text(scene).find("--cell cell.obj:\nv 0 0 1\nv 2 0 1\nv 2 3 1\n"), std::string::npos);
}

}  // namespace
}  // namespace clues::tests
