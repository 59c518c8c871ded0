#include "scene/stream/perception_curve.h"

#include <string>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"

namespace clues::scene {

std::vector<PerceptionRow> read_perception_curve(const std::filesystem::path& path) {
  const std::string bytes = read_file_bytes(path), file = path.string();
  LineReader lines(file, bytes, {});
  std::vector<PerceptionRow> curve;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    if (tokens.size() != 2)
      fail_at(lines.place(), ErrorCode::malformed, "give two numbers: a speed and the error that goes unseen at it");
    const PerceptionRow row{number_at(tokens[0], "speed", lines.place()), number_at(tokens[1], "error", lines.place())};
    if (row.speed < 0) fail_at(lines.place(), ErrorCode::malformed, "the speed is below 0");
    if (row.error < 0 || row.error > 1)
      fail_at(lines.place(), ErrorCode::malformed, "the error is not from 0 to 1; it is an angle in radians");
    if (!curve.empty() && row.speed <= curve.back().speed)
      fail_at(lines.place(), ErrorCode::malformed, "the speed is not above that of the line before; sort the lines");
    if (!curve.empty() && row.error < curve.back().error)
      fail_at(lines.place(), ErrorCode::malformed,
              "the error is below that of the line before; what moves faster is not seen better");
    curve.push_back(row);
  }
  if (curve.empty()) throw Error(ErrorCode::malformed, file + ": has no line with a speed and an error");
  return curve;
}

}  // namespace clues::scene
