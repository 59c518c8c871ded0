// Walks to JSON lines and back.
#include "scene/motion/walk_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/motion/malformed.h"
#include "scene/motion/motion_files.h"

namespace clues::scene {
namespace {

using Json = nlohmann::json;

constexpr const char* format_name = "clues-motion-walk/1";
constexpr std::array<std::uint32_t, 3> free_place{no_sample, no_sample, no_sample};
constexpr std::uint64_t most_places = std::uint64_t{1} << 26;  // of samples, and of triangles: beyond is a damaged file
constexpr std::uint64_t most_triangles_of_a_sample = 64;       // a sphere has two

// whole_number, with the place.
std::uint64_t number_in(const Json& value, const std::string& where, const char* what, std::uint64_t most) {
  try {
    return whole_number(value, what, most);
  } catch (const JsonError& e) {
    throw_malformed(where, e.what());
  }
}

// Those from `fresh` on are new, and nothing is known of them but what this frame says.
void apply_samples(const Json& list, std::vector<DepthSample>& samples, std::size_t fresh, const std::string& where) {
  if (!list.is_array()) throw_malformed(where, "\"samples\" must be a list");
  std::vector<bool> given(samples.size());
  for (const auto& item : list) {
    if (!item.is_array() || item.empty()) throw_malformed(where, json_excerpt(item) + " is no sample [I, x, y, z]");
    const auto index = number_in(item[0], where, "the number of a sample", most_places);
    if (index >= samples.size()) {
      throw Error(ErrorCode::index_out_of_range,
                  fmt::format("{}: sample {} of {}: beyond \"sizes\"", where, index, samples.size()));
    }
    if (given[index]) throw_malformed(where, fmt::format("sample {} is given twice", index));
    given[index] = true;
    Json rest = Json::array();
    for (std::size_t i = 1; i < item.size(); ++i) rest.push_back(item[i]);
    samples[index] = sample_of(rest, fmt::format("{}: sample {}", where, index));
  }
  const auto missing = std::find(given.begin() + static_cast<std::ptrdiff_t>(fresh), given.end(), false);
  if (missing != given.end()) {
    throw_malformed(where, fmt::format("sample {} is new by \"sizes\", and not given", missing - given.begin()));
  }
}

void apply_triangles(const Json& list, DepthMesh& mesh, const std::string& where) {
  if (!list.is_array()) throw_malformed(where, "\"triangles\" must be a list");
  for (const auto& item : list) {
    if (!item.is_array() || (item.size() != 1 && item.size() != 4)) {
      throw_malformed(where, json_excerpt(item) + " is no triangle [I, a, b, c], and no free place [I]");
    }
    const auto index = number_in(item[0], where, "the number of a triangle", most_places);
    if (index >= mesh.triangles.size()) {
      throw Error(ErrorCode::index_out_of_range,
                  fmt::format("{}: triangle {} of {}: beyond \"sizes\"", where, index, mesh.triangles.size()));
    }
    auto& triangle = mesh.triangles[index];
    triangle = free_place;
    for (std::size_t i = 1; i < item.size(); ++i) {
      triangle[i - 1] = static_cast<std::uint32_t>(
          number_in(item[i], where, "a corner of a triangle", mesh.samples.size() - (mesh.samples.empty() ? 0 : 1)));
    }
  }
}

}  // namespace

std::string WalkWriter::header() { return fmt::format("{{\"format\": \"{}\"}}\n", format_name); }

std::string WalkWriter::frame(const DepthMesh& mesh, const MotionPoint& viewpoint, const MotionThresholds& thresholds) {
  std::string samples, triangles;
  for (std::size_t i = 0; i < mesh.samples.size(); ++i) {
    if (i < last_.samples.size() && mesh.samples[i] == last_.samples[i]) continue;
    const auto text = to_text(mesh.samples[i]);  // [x, ...
    samples.append(samples.empty() ? "[" : ", [").append(fmt::format("{}, {}", i, text.substr(1)));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    if (i < last_.triangles.size() ? t == last_.triangles[i] : t == free_place) continue;
    triangles.append(triangles.empty() ? "[" : ", [")
        .append(t == free_place ? fmt::format("{}]", i) : fmt::format("{}, {}, {}, {}]", i, t[0], t[1], t[2]));
  }
  std::string line = fmt::format("{{\"sizes\": [{}, {}]", mesh.samples.size(), mesh.triangles.size());
  if (!samples.empty()) line.append(", \"samples\": [").append(samples).append("]");
  if (!triangles.empty()) line.append(", \"triangles\": [").append(triangles).append("]");
  if (first_ || thresholds != last_thresholds_) line.append(", \"thresholds\": ").append(to_text(thresholds));
  line.append(", \"viewpoint\": ").append(to_text(viewpoint)).append("}\n");
  last_ = mesh;
  last_thresholds_ = thresholds;
  first_ = false;
  return line;
}

WalkReader::WalkReader(const std::filesystem::path& path) : file_(path.string()), input_(path, std::ios::binary) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw Error(ErrorCode::file_not_found, file_ + ": no such file");
  std::string text;
  if (!input_ || std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorCode::file_unreadable, file_ + ": cannot be read");
  }
  std::getline(input_, text);
  line_ = 1;
  const auto root = parse_json(text, file_);
  if (!root.is_object() || root.size() != 1 || !root.contains("format") || root["format"] != format_name) {
    throw_malformed(file_ + ":1",
                    fmt::format("this is no walk; the first line must be {{\"format\": \"{}\"}}", format_name));
  }
}

