// Reads and checks an IBSP 46 file. Nothing here interprets; whatever the other files of this folder index has been looked at here.
#include "scene/levels/bsp_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/formats/place.h"
#include "scene/levels/entities.h"

namespace clues::scene {
namespace {

constexpr std::uint32_t version = 46;
constexpr std::uint64_t most_drawn = std::uint64_t{1}
                                     << 24;  // faces may share vertices: a few bytes can ask for any number
// Brushes may share sides, and each cuts what those before it left. Compilers allow a brush 1024.
constexpr std::uint64_t most_sides_of_brush = 1024, most_sides = std::uint64_t{1} << 20;
constexpr std::size_t lump_count = 17, header_size = 8 + 8 * lump_count;

enum LumpId : std::size_t {
  entities_lump = 0,
  shaders_lump = 1,
  planes_lump = 2,
  nodes_lump = 3,
  leaves_lump = 4,
  leaf_faces_lump = 5,
  models_lump = 7,
  brushes_lump = 8,
  sides_lump = 9,
  points_lump = 10,
  corners_lump = 11,
  faces_lump = 13,
  visibility_lump = 16,
};

struct LumpKind {
  const char* name;
  std::size_t record;  // bytes
};
constexpr std::array<LumpKind, lump_count> lump_kinds{{{"entities", 1},
                                                       {"shaders", 72},
                                                       {"planes", 16},
                                                       {"nodes", 36},
                                                       {"leaves", 48},
                                                       {"leaf faces", 4},
                                                       {"leaf brushes", 4},
                                                       {"models", 40},
                                                       {"brushes", 12},
                                                       {"brush sides", 8},
                                                       {"vertices", 44},
                                                       {"mesh vertices", 4},
                                                       {"effects", 72},
                                                       {"faces", 104},
                                                       {"lightmaps", 1},
                                                       {"light grid", 1},
                                                       {"visibility", 1}}};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

// One record of a lump; words count in units of four bytes.
class Record {
 public:
  Record(std::string_view bytes, const Place& place) : bytes_(bytes), place_(place) {}

  const Place& place() const { return place_; }
  std::string_view bytes() const { return bytes_; }
  std::uint32_t bits(std::size_t word) const { return word_at(bytes_, 4 * word); }
  std::int32_t number(std::size_t word) const { return static_cast<std::int32_t>(bits(word)); }
  double real(std::size_t word, const char* what) const {
    const float x = std::bit_cast<float>(bits(word));
    if (!std::isfinite(x))
      fail_at(place_, ErrorCode::non_finite, fmt::format("{} is no finite number; compile the level again", what));
    return x;
  }
  Point point(std::size_t word, const char* what) const {
    return {real(word, what), real(word + 1, what), real(word + 2, what)};
  }
  std::uint32_t index(std::size_t word, const char* what, std::size_t count) const {
    const std::int64_t i = number(word);
    if (i < 0 || i >= static_cast<std::int64_t>(count)) fail_index(what, i, count);
    return static_cast<std::uint32_t>(i);
  }
  // First and count, in words that follow one another unless told.
  BspFile::Range range(std::size_t word, std::size_t count_word, const char* what, std::size_t count) const {
    const std::int64_t first = number(word), n = number(count_word);
    if (n == 0) return {};
    if (first < 0 || n < 0 || first + n > static_cast<std::int64_t>(count)) {
      fail_at(place_, ErrorCode::index_out_of_range,
              fmt::format("{0} {1} to {2} do not exist: the file has {3}; compile the level again", what, first,
                          first + n - 1, count));
    }
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(n)};
  }
  [[noreturn]] void fail_index(const char* what, std::int64_t i, std::size_t count) const {
    fail_at(place_, ErrorCode::index_out_of_range,
            fmt::format("{} {} does not exist: the file has {}; compile the level again", what, i, count));
  }
  [[noreturn]] void fail(const std::string& what) const {
    fail_at(place_, ErrorCode::malformed, what + "; compile the level again");
  }

