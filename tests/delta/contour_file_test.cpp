// Files of contours: what is written is read again and decoded to the maps that were coded, and what is no such file is refused.
#include <gtest/gtest.h>

#include <string>

#include "fastpath/contours/contour_decoder.h"
#include "fastpath/contours/side_graph.h"
#include "fastpath/predicates/float_rules.h"
#include "reference/contours/contour_maker.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/stream/contour_file.h"
#include "tests/app/program.h"
#include "tests/delta/plates.h"
#include "tests/reference/support.h"

namespace clues::test {
namespace {

scene::ContourFile file_of_plates() {
  static const scene::ContourFile file = [] {
    const auto mesh = plates_and_a_box();
    reference::ContourMaker maker(mesh, {}, 0);
    maker.add("parent", box_cell(-2, -1, -1, 2, 1, 0), 0, true);
    maker.add("left", box_cell(-2, -1, -1, 0, 1, 0), 1, true);
    maker.add("left below", box_cell(-2, -1, -1, 0, 0, 0), 2, false);
    scene::ContourFile made = maker.file();
    made.scene_sha256 = scene::sha256_of("plates");
    return made;
  }();
  return file;
}

std::string unsealed(const scene::ContourFile& file) {
  const std::string bytes = scene::to_bytes(file);
  return bytes.substr(0, bytes.size() - 32);
}

// Two sides go along a common edge in opposite directions. Were it measured along another axis by each, what one side cannot tell apart the other one could, and an open slit
// between two points would be taken for closed. Differences that are rounded upward are not the same both ways.
TEST(ContourDecoders, MeasureAnEdgeAlongOneAxisFromBothEnds) {
  const fastpath::RoundedUp rounded_up;
  const auto at = [](double x, double y, double z) { return fastpath::Box3{x, y, z}; };
  EXPECT_EQ(fastpath::longest_axis(at(5.61, 0.47, 1), at(13.98, -7.9, 1)),
            fastpath::longest_axis(at(13.98, -7.9, 1), at(5.61, 0.47, 1)));
}

TEST(ContourFiles, AreReadAsTheyWereWritten) {
  const auto file = file_of_plates();
  const std::string bytes = scene::to_bytes(file);
  const auto again = scene::parse_contours(bytes, "file");
  EXPECT_EQ(again, file);
  EXPECT_EQ(scene::to_bytes(again), bytes);
  EXPECT_EQ(scene::chain_of(again.cells, 2), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ContourFiles, CutShortOrChangedAnywhereAreRefused) {
  const std::string bytes = scene::to_bytes(file_of_plates());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(scene::parse_contours(bytes.substr(0, size), "file"), scene::Error) << size;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] ^ 1);
    EXPECT_THROW(scene::parse_contours(other, "file"), scene::Error) << at;
  }
  EXPECT_THROW(scene::parse_contours(bytes + "x", "file"), scene::Error);
}

// Who makes the hash anew is refused or decoded to something; there is no third.
TEST(ContourFiles, ChangedWithTheirHashAreRefusedOrDecoded) {
  const std::string bytes = unsealed(file_of_plates());
  const auto mesh = plates_and_a_box();
  const auto sides = reference::input_sides(mesh, reference::Mode::sheet);
  const fastpath::ContourDecoder decoder(mesh);
  std::uint64_t refused = 0, decoded = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const unsigned change : {0x01U, 0x02U, 0x80U}) {
      std::string other = bytes;
      other[at] = static_cast<char>(static_cast<unsigned char>(other[at]) ^ change);
      try {
        const auto file = scene::parse_unsealed_contours(other, "file");
        EXPECT_EQ(unsealed(file), other);
        const auto last = static_cast<std::uint32_t>(file.cells.size() - 1);
        decoder.decode(file, last);
        if (at % 16 == 0) reference::decoded_map(sides, mesh, file, last);
        ++decoded;
      } catch (const scene::Error& error) {
        EXPECT_NE(error.code(), scene::ErrorCode::internal) << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100U);
  EXPECT_GT(decoded, 100U);
}

