// Files of lists: what is cut, changed, written in another form, does not fit, or asks for too much is refused.
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <string_view>

#include "scene/messages/error.h"
#include "tests/delta/floor_lists.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using scene::ListRecord;

// Empty: it is not. Malformed, or the test fails.
template <class Reading>
std::string why_refused(const Reading& reading) {
  try {
    reading();
    return "";
  } catch (const scene::Error& e) {
    EXPECT_EQ(e.code(), scene::ErrorCode::malformed) << e.what();
    return e.what();
  }
}

TEST(ListFile, FilesThatAreCutOrChangedAreRefused) {
  const auto bytes = scene::to_bytes(file_with(made(row_of_discs(1, 3), {2}), floor_scene().mesh.triangles.size()));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string why = why_refused([&] { scene::parse_lists(bytes.substr(0, size), "x"); });
    const bool is_named = size >= std::string_view("CLUESLST").size();
    EXPECT_NE(why.find(is_named ? "x: is cut short or was changed" : "x: is no file of lists"), std::string::npos)
        << size << ": " << why;
    // Where there is no hash to tell, too.
    if (is_named && size < bytes.size() - 32) {
      EXPECT_NE(why_refused([&] { scene::parse_unsealed_lists(bytes.substr(0, size), "x"); }), "") << size;
    }
  }
  std::mt19937_64 random(kSeed);
  std::uint64_t read = 0, decoded = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (random() % 8)));
    EXPECT_THROW(scene::parse_lists(changed, "x"), scene::Error);
    if (at >= bytes.size() - 32) continue;
    // Without the hash: another file, or none; what a record does not fit is refused.
    try {
      const auto file = scene::parse_unsealed_lists(changed.substr(0, bytes.size() - 32), "x");
      ++read;
      reference::decoded_levels(floor_scene().edges, file.levels);
      ++decoded;
    } catch (const scene::Error& e) {
      EXPECT_NE(e.code(), scene::ErrorCode::internal) << e.what();
    }
  }
  EXPECT_GT(read, 100U);
  EXPECT_GT(decoded, 50U);
  EXPECT_LT(decoded, read);
}

TEST(ListFile, RecordsThatDoNotFitAreRefused) {
  const auto triangles = static_cast<std::uint32_t>(floor_scene().mesh.triangles.size());
  const auto refused = [](const ListLevels& levels) {
    return why_refused([&] { reference::decoded_levels(floor_scene().edges, levels); });
  };
  const std::vector<scene::ListPlace> node{{0, {RecordKind::list, 0, {1, 2, 3}, {}}}};
  EXPECT_EQ(refused({node}), "");
  // Triangles 0 and 1 are a square, of two that touch at no edge; edge 2 is between the two.
  const std::vector<scene::ListPlace> nodes{{0, {RecordKind::list, 0, {0, 1, 100, 101}, {}}},
                                            {0, {RecordKind::list, 0, {0, 1}, {}}}};
  const scene::ListPlace square{0, {RecordKind::contour, 0, {0}, {}}}, half{0, {RecordKind::contour, 0, {0}, {2}}};
  EXPECT_EQ(
      refused({nodes, {square, half, {0, {RecordKind::changed, 1, {}, {2}}}, {0, {RecordKind::same, 0, {}, {}}}}}), "");
  for (const auto& [levels, why] :
       {std::pair<ListLevels, const char*>({{{0, {RecordKind::list, 0, {triangles}, {}}}}}, "does not have"),
        {{{{0, {RecordKind::all, 0, {}, {}}}}}, "a list that there is not"},
        {{{{0, {RecordKind::goes, 0, {1}, {}}}}}, "a list that there is not"},
        {{{{0, {RecordKind::contour, 0, {1}, {}}}}}, "a list that there is not"},
        {{node, {{0, {RecordKind::list, 0, {4}, {}}}}}, "has more than"},
        {{node, {{0, {RecordKind::goes, 0, {4}, {}}}}}, "what is not there"},
        {{node, {{0, {RecordKind::contour, 0, {4}, {}}}}}, "begins outside"},
        {{node, {{0, {RecordKind::contour, 0, {1}, {3 * triangles}}}}}, "an edge"},
        {{{node[0], {0, {RecordKind::delta, 0, {}, {7}}}}}, "what is not there"},
        {{{node[0], {0, {RecordKind::delta, 0, {1}, {}}}}}, "brings what is there"},
        {{{node[0], {0, {RecordKind::delta, 0, {1}, {1}}}}}, "brings what is there"},
        {{nodes, {square, {1, {RecordKind::same, 0, {}, {}}}}}, "within another"},
        {{nodes, {square, {1, {RecordKind::changed, 0, {}, {2}}}}}, "within another"},
        {{nodes, {{0, {RecordKind::contour, 0, {0, 1}, {}}}}}, "not the one"},  // a seed too many
        {{nodes, {{0, {RecordKind::contour, 0, {1}, {}}}}}, "not the one"},     // another seed
        {{nodes, {{0, {RecordKind::contour, 0, {0}, {0}}}}}, "not the one"},    // an edge too many
        {{nodes, {square, {0, {RecordKind::changed, 0, {}, {0}}}}}, "not the one"}})
    EXPECT_NE(refused(levels).find(why), std::string::npos) << why << ": " << refused(levels);
}