 private:
  std::string_view bytes_;
  Place place_;
};

class Parser {
 public:
  Parser(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) { level_.name = file; }

  BspFile parse() {
    read_header();
    read_shaders();
    read_planes();
    read_points();
    read_faces();
    read_brushes();
    read_models();
    read_tree();
    check_tree();
    read_visibility();
    level_.far_plane = far_plane_in(lumps_[entities_lump]);
    return std::move(level_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_in(file_, ErrorCode::malformed, what); }

  void read_header() {
    if (!bytes_.starts_with("IBSP")) fail("does not begin with IBSP; is it a level of the Quake 3 family?");
    if (bytes_.size() < header_size)
      fail(fmt::format("ends within its header, after {} bytes; copy it again", bytes_.size()));
    if (const auto v = word_at(bytes_, 4); v != version) {
      fail_in(file_, ErrorCode::unsupported,
              fmt::format("is an IBSP level of version {}; only version {} (Quake 3) is read", v, version));
    }
    std::vector<std::array<std::size_t, 3>> used{{0, header_size, lump_count}};
    for (std::size_t i = 0; i < lump_count; ++i) {
      const auto& [name, record] = lump_kinds[i];
      const std::size_t first = word_at(bytes_, 8 + 8 * i), size = word_at(bytes_, 12 + 8 * i);
      if (size == 0) continue;
      if (first > bytes_.size() || size > bytes_.size() - first) {
        fail(fmt::format("the lump of {} ({} bytes from {}) reaches past the end of the file ({} bytes); copy it again",
                         name, size, first, bytes_.size()));
      }
      if (size % record != 0)
        fail(fmt::format("the lump of {} has {} bytes, which is no multiple of {}; compile the level again", name, size,
                         record));
      lumps_[i] = bytes_.substr(first, size);
      used.push_back({first, first + size, i});
    }
    std::sort(used.begin(), used.end());
    for (std::size_t i = 1; i < used.size(); ++i) {
      if (used[i][0] >= used[i - 1][1]) continue;
      const auto name = [&](std::size_t lump) {
        return lump == lump_count ? std::string("the header") : fmt::format("the lump of {}", lump_kinds[lump].name);
      };
      fail(fmt::format("{} and {} overlap; compile the level again", name(used[i - 1][2]), name(used[i][2])));
    }
  }

  std::size_t count(LumpId lump) const { return lumps_[lump].size() / lump_kinds[lump].record; }

  template <class Use>
  void each(LumpId lump, const char* item, const Use& use) const {
    const std::size_t size = lump_kinds[lump].record;
    for (std::size_t i = 0; i < count(lump); ++i) use(Record(lumps_[lump].substr(i * size, size), {file_, item, i}));
  }

  void read_shaders() {
    each(shaders_lump, "shader", [&](const Record& r) {
      const auto name = r.bytes().substr(0, 64);
      level_.shaders.push_back({std::string(name.substr(0, name.find('\0'))), r.bits(16), r.bits(17)});
    });
  }

  void read_planes() {
    each(planes_lump, "plane", [&](const Record& r) {
      BspFile::Plane plane{r.point(0, "the normal"), r.real(3, "the distance")};
      if (plane.normal == Point{0, 0, 0}) r.fail("the normal is zero");
      level_.planes.push_back(plane);
    });
  }

  void read_points() {
    each(points_lump, "vertex", [&](const Record& r) { level_.points.push_back(r.point(0, "a coordinate")); });
    each(corners_lump, "mesh vertex", [&](const Record& r) { level_.corners.push_back(r.bits(0)); });
  }

  void read_faces() {
    std::uint64_t drawn = 0;
    each(faces_lump, "face", [&](const Record& r) {
      BspFile::Face face;
      face.shader = r.index(0, "the shader", level_.shaders.size());
      const auto kind = r.number(2);
      if (kind < 1 || kind > 4) r.fail(fmt::format("its type is {}, and not 1 to 4", kind));
      face.kind = static_cast<BspFile::Kind>(kind);
      face.vertices = r.range(3, 4, "vertices", level_.points.size());
      face.corners = r.range(5, 6, "mesh vertices", level_.corners.size());
      drawn += face.vertices.count + face.corners.count;
      if (drawn > most_drawn)
        fail_at(r.place(), ErrorCode::unsupported,
                fmt::format("with it more than {} vertices are drawn; no level has so many", most_drawn));
      if (face.kind == BspFile::Kind::patch) {
        check_patch(r, face);
      } else {
        check_corners(r, face);
      }
      level_.faces.push_back(face);
    });
  }

  void check_patch(const Record& r, BspFile::Face& face) const {
    const std::int64_t columns = r.number(24), rows = r.number(25);
    if (columns < 3 || rows < 3 || columns % 2 == 0 || rows % 2 == 0 ||
        columns > static_cast<std::int64_t>(face.vertices.count) || columns * rows != face.vertices.count) {
      r.fail(fmt::format(
          "a patch of {} x {} control points, with {} vertices; both are odd, 3 or more, and multiply to the vertices",
          columns, rows, face.vertices.count));
    }
    face.controls = {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
  }

  void check_corners(const Record& r, const BspFile::Face& face) const {
    if (face.corners.count % 3 != 0)
      r.fail(fmt::format("it has {} corners of triangles, which is no multiple of 3", face.corners.count));
    for (std::uint32_t i = 0; i < face.corners.count; ++i) {
      const auto corner = level_.corners[face.corners.first + i];
      if (corner >= face.vertices.count) r.fail_index("vertex", static_cast<std::int32_t>(corner), face.vertices.count);
    }
  }

  void read_brushes() {
    each(sides_lump, "brush side", [&](const Record& r) {
      level_.sides.push_back(
          {r.index(0, "the plane", level_.planes.size()), r.index(1, "the shader", level_.shaders.size())});
    });
    std::uint64_t sides = 0;
    each(brushes_lump, "brush", [&](const Record& r) {
      level_.brushes.push_back(
          {r.range(0, 1, "brush sides", level_.sides.size()), r.index(2, "the shader", level_.shaders.size())});
      const std::uint64_t own = level_.brushes.back().sides.count;
      sides += own;
      if (own > most_sides_of_brush || sides > most_sides) {
        fail_at(r.place(), ErrorCode::unsupported,
                fmt::format("it has {} sides, and the brushes up to it {}; at most {} and {} are read", own, sides,
                            most_sides_of_brush, most_sides));
      }
    });
  }

  void read_models() {
    each(models_lump, "model", [&](const Record& r) {
      BspFile::Model model{r.point(0, "a bound"), r.point(3, "a bound"), r.range(6, 7, "faces", level_.faces.size()),
                           r.range(8, 9, "brushes", level_.brushes.size())};
      level_.models.push_back(model);
    });
    if (level_.models.empty()) fail("has no model; the first is the world itself: compile the level again");
    const Point &low = level_.models[0].low, &high = level_.models[0].high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (low[axis] >= high[axis])
        fail(fmt::format("the world is empty or inverted on axis {}; compile the level again", "xyz"[axis]));
    }
  }

  void read_tree() {
    each(leaf_faces_lump, "leaf face",
         [&](const Record& r) { level_.leaf_faces.push_back(r.index(0, "the face", level_.faces.size())); });
    each(leaves_lump, "leaf", [&](const Record& r) {
      BspFile::Leaf leaf{r.number(0), r.range(8, 9, "leaf faces", level_.leaf_faces.size())};
      if (leaf.cluster < -1) r.fail(fmt::format("its cluster is {}", leaf.cluster));
      level_.leaves.push_back(leaf);
    });
    each(nodes_lump, "node", [&](const Record& r) {
      BspFile::Node node{r.index(0, "the plane", level_.planes.size()), {r.number(1), r.number(2)}};
      for (const std::int64_t child : node.children) {
        if (child >= 0 ? child >= static_cast<std::int64_t>(count(nodes_lump))
                       : -1 - child >= static_cast<std::int64_t>(level_.leaves.size())) {
          r.fail_index(child >= 0 ? "node" : "leaf", child >= 0 ? child : -1 - child,
                       child >= 0 ? count(nodes_lump) : level_.leaves.size());
        }
      }
      level_.nodes.push_back(node);
    });
    if (level_.nodes.empty()) fail("has no BSP tree (no nodes); compile the level again");
  }

  // From the root every node and leaf is reached once or not at all (those of models that move are not).
  void check_tree() {
    std::vector<bool> node_seen(level_.nodes.size()), leaf_seen(level_.leaves.size());
    std::vector<std::int32_t> open{0};
    while (!open.empty()) {
      const std::int32_t at = open.back();
      open.pop_back();
      const std::size_t place = static_cast<std::size_t>(at >= 0 ? at : -1 - at);
      auto& seen = at >= 0 ? node_seen : leaf_seen;
      if (seen[place]) {
        fail_at({file_, at >= 0 ? "node" : "leaf", place}, ErrorCode::malformed,
                "the BSP tree reaches it twice; compile the level again");
      }
      seen[place] = true;
      if (at < 0) {
        level_.leaves_of_tree.push_back(static_cast<std::uint32_t>(place));
        continue;
      }
      open.push_back(level_.nodes[place].children[1]);
      open.push_back(level_.nodes[place].children[0]);
    }
  }

  void read_visibility() {
    std::int64_t clusters = 0;
    for (const auto i : level_.leaves_of_tree)
      clusters = std::max<std::int64_t>(clusters, level_.leaves[i].cluster + std::int64_t{1});
    const std::string_view lump = lumps_[visibility_lump];
    if (lump.empty()) {
      if (clusters > static_cast<std::int64_t>(level_.leaves.size()))
        fail(fmt::format("cluster {} in a level of {} leaves; compile the level again", clusters - 1,
                         level_.leaves.size()));
      level_.visibility.clusters = static_cast<std::uint32_t>(clusters);
      return;
    }
    const std::uint64_t rows = lump.size() < 8 ? 0 : word_at(lump, 0), row = lump.size() < 8 ? 0 : word_at(lump, 4);
    if (lump.size() < 8 || row > lump.size() || rows > lump.size() * 8 || 8 + rows * row != lump.size()) {
      fail(fmt::format(
          "the visibility of {} clusters of {} bytes does not fit its lump of {} bytes; compile the level again", rows,
          row, lump.size()));
    }
    if (row * 8 < rows)
      fail(fmt::format("the visibility has {} bytes for {} clusters; compile the level again", row, rows));
    if (clusters > static_cast<std::int64_t>(rows))
      fail(fmt::format("cluster {} has no visibility: the file has {} clusters; compile the level again", clusters - 1,
                       rows));
    level_.visibility = {static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(row),
                         std::string(lump.substr(8))};
  }

  std::string_view bytes_;
  const std::string& file_;
  std::array<std::string_view, lump_count> lumps_;
  BspFile level_;
};

}  // namespace

bool BspFile::sees(std::uint32_t from_cluster, std::uint32_t cluster) const {
  if (visibility.bits.empty()) return true;
  const std::size_t at = std::size_t{from_cluster} * visibility.row_bytes + cluster / 8;
  return (static_cast<unsigned char>(visibility.bits[at]) >> (cluster % 8) & 1) != 0;
}

BspFile parse_bsp(std::string_view bytes, const std::string& file) { return Parser(bytes, file).parse(); }

}  // namespace clues::scene