TEST(ContourFiles, SayWhatIsWrong) {
  const auto refusal = [](const std::string& bytes) {
    try {
      scene::parse_unsealed_contours(bytes, "some.contours");
    } catch (const scene::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  std::string bytes = unsealed(file_of_plates());
  EXPECT_EQ(refusal("CLUESSTR"), "some.contours: is no file of contours, which begins with CLUESCON");
  EXPECT_EQ(refusal(bytes + "x"), "some.contours: something stands behind the last cell");
  EXPECT_EQ(refusal(bytes.substr(0, 60)), "some.contours: cut short, or a number that there is none");
  bytes[8] = 2;
  EXPECT_EQ(refusal(bytes), "some.contours: contours of version 2; this program reads version 1");
  const auto changed = [&](const auto& change) {
    auto file = file_of_plates();
    change(file);
    return refusal(unsealed(file));
  };
  EXPECT_EQ(changed([](auto& f) { f.cells.clear(); }), "some.contours: without a cell");
  EXPECT_EQ(changed([](auto& f) { f.reach = -1; }), "some.contours: a reach below 0");
  EXPECT_EQ(changed([](auto& f) { f.cells[0].points.clear(); }), "some.contours: a cell without points");
  EXPECT_EQ(changed([](auto& f) { f.cells[0].sides[0].points.emplace_back(); }),
            "some.contours: a point that nothing uses");
  EXPECT_EQ(changed([](auto& f) {
              f.cells[0].seeds[0] = {f.cells[0].seeds[0].side, 0, 2, {2, 2}, {}};
            }),
            "some.contours: a seed that is not inside of its triangle");
  EXPECT_EQ(changed([](auto& f) {
              f.cells[0].seeds[0] = {f.cells[0].seeds[0].side, 0, 0, {}, {"1/3", "0x1"}};
            }),
            "some.contours: a coordinate in full is no fraction p/q");
  EXPECT_EQ(changed([](auto& f) { f.mode = "solid"; }), "some.contours: the back of a triangle, in solid mode");
}

// A point that its label puts elsewhere is noticed by whoever has the scene.
TEST(ContourFiles, LabelsThatMakeNoPointAreRefused) {
  const auto mesh = plates_and_a_box();
  const auto sides = reference::input_sides(mesh, reference::Mode::sheet);
  const auto expect_refused = [&](const auto& change) {
    auto file = file_of_plates();
    change(file.cells[0]);
    EXPECT_THROW(reference::decoded_map(sides, mesh, file, 0), scene::Error);
  };
  expect_refused([](scene::ContourCell& cell) {  // no plane
    for (auto& plane : cell.planes) plane = {scene::ContourPlane::Kind::edge, {0, 0, 0}, {0, 0}, 0};
  });
  expect_refused([](scene::ContourCell& cell) {  // a point of an edge that has none
    for (auto& point : cell.sides[0].points) point = {scene::ContourPoint::Kind::again, 0, 1000, {}};
  });
  expect_refused([](scene::ContourCell& cell) {  // beside its triangle
    for (auto& point : cell.sides[0].points) point = {scene::ContourPoint::Kind::in_full, 0, 0, {"1000", "0", "8"}};
  });
}

// The file and the scene give what `clues map` gives, exactly, and never less in doubles.
TEST(ContourCommands, DecodeWhatWasMapped) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const auto run = [&](const std::vector<std::string>& words) { return tests::run_clues(words, folder.path()); };
  const std::string parent = "box:-0.25,-0.25,-0.25,0.25,0.25,0";
  const auto made = run({"delta", "contours", "screen.off", "--parent", parent, "--cells", "grid:4x2x1:" + parent,
                         "--levels", "1", "-o", "screen.contours"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto listed = run({"delta", "decode", "screen.off", "--contours", "screen.contours"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_NE(listed.out.find("     2       0  exact"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("    10       2  exact"), std::string::npos) << listed.out;
  const auto text = [&](const std::string& name) { return scene::read_file_bytes(folder.file(name)); };
  ASSERT_EQ(run({"map", "screen.off", "--cells", "grid:4x2x1:" + parent, "-o", "maps"}).exit_code, 0);
  for (const auto& [cell, name] : {std::pair("3", "0-0-0"), {"6", "3-0-0"}, {"10", "3-1-0"}}) {
    const auto exact = run({"delta", "decode", "screen.off", "--contours", "screen.contours", "--cell", cell, "--check",
                            "-o", "exact.pvs", "--fragments", "exact.json"});
    ASSERT_EQ(exact.exit_code, 0) << exact.err << exact.out;
    EXPECT_NE(exact.out.find("doubles hold what is exact on"), std::string::npos) << exact.out;
    const auto of_map = scene::read_pvs(folder.file("maps") + "/cell-" + name + ".clues.json", 5);
    EXPECT_EQ(scene::read_pvs(folder.file("exact.pvs"), 5), of_map);
    ASSERT_EQ(run({"delta", "decode", "screen.off", "--contours", "screen.contours", "--cell", cell, "--kernel", "fast",
                   "-o", "fast.clues.json"})
                  .exit_code,
              0);
    EXPECT_EQ(scene::read_pvs(folder.file("fast.clues.json"), 5), of_map);
    EXPECT_NE(text("fast.clues.json").find("\"decoded_conservatively\": 1"), std::string::npos);
  }
}

TEST(ContourCommands, RefuseWhatDoesNotBelongTogether) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  folder.write("other.off", std::string(tests::screen_scene) + "\n");
  folder.write("bad.contours", "CLUESCON");
  const std::string parent = tests::screen_cell;
  const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
    const auto ran = tests::run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << ran.out;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder.file("out.pvs")));
  };
  ASSERT_EQ(tests::run_clues({"delta", "contours", "screen.off", "--parent", parent, "--cells", "grid:2x1x1:" + parent,
                              "-o", "good.contours"},
                             folder.path())
                .exit_code,
            0);
  const auto decode = [](const std::string& scene, const std::string& file, const std::string& cell) {
    return std::vector<std::string>{"delta", "decode", scene, "--contours", file, "--cell", cell, "-o", "out.pvs"};
  };
  refused(decode("other.off", "good.contours", "1"), "is of another scene than other.off");
  refused(decode("screen.off", "good.contours", "3"), "--cell 3: the file has cells 0 to 2");
  refused(decode("screen.off", "bad.contours", "0"), "bad.contours: is cut short or was changed");
  refused(decode("screen.off", "none.contours", "0"), "none.contours");
  refused({"delta", "decode", "screen.off", "--contours", "good.contours", "-o", "out.pvs"}, "give --cell");
  refused({"delta", "decode", "screen.off", "--contours", "good.contours", "--cell", "1", "--kernel", "fast",
           "--fragments", "out.pvs"},
          "--fragments: of the exact kernel only");
  refused({"delta", "contours", "screen.off", "--bake", "x.bake", "-o", "out.pvs"}, "-o and --levels: of --cells only");
  refused({"delta", "contours", "screen.off", "--parent", parent, "--cells", parent, "--levels", "1", "-o", "out.pvs"},
          "--levels: --cells has to be a grid");
}

// What is left to the cell around is said in the file, and in what is decoded.
TEST(ContourCommands, SayWhereDecodingIsConservative) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string parent = tests::screen_cell;
  const auto made = tests::run_clues({"delta", "contours", "screen.off", "--parent", parent, "--cells",
                                      "grid:4x4x1:" + parent, "--reach", "0.01", "-o", "far.contours"},
                                     folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto file = scene::read_contours(folder.file("far.contours"));
  EXPECT_EQ(file.reach, 0.01);
  EXPECT_TRUE(file.cells[0].exact);
  EXPECT_FALSE(file.cells[1].exact);
  const auto decoded = tests::run_clues(
      {"delta", "decode", "screen.off", "--contours", "far.contours", "--cell", "1", "--check"}, folder.path());
  EXPECT_EQ(decoded.exit_code, 0) << decoded.err;
  EXPECT_NE(decoded.out.find("decoded conservatively"), std::string::npos) << decoded.out;
}

}  // namespace
}  // namespace clues::test
