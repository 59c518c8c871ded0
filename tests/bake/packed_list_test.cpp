#include "scene/bakes/packed_list.h"

#include <gmock/gmock.h>

#include <random>

#include "scene/messages/error.h"

namespace clues::tests {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(PackedList, ComesBack) {
  std::mt19937 random(1);
  for (const std::uint32_t triangles : {1U, 7U, 8U, 9U, 1000U, 100003U}) {
    for (const double density : {0.0, 0.01, 0.5, 1.0}) {
      Ids list;
      for (std::uint32_t t = 0; t < triangles; ++t) {
        if (std::uniform_real_distribution<double>(0, 1)(random) < density) list.push_back(t);
      }
      const auto bytes = scene::packed_list(list, triangles);
      EXPECT_EQ(scene::unpacked_list(bytes, triangles, ""), list);
      EXPECT_EQ(scene::packed_list(list, triangles), bytes);
    }
  }
}

TEST(PackedList, DamageIsSeen) {
  const auto bytes = scene::packed_list({3, 8}, 9);
  const auto fails = [](const std::string& damaged, std::uint32_t triangles) {
    try {
      scene::unpacked_list(damaged, triangles, "cell 4");
      return std::string();
    } catch (const scene::Error& error) {
      return std::string(error.what());
    }
  };
  for (const auto& damaged : {std::string(), std::string("not packed"), bytes.substr(0, bytes.size() - 1), bytes + "x"})
    EXPECT_THAT(fails(damaged, 9), testing::StartsWith("cell 4: a list"));
  EXPECT_THAT(fails(bytes, 17), testing::HasSubstr("another length"));
  EXPECT_THAT(fails(scene::packed_list({9}, 16), 9), testing::HasSubstr("a triangle that the scene does not have"));
}

}  // namespace
}  // namespace clues::tests
