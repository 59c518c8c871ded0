// FIGS. 49, 50A, 51: how much of an error goes unseen at which speed of the image. The published text prints no curve,
// so it is a file: in each line a speed and an error, both in radians (a second), '#' comments. Speeds rise from line
// to line, errors do not fall. Between two lines the first of them holds, below the first line none: no error goes
// unseen there.
#pragma once

#include <filesystem>
#include <vector>

namespace clues::scene {

struct PerceptionRow {
  double speed = 0;  // of the image on the retina: radians a second
  double error = 0;  // from 0 to 1 radian
};

// Not empty. Throws Error: file errors; malformed and non_finite with file and line.
std::vector<PerceptionRow> read_perception_curve(const std::filesystem::path& path);

}  // namespace clues::scene
