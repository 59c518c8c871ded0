// A finished bake as files: plain lists, and one flat file for engines (app/engine/clues_pvs.h).
#pragma once

#include <filesystem>
#include <string>

#include "scene/bakes/bake_store.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::app {

// Throws Error unsupported where there are more than 2^32 places of cells in voxels, or planes of cells.
std::string engine_file(const scene::FinishedBake& bake);

// Throws Error now, and not after hours, where export_bake could not write into the folder.
void require_exportable(const std::filesystem::path& folder);

// cells.txt (number, name, cluster), pvs/NUMBER.txt, parts.txt (first triangle and name) where parts have names, engine.cluespvs. The folder must be new or empty.
void export_bake(const std::filesystem::path& folder, const scene::FinishedBake& bake, const scene::FlaggedMesh& scene);

}  // namespace clues::app
