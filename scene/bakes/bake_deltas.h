// From cell to cell in the store of a finished bake: which triangles a viewer's list gains and which it loses, so that who walks need not load lists.
//
// There is a row for every two cells whose bounding boxes touch; it says what their lists say. Which cells are neighbours decides nothing but what is at hand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "scene/bakes/bake_store.h"
#include "scene/stores/database.h"

namespace clues::scene {

struct BakeDelta {
  std::vector<std::uint32_t> appears, disappears;  // ascending
};

// Makes the table `deltas` from the lists of all cells, within the caller's transaction. O(cells^2) boxes, and for each pair the length of two lists.
void write_deltas(const Database& db, const std::vector<BakePlace>& cells, std::uint32_t triangles);

// Whether the deltas of a finished store say what the lists of all its cells say; a store without the table has none to ask. Throws Error malformed where they do not.
// O(neighbours * length of two lists).
void require_deltas_of_lists(const std::filesystem::path& file, const std::vector<std::vector<std::uint32_t>>& lists,
                             std::uint32_t triangles);

class BakeDeltas {
 public:
  // Throws Error as FinishedBake; malformed where the store has no deltas.
  explicit BakeDeltas(const std::filesystem::path& file);

  std::vector<std::uint32_t> neighbours_of(std::uint32_t cell) const;  // ascending; throws Error malformed
  // None: they are no neighbours. Throws Error malformed.
  std::optional<BakeDelta> between(std::uint32_t from, std::uint32_t to) const;

 private:
  Database db_;
  std::uint32_t triangles_ = 0;
  std::size_t cells_ = 0;
};

}  // namespace clues::scene
