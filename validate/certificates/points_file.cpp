#include "validate/certificates/points_file.h"

#include <fmt/format.h>

#include <string>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"
#include "validate/windows/rational.h"

namespace clues::validate {
namespace {

bool is_whole(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

Rational coordinate(std::string_view token, const scene::Place& place) {
  const auto slash = token.find('/');
  if (slash == std::string_view::npos) return Rational(scene::number_at(token, "coordinate", place));
  const std::string_view p = token.substr(0, slash), q = token.substr(slash + 1);
  const bool negative = p.starts_with('-');
  if (!is_whole(negative ? p.substr(1) : p) || !is_whole(q) || q.find_first_not_of('0') == std::string_view::npos) {
    scene::fail_at(place, scene::ErrorCode::malformed,
                   fmt::format("the coordinate {} is not a fraction; write p/q with whole numbers, q above 0",
                               scene::excerpt(token)));
  }
  Rational x(std::string(token), 10);  // else a leading zero would make it octal
  x.canonicalize();
  return x;
}

}  // namespace

std::vector<LinePoint> read_points(const std::filesystem::path& path) {
  const std::string bytes = scene::read_file_bytes(path), file = path.string();
  scene::LineReader lines(file, bytes, {});
  std::vector<LinePoint> points;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    if (tokens.size() != 3 && tokens.size() != 6) {
      scene::fail_at(lines.place(), scene::ErrorCode::malformed,
                     fmt::format("a point has three coordinates and a segment six, this line has {}", tokens.size()));
    }
    const auto point_at = [&](std::size_t first) {
      RVector p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = coordinate(tokens[first + i], lines.place());
      return to_point(p);
    };
    LinePoint read{lines.line(), point_at(0), std::nullopt};
    if (tokens.size() == 6) {
      read.end = point_at(3);
      if (*read.end == read.point)
        scene::fail_at(lines.place(), scene::ErrorCode::malformed,
                       "the two ends of the segment are one point; give it alone");
    }
    points.push_back(std::move(read));
  }
  if (points.empty()) scene::fail_in(file, scene::ErrorCode::malformed, "no points; write three numbers a line");
  return points;
}

}  // namespace clues::validate
