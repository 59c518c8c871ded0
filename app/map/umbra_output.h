// What `clues map --umbra` adds: the umbra, verified before a byte of it is written.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "reference/visibility/hidden/umbra.h"
#include "reference/visibility/map/omega.h"
#include "scene/cell_spec.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::app {

struct UmbraRequest {
  std::string file, bounds;

  void add_to(CLI::App& command);
};

// Throws Error bad_argument where the options do not fit together, file_unwritable where the file cannot be made.
void require_good(const UmbraRequest& request, bool many_cells);

// The umbra, with its certificate checked. Throws Unfinished when limits (D17) leave it open, Error internal when its
// certificate fails without them; bad_argument where `bounds` is no box (empty: as large as usual).
reference::Umbra checked_umbra(const reference::Omega& omega, const scene::TriangleMesh& mesh,
                               const std::string& bounds, int threads);

struct UmbraOutput {
  std::string bytes, summary;
};

// `omega` is of what blocks in the scene (D22), in that order; the facets name triangles of the scene. Throws as checked_umbra.
UmbraOutput make_umbra(const reference::Omega& omega, const scene::FlaggedMesh& scene, const scene::CellSpec& cell,
                       const std::string& scene_path, const std::string& scene_sha256, const UmbraRequest& request,
                       int threads);

}  // namespace clues::app
