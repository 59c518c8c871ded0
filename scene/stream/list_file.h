// D26, FIG. 52: a file of lists, "clues-lists 1" (docs/delta.md): the cells of a level, and what each lists, within what
// larger cells list. No geometry is in it but the corners of cells: triangles and edges are numbers, those of the scene.
// What a record means is in reference/streams/list_store.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// How a list is said. `known` is the list of the place around it, all triangles of the scene where there is none.
struct ListRecord {
  enum class Kind : std::uint8_t {
    list,     // `first`: the triangles
    all,      // those of `known`
    goes,     // `first`: the triangles of `known` that are not in it
    contour,  // `first`: seeds, `second`: boundary edges within `known`
    same,     // the list of place `of`, which lies in the same one
    changed,  // the contour of place `of`, in which these seeds and edges are other way round: there, or not there
    delta,    // the list of place `of` with triangles `first`, and without triangles `second`
  };
  static constexpr std::uint64_t kinds = 7;

  Kind kind = Kind::list;
  std::uint32_t of = 0;                      // an earlier place of the level
  std::vector<std::uint32_t> first, second;  // ascending

  friend bool operator==(const ListRecord&, const ListRecord&) = default;
};

// A node of the hierarchy, or a cell.
struct ListPlace {
  std::uint32_t within = 0;  // of the next level above; 0 on the first
  ListRecord record;

  friend bool operator==(const ListPlace&, const ListPlace&) = default;
};

struct ListedCell {
  std::string name;
  std::vector<Point> points, inner;  // W_out, and W_in where it is another (D23)

  friend bool operator==(const ListedCell&, const ListedCell&) = default;
};

struct ListFile {
  std::string scene_sha256;  // 64 hex digits
  std::uint64_t scene_triangles = 0;
  std::string question;  // of the bake
  std::vector<ListedCell> cells;
  std::vector<std::vector<ListPlace>> levels;  // from the coarsest; the last has a place for each cell

  friend bool operator==(const ListFile&, const ListFile&) = default;
};

bool has_of(ListRecord::Kind kind);      // same, changed, delta
bool has_first(ListRecord::Kind kind);   // all but `all` and `same`
bool has_second(ListRecord::Kind kind);  // contour, changed, delta

// What the record of this place takes.
std::string record_bytes(const ListRecord& record, std::uint32_t place);

std::string to_bytes(const ListFile& file);
// Throws Error malformed, non_finite; unsupported for another version. O(size) time and memory. The hash is looked at
// first, but for the second, which is for the coverage-guided target.
ListFile parse_lists(std::string_view bytes, const std::string& where);
ListFile parse_unsealed_lists(std::string_view bytes, const std::string& where);
ListFile read_lists(const std::filesystem::path& path);

}  // namespace clues::scene