// A small file that asks for much: nothing is made of it.
TEST(ListFile, AFileThatAsksForTooMuchIsRefused) {
  const StoreScene big(floor_of(400));  // 320,000 triangles
  std::vector<std::uint32_t> all(big.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const ListLevels node{{{0, {RecordKind::list, 0, all, {}}}}};
  const auto code_of = [&](const ListLevels& levels) {
    try {
      reference::decoded_levels(big.edges, levels);
    } catch (const scene::Error& e) {
      return e.code();
    }
    return scene::ErrorCode::internal;
  };
  ListLevels same = node;
  for (std::uint32_t i = 1; i < 1000; ++i) same[0].push_back({0, {RecordKind::same, i - 1, {}, {}}});
  EXPECT_EQ(code_of(same), scene::ErrorCode::unsupported);
  // Little is found, but much gone over: contours of nothing, the last triangle alone, and all without its only seed.
  for (const ListRecord& record : {ListRecord{RecordKind::contour, 0, {}, {}},
                                   {RecordKind::list, 0, {all.back()}, {}},
                                   {RecordKind::changed, 0, {0}, {}}}) {
    ListLevels levels{node[0], {{0, {RecordKind::all, 0, {}, {}}}}};
    levels[1].resize(1000, {0, record});
    EXPECT_EQ(code_of(levels), scene::ErrorCode::unsupported) << static_cast<int>(record.kind);
    levels[1].resize(100);
    EXPECT_EQ(code_of(levels), scene::ErrorCode::internal) << "is read";
  }
}

// What a list takes to say has nothing to do with how large the scene is: a small node in a large one may have many cells.
TEST(ListFile, ManyCellsOfASmallNodeAreRead) {
  const StoreScene big(floor_of(400));
  ListLevels levels{{{0, {RecordKind::list, 0, {0, 1}, {}}}}, {}};
  levels[1].resize(200000, {0, {RecordKind::contour, 0, {0}, {2}}});
  const auto lists = reference::decoded_levels(big.edges, levels).back();
  EXPECT_EQ(lists.size(), 200000U);
  EXPECT_EQ(lists.back(), std::vector<std::uint32_t>{0});
}

// The same cell with its corners for those of the inner one: it is written without.
TEST(ListFile, AFileHasOneForm) {
  auto file = file_with({{{0, {RecordKind::list, 0, {1}, {}}}}}, 12);
  EXPECT_EQ(why_refused([&] { scene::parse_lists(scene::to_bytes(file), "x"); }), "");
  file.cells[0].inner = file.cells[0].points;
  EXPECT_NE(why_refused([&] { scene::parse_lists(scene::to_bytes(file), "x"); }).find("not written"),
            std::string::npos);
  // A number with a byte more, that says nothing.
  file.cells[0].inner.clear();
  const std::string sealed = scene::to_bytes(file);
  const std::string bytes = sealed.substr(0, sealed.size() - 32);
  std::uint64_t longer = 0;
  for (std::size_t at = 12 + 32; at < bytes.size(); ++at) {
    if (static_cast<unsigned char>(bytes[at]) >= 0x80) continue;
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] | static_cast<char>(0x80));
    other.insert(at + 1, 1, '\0');
    EXPECT_NE(why_refused([&] { scene::parse_unsealed_lists(other, "x"); }), "") << at;
    ++longer;
  }
  EXPECT_GT(longer, 10U);
}

}  // namespace
}  // namespace clues::test
