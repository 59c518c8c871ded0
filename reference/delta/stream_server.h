// FIGS. 43 to 47: the server's side of a stream (D25). It keeps the client's display list as a mirror: which triangle
// and which vertex is in which slot, and how many triangles use each vertex, so that it can tell what is new and what
// becomes free. Slots are given out from 1, the lowest free one first; so the mirror follows from the messages alone.
//
// Entering a cell takes up to four messages: `+` what is missing there, the cell, `-` what is not wanted any more, `+`
// what is seen from cells within the horizon, so that it is there before the viewer is. So on the face between two cells
// the client has what either sees, and nobody waits for what he does not see yet. Which triangles the client holds in the
// end is a function of the cell that the viewer is in, whichever way he came: what is sound on every transition is sound
// on every route.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

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
  // `lists`: what is visible, for each cell; `neighbours`: where a viewer can go from there. With a horizon of n a client
  // has what is seen from all cells that can be reached in n steps. Keeps a reference to the mesh.
  StreamStore(const scene::TriangleMesh& mesh, std::vector<std::vector<std::uint32_t>> lists,
              std::vector<std::vector<std::uint32_t>> neighbours, int horizon);

  const scene::TriangleMesh& mesh() const { return *mesh_; }
  const std::vector<std::uint32_t>& seen_from(std::uint32_t cell) const { return lists_[cell]; }
  std::vector<std::uint32_t> wanted_in(std::uint32_t cell) const;  // ascending
  // SHA-256 of the lists, which follow from mode and --drop, the neighbours and the horizon: from these, and the scene,
  // all messages follow. O(size of the lists).
  std::string digest() const;

 private:
  std::vector<std::vector<std::uint32_t>> lists_, neighbours_;
  const scene::TriangleMesh* mesh_;
  int horizon_;
};

// One client's session.
class StreamServer {
 public:
  explicit StreamServer(const StreamStore& store) : store_(&store), mirror_(store.mesh()) {}  // keeps a reference

  // The messages of a step into the cell. Empty packets are left out.
  std::vector<scene::StreamMessage> enter(std::uint32_t cell);

  // After a lost connection, also by another server of the same digest and cells: goes the route again from its
  // beginning, and returns all but the first `have` messages, which the client has. The client is then where the
  // connection was lost, and nothing is sent twice. Throws scene::Error bad_argument where the route has not so many
  // messages.
  std::vector<scene::StreamMessage> resume(const std::vector<std::uint32_t>& route, std::uint64_t have);

  // The same, message for message, where not all are to be in memory at once: from the beginning, cell by cell.
  void restart();
  void require_said(std::uint64_t have) const;          // throws as resume does
  std::uint64_t messages() const { return messages_; }  // of this session
  const DisplayList& mirror() const { return mirror_; }

 private:
  const StreamStore* store_;
  std::uint64_t messages_ = 0;
  DisplayList mirror_;
};

}  // namespace clues::reference
