// Points to ask for: three numbers a line, or six for the two ends of a segment; '#' starts a comment. Decimals and hex floats become the nearest double, as in scene files; "p/q" with whole
// p and q is exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "exact/kernel.h"

namespace clues::validate {

struct LinePoint {
  std::uint64_t line = 0;
  exact::Point3 point;
  std::optional<exact::Point3> end;  // of a segment; not the same point
};

// Throws Error: file errors; malformed and non_finite with file and line; malformed for a file without points.
std::vector<LinePoint> read_points(const std::filesystem::path& path);

}  // namespace clues::validate
