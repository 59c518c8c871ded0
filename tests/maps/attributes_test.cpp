// Texture coordinates and colours: read as files have them, and carried by the map.
#include "scene/multires/attributes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "fuzz/multires/surfaces.h"
#include "reference/multires/carried.h"
#include "reference/multires/hierarchy.h"
#include "scene/files/atomic_file.h"
#include "scene/files/temporary_folder.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "tests/maps/hierarchy_over.h"

namespace clues {
namespace {

scene::MeshAttributes read(const std::string& name, const std::string& text) {
  const scene::TemporaryFolder folder;
  scene::write_file_atomically(folder.file(name), text);
  return scene::read_attributes(folder.path() / name, scene::read_mesh(folder.path() / name));
}

TEST(Attributes, OfObjFollowFansAndLeftOutFaces) {
  const auto got =
      read("a.obj",
           "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 .5 .5 .5\nvt 0 0\nvt 1 0 0\nvt 1 1\nvt .25\n"
           "f 1 2\nf 1/1 2/2 3/3 4/-1\nf 1//1 3//1 2//1\n");
  ASSERT_EQ(got.texture_corners.size(), 3U);
  EXPECT_EQ(got.texture_corners[0], (scene::Triangle{0, 1, 2}));
  EXPECT_EQ(got.texture_corners[1], (scene::Triangle{0, 2, 3}));
  EXPECT_EQ(got.texture_corners[2][0], scene::no_vertex);
  EXPECT_EQ(got.texture[3], (std::array<double, 2>{0.25, 0}));
  ASSERT_EQ(got.colours.size(), 4U);
  EXPECT_EQ(got.colours[1], (std::array<double, 3>{0, 1, 0}));
  EXPECT_TRUE(read("a.obj", "v 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").colours.empty());
  EXPECT_TRUE(read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1 2 3\n").texture_corners.empty());
}

TEST(Attributes, OfPlyAreThoseOfVerticesOrCorners) {
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const auto coloured =
      read("a.ply", vertices +
                        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar "
                        "alpha\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar int "
                        "vertex_indices\nend_header\n0 0 0 255 0 0 9 .5 .25\n1 0 0 0 51 0 9 0 1\n1 1 0 0 0 255 9 1 1\n"
                        "3 0 1 2\n");
  ASSERT_EQ(coloured.colours.size(), 3U);
  EXPECT_EQ(coloured.colours[1][1], 0.2);
  ASSERT_EQ(coloured.texture_corners.size(), 1U);
  EXPECT_EQ(coloured.texture[0], (std::array<double, 2>{0.5, 0.25}));
  const auto wedges =
      read("a.ply", vertices +
                        "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float "
                        "texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2 6 0 0 1 0 1 1\n");
  ASSERT_EQ(wedges.texture_corners.size(), 1U);
  EXPECT_EQ(wedges.texture[2], (std::array<double, 2>{1, 1}));
}

TEST(Attributes, ThatAreWrongAreRefused) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THROW(read("a.obj", mesh + "vt 0 0\nf 1/1 2/2 3/1\n"), scene::Error);
  EXPECT_THROW(read("a.obj", mesh + "vt 0 0\nf 1/1 2/-2 3/1\n"), scene::Error);
  EXPECT_THROW(read("a.obj", mesh + "vt 0 0\nf 1/0 2/1 3/1\n"), scene::Error);
  EXPECT_THROW(read("a.obj", mesh + "vt nan 0\nf 1/1 2/1 3/1\n"), scene::Error);
}

// Somebody writes the file between the two readings: corners must not name vertices that are gone.
TEST(Attributes, OfAFileThatChangedMeanwhileAreRefused) {
  const auto ply = [](int vertices, const std::string& properties, const std::string& values) {
    std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\n", vertices);
    text += "property float x\nproperty float y\nproperty float z\n" + properties;
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < vertices; ++i) text += fmt::format("{} {} 0 {}\n", i, i * i, values);
    return text + "3 0 1 2\n";
  };
  const scene::TemporaryFolder folder;
  const auto path = folder.path() / "a.ply";
  for (const auto& [properties, values] :
       {std::pair<std::string, std::string>("property float s\nproperty float t\n", ".5 .25"),
        std::pair<std::string, std::string>("property uchar red\nproperty uchar green\nproperty uchar blue\n",
                                            "1 2 3")}) {
    scene::write_file_atomically(path, ply(3, properties, values));
    const auto mesh = scene::read_mesh(path);
    EXPECT_NO_THROW(scene::read_attributes(path, mesh));
    scene::write_file_atomically(path, ply(2, properties, values));
    EXPECT_THROW(scene::read_attributes(path, mesh), scene::Error) << properties;
  }
  scene::write_file_atomically(folder.path() / "a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nf 1 2 3\n");
  const auto mesh = scene::read_mesh(folder.path() / "a.obj");
  scene::write_file_atomically(folder.path() / "a.obj", "v 0 0 0 1 0 0\n");
  EXPECT_THROW(scene::read_attributes(folder.path() / "a.obj", mesh), scene::Error);
}

reference::Remesh remeshed(const scene::TriangleMesh& mesh, int level) {
  reference::RemeshOptions how;
  how.level = level;
  return reference::remeshed(test::hierarchy_over(mesh, 12), how);
}

// What is linear on the input stays the same function of the place: colour and texture are the coordinates.
TEST(CarriedAttributes, AreThoseOfThePoint) {
  const auto mesh = fuzz::ball(5);
  scene::MeshAttributes from;
  for (const auto& p : mesh.points) {
    from.colours.push_back(p);
    from.texture.push_back({p[0], p[1]});
  }
  from.texture_corners = mesh.triangles;
  const auto remesh = remeshed(mesh, 2);
  const auto got = reference::carried(remesh, mesh, from);
  EXPECT_EQ(got.across_seams, 0U);
  ASSERT_EQ(got.attributes.colours.size(), remesh.mesh.points.size());
  EXPECT_EQ(got.attributes.texture.size(), remesh.mesh.points.size());
  for (std::size_t v = 0; v < remesh.mesh.points.size(); ++v) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got.attributes.colours[v][i], remesh.mesh.points[v][i], 0x1p-50);
  }
  for (std::size_t t = 0; t < remesh.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& at = got.attributes.texture[got.attributes.texture_corners[t][k]];
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(at[i], remesh.mesh.points[remesh.mesh.triangles[t][k]][i], 0x1p-50);
    }
  }
}

