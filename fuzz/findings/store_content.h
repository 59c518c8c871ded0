// All that a store of a campaign holds, as one value: to write it anew, so that the same content has the same bytes, and to bring shards together. Case n of a
// campaign is a pure function of its number, so that what shards found, in the order of the cases, is what one machine would have found.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/findings/store.h"
#include "scene/stores/database.h"

namespace clues::fuzz {

using Contradictions = std::vector<std::pair<std::int64_t, std::string>>;  // by number, which ascends with the case

struct StoreContent {
  std::string plan;
  std::uint64_t cases_done = 0;
  Counters counters;
  Contradictions contradictions;
  std::vector<StoredFinding> findings;  // in the order in which they were found
  std::vector<SoughtCase> sought;       // in order; of a campaign that chooses its cases
};

extern const char* const store_schema;

std::uint64_t stored_cases_done(const scene::Database& store);
Counters stored_counters(const scene::Database& store);
Contradictions stored_contradictions(const scene::Database& store);
std::vector<StoredFinding> stored_findings(const scene::Database& store);
std::vector<SoughtCase> stored_sought(const scene::Database& store);
void insert_sought(const scene::Database& store, std::uint64_t place, const SoughtCase& sought);

StoreContent content_of(const scene::Database& store);
// Throws scene::Error file_unreadable, malformed.
StoreContent read_store(const std::filesystem::path& file);
// In place of what is there, as a whole. Throws scene::Error file_unwritable.
void write_store(const std::filesystem::path& file, const StoreContent& content);

// Of shards that have done the same cases, each its share. A finding is that of the first case that has it; none has a folder.
StoreContent merged(const std::vector<StoreContent>& shards, const std::string& plan);

}  // namespace clues::fuzz