bool WalkReader::next(WalkFrame& frame) {
  std::string text;
  if (!std::getline(input_, text)) {
    if (input_.bad()) throw Error(ErrorCode::file_unreadable, file_ + ": cannot be read to its end");
    return false;
  }
  const auto where = fmt::format("{}:{}", file_, ++line_);
  Json root;
  try {
    root = parse_json_text(text);
  } catch (const JsonError& e) {
    throw_malformed(where, e.what());
  }
  if (!root.is_object()) throw_malformed(where, json_excerpt(root) + " is no frame");
  for (const auto& [key, value] : root.items()) {
    if (key != "sizes" && key != "samples" && key != "triangles" && key != "thresholds" && key != "viewpoint") {
      throw_malformed(where, "there is no field \"" + key + "\" in this format");
    }
  }
  if (!root.contains("viewpoint")) throw_malformed(where, "the field \"viewpoint\" is missing");
  if (frames_ == 0 && !root.contains("thresholds")) throw_malformed(where, "the first frame must have \"thresholds\"");
  std::size_t fresh = mesh_.samples.size();
  if (root.contains("sizes")) {
    const auto& sizes = root["sizes"];
    if (!sizes.is_array() || sizes.size() != 2) throw_malformed(where, "\"sizes\" must be [SAMPLES, TRIANGLES]");
    const auto samples = number_in(sizes[0], where, "the number of samples", most_places);
    const auto triangles = number_in(sizes[1], where, "the number of triangles", most_places);
    // What a line of text asks for stays in proportion to the text: new samples are given with it, and free places are a few for each sample.
    const std::uint64_t given = root.contains("samples") && root["samples"].is_array() ? root["samples"].size() : 0;
    if (samples > mesh_.samples.size() + given) {
      throw_malformed(where, fmt::format("\"sizes\" says {} samples; {} before, and {} in this frame", samples,
                                         mesh_.samples.size(), given));
    }
    if (triangles > most_triangles_of_a_sample * (samples + 1)) {
      throw_malformed(where, fmt::format("\"sizes\" says {} triangles of {} samples; at most {} of each", triangles,
                                         samples, most_triangles_of_a_sample));
    }
    fresh = std::min<std::size_t>(fresh, samples);
    mesh_.samples.resize(samples);
    mesh_.triangles.resize(triangles, free_place);
  }
  if (root.contains("samples")) apply_samples(root["samples"], mesh_.samples, fresh, where);
  if (root.contains("triangles")) apply_triangles(root["triangles"], mesh_, where);
  if (root.contains("thresholds")) thresholds_ = thresholds_of(root["thresholds"], where + ": thresholds");
  frame.number = frames_++;
  frame.viewpoint = motion_point_of(root["viewpoint"], where + ": viewpoint");
  frame.thresholds = thresholds_;
  frame.mesh.samples = mesh_.samples;
  frame.mesh.triangles.clear();
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const auto& t = mesh_.triangles[i];
    if (t == free_place) continue;
    for (const auto corner : t) {
      if (corner >= mesh_.samples.size()) {
        throw Error(ErrorCode::index_out_of_range,
                    fmt::format("{}: triangle {} names sample {} of {}", where, i, corner, mesh_.samples.size()));
      }
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      throw_malformed(where, fmt::format("triangle {} has a sample twice", i));
    frame.mesh.triangles.push_back(t);
  }
  return true;
}

}  // namespace clues::scene
