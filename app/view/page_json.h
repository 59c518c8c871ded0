// The files of a page as JSON: what is drawn of them, checked, and meshes in base64.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/mesh/flagged_mesh.h"

namespace clues::app {

// {"points", "triangles"}: doubles and 32-bit numbers, little-endian, in base64.
nlohmann::json mesh_for_page(const scene::TriangleMesh& mesh);
// Besides, where they are not plain: "flags", a byte a triangle (1: it blocks, 2: it counts), and "parts", the first triangle of each with its name.
nlohmann::json mesh_for_page(const scene::FlaggedMesh& scene);

// The keys of a result, judgement or umbra that the page reads, without exact texts where doubles stand beside them. `file` is for messages. Throws Error malformed for a
// map that is not whole.
nlohmann::json result_for_page(const nlohmann::json& result, std::uint64_t triangles, const std::string& file);

}  // namespace clues::app
