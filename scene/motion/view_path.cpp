// Ways of viewpoints. The points of circles come from polynomials, so that they are the same on every machine.
#include "scene/motion/view_path.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

constexpr std::uint64_t kUsualFrames = 600, kMostFrames = 10'000'000;

[[noreturn]] void fail_spec(const std::string& spec, const std::string& what) {
  throw Error(ErrorCode::bad_argument, fmt::format("--path {}: {}", spec, what));
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<double> numbers_of(const std::string& spec, std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view word : split(text, ',')) {
    const ParsedNumber parsed = parse_number(word);
    if (parsed.kind == NumberKind::non_finite) fail_spec(spec, fmt::format("{} is not finite", excerpt(word)));
    if (parsed.kind == NumberKind::not_a_number) fail_spec(spec, fmt::format("{} is no number", excerpt(word)));
    if (std::fabs(parsed.value) > farthest_viewpoint) fail_spec(spec, fmt::format("{} is beyond 2^90", excerpt(word)));
    numbers.push_back(parsed.value);
  }
  return numbers;
}

struct Direction {
  double cosine, sine;
};

// Of an angle in turns. Within an eighth of a turn the series ends below the last place.
Direction direction_of(double turns) {
  const double part = turns - std::floor(turns), quarter = std::floor(part * 4 + 0.5);
  const double x = (part - quarter / 4) * 0x1.921fb54442d18p+2, y = x * x;
  const double s =
      x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156 * (1 - y / 210)))))));
  const double c =
      1 - y / 2 * (1 - y / 12 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90 * (1 - y / 132 * (1 - y / 182))))));
  switch (static_cast<int>(quarter) % 4) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

std::vector<MotionPoint> orbit(const std::string& spec, std::uint64_t frames) {
  const auto n = numbers_of(spec, std::string_view(spec).substr(6));
  if (n.size() != 4 && n.size() != 5) fail_spec(spec, "expected orbit:x,y,z,r or orbit:x,y,z,r,turns");
  if (!(n[3] > 0)) fail_spec(spec, "the distance r has to be above 0");
  const double turns = n.size() == 5 ? n[4] : 1;
  std::vector<MotionPoint> path;
  for (std::uint64_t k = 0; k <= frames; ++k) {
    const Direction d = direction_of(turns * (static_cast<double>(k) / static_cast<double>(frames > 0 ? frames : 1)));
    path.push_back({n[0] + n[3] * d.cosine, n[1] + n[3] * d.sine, n[2]});
  }
  return path;
}

std::vector<MotionPoint> along_corners(const std::string& spec, std::uint64_t frames) {
  std::vector<MotionPoint> corners;
  for (const std::string_view part : split(std::string_view(spec).substr(5), ':')) {
    const auto n = numbers_of(spec, part);
    if (n.size() != 3) fail_spec(spec, "expected walk:x,y,z:x,y,z, with more corners after more colons");
    corners.push_back({n[0], n[1], n[2]});
  }
  if (corners.size() < 2) fail_spec(spec, "a way has two corners at least");
  std::vector<double> far{0};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k)
      square += (corners[i][k] - corners[i - 1][k]) * (corners[i][k] - corners[i - 1][k]);
    far.push_back(far.back() + std::sqrt(square));
  }
  std::vector<MotionPoint> path;
  std::size_t leg = 1;
  for (std::uint64_t k = 0; k <= frames; ++k) {
    if (k == frames) {
      path.push_back(frames > 0 ? corners.back() : corners.front());
      break;
    }
    const double at = far.back() * (static_cast<double>(k) / static_cast<double>(frames));
    while (leg + 1 < corners.size() && far[leg] < at) ++leg;
    const double length = far[leg] - far[leg - 1], t = length > 0 ? (at - far[leg - 1]) / length : 0;
    MotionPoint p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = corners[leg - 1][i] + t * (corners[leg][i] - corners[leg - 1][i]);
    path.push_back(p);
  }
  return path;
}

std::vector<MotionPoint> from_file(const std::string& file, std::optional<std::uint64_t> frames) {
  const auto bytes = read_file_bytes(file);
  LineReader lines(file, bytes, {});
  std::vector<MotionPoint> path;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    if (tokens.size() != 3) {
      fail_at(lines.place(), ErrorCode::malformed,
              fmt::format("a viewpoint is three numbers, x y z; this line has {}", tokens.size()));
    }
    MotionPoint p{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = number_at(tokens[i], "coordinate", lines.place());
      if (std::fabs(p[i]) > farthest_viewpoint) {
        fail_at(lines.place(), ErrorCode::bad_argument, "the viewpoint is further than 2^90 from the origin; move it");
      }
    }
    path.push_back(p);
  }
  if (path.empty()) fail_in(file, ErrorCode::malformed, "no viewpoint; expected lines of three numbers, x y z");
  if (frames) {
    if (*frames + 1 > path.size()) {
      throw Error(ErrorCode::bad_argument, fmt::format("--frames {}: {} has {} frames after the first viewpoint",
                                                       *frames, file, path.size() - 1));
    }
    path.resize(*frames + 1);
  }
  return path;
}

}  // namespace

std::vector<MotionPoint> read_view_path(const std::string& spec, std::optional<std::uint64_t> frames) {
  if (frames && *frames > kMostFrames) throw Error(ErrorCode::bad_argument, "--frames: at most 10000000");
  std::vector<MotionPoint> path;
  if (spec.starts_with("orbit:")) {
    path = orbit(spec, frames.value_or(kUsualFrames));
  } else if (spec.starts_with("walk:")) {
    path = along_corners(spec, frames.value_or(kUsualFrames));
  } else {
    path = from_file(spec, frames);
  }
  for (const MotionPoint& p : path) {
    for (const double x : p) {
      if (!std::isfinite(x)) fail_spec(spec, "a viewpoint is not finite");
      if (std::fabs(x) > farthest_viewpoint) fail_spec(spec, "a viewpoint is further than 2^90 from the origin");
    }
  }
  return path;
}

}  // namespace clues::scene
