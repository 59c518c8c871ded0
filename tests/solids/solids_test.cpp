// T15: what is a solid, what sections of solids cover, where facets are open, and what is hidden by all that.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <utility>

#include "fastpath/solids/find_solids.h"
#include "fastpath/solids/shafts.h"
#include "tests/solids/worlds.h"

namespace clues::tests {
namespace {

namespace solids = fastpath::solids;
using scene::Bounds;
using scene::Point;
using solids::Solid;

const Bounds about{{0, 0, 0}, {64, 64, 64}};

std::vector<Solid> boxes(const std::vector<std::array<Point, 2>>& all) {
  std::vector<Solid> out;
  for (const auto& [low, high] : all) out.push_back(*solids::solid_of(faces_of_box(low, high)));
  return out;
}

TEST(Solid, IsWhatIsConvexAndClosed) {
  const auto box = faces_of_box({0, 0, 0}, {4, 4, 4});
  ASSERT_TRUE(solids::solid_of(box));
  EXPECT_EQ(solids::solid_of(box)->sides.size(), 6U);
  EXPECT_EQ(solids::solid_of(box)->edges.size(), 12U);
  std::vector<Face> triangles;
  for (const Face& face : box) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) triangles.push_back({face[0], face[i], face[i + 1]});
  }
  ASSERT_TRUE(solids::solid_of(triangles));
  EXPECT_EQ(solids::solid_of(triangles)->edges.size(), 12U) << "where parts of a face meet there is none";
  auto turned = box;
  std::reverse(turned[2].begin(), turned[2].end());
  EXPECT_TRUE(solids::solid_of(turned)) << "it does not matter which way a face turns";
  auto repeated = box;
  repeated.push_back({box[0][0], box[0][0], box[0][1], box[0][1]});
  EXPECT_TRUE(solids::solid_of(repeated)) << "nor a face without an area";
  for (std::size_t i = 0; i < box.size(); ++i) {
    auto open = box;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(solids::solid_of(open)) << "without face " << i;
  }
  auto dented = box;
  for (auto& face : dented) {
    for (auto& p : face) {
      if (p == Point{4, 4, 4}) p = {4, 4, 4 - 0x1p-40};
    }
  }
  EXPECT_FALSE(solids::solid_of(dented)) << "its upper face is bent the wrong way";
  EXPECT_FALSE(solids::solid_of(faces_of_box({0, 0, 0}, {4, 4, 0})));
  EXPECT_FALSE(solids::solid_of({}));
}

TEST(Solid, IsFoundInAScene) {
  scene::FlaggedMeshBuilder builder;
  const auto add = [&](const std::vector<Face>& faces, bool blocks) {
    for (const auto& face : faces) {
      for (std::size_t i = 1; i + 1 < face.size(); ++i) builder.add({face[0], face[i], face[i + 1]}, 0, {blocks, true});
    }
  };
  add(faces_of_box({0, 0, 0}, {1, 1, 1}), true);
  add(faces_of_box({4, 0, 0}, {5, 1, 1}), false);  // glass
  auto open = faces_of_box({8, 0, 0}, {9, 1, 1});
  open.pop_back();
  add(open, true);
  const auto found = solids::find_solids(builder.take());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].bounds.high, (Point{1, 1, 1}));
}

void add_faces(scene::FlaggedMesh& scene, const std::vector<Face>& faces) {
  for (const auto& face : faces) {
    const auto first = static_cast<std::uint32_t>(scene.mesh.points.size());
    scene.mesh.points.insert(scene.mesh.points.end(), face.begin(), face.end());
    for (std::uint32_t i = 1; i + 1 < face.size(); ++i)
      scene.mesh.triangles.push_back({first, first + i, first + i + 1});
  }
}

