// The store of `clues bake`: one SQLite file with the cells of a scene, a tree over them, and for each its list. docs/bakes.md has the tables.
// While a bake runs the file holds what is finished, and the next run goes on from there; a finished one is made anew from it, row by row, so that its bytes do not
// tell in which order and by how many runs it came about.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"
#include "scene/stores/database.h"

namespace clues::scene {

// What is asked of a node of the tree or of a cell.
struct BakePlace {
  std::string name;           // of a cell; none for a node
  std::uint32_t node = 0;     // in whose list it is mapped; 0: in the scene
  std::vector<Point> points;  // their hull is the cell that is mapped (W_out); none: a node that is not mapped
  std::vector<Point> inner;   // W_in, where the cell has one of its own; none: the same
  std::int64_t group = -1;    // the cluster of a leaf
};

struct BakedPlace {
  std::vector<std::uint32_t>
      list;  // of a cell: triangles that count and may be visible; of a node: all in which those below it are mapped
  std::int64_t fallbacks = 0, mapped = 0, passes = 0;
};

// What the lists depend on.
struct BakePlan {
  std::string scene_file;  // its name
  std::string scene_sha256;
  std::uint32_t triangles = 0;
  std::string question;          // JSON: cells, kernel, groups
  std::string note;              // for a reader: what cells leave out
  std::vector<BakePlace> nodes;  // nodes[0] is the scene itself, and is never mapped
  std::vector<BakePlace> cells;
};

enum class PlaceKind : std::uint8_t { node, cell };

class BakeStore {
 public:
  // Makes the file, or goes on with what is there: throws Error bad_argument where that is another bake, malformed, file_unwritable.
  BakeStore(const std::filesystem::path& file, const BakePlan& plan);

  bool is_finished() const { return finished_; }
  bool has(PlaceKind kind, std::uint32_t index) const;  // whether it is mapped; its list is not unpacked
  bool has_all_cells() const;
  // Empty: not mapped yet.
  std::optional<BakedPlace> find(PlaceKind kind, std::uint32_t index) const;

  struct Done {
    PlaceKind kind = PlaceKind::cell;
    std::uint32_t index = 0;
    BakedPlace place;
  };
  void commit(const std::vector<Done>& done);  // all or nothing
  // Takes over what another store of the same bake holds and this one does not; returns how many cells. Throws Error bad_argument where it is of another
  // bake, malformed, file_unreadable.
  std::uint64_t take_from(const std::filesystem::path& file);
  // Throws what take_from would where the file is no store of this bake.
  static void require_store_of(const BakePlan& plan, const std::filesystem::path& file);
  // When all cells are there. The file is replaced as a whole; nothing may be asked afterwards.
  void finish();

 private:
  void make(const BakePlan& plan);
  static void require_same(const BakePlan& plan, const Database& db);

  std::filesystem::path file_;
  BakePlan plan_;
  std::unique_ptr<Database> db_;
  bool finished_ = false;
};

// A finished store, to be read. Lists are unpacked when they are asked for.
class FinishedBake {
 public:
  // Throws Error: file_unreadable, malformed; bad_argument where the bake is not finished.
  explicit FinishedBake(const std::filesystem::path& file);

  const BakePlan& plan() const { return plan_; }
  BakedPlace cell(std::uint32_t index) const;

 private:
  Database db_;
  BakePlan plan_;
};

}  // namespace clues::scene
