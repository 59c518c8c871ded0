// A complex is the same with and without a memory, whatever parts and cells that memory knows (D16).
#include "exact/complex/cut_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <thread>

#include "exact/complex/complex.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::exact {
namespace {

constexpr std::uint64_t kSeedOfParts = 20261128;

bool are_equal(const Complex& a, const Complex& b) {
  const auto same_piece = [](const Piece& x, const Piece& y) {
    return x.corners == y.corners && std::equal(x.origins.begin(), x.origins.end(), y.origins.begin(), y.origins.end(),
                                                [](const Origin& p, const Origin& q) {
                                                  return p.triangle == q.triangle && p.same_side == q.same_side;
                                                });
  };
  return a.points == b.points && a.in_cell == b.in_cell && a.degenerate == b.degenerate &&
         a.refined_triangles == b.refined_triangles &&
         std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(), same_piece);
}

// Pierced, touching, coplanar and repeated triangles, some of which the cells' borders cut.
struct Scene {
  scene::TriangleMesh mesh;
  std::vector<ConvexCell> cells;
};

Scene scene_of(fuzz::Kind kind, std::uint64_t index) {
  Scene s{fuzz::generate(kind, kSeedOfParts, index).mesh, {}};
  fuzz::Random random(kSeedOfParts + index);
  for (std::size_t t = 0, n = s.mesh.triangles.size(); t < n; t += 3) {
    scene::Triangle again = s.mesh.triangles[t];
    if (t % 2 == 0) std::swap(again[1], again[2]);
    s.mesh.triangles.push_back(again);
    s.mesh.face_of.push_back(static_cast<std::uint32_t>(s.mesh.face_of.size()));
  }
  for (int i = 0; i < 3; ++i) {
    std::vector<scene::Point> corners(5);
    for (scene::Point& p : corners) {
      for (double& x : p) x = random.between(-20, 20);
    }
    s.cells.push_back(ConvexCell::from_doubles(corners));
  }
  // With triangles of the scene as facets, alone and with more in their plane.
  for (int i = 0; i < 2; ++i) {
    const auto last = static_cast<int>(s.mesh.triangles.size()) - 1;
    std::vector<scene::Point> corners;
    for (const std::uint32_t p : s.mesh.triangles[static_cast<std::size_t>(random.between(0, last))])
      corners.push_back(s.mesh.points[p]);
    if (i > 0) {
      scene::Point beyond{};
      for (std::size_t k = 0; k < 3; ++k) beyond[k] = corners[0][k] + 2 * (corners[1][k] - corners[0][k]);
      corners.push_back(beyond);
    }
    corners.push_back({random.between(-20, 20) + 0.5, random.between(-20, 20) + 0.5, random.between(-20, 20) + 0.5});
    s.cells.push_back(ConvexCell::from_doubles(corners));
  }
  return s;
}

struct Part {
  scene::TriangleMesh mesh;
  std::vector<std::uint32_t> names;
};

Part random_part(const scene::TriangleMesh& mesh, fuzz::Random& random) {
  std::vector<std::uint32_t> names;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!random.one_in(3)) names.push_back(t);
  }
  return {scene::part_of(mesh, names), names};
}

Complex complex_of(const Part& part, const ConvexCell& cell, CutMemory& memory) {
  return build_complex(part.mesh, &cell, part.names, memory);
}

TEST(CutMemory, AComplexIsTheSameWhateverPartsAndCellsCameBefore) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      SCOPED_TRACE(std::string(fuzz::name_of(kind)) + " " + std::to_string(i));
      const Scene s = scene_of(kind, i);
      fuzz::Random random(i);
      CutMemories memories;
      for (int time = 0; time < 2; ++time) {
        for (const ConvexCell& cell : s.cells) {
          CutMemories::Loan loan(memories);
          for (int k = 0; k < 2; ++k) {
            const Part part = random_part(s.mesh, random);
            EXPECT_TRUE(are_equal(complex_of(part, cell, loan.memory()), build_complex(part.mesh, &cell)));
          }
        }
      }
    }
  }
}

// The test above would notice: what the border of another cell cuts is not what this one's does.
TEST(CutMemory, WithoutForgettingTheCellBeforeComplexesAreOthers) {
  int others = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const Scene s = scene_of(fuzz::Kind::interpenetrating, i);
    fuzz::Random random(i);
    CutMemory memory;
    for (const ConvexCell& cell : s.cells) {
      const Part part = random_part(s.mesh, random);
      others += are_equal(complex_of(part, cell, memory), build_complex(part.mesh, &cell)) ? 0 : 1;
    }
  }
  EXPECT_GT(others, 0);
}

TEST(CutMemory, IsLentToOneAtATimeAndKeepsWhatItKnowsOfTheScene) {
  CutMemories memories;
  Contact contact;
  contact.overlap = true;
  {
    CutMemories::Loan first(memories), second(memories);
    EXPECT_NE(&first.memory(), &second.memory());
    for (CutMemory* memory : {&first.memory(), &second.memory()}) {
      memory->keep(3, 5, contact);
      memory->keep(3, CutMemory::kBorder, contact);
      memory->keep(CutMemory::Situation{{3, 5}}, {});
      memory->keep(CutMemory::Situation{{3, CutMemory::kBorder + 2}}, {});
    }
  }
  CutMemories::Loan again(memories);
  EXPECT_TRUE(again.memory().contact(3, 5)->overlap);
  EXPECT_EQ(again.memory().contact(5, 3), nullptr);
  EXPECT_EQ(again.memory().contact(3, CutMemory::kBorder), nullptr);
  EXPECT_NE(again.memory().cut({{3, 5}}), nullptr);
  EXPECT_EQ(again.memory().cut({{3, CutMemory::kBorder + 2}}), nullptr);
}

TEST(CutMemory, SeveralThreadsBuildTheSame) {
  const Scene s = scene_of(fuzz::Kind::interpenetrating, 1);
  CutMemories memories;
  std::array<int, 4> wrong{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    threads.emplace_back([&, i] {
      fuzz::Random random(i);
      for (const ConvexCell& cell : s.cells) {
        const Part part = random_part(s.mesh, random);
        CutMemories::Loan loan(memories);
        wrong[i] += are_equal(complex_of(part, cell, loan.memory()), build_complex(part.mesh, &cell)) ? 0 : 1;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

}  // namespace
}  // namespace clues::exact