// Each face has vertices of its own, so only coordinates say what hangs together.
TEST(Solid, IsFoundBesideOthersThatTouchIt) {
  scene::FlaggedMesh scene;
  add_faces(scene, faces_of_box({0, 0, 0}, {1, 1, 1}));
  add_faces(scene, faces_of_box({1, 1, 1}, {2, 2, 2}));  // at a corner
  add_faces(scene, faces_of_box({1, 1, 0}, {2, 2, 1}));  // along edges, and a face
  add_faces(scene, faces_of_box({-1, 0, 1}, {0, 1, 2}));
  EXPECT_EQ(solids::find_solids(scene).size(), 2U) << "those with a face in common are one part";
}

// Vertices of their own are enough, whatever they touch.
TEST(Solid, IsFoundByItsVertices) {
  scene::FlaggedMesh scene;
  const auto add_box = [&](const Point& low, const Point& high) {
    scene::FlaggedMeshBuilder builder;
    for (const auto& face : faces_of_box(low, high)) {
      for (std::size_t i = 1; i + 1 < face.size(); ++i) builder.add({face[0], face[i], face[i + 1]}, 0, {true, true});
    }
    const auto box = builder.take().mesh;
    const auto first = static_cast<std::uint32_t>(scene.mesh.points.size());
    scene.mesh.points.insert(scene.mesh.points.end(), box.points.begin(), box.points.end());
    for (const auto& [a, b, c] : box.triangles) scene.mesh.triangles.push_back({first + a, first + b, first + c});
  };
  for (int i = 0; i < 3; ++i) add_box({1.0 * i, 0, 0}, {1.0 * i + 1, 1, 1});
  EXPECT_EQ(solids::find_solids(scene).size(), 3U);
}

std::vector<Point> window(double x, double y, double z) {
  return {{x, y - 1, z - 1}, {x, y + 1, z - 1}, {x, y + 1, z + 1}, {x, y - 1, z + 1}};
}

bool is_covered(const solids::Section& section, const std::vector<Point>& from, const std::vector<Point>& to) {
  return section.covers(solids::Piece(from), solids::Piece(to));
}

// Whether all lines from a small window at x = 0 to one at x = 64, both about the same y and z, are stopped by the sections behind x = 30.
bool stops(std::vector<Solid> walls, double y, double z) {
  const solids::Solids all(std::move(walls), about);
  bool any = false;
  for (std::uint32_t solid = 0; solid < all.all().size(); ++solid) {
    for (std::uint32_t side = 0; side < all.all()[solid].sides.size(); ++side)
      any = any || is_covered(all.section(all.plane_behind(solid, side)), window(0, y, z), window(64, y, z));
  }
  return any;
}

TEST(Section, WallsThatAbutAreOne) {
  EXPECT_TRUE(stops(boxes({{{{30, 0, 0}, {34, 20, 64}}}, {{{30, 20, 0}, {34, 64, 64}}}}), 20, 30));
  EXPECT_TRUE(stops(boxes({{{{30, 0, 0}, {34, 24, 64}}}, {{{30, 20, 0}, {34, 64, 64}}}}), 20, 30)) << "or overlap";
  EXPECT_TRUE(stops(boxes({{{{30, 0, 0}, {34, 64, 64}}}, {{{30, 0, 0}, {34, 64, 64}}}}), 20, 30))
      << "or are twice there";
  const double crack = 0x1p-40;
  EXPECT_FALSE(stops(boxes({{{{30, 0, 0}, {34, 20, 64}}}, {{{30, 20 + crack, 0}, {34, 64, 64}}}}), 20, 30));
  EXPECT_FALSE(stops(boxes({{{{30, 0, 0}, {34, 20, 64}}}}), 20, 30)) << "half of a wall";
  EXPECT_FALSE(stops(boxes({{{{30, 0, 0}, {34, 20, 20}}},
                            {{{30, 20, 0}, {34, 64, 30}}},
                            {{{30, 10, 30}, {34, 64, 64}}},
                            {{{30, 0, 20}, {34, 10, 64}}}}),
                     15, 25))
      << "four around a hole";
}

