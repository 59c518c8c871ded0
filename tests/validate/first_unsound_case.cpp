#include "first_unsound_case.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "reference/visibility/first_order.h"
#include "validate/vectors/reader.h"

namespace clues::validate {

std::string first_unsound_case(const std::filesystem::path& suite) {
  constexpr std::array<std::string_view, 6> topics{"hazards", "grazing",     "fusion",
                                                   "portals", "coordinates", "cyclic-overlap"};
  for (const auto& c : read_suite(suite)) {
    if (std::find(topics.begin(), topics.end(), c.topic) == topics.end() || c.level != CaseLevel::core) continue;
    reference::Options options;
    options.mode = c.mode == CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet;
    std::vector<std::uint32_t> answer;
    try {
      answer = reference::first_order_visibility(c.mesh, exact::ConvexCell::from_doubles(c.cell), options).visible;
    } catch (const std::exception&) {  // a bug may also stop the reference; a wrong answer is wanted here
      continue;
    }
    for (const auto& seen : c.expect->must_be_visible) {
      if (!std::binary_search(answer.begin(), answer.end(), seen.triangle)) return c.id;
    }
  }
  return "";
}

}  // namespace clues::validate
