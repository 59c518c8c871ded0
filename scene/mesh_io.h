// Readers for the scene formats of docs/formats.md: OBJ, OFF, PLY (ascii, binary little and big endian), STL
// (ascii and binary). Decimal text is read to the nearest double (hex floats too), binary floats exactly.
// A face with more than three corners becomes a fan from its first corner (D1).
#pragma once

#include <filesystem>
#include <string>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// Chooses the reader by the file's extension (case-insensitive). Throws Error: file_not_found,
// file_unreadable, unsupported (extension or feature), malformed (syntax, truncated, a face with fewer
// than three corners), non_finite, index_out_of_range. The message names file and line (or face).
// A file with zero triangles is malformed ("no triangles"). O(size of the file).
TriangleMesh read_mesh(const std::filesystem::path& path);

// What chooses a reader: ".obj" of "TOWN.OBJ".
std::string lower_case_extension(const std::filesystem::path& path);
// Throws the error of a file with zero triangles.
void require_triangles(const TriangleMesh& mesh, const std::filesystem::path& path);

// The mesh as the text of an OFF file; read_mesh gets every double back, bit for bit. A mesh without triangles is a point list (a cell).
std::string to_off_text(const TriangleMesh& mesh);

}  // namespace clues::scene