// Prisms that meet along a plane, and are cut a third of the way along it: both have the same edge there, and no double has it.
TEST(Section, WallsThatAbutAskewAreOne) {
  const auto prism = [](double y0, double y1, double y2, double y3) {
    const std::array<Point, 8> p{Point{30, y0, 0}, {36, y1, 0},  {36, y2, 0},  {30, y3, 0},
                                 {30, y0, 64},     {36, y1, 64}, {36, y2, 64}, {30, y3, 64}};
    return *solids::solid_of({{p[0], p[1], p[2], p[3]},
                              {p[4], p[5], p[6], p[7]},
                              {p[0], p[1], p[5], p[4]},
                              {p[1], p[2], p[6], p[5]},
                              {p[2], p[3], p[7], p[6]},
                              {p[3], p[0], p[4], p[7]}});
  };
  const auto covers = [&](double gap) {
    const std::vector<Solid> both{prism(0, 0, 23, 16), prism(16 + gap, 23 + gap, 64, 64)};
    const solids::Section section({{1, 0, 0}, 32}, both, solids::Scale::of(about));
    EXPECT_EQ(section.polygons(), 2U);
    return is_covered(section, window(0, 18, 30), window(64, 18, 30));
  };
  EXPECT_TRUE(covers(0));
  EXPECT_FALSE(covers(0x1p-40));
}

// Shafts that end in the plane of a wall's side, on its inside: they touch the rim, and nothing passes there.
TEST(Section, AShaftMayTouchTheRim) {
  const auto wall = boxes({{{{30, 0, 0}, {34, 20, 64}}}});
  const solids::Section section({{1, 0, 0}, 32}, wall, solids::Scale::of(about));
  const auto beside = [](double x, double least, double most) {
    return std::vector<Point>{{x, least, 29}, {x, most, 29}, {x, most, 31}, {x, least, 31}};
  };
  EXPECT_TRUE(is_covered(section, beside(0, 18, 20), beside(64, 18, 20)));
  EXPECT_TRUE(is_covered(section, beside(0, 18, 20), beside(64, 16, 19)));
  const double crack = 0x1p-40;
  EXPECT_FALSE(is_covered(section, beside(0, 18, 20), beside(64, 18, 20 + crack)));
  EXPECT_FALSE(is_covered(section, beside(0, 18, 20 + crack), beside(64, 18, 20)));
  EXPECT_FALSE(is_covered(section, beside(0, 20, 22), beside(64, 20, 22))) << "on the other side";
  EXPECT_FALSE(is_covered(section, beside(0, 19, 21), beside(64, 19, 21)));
}

// Cut off the same box by a plane that no corner with doubles lies in.
TEST(Section, BrushesThatAbutAreOne) {
  const scene::HalfSpace askew{{mpq_class(1, 3), 1, mpq_class(1, 7)}, mpq_class(35)};
  const auto box = scene::box_polytope(scene::to_rational({30, 0, 0}), scene::to_rational({34, 64, 64}));
  const auto covers = [&](const mpq_class& gap) {
    scene::HalfSpace beyond = askew.opposite();
    beyond.offset -= gap;
    const auto both = solids::solids_of({*scene::intersection(box, askew), *scene::intersection(box, beyond)});
    EXPECT_FALSE(both[0].exact_corners.empty());
    const solids::Section section({{1, 0, 0}, 32}, both, solids::Scale::of(about));
    EXPECT_EQ(section.polygons(), 2U);
    return is_covered(section, window(0, 20, 30), window(64, 20, 30));
  };
  EXPECT_TRUE(covers(0));
  EXPECT_TRUE(covers(mpq_class(-1, 1000))) << "or overlap";
  EXPECT_FALSE(covers(mpq_class(1, mpz_class(1) << 80)));
}

