// The umbra as files: exactly, as JSON that `clues verify` reads again ("clues-umbra/1", docs/formats.md), and rounded, as OFF and PLY to look at.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/visibility/hidden/umbra.h"
#include "scene/mesh/mesh.h"
#include "validate/certificates/umbra_certificate.h"

namespace clues::validate {

struct UmbraRecord {
  std::string scene_file, scene_sha256;
  std::uint64_t scene_triangles = 0;
  std::vector<scene::Point> cell;  // as the user gave it
  std::array<RVector, 2> bounds;   // what is unbounded was ended at this box
  UmbraCertificate facets;
  std::vector<reference::UmbraFacetKind> kinds;  // per facet; surface exactly where the facet names a triangle
};

// Fills bounds, facets and kinds.
UmbraRecord record_of(const reference::Umbra& umbra);

// The volume within the facets of a valid certificate, where w = 1 (as build_umbra makes them). O(n).
Rational enclosed_volume(const UmbraCertificate& facets);

// Keys sorted, two-space indent, trailing newline; corners are shared and sorted, so the same facets give the same bytes.
std::string to_json_text(const UmbraRecord& record);

// A valid JSON file of that format need not hold a valid certificate. Throws Error: file errors, malformed and index_out_of_range (file and entry),
// unsupported (another format), and malformed when it is of a scene with another number of triangles.
UmbraRecord read_umbra(const std::filesystem::path& path, std::uint64_t triangles);

// Coordinates rounded to the nearest double. PLY has a colour on every face: surfaces grey, wedges orange, the enclosing box blue.
std::string to_off_text(const UmbraRecord& record);
std::string to_ply_text(const UmbraRecord& record);

}  // namespace clues::validate
