// Random numbers that are a function of a case's name (generator, seed, number) and of what they are for, and of nothing else: who draws more does not change what others draw.
#pragma once

#include <string>

#include "fuzz/findings/finding.h"
#include "fuzz/generators/random.h"

namespace clues::fuzz {

inline Random random_for(const Case& scene, const std::string& purpose) {
  const auto hash_of = [](const std::string& text) {  // FNV-1a
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return hash;
  };
  return Random(Random(Random(scene.seed ^ hash_of(purpose)).next() ^ scene.index).next() ^ hash_of(scene.generator));
}

}  // namespace clues::fuzz
