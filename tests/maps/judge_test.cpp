// The judge of hierarchies finds what is planted: each defect by the check that is for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "fuzz/generators/random.h"
#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/stars/features.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy_file.h"
#include "tests/maps/hierarchy_over.h"
#include "validate/multires/check_hierarchy.h"
#include "validate/multires/check_plain_map.h"

namespace clues {
namespace {

using testing::HasSubstr;

scene::Hierarchy good() { return test::hierarchy_over(fuzz::ball(5), 24); }

// All findings of the hierarchy with the defect.
std::string verdict(const scene::Hierarchy& h) {
  const auto report = validate::check_hierarchy(h);
  std::string out;
  for (const auto& f : report.findings) out += f.check + " " + f.what + "\n";
  EXPECT_EQ(out.empty(), report.sound());
  return out;
}

// Vertices 0 to 5: x, -x, y, -y, z, -z; one level for each of z and -z, whose holes get these diagonals.
scene::Hierarchy octahedron(scene::Edge first, scene::Edge second) {
  scene::Hierarchy h;
  h.input.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  h.input.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const std::int64_t u = 1 << 20;
  const auto removal = [&](std::uint32_t v, std::vector<std::uint32_t> ring, scene::Edge diagonal) {
    scene::Removal r;
    r.vertex = v;
    r.ring = ring;
    r.flat = {{u, 0}, {0, u}, {-u, 0}, {0, -u}};
    const bool even = diagonal == scene::edge_of(ring[0], ring[2]);
    const auto t = [&](std::size_t a, std::size_t b, std::size_t c) {
      return scene::Triangle{ring[a], ring[b], ring[c]};
    };
    r.triangles = even ? std::vector{t(0, 1, 2), t(0, 2, 3)} : std::vector{t(0, 1, 3), t(1, 2, 3)};
    return r;
  };
  h.levels.push_back({{removal(4, {0, 2, 1, 3}, first)}, {}});
  h.levels.push_back({{removal(5, {0, 3, 1, 2}, second)}, {}});
  for (std::uint32_t v = 0; v < 6; ++v) h.points.push_back({scene::at_vertex(v), scene::at_vertex(v)});
  return h;
}

TEST(JudgeOfHierarchies, AcceptsWhatIsRight) { EXPECT_EQ(verdict(good()), ""); }

TEST(JudgeOfHierarchies, FindsASkippedLinkCondition) {
  EXPECT_THAT(verdict(octahedron({0, 1}, {0, 1})),
              HasSubstr("E1 level 2, vertex 5: the new triangle (0, 3, 1) exists already"));
  EXPECT_THAT(verdict(octahedron({0, 1}, {2, 3})), Not(HasSubstr("E1")));
}

TEST(JudgeOfHierarchies, FindsAWrongCocircularTie) {
  EXPECT_THAT(verdict(octahedron({2, 3}, {0, 1})),
              HasSubstr("E3 level 1, vertex 4: the new edge (2, 3) is not Delaunay, (0, 1) would be"));
  EXPECT_THAT(verdict(octahedron({0, 1}, {2, 3})), Not(HasSubstr("Delaunay")));
}

// With a radius exponent for each side the end of a feature would have two places; here it has one, and it must be on the axis.
TEST(JudgeOfHierarchies, FindsAFeatureThatBends) {
  const auto mesh = fuzz::frame(0, 4);
  reference::HierarchyOptions options;
  options.base_triangles = 0;
  options.features = reference::sharp_edges(mesh, 0.5);
  auto h = reference::build_hierarchy(mesh, options);
  EXPECT_EQ(verdict(h), "");
  bool planted = false;
  for (auto& level : h.levels) {
    for (auto& r : level.removals) {
      if (planted || r.kind != scene::StarKind::feature) continue;
      r.flat[r.across][1] += 1;
      planted = true;
    }
  }
  ASSERT_TRUE(planted);
  EXPECT_THAT(verdict(h), HasSubstr("it does not lie on its new feature edge"));
  // A feature that is not stated is not kept.
  auto lost = reference::build_hierarchy(mesh, options);
  lost.fixed.clear();
  EXPECT_THAT(verdict(lost), HasSubstr("E2 vertex"));
}

TEST(JudgeOfHierarchies, FindsWeightsThatMissOneByTheLeast) {
  for (const int by : {-1, 1}) {
    auto h = good();
    for (auto& p : h.points) {
      if (p.image.size() != 3) continue;
      p.image.weight[1] += by;
      break;
    }
    EXPECT_THAT(verdict(h),
                HasSubstr(by > 0 ? "its weights sum to 1 + 1 * 2^-60" : "its weights sum to 1 - 1 * 2^-60"));
  }
}

TEST(JudgeOfHierarchies, FindsWhatIsWrongWithTheOverlay) {
  auto flipped = good();
  std::swap(flipped.pieces[7].corners[0], flipped.pieces[7].corners[1]);
  EXPECT_THAT(verdict(flipped), HasSubstr("E6 piece 7 is flipped"));
  auto missing = good();
  missing.pieces.erase(missing.pieces.begin() + 3);
  EXPECT_THAT(verdict(missing), testing::AllOf(HasSubstr("has no neighbour"), HasSubstr("of its area")));
  auto twice = good();
  twice.pieces.push_back(twice.pieces[2]);
  EXPECT_THAT(verdict(twice), HasSubstr("lie on the same side"));
  // Two points on one edge of the base change places.
  auto moved = good();
  std::map<scene::Edge, std::size_t> first;
  for (std::size_t p = 0; p < moved.points.size(); ++p) {
    auto& image = moved.points[p].image;
    if (image.size() != 2) continue;
    const auto [other, fresh] = first.try_emplace({image.corner[0], image.corner[1]}, p);
    if (fresh) continue;
    std::swap(image, moved.points[other->second].image);
    break;
  }
  EXPECT_THAT(verdict(moved), HasSubstr("E6 piece"));
}

// The triangles as a base domain of their own, every vertex where it is.
scene::Hierarchy itself(std::size_t vertices, const std::vector<scene::Triangle>& triangles) {
  scene::Hierarchy h;
  h.input.points.resize(vertices);
  h.input.triangles = h.base = triangles;
  for (std::uint32_t v = 0; v < vertices; ++v) h.points.push_back({scene::at_vertex(v), scene::at_vertex(v)});
  for (std::uint32_t t = 0; t < triangles.size(); ++t) h.pieces.push_back({triangles[t], t});
  return h;
}

// The first points were the identity, as E5 wants them, and the pieces a rotation: it was verified.
TEST(JudgeOfHierarchies, FindsPointsBesideThePieces) {
  auto h = itself(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  EXPECT_EQ(verdict(h), "");
  for (std::uint32_t v = 0; v < 4; ++v)
    h.points.push_back({scene::at_vertex(v), scene::at_vertex(v < 3 ? (v + 1) % 3 : 3)});
  for (auto& piece : h.pieces) {
    for (auto& corner : piece.corners) corner += 4;
  }
  EXPECT_EQ(verdict(h),
            "E6 point 0 is a corner of no piece\nE6 point 1 is a corner of no piece\n"
            "E6 point 2 is a corner of no piece\nE6 point 3 is a corner of no piece\n");
}

TEST(JudgeOfHierarchies, FindsAVertexWithoutTriangle) {
  EXPECT_THAT(verdict(itself(4, {{0, 1, 2}})), HasSubstr("E1 vertex 3 of the input has no triangle"));
}

// Half-edges take both of them.
TEST(JudgeOfHierarchies, FindsTwoTrianglesOfTheSameThree) {
  EXPECT_THAT(verdict(itself(3, {{0, 1, 2}, {0, 2, 1}})),
              HasSubstr("E1 level 0: two triangles have vertices 0, 1 and 2"));
  EXPECT_THAT(verdict(itself(3, {{0, 1, 2}, {1, 2, 0}})),
              HasSubstr("E1 level 0: two triangles have vertices 0, 1 and 2"));
}

// The feature's second end was looked for in a ring that is none.
TEST(JudgeOfHierarchies, FindsAReasonWhereTwoFansMeet) {
  auto h = itself(5, {{0, 1, 2}, {0, 3, 4}});
  h.features = {{0, 1}, {0, 2}};
  h.fixed = {1, 2, 3, 4};
  h.levels.push_back({{}, {{0, scene::KeptFor::link}}});
  EXPECT_THAT(verdict(h), HasSubstr("E2 level 1, vertex 0: a reason is given why it stays, and its star is no fan"));
}

TEST(JudgeOfHierarchies, FindsReasonsThatNobodyAskedFor) {
  const auto h = good();
  const std::uint32_t removed = h.levels[0].removals[0].vertex, blocked = h.levels[0].removals[0].ring[0];
  for (const std::uint32_t v : {removed, blocked}) {
    auto wrong = h;
    wrong.levels[0].kept.push_back({v, scene::KeptFor::numbers});
    EXPECT_THAT(verdict(wrong), testing::StartsWith("E2 level 1, vertex " + std::to_string(v) + ": a reason is given"));
  }
  auto gone = h;
  gone.levels[1].kept.push_back({removed, scene::KeptFor::numbers});
  EXPECT_THAT(verdict(gone), HasSubstr("E2 level 2, vertex " + std::to_string(removed) + ": a reason is given"));
  // No vertex of a tetrahedron can be removed; those that are fixed need no reason.
  auto two = itself(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  two.fixed = {1, 2, 3};
  two.levels.push_back({{}, {{0, scene::KeptFor::link}}});
  EXPECT_EQ(verdict(two), "");
  two.levels[0].kept.push_back({0, scene::KeptFor::numbers});
  EXPECT_EQ(verdict(two), "E2 level 1, vertex 0: two reasons are given why it stays\n");
  two.levels[0].kept[1].vertex = 1;
  EXPECT_THAT(verdict(two), HasSubstr("E2 level 1, vertex 1: a reason is given"));
}

TEST(JudgeOfHierarchies, FindsALevelThatIsNotIndependentOrNotMaximal) {
  auto less = good();
  less.levels.back().removals.pop_back();
  EXPECT_THAT(verdict(less), HasSubstr("the base domain is not what the levels leave"));
  auto joined = good();
  auto& first = joined.levels[0].removals;
  first.insert(first.end(), joined.levels[1].removals.begin(), joined.levels[1].removals.end());
  joined.levels.erase(joined.levels.begin() + 1);
  EXPECT_THAT(verdict(joined), HasSubstr("a neighbour is removed in the same level"));
  auto split = good();
  split.levels.insert(split.levels.begin() + 1, scene::HierarchyLevel{});
  auto& whole = split.levels[0].removals;
  split.levels[1].removals.assign(whole.begin() + 10, whole.end());
  whole.erase(whole.begin() + 10, whole.end());
  EXPECT_THAT(verdict(split), HasSubstr("the level is not maximal"));
  auto excused = split;
  for (const auto& r : split.levels[1].removals) excused.levels[0].kept.push_back({r.vertex, scene::KeptFor::link});
  EXPECT_THAT(verdict(excused), HasSubstr("no triangulation of its hole is free, and one is"));
}

TEST(JudgeOfHierarchies, FindsAnImageThatIsNotWhatTheStepsSay) {
  auto h = good();
  for (std::size_t v = 0; v < h.input.points.size(); ++v) {
    auto& image = h.points[v].image;
    if (image.size() != 3) continue;
    ++image.weight[0];
    --image.weight[1];
    break;
  }
  EXPECT_THAT(verdict(h), HasSubstr("E5 vertex"));
}

TEST(HierarchyFile, IsRefusedWithTheLine) {
  const auto text = scene::to_text(good());
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string wrong = text;
    const auto at = wrong.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    wrong.replace(at, from.size(), to);
    try {
      scene::parse_hierarchy(wrong, "f");
    } catch (const scene::Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal("clues-maps 1", "clues-maps 2"), HasSubstr("f:1"));
  EXPECT_THAT(refusal("triangles 200", "triangles 201"), HasSubstr("f:"));
  EXPECT_THAT(refusal("vertices 102", "vertices 99999999999"), HasSubstr("is no count"));
  EXPECT_THAT(refusal("remove ", "remove 5000 "), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(" interior ", " inner "), HasSubstr("is no kind of a star"));
  EXPECT_THAT(refusal("\npieces ", "\npieces 1 "), HasSubstr("one word too many"));
  for (std::size_t cut = 0; cut + 1 < text.size(); cut += 97) {
    EXPECT_THROW(scene::parse_hierarchy(text.substr(0, cut), "f"), scene::Error) << cut;
  }
}

// Whatever is in a file: it is refused, or judged.
TEST(HierarchyFile, MayHoldAnything) {
  std::vector<std::string> lines;
  std::istringstream in(scene::to_text(good()));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::uint64_t refused = 0, found = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    fuzz::Random random(1000 + k);
    auto wrong = lines;
    for (int times = random.between(1, 4); times > 0; --times) {
      const std::size_t i = random.next() % wrong.size(), j = random.next() % wrong.size();
      switch (random.between(0, 3)) {
        case 0:
          std::swap(wrong[i], wrong[j]);
          break;
        case 1:
          wrong[i] = wrong[j];
          break;
        default: {
          const char* const words[] = {"0",       "1", "3", "7", "-1", "1152921504606846976", "-4611686018427387904",
                                       "16777216"};
          const auto from = wrong[i].find(' ', random.next() % (wrong[i].size() + 1));
          if (from == std::string::npos) break;
          const auto to = std::min(wrong[i].find(' ', from + 1), wrong[i].size());
          wrong[i].replace(from + 1, to - from - 1, words[random.next() % 8]);
        }
      }
    }
    std::string text;
    for (const auto& line : wrong) text += line + "\n";
    try {
      found += validate::check_hierarchy(scene::parse_hierarchy(text, "f")).sound() ? 0U : 1U;
    } catch (const scene::Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 50U);
  EXPECT_GT(found, 30U);
}

validate::PlainMapReport plain(std::vector<scene::PlainMapLine> lines) {
  const auto mesh = fuzz::ball(1);
  return validate::check_plain_map(mesh, mesh, lines, "plain.txt");
}

// Every vertex of the octahedron at itself, by the first triangle that has it.
std::vector<scene::PlainMapLine> identity() {
  const auto mesh = fuzz::ball(1);
  std::vector<scene::PlainMapLine> lines(6);
  for (std::uint32_t t = 8; t-- > 0;) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& line = lines[mesh.triangles[t][k]];
      line.triangle = t;
      line.weights = {k == 0 ? "1" : "0", k == 1 ? "1.0" : "0", k == 2 ? "7/7" : "0"};
    }
  }
  return lines;
}

TEST(JudgeOfPlainMaps, ProvesRefutesAndLeavesOpen) {
  EXPECT_EQ(plain(identity()).verdict, validate::PlainVerdict::proved);
  auto ulp = identity();
  for (auto& w : ulp[2].weights) {
    if (w != "0") w = "0.9999999999999999";
  }
  EXPECT_THAT(validate::to_text(plain(ulp)), HasSubstr("E4 vertex 2: its coordinates sum to 1 - 1e-16"));
  auto swapped = identity();
  std::swap(swapped[0], swapped[1]);
  const auto report = plain(swapped);
  EXPECT_EQ(report.verdict, validate::PlainVerdict::refuted);
  EXPECT_THAT(validate::to_text(report), HasSubstr("flipped"));
  auto same = identity();
  same[0] = same[1];
  EXPECT_THAT(validate::to_text(plain(same)), HasSubstr("vertices 0 and 1 have the same image"));
  auto inside = identity();
  inside[0].weights = {"1/3", "1/3", "1/3"};
  EXPECT_EQ(plain(inside).verdict, validate::PlainVerdict::undecided);
  auto two = identity();
  two[0].weights[2].clear();
  EXPECT_EQ(plain(two).verdict, validate::PlainVerdict::proved);
  auto nonsense = identity();
  nonsense[0].weights[1] = "1/0";
  EXPECT_THROW(plain(nonsense), scene::Error);
  nonsense.pop_back();
  EXPECT_THROW(plain(nonsense), scene::Error);
  auto outside = identity();
  outside[0].triangle = 8;
  EXPECT_THAT(validate::to_text(plain(outside)), HasSubstr("base triangle 8 does not exist"));
}

scene::TriangleMesh surface(std::size_t vertices, const std::vector<scene::Triangle>& triangles) {
  scene::TriangleMesh mesh;
  mesh.points.resize(vertices);
  mesh.triangles = triangles;
  return mesh;
}

// The vertices of a surface, each at two coordinates in a base that is one triangle.
validate::PlainMapReport in_one_triangle(const std::vector<scene::Triangle>& triangles,
                                         const std::vector<std::array<const char*, 2>>& images) {
  std::vector<scene::PlainMapLine> lines;
  for (const auto& [u, v] : images) lines.push_back({0, {u, v, ""}});
  return validate::check_plain_map(surface(images.size(), triangles), surface(3, {{0, 1, 2}}), lines, "plain.txt");
}

// A fan of three in a triangle, its middle at these coordinates.
validate::PlainMapReport with_middle(const char* a, const char* b, const char* c) {
  const std::vector<scene::PlainMapLine> lines{
      {0, {"1", "0", "0"}}, {0, {"0", "1", "0"}}, {0, {"0", "0", "1"}}, {0, {a, b, c}}};
  return validate::check_plain_map(surface(4, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}), surface(3, {{0, 1, 2}}), lines,
                                   "plain.txt");
}

// They were rounded to doubles first: tenths were off by what nobody wrote, and 1 + 1e-20 was 1.
TEST(JudgeOfPlainMaps, CoordinatesAreTakenAsTheyAreWritten) {
  using validate::PlainVerdict;
  EXPECT_EQ(with_middle("0.1", "0.2", "0.7").verdict, PlainVerdict::proved);
  EXPECT_EQ(with_middle("+1e-1", "2.E-01", ".7").verdict, PlainVerdict::proved);
  EXPECT_EQ(with_middle("0x.4p0", "0X1P-2", "0x0.8").verdict, PlainVerdict::proved);
  EXPECT_EQ(with_middle("0x1.8p-2", "25e-2", "3/8").verdict, PlainVerdict::proved);
  const auto text = [&](const char* a) { return validate::to_text(with_middle(a, "0.25", "0.25")); };
  EXPECT_THAT(text("0.50000000000000000001"), HasSubstr("E4 vertex 3: its coordinates sum to 1 + 1e-20, not to 1"));
  EXPECT_THAT(text("0x.7ffffffffffffffffp0"), HasSubstr("E4 vertex 3: its coordinates sum to 1 - 3.39e-21, not to 1"));
  EXPECT_THAT(validate::to_text(with_middle("1e-400", "0.5", "0.5")), HasSubstr("sum to 1 + less than 1e-300"));
  EXPECT_THAT(text("-1e-1"), HasSubstr("coordinate 0 is negative (-0.1)"));
  EXPECT_EQ(with_middle("1e-5000", "0.5", "0.5").verdict, PlainVerdict::refuted);
  const std::string too_long = "0." + std::string(10'000, '3');
  for (const char* wrong : {"1e-5001", "0e5001", "0x1p-5001", "1e99999999999999999999", "1e400", "0x", "0x1p", "1e",
                            ".", "-", "", "--1", "nan", "inf", "1 ", "0x1.8p+3x", "1/", "+1/2", too_long.c_str()}) {
    EXPECT_THROW(with_middle(wrong, "0.25", "0.25"), scene::Error) << wrong;
  }
}

TEST(JudgeOfPlainMaps, AVertexWithoutTriangleIsNoPartOfASurface) {
  const std::vector<scene::Triangle> one{{0, 1, 2}};
  const std::vector<scene::PlainMapLine> corners{{0, {"1", "0", "0"}}, {0, {"0", "1", "0"}}, {0, {"0", "0", "1"}}};
  auto lines = corners;
  lines.push_back({0, {"1/3", "1/3", "1/3"}});
  const auto input = validate::check_plain_map(surface(4, one), surface(3, one), lines, "plain.txt");
  EXPECT_EQ(input.verdict, validate::PlainVerdict::refuted);
  EXPECT_THAT(validate::to_text(input), HasSubstr("E1 the input: vertex 3 has no triangle"));
  const auto base = validate::check_plain_map(surface(3, one), surface(4, one), corners, "plain.txt");
  EXPECT_THAT(validate::to_text(base), HasSubstr("E1 the base: vertex 3 has no triangle"));
}

// Nothing is flipped, no place is taken twice, and the Euler numbers agree; it was called proved for that.
TEST(JudgeOfPlainMaps, AStripThatOverlapsItselfIsNoBijection) {
  const auto report = in_one_triangle(
      {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}, {4, 5, 7}, {4, 7, 6}, {6, 7, 9}, {6, 9, 8}, {8, 9, 11}, {8, 11, 10}},
      {{"6/16", "4/16"},
       {"9/16", "4/16"},
       {"4/16", "6/16"},
       {"4/16", "9/16"},
       {"3/16", "4/16"},
       {"1/16", "4/16"},
       {"4/16", "3/16"},
       {"4/16", "1/16"},
       {"6/16", "5/16"},
       {"8/16", "3/16"},
       {"5/16", "6/16"},
       {"6/16", "8/16"}});
  EXPECT_EQ(report.flipped, 0U);
  EXPECT_EQ(report.verdict, validate::PlainVerdict::refuted);
  EXPECT_THAT(validate::to_text(report), HasSubstr("vertex 0 of the boundary is mapped to the inside"));
}

TEST(JudgeOfPlainMaps, ABoundaryThatCutsThroughTheBaseIsNone) {
  const auto report = in_one_triangle({{0, 1, 2}}, {{"1/2", "0"}, {"1/2", "1/2"}, {"0", "1/2"}});
  EXPECT_EQ(report.verdict, validate::PlainVerdict::refuted);
  EXPECT_THAT(validate::to_text(report), HasSubstr("runs through the inside of base triangle 0"));
  EXPECT_THAT(validate::to_text(report), HasSubstr("base triangle 0: what lies in it has 0.25 of its area"));
}

// A torus changes neither the Euler number nor the number of boundaries.
TEST(JudgeOfPlainMaps, APartOfTheBaseThatNothingIsMappedToIsSeen) {
  std::vector<scene::Triangle> base{{0, 1, 2}};
  for (std::uint32_t i = 0; i < 7; ++i) {
    base.push_back({3 + i, 3 + (i + 1) % 7, 3 + (i + 3) % 7});
    base.push_back({3 + i, 3 + (i + 3) % 7, 3 + (i + 2) % 7});
  }
  const std::vector<scene::PlainMapLine> lines{{0, {"1", "0", "0"}}, {0, {"0", "1", "0"}}, {0, {"0", "0", "1"}}};
  const auto report = validate::check_plain_map(surface(3, {{0, 1, 2}}), surface(10, base), lines, "plain.txt");
  EXPECT_EQ(report.verdict, validate::PlainVerdict::refuted);
  EXPECT_EQ(report.counts, (std::map<std::string, std::uint64_t>{{"E6", 14}}));
}

// Both sides of a cushion have the same corners: by those nothing is known to be flipped.
TEST(JudgeOfPlainMaps, OnACushionCornersDoNotTellTheSide) {
  const auto cushion = surface(3, {{0, 1, 2}, {0, 2, 1}});
  const std::vector<scene::PlainMapLine> lines{{0, {"1", "0", "0"}}, {0, {"0", "1", "0"}}, {0, {"0", "0", "1"}}};
  const auto report = validate::check_plain_map(cushion, cushion, lines, "plain.txt");
  EXPECT_TRUE(report.findings.empty()) << validate::to_text(report);
  EXPECT_EQ(report.verdict, validate::PlainVerdict::undecided);
}

}  // namespace
}  // namespace clues