// A texture that begins anew at each triangle of a sheet: corners get the value of a triangle that they touch, and jumps are counted.
TEST(CarriedAttributes, HaveSidesAtSeams) {
  const auto mesh = fuzz::sheet(4);
  scene::MeshAttributes from;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(from.texture.size());
    for (int k = 0; k < 3; ++k) from.texture.push_back({double(t), 0});
    from.texture_corners.push_back({first, first + 1, first + 2});
  }
  from.texture_corners[5] = {scene::no_vertex, scene::no_vertex, scene::no_vertex};
  const auto remesh = remeshed(mesh, 1);
  const auto got = reference::carried(remesh, mesh, from);
  EXPECT_GT(got.across_seams, 0U);
  std::size_t without = 0;
  for (std::size_t t = 0; t < remesh.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t number = got.attributes.texture_corners[t][k];
      if (number == scene::no_vertex) {
        ++without;
        continue;
      }
      const auto in = static_cast<std::size_t>(got.attributes.texture[number][0]);
      const auto& source = remesh.sources[remesh.mesh.triangles[t][k]];
      std::int64_t weight = 0;
      for (const std::uint32_t v : mesh.triangles[in]) weight += source.weight_of(v);
      EXPECT_EQ(weight, scene::whole_weight) << t;
    }
  }
  EXPECT_EQ(without % 3, 0U);
}

}  // namespace
}  // namespace clues