TEST(Solid, OfAPolytopeIsExact) {
  const mpq_class third(1, 3);
  const auto brush = scene::intersection(scene::box_polytope({0, 0, 0}, {1, 1, 1}), {{1, 1, 0}, third});
  const auto solid = solids::solid_of_polytope(*brush);
  ASSERT_EQ(solid.corners.size(), 6U);
  EXPECT_EQ(solid.sides.size(), 5U);
  EXPECT_EQ(solid.edges.size(), 9U);
  EXPECT_LT(mpq_class(solid.bounds.low[0]), 0) << "no bound is within it";
  EXPECT_GT(mpq_class(solid.bounds.high[0]), third);
  for (std::size_t i = 0; i < solid.sides.size(); ++i) {
    for (std::uint32_t k = 0; k < solid.corners.size(); ++k) {
      const int side = solid.sides[i].side_of(solid.exact_corner(k));
      EXPECT_LE(side, 0);
      EXPECT_EQ(side == 0, std::binary_search(solid.on_side[i].begin(), solid.on_side[i].end(), k));
    }
    EXPECT_EQ(solid.sides[i].flat.has_value(),
              brush->faces[i].half_space.normal[0] == 0 || brush->faces[i].half_space.normal[1] == 0);
  }
  const auto sloped = std::find_if(solid.sides.begin(), solid.sides.end(), [](const auto& s) { return !s.flat; });
  ASSERT_NE(sloped, solid.sides.end());
  const double near = third.get_d();  // rounded down
  EXPECT_EQ(sloped->side_of(Point{near, 0, 0.5}), -1);
  EXPECT_EQ(sloped->side_of(Point{std::nextafter(near, 1.0), 0, 0.5}), 1);
}

