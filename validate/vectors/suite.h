// The conformance suite vectors/ (format "clues-vectors/1", docs/formats.md): one topic a file, one geometric fact a case. This
// header is the suite as data; reader.h reads it, writer.h writes it, lint.h proves what it says.
//
// Input coordinates are doubles, exact results stay the canonical strings of the file ("p/q" in lowest terms, "p" when q is 1), so
// that who only runs the suite needs no exact kernel.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh/flagged_mesh.h"

namespace clues::validate {

using RationalPoint = std::array<std::string, 3>;

// A triangle that every sound PVS lists: it meets the cell (D3), or the open segment (v, p) is a free sight line (D5).
struct MustBeVisible {
  std::uint32_t triangle = 0;
  bool meets_cell = false;
  // Of the witness; without meaning when meets_cell.
  bool front = true;  // p is seen on this side
  RationalPoint v;    // in int V
  RationalPoint p;    // in the relative interior of the triangle
};

// A triangle that is hidden, and how that was proved.
enum class UmbraProof {
  first_order_map,  // outside Omega (T1)
  exhaustive,       // inside Omega, but validate/visible_set/visible_set.h proved that no sight line reaches it
};
struct Umbra {
  std::uint32_t triangle = 0;
  UmbraProof proof = UmbraProof::first_order_map;
};

// Every triangle that counts is in exactly one of must_be_visible, umbra and no_surface, and no other is in any. All lists ascend.
struct Expectation {
  std::vector<MustBeVisible> must_be_visible;
  std::vector<Umbra> umbra;
  std::vector<std::uint32_t> no_surface;  // without area: neither visible nor an occluder
  // The PVS of Omega: contains must_be_visible (T1). A triangle that does not block is asked about in the scene of what blocks and itself (D22).
  std::vector<std::uint32_t> first_order_visible;
};

enum class CaseMode { sheet, solid };  // D4
enum class CaseLevel { core, full };   // core: every implementation should run it; full: larger, or far-fetched numbers

struct VectorCase {
  std::string id;       // permanent, unique in the whole suite: lower-case words joined by '-'
  std::string topic;    // of its file
  std::string comment;  // the fact, and which mistake gets it wrong
  std::vector<std::string> flags;
  CaseLevel level = CaseLevel::core;
  std::string scene;         // its name in the file
  scene::TriangleMesh mesh;  // every triangle is a face of its own
  std::vector<std::uint8_t> blocks,
      counts;  // D22, as in FlaggedMesh: per triangle; empty: all do. Solid cases are plain
  std::vector<scene::Point> cell;
  CaseMode mode = CaseMode::sheet;
  std::optional<Expectation> expect;  // read_suite: always there

  // Whoever takes all of `mesh` for opaque, or asks about all of it, has to look at this first.
  bool is_plain() const { return blocks.empty() && counts.empty(); }
  scene::FlaggedMesh flagged() const { return {mesh, blocks, counts, {}}; }
};

// What a flag means, once per file.
struct VectorNote {
  std::string bug_type;     // "EDGE_CASE", "PRECISION", "METHOD", "INPUT", "MODE"
  std::string description;  // the situation
  std::string effect;       // what goes wrong where it is not respected
  std::vector<std::string>
      hazards;  // "B-7", "A-3": the traps of the published text, as numbered in tests/reference/hazards_test.cpp
};

struct VectorSource {
  std::string name;
  std::string version;                // "2026-11"
  std::optional<std::uint64_t> seed;  // null for scenes made by hand
  std::string confirmed_by;           // the independent means
};

struct VectorScene {
  std::vector<scene::Point> vertices;
  std::vector<scene::Triangle> triangles;
  std::vector<std::uint32_t> see_through{},
      not_counted{};  // D22: what does not block, what does not count; ascending, no id in both
};

struct VectorFile {
  std::string name;  // "grazing.json"
  std::string topic;
  std::string definition;  // "D5"
  VectorSource source;
  std::map<std::string, VectorNote> notes;  // by flag
  std::map<std::string, VectorScene> scenes;
  std::vector<VectorCase> cases;
};

// index.json: every id that ever was, and how many there are. An id never disappears: a case that is taken out is `withdrawn`, with
// the reason, and its id is not used again.
struct IndexEntry {
  std::string topic;
  bool withdrawn = false;
  std::string reason;  // of the withdrawal; else empty
};
struct VectorIndex {
  std::map<std::string, IndexEntry> cases;      // by id
  std::map<std::string, std::uint64_t> topics;  // active cases per topic
  std::uint64_t active = 0, withdrawn = 0;
};

}  // namespace clues::validate
