// FIGS. 43 to 47: the server's side of a stream (D25). It keeps the client's display list as a mirror: which triangle
// and which vertex is in which slot, and how many triangles use each vertex, so that it can tell what is new and what
// becomes free. Slots are given out from 1, the lowest free one first; so the mirror follows from the messages alone.
//
// Entering a cell takes up to four messages: `+` what is missing there, the cell, `-` what is not wanted any more, `+`
// what is seen from cells within the horizon, so that it is there before the viewer is. So on the face between two
// cells the client has what either sees, and nobody waits for what he does not see yet. Which triangles the client
// holds in the end is a function of the cell that the viewer is in, whichever way he came: what is sound on every
// transition is sound on every route.
//
// FIGS. 52, 54: with a hierarchy the client gets, behind what he waits for, what is seen from the whole node that the
// cell is in, and within the node nothing is sent any more. Fewer packets, larger ones. Where the link is too slow for
// that a smaller node, or the cell alone, will do for the moment: nothing that a larger node has use for is taken away.
// So after each step the client has what the cell sees, and nothing that the coarsest node does not see. With contours
// (client_contours.h) he is told as well, once in each of these nodes, what of it each of its cells sees.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reference/streams/cell_tree.h"
#include "scene/mesh/mesh.h"
#include "scene/stream/stream_file.h"

namespace clues::reference {

// Slots that are given out, the lowest free one first.
class Slots {
 public:
  std::uint32_t take();
  void give_back(std::uint32_t slot) { free_.insert(slot); }

 private:
  std::uint32_t next_ = 1;
  std::set<std::uint32_t> free_;
};

class DisplayList {
 public:
  explicit DisplayList(const scene::TriangleMesh& mesh) : mesh_(&mesh) {}  // keeps a reference

  std::vector<std::uint32_t> triangles() const;  // ids, ascending
  std::size_t size() const { return triangles_.size(); }

  // FIG. 44: of triangles that it does not hold. FIG. 45: of triangles that it holds. O(log n) each.
  scene::StreamMessage plus(const std::vector<std::uint32_t>& triangles);
  scene::StreamMessage minus(const std::vector<std::uint32_t>& triangles);

  // What is in the slots, for comparing mirrors: a line for each triangle and vertex, by slot.
  std::string bytes() const;

 private:
  struct Vertex {
    std::uint32_t slot = 0;
    std::uint32_t users = 0;
  };

  const scene::TriangleMesh* mesh_;
  std::map<std::uint32_t, scene::StreamTriangle> triangles_;  // by id
  std::map<std::uint32_t, Vertex> vertices_;                  // by number in the mesh
  Slots triangle_slots_, vertex_slots_;
};

// What all clients of a server share.
class StreamStore {
 public:
  // `lists`: what is visible, for each cell; `neighbours`: where a viewer can go from there. With a horizon of n a
  // client has what is seen from all cells that can be reached in n steps, and with a tree from their nodes. Keeps a
  // reference to the mesh.
  StreamStore(const scene::TriangleMesh& mesh, std::vector<std::vector<std::uint32_t>> lists,
              std::vector<std::vector<std::uint32_t>> neighbours, int horizon, CellTree tree = {});

  const scene::TriangleMesh& mesh() const { return *mesh_; }
  const std::vector<std::uint32_t>& seen_from(std::uint32_t cell) const { return lists_[cell]; }
  std::size_t coarsest() const { return tree_.node_of.empty() ? 0 : tree_.node_of.size() - 1; }  // level of the tree
  std::vector<std::uint32_t> wanted_in(std::uint32_t cell, std::size_t level) const;             // ascending

  // From here on clients get contours: of each cell within what they hold when the viewer is there. O(cells * size of
  // what is held there * log n).
  void add_contours();
  std::uint32_t coarsest_node(std::uint32_t cell) const;
  // Of the cells of this node; none where clients get none.
  std::vector<scene::CellContour> contours_of_node(std::uint32_t node) const;
  // SHA-256 of the lists, which follow from mode and --drop, the neighbours, the horizon, the tree, and whether there are
  // contours: from these, and the scene, all messages follow. O(size of the lists).
  std::string digest() const;

 private:
  std::vector<std::vector<std::uint32_t>> lists_, neighbours_;
  CellTree tree_;
  std::vector<std::vector<std::vector<std::uint32_t>>> node_lists_;  // of each level but 0, of each node
  std::vector<scene::CellContour> contours_;                         // of each cell; or none
  const scene::TriangleMesh* mesh_;
  int horizon_;
};

// One client's session.
class StreamServer {
 public:
  explicit StreamServer(const StreamStore& store) : store_(&store), mirror_(store.mesh()) {}  // keeps a reference

  // The messages of a step into the cell. Empty packets are left out.
  std::vector<scene::StreamMessage> enter(std::uint32_t cell) { return enter(cell, store_->coarsest()); }
  // The same, with no more in advance than what nodes of this level want; at most the coarsest.
  std::vector<scene::StreamMessage> enter(std::uint32_t cell, std::size_t level);

  // After a lost connection, also by another server of the same digest and cells: goes the route again from its
  // beginning, and returns all but the first `have` messages, which the client has. The client is then where the
  // connection was lost, and nothing is sent twice. Throws scene::Error bad_argument where the route has not so many
  // messages. `levels`: of each step, where they were not all the coarsest.
  std::vector<scene::StreamMessage> resume(const std::vector<std::uint32_t>& route, std::uint64_t have,
                                           const std::vector<std::size_t>& levels = {});

  // The same, message for message, where not all are to be in memory at once: from the beginning, cell by cell.
  void restart();
  void require_said(std::uint64_t have) const;          // throws as resume does
  std::uint64_t messages() const { return messages_; }  // of this session
  const DisplayList& mirror() const { return mirror_; }

 private:
  const StreamStore* store_;
  std::uint64_t messages_ = 0;
  DisplayList mirror_;
  std::optional<std::uint32_t> node_;  // that the client has the contours of
};

}  // namespace clues::reference
