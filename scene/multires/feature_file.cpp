#include "scene/multires/feature_file.h"

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"

namespace clues::scene {

Features read_features(const std::filesystem::path& path) {
  const std::string text = read_file_bytes(path), file = path.string();
  LineReader lines(file, text, {});
  Features out;
  while (lines.next()) {
    std::vector<std::uint32_t> numbers;
    for (const auto token : lines.tokens()) {
      const auto value = parse_integer(token);
      if (!value || *value < 0 || *value >= no_vertex || lines.tokens().size() > 2) {
        fail_at(lines.place(), ErrorCode::malformed, "expected two vertex numbers (an edge) or one (a vertex)");
      }
      numbers.push_back(static_cast<std::uint32_t>(*value));
    }
    if (numbers.size() == 2) {
      out.edges.push_back({numbers[0], numbers[1]});
    } else {
      out.vertices.push_back(numbers[0]);
    }
  }
  return out;
}

}  // namespace clues::scene
