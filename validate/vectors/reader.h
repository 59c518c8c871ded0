// Reads vectors/ and believes nothing: the schema is closed (vectors/schema.json says the same), so an unknown field, a wrong type, a
// number that is not a C99 hex float, an index out of range or a list out of order is an Error malformed that names file, case
// and field. What the expectations claim is not checked here: that is `clues lint`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "validate/vectors/suite.h"

namespace clues::validate {

// All cases of the suite, by file name and then in the order of the file. Requires index.json, no id twice, exactly the active ids of
// the index, and every expectation present. Throws Error file_not_found (no such folder, no index), malformed.
std::vector<VectorCase> read_suite(const std::filesystem::path& folder);

// What `clues replay --promote` changes together (scene/files/folder_update.h). The readers of folders finish what it was killed in.
inline constexpr const char* suite_files[] = {"index.json", "found.json"};

// The pieces, for who needs more than the cases. A case without "expect" is accepted when `drafts`.
std::vector<std::filesystem::path> vector_files(
    const std::filesystem::path& folder);  // *.json but index and schema, sorted
VectorFile read_vector_file(const std::filesystem::path& path, bool drafts = false);
VectorFile parse_vector_file(std::string_view text, const std::string& name, bool drafts = false);
VectorIndex parse_vector_index(std::string_view text, const std::string& name);
VectorIndex read_vector_index(const std::filesystem::path& folder);
Expectation parse_expectation(std::string_view text, const VectorCase& about);

// '*' stands for any characters, '?' for one. For --case GLOB.
bool matches_glob(std::string_view text, std::string_view glob);

}  // namespace clues::validate