// Its face abc is a needle, the normal of which doubles know to four digits: what is beside it was taken for what is behind it, so that its rim was passed over.
TEST(Shafts, APlaneOfANeedleIsKnownExactly) {
  const Point a{-0x1.8e98c18199bf7p+4, -0x1.50393ed6673e1p+4, -0x1.2d36b6074bbe2p+5},
      b{0x1.2eb4c383083fbp+5, 0x1.6d34f769c4d1dp+4, 0x1.51a13b46827d5p+4},
      c{0x1.2eb681c85e292p+5, 0x1.6d390ef1dfd7p+4, 0x1.51a2c543c1b84p+4},
      d{0x1.3f38d90290f6ep+4, 0x1.80ae9b5058aap+4, -0x1.b6dace3578fa7p+5};
  const std::array<Point, 3> seen{Point{0x1.2e792ac66f6b2p+5, 0x1.0a3191371f8dbp+5, 0x1.455eda4bb5882p+3},
                                  {0x1.07d06fb03faecp+5, 0x1.0520781a56db8p+5, -0x1.8cbc2411d573ap+2},
                                  {0x1.bf4ec518344e5p+4, 0x1.d223a42f8b784p+4, -0x1.5cc6d0a5e4a45p+3}};
  scene::FlaggedMeshBuilder builder;
  for (const auto& face : {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) builder.add(face, 0, {true, false});
  builder.add(seen, 0, {false, true});
  const Point v{0x1.1add8b05f74cap+5, 0x1.53f851eefb8p+3, 0x1.dafa5bdbf7289p+4};
  const double e = 0x1.7268p-39;
  const auto listed =
      solids::not_hidden(builder.take(), scene::corners_of({{v[0] - e, v[1] - e, v[2] - e}, {v[0], v[1], v[2]}}));
  EXPECT_EQ(listed, std::vector<std::uint32_t>{4});
}

TEST(Solid, OfSubnormalNumbersIsExact) {
  const double s = 0x1p-1074;
  const auto side = solids::side_along({scene::to_rational({0, 2 * s, s}), mpq_class(30 * s)});
  for (double y = 0; y < 16; ++y) {
    for (double z = 0; z < 31; ++z) {
      const double above = 2 * y + z - 30;
      EXPECT_EQ(side.side_of(Point{0, y, z}), above > 0 ? 1 : above < 0 ? -1 : 0);
    }
  }
}

TEST(Rim, IsThatOfRationals) {
  const Rims rims = compare_rims(1, 60);
  EXPECT_EQ(rims.differs, "");
  EXPECT_GT(rims.parts, 10'000U);
  EXPECT_GT(rims.numbered, 10'000U);
  EXPECT_GT(rims.estimated, 10'000U);
}

TEST(Rim, OfTurnsBeyondTheRangeOfDoublesIsExact) {
  const auto a = solids::exact_spot(-0x1.40d1d6cf7ebcp+451, -0x1.2b3b5d92f6p+460),
             b = solids::exact_spot(0x1.28b574dc43221p+510, 0x1.ea12c0772a938p+518),
             c = solids::exact_spot(0x1.0b74328c6f229p+505, 0x1.b9c0c2a525a7cp+513);
  EXPECT_EQ(solids::sign_of_turn(a, b, c), -1) << "a product is infinite, and what is subtracted from it is not";
}

// Over a quadrangle, counter-clockwise; the third coordinate is from -1 to 1, and the second one is that of the quadrangle and so many times the third.
Solid sheared_prism(const std::array<std::array<mpq_class, 2>, 4>& base, const mpq_class& lean) {
  scene::Polytope prism;
  for (const int z : {-1, 1}) {
    for (const auto& p : base) prism.vertices.push_back({p[0], mpq_class(p[1] + z * lean), mpq_class(z)});
  }
  const auto add = [&](const std::vector<std::uint32_t>& ids) {
    auto plane = scene::plane_through(prism.vertices[ids[0]], prism.vertices[ids[1]], prism.vertices[ids[2]]).value();
    if (!std::all_of(prism.vertices.begin(), prism.vertices.end(),
                     [&](const auto& v) { return sgn(plane.height(v)) <= 0; }))
      plane = plane.opposite();
    prism.faces.push_back({plane, ids});
  };
  add({0, 1, 2, 3});
  add({4, 5, 6, 7});
  for (std::uint32_t i = 0; i < 4; ++i) add({i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
  return solids::solid_of_polytope(prism);
}

// Two prisms on one side of a line that is not upright by less than doubles know: neither is beyond it, where the other one is.
TEST(FilledPlane, KnowsCoordinatesThatAreTooSmallForDoubles) {
  for (const int power : {100, 1060, 1080}) {
    mpq_class e;
    mpq_div_2exp(e.get_mpq_t(), mpq_class(1).get_mpq_t(), static_cast<mp_bitcnt_t>(power));
    const mpq_class third(1, 3), half(1, 2), low(13, 30), high(37, 30);
    const std::vector<Solid> walls{sheared_prism({{{e, third}, {1, third}, {1, 4 * third}, {0, 4 * third}}}, third),
                                   sheared_prism({{{e * 9 / 10, low}, {half, low}, {half, high}, {e / 10, high}}}, 0)};
    const solids::FilledPlane plane({2, 0, true}, walls);
    EXPECT_FALSE(plane.fills({{-0.375, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 1, 0}, {-0.375, 1, 0}})) << power;
    EXPECT_TRUE(plane.fills({{0x1p-20, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 1, 0}, {0x1p-20, 1, 0}})) << power;
  }
}

TEST(FilledPlane, KnowsWhereAFacetIsOpen) {
  // A wall behind x = 10 with a door in it.
  const auto walls = boxes({{{{10, 0, 0}, {12, 8, 16}}}, {{{10, 12, 0}, {12, 20, 16}}}, {{{10, 8, 6}, {12, 12, 16}}}});
  const solids::FilledPlane plane({0, 10, true}, walls);
  const auto facet = [](double y0, double y1, double z1) {
    return std::vector<Point>{{10, y0, 0}, {10, y1, 0}, {10, y1, z1}, {10, y0, z1}};
  };
  EXPECT_TRUE(plane.open_parts(facet(0, 8, 16), 0.5).empty()) << "exactly the wall";
  EXPECT_TRUE(plane.fills(facet(0, 8, 16)));
  const auto open = plane.open_parts(facet(0, 20, 16), 0.5);
  ASSERT_FALSE(open.empty());
  double area = 0;
  for (const auto& part : open) {
    const Bounds box = scene::bounds_of(part.corners);
    EXPECT_EQ(box.low[0], 10);
    EXPECT_EQ(box.high[0], 10);
    area += (box.high[1] - box.low[1]) * (box.high[2] - box.low[2]);
  }
  EXPECT_GE(area, 4 * 6);
  EXPECT_LE(area, 2 * 4 * 6);
  EXPECT_FALSE(plane.fills(facet(0, 20, 16)));
  EXPECT_FALSE(plane.fills(facet(0, 8 + 0x1p-40, 16)));
  // Seen from the other side these solids are not behind the plane.
  EXPECT_FALSE(solids::FilledPlane({0, 10, false}, walls).fills(facet(0, 8, 16)));
}

std::vector<std::uint32_t> listed_of(const scene::FlaggedMesh& scene, std::vector<Solid> walls,
                                     const std::vector<Point>& cell) {
  const solids::Solids all(std::move(walls), solids::bounds_of_questions(scene, {cell}));
  return solids::not_hidden(all, solids::Targets(scene, all), cell);
}

// The upper face is bent outwards along a diagonal. A triangle in the plane of one half, over the other, is out of the solid.
TEST(Solid, HasASideForEachPartOfABentFace) {
  const std::vector<Face> faces{
      {{4, 0, 4}, {4, 4, 2}, {0, 4, 4}, {0, 0, 4}}, {{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}},
      {{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}}, {{4, 0, 0}, {4, 4, 0}, {4, 4, 2}, {4, 0, 4}},
      {{4, 4, 0}, {0, 4, 0}, {0, 4, 4}, {4, 4, 2}}, {{0, 4, 0}, {0, 0, 0}, {0, 0, 4}, {0, 4, 4}}};
  const auto solid = solids::solid_of(faces);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->sides.size(), 7U);
  EXPECT_EQ(solid->edges.size(), 13U);
  scene::FlaggedMeshBuilder builder;
  builder.add({Point{0, 0, 6}, {4, 0, 4}, {0, 4, 4}}, 0, {});
  EXPECT_EQ(
      listed_of(builder.take(), {*solid}, {{.25, .25, 4.25}, {1.25, .25, 4.25}, {.25, 1.25, 4.25}, {.25, .25, 4.75}}),
      std::vector<std::uint32_t>{0});
}

// So thin that its normal is lost in doubles: on which side of it the boxes are has to be decided exactly.
TEST(Shafts, AThinTriangleOnAFloorIsSeenFromAbove) {
  const Point a{-97.590556144714355, -127.53261184692383, 0}, b{35.315532684326172, 46.150800704956055, 0},
      c{62.275025367736816, 81.381817817687988, 0};
  scene::FlaggedMeshBuilder builder;
  for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}, std::array{a, c, b},
                                std::array{c, b, a}, std::array{b, a, c}})
    builder.add({p, q, r}, 0, {});
  const auto scene = builder.take();
  const auto floor = boxes({{{{-256, -256, -8}, {.125, 256, 0}}}, {{{.125, -256, -8}, {256, 256, 0}}}});
  EXPECT_EQ(listed_of(scene, floor, scene::corners_of({{10, 10, 4}, {20, 20, 8}})).size(), 6U);
  EXPECT_TRUE(listed_of(scene, floor, scene::corners_of({{10, 10, -20}, {20, 20, -12}})).empty());
}

// What products of its coordinates underflow to is no proof of anything.
TEST(Shafts, ATinyTriangleInTheOpenIsSeen) {
  scene::FlaggedMeshBuilder builder;
  const auto at = [](double x, double y) { return Point{std::ldexp(x, -541), std::ldexp(y, -541), 0}; };
  builder.add({at(23, 25), at(28, 11), at(33, 31)}, 0, {});
  EXPECT_EQ(listed_of(builder.take(), {}, scene::corners_of({{-1, -1, 1}, {1, 1, 2}})), std::vector<std::uint32_t>{0});
}

// Sides without a normal make no planes.
TEST(Shafts, SolidsThatAreTooThinForDoublesAreLeftOut) {
  scene::FlaggedMeshBuilder builder;
  builder.add({Point{12, -1, -1}, {12, 1, -1}, {12, 0, 1}}, 0, {});
  const auto scene = builder.take();
  const auto cell = scene::corners_of({{-4, -1, -1}, {-2, 1, 1}});
  const double s = 0x1p-20, large = 0x1p27;
  const std::array<Point, 3> floor{Point{0, 0, 0}, {(large + 1) * s, large * s, 0}, {large * s, (large - 1) * s, 0}};
  std::array<Point, 3> roof = floor;
  for (auto& p : roof) p[2] = 1;
  const auto thin = solids::solid_of({{floor[0], floor[1], floor[2]},
                                      {roof[0], roof[1], roof[2]},
                                      {floor[0], floor[1], roof[1], roof[0]},
                                      {floor[1], floor[2], roof[2], roof[1]},
                                      {floor[2], floor[0], roof[0], roof[2]}});
  ASSERT_TRUE(thin);
  for (const Solid& first : {*thin, boxes({{{{0, 0, 0}, {1e-170, 1e-170, 1e-170}}}})[0]}) {
    std::vector<Solid> walls = boxes({{{{4, -16, -16}, {8, 16, 16}}}});
    walls.insert(walls.begin(), first);
    EXPECT_TRUE(listed_of(scene, walls, cell).empty()) << "it is behind the wall";
  }
}

// A room that is walled in: its openings are none, and yet what touches it is seen.
TEST(Shafts, WhatMeetsTheCellIsListed) {
  scene::FlaggedMeshBuilder builder;
  const auto walls = boxes({{{{0, 0, 0}, {1, 10, 10}}},
                            {{{9, 0, 0}, {10, 10, 10}}},
                            {{{1, 0, 0}, {9, 1, 10}}},
                            {{{1, 9, 0}, {9, 10, 10}}},
                            {{{1, 1, 0}, {9, 9, 1}}},
                            {{{1, 1, 9}, {9, 9, 10}}}});
  builder.add({Point{1, 2, 2}, {1, 8, 2}, {1, 2, 8}}, 0, {});     // on a wall of the room
  builder.add({Point{4, 4, 4}, {5, 4, 4}, {4, 5, 4}}, 1, {});     // in the room
  builder.add({Point{0, 2, 2}, {0, 8, 2}, {0, 2, 8}}, 2, {});     // on the far side of that wall
  builder.add({Point{20, 0, 0}, {20, 9, 0}, {20, 0, 9}}, 3, {});  // outside
  const auto scene = builder.take();
  const auto cell = scene::corners_of({{1, 1, 1}, {9, 9, 9}});
  const solids::Solids all(walls, solids::bounds_of_questions(scene, {cell}));
  EXPECT_EQ(solids::not_hidden(all, solids::Targets(scene, all), cell), (std::vector<std::uint32_t>{0, 1}));
  // Seen from within the wall nothing is hidden by it, but by others.
  const auto in_wall = scene::corners_of({{0.25, 4, 4}, {0.75, 6, 6}});
  const auto seen = solids::not_hidden(all, solids::Targets(scene, all), in_wall);
  EXPECT_TRUE(std::binary_search(seen.begin(), seen.end(), 0U));
  EXPECT_TRUE(std::binary_search(seen.begin(), seen.end(), 2U));
}

TEST(Shafts, NothingThatASightLineReachesIsHidden) {
  const Looked looked = look_for_what_is_hidden(1, 150, 150);
  EXPECT_EQ(looked.seen, "");
  EXPECT_GT(looked.hidden, 1000U);
  std::cout << looked.hidden << " hidden triangles, " << looked.lines << " sight lines\n";
}

TEST(ShaftsLong, NothingThatASightLineReachesIsHidden) {
  const Looked looked = look_for_what_is_hidden(1'000, 3'000, 200);
  EXPECT_EQ(looked.seen, "");
  std::cout << looked.hidden << " hidden triangles, " << looked.lines << " sight lines\n";
}

}  // namespace
}  // namespace clues::tests
