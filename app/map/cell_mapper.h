// What `clues map` does with one cell, by either kernel. The cells of a grid are mapped by several threads at once.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/common.h"
#include "app/json_output.h"
#include "app/map/simplify_choice.h"
#include "app/map/umbra_output.h"
#include "reference/visibility/first_order.h"
#include "scene/cell_spec.h"
#include "scene/mesh/flagged_mesh.h"
#include "scene/mesh/mesh.h"

namespace clues::app {

struct MapRequest {
  std::string scene, cell, cells, out, overlap_graph, fragments;
  bool with_map = false, with_states = false, resume = false;
  JsonOutput json;
  MethodOptions method;
  std::string asked_method;  // as the user wrote it
  RefineChoice refine;
  validate::Refinement refinement = validate::Refinement::none;  // as --method and --refine together say
  SimplifyChoice simplify;
  UmbraRequest umbra;
  std::optional<std::uint32_t> covered_sides;  // of a level: how many sides of hulls its scene leaves out
};

struct MappedCell {
  std::string name;
  std::string json;           // the result, where it is printed or the file is one
  std::string list;           // the plain list, where the file is one
  std::string summary;        // one line of the table, and one more of what simplification did
  std::string overlap_graph;  // GraphViz, where it was asked for
  std::string umbra_bytes, umbra_summary;
  std::string fragments_bytes, fragments_summary;
};

class CellMapper {
 public:
  CellMapper() = default;
  CellMapper(const CellMapper&) = delete;
  CellMapper& operator=(const CellMapper&) = delete;
  virtual ~CellMapper() = default;

  // May be called from several threads at once; each call may use `threads` threads itself.
  virtual MappedCell map(const scene::CellSpec& cell, int threads, const reference::Progress& progress) const = 0;
  virtual const char* table_head() const = 0;
};

bool wants_plain_list(const std::filesystem::path& out);  // *.pvs, *.txt

// Sets `json` and `list`.
void put_result(MappedCell& cell, scene::Result result, const MapRequest& request, const std::string& sha256,
                const std::optional<scene::Simplification>& simplification = {});

// Both keep references to mesh and request. The fast one refuses what only the exact one can do (Error unsupported).
std::unique_ptr<CellMapper> exact_mapper(const scene::TriangleMesh& mesh, const std::string& sha256,
                                         const MapRequest& request);
std::unique_ptr<CellMapper> fast_mapper(const scene::TriangleMesh& mesh, const std::string& sha256,
                                        const MapRequest& request);
// For a scene that is not plain (D22): lists by either kernel, maps and umbrae by the exact one.
std::unique_ptr<CellMapper> see_through_mapper(const scene::FlaggedMesh& scene, const std::string& sha256,
                                               const MapRequest& request);

}  // namespace clues::app
