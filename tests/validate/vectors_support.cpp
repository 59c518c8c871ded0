// The fixture of the tests of validate/vectors/.
#include "tests/validate/vectors_support.h"

#include <fstream>
#include <sstream>

#include "scene/messages/error.h"
#include "validate/vectors/reader.h"
#include "validate/vectors/writer.h"

namespace clues::validate::tests {

const char* const kScreenFile = R"({
  "format": "clues-vectors/1", "topic": "screens", "definition": "D5, T1",
  "source": {"name": "hand", "version": "2026-11", "seed": null, "confirmed_by": "the oracle"},
  "notes": {"Screen": {"bug_type": "METHOD", "description": "A screen hides.", "effect": "None.", "hazards": ["B-27"]}},
  "scenes": {"screen": {
    "vertices": [["-0x1.4p+4", "-0x1.4p+4", "0x1p+2"], ["0x1.4p+4", "-0x1.4p+4", "0x1p+2"], ["0x1.4p+4", "0x1.4p+4", "0x1p+2"],
      ["-0x1.4p+4", "0x1.4p+4", "0x1p+2"], ["-0x1.8p+2", "-0x1p+2", "0x1p+1"], ["0x1.8p+2", "-0x1p+2", "0x1p+1"],
      ["0x0p+0", "0x1p+3", "0x1p+1"], ["-0x1p-1", "-0x1p-1", "0x1.2p+1"], ["0x1p-1", "-0x1p-1", "0x1.2p+1"],
      ["0x0p+0", "0x1p-1", "0x1.2p+1"], ["0x1.2p+3", "0x0p+0", "0x1p+1"], ["0x1.4p+3", "0x0p+0", "0x1p+1"],
      ["0x1.2p+3", "0x1p+0", "0x1p+1"], ["-0x1p+1", "0x0p+0", "-0x1p-3"], ["0x0p+0", "0x0p+0", "-0x1p-3"], ["-0x1p+1", "0x1p+0", "-0x1p-3"]],
    "triangles": [[0, 2, 1], [0, 3, 2], [4, 6, 5], [7, 9, 8], [10, 12, 11], [13, 14, 15], [0, 0, 1]]}},
  "cases": [{
    "id": "screen-hides-what-is-right-behind", "comment": "A screen before a wall.", "flags": ["Screen"], "level": "core",
    "scene": "screen", "mode": "sheet",
    "cell": [["-0x1p-2", "-0x1p-2", "-0x1p-2"], ["0x1p-2", "-0x1p-2", "-0x1p-2"], ["-0x1p-2", "0x1p-2", "-0x1p-2"],
      ["0x1p-2", "0x1p-2", "-0x1p-2"], ["-0x1p-2", "-0x1p-2", "0x0p+0"], ["0x1p-2", "-0x1p-2", "0x0p+0"],
      ["-0x1p-2", "0x1p-2", "0x0p+0"], ["0x1p-2", "0x1p-2", "0x0p+0"]]}]
})";

SuiteFolder::SuiteFolder() {
  auto file = parse_vector_file(kScreenFile, "screens.json", true);
  file.cases[0].expect = Expectation{{{0, false, true, {"0", "0", "-1/8"}, {"10", "-15", "4"}},
                                      {1, false, true, {"0", "0", "-1/8"}, {"-15", "10", "4"}},
                                      {2, false, true, {"0", "0", "-1/8"}, {"0", "0", "2"}},
                                      {4, false, true, {"0", "0", "-1/8"}, {"37/4", "1/4", "2"}},
                                      {5, true, true, {}, {}}},
                                     {{3, UmbraProof::first_order_map}},
                                     {6},
                                     {0, 1, 2, 4, 5}};
  put("screens.json", to_json_text(file));
  VectorIndex index;
  index.cases[file.cases[0].id] = {"screens", false, ""};
  index.topics["screens"] = 1;
  index.active = 1;
  put("index.json", to_json_text(index));
}

std::string SuiteFolder::text(const std::string& file) const {
  std::ifstream in(path() / file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

void SuiteFolder::put(const std::string& file, const std::string& text) const {
  std::ofstream(path() / file, std::ios::binary) << text;
}

void SuiteFolder::spoil(const std::function<void(nlohmann::ordered_json&)>& change, const std::string& file) const {
  auto value = nlohmann::ordered_json::parse(text(file));
  change(value);
  std::string changed = value.dump();
  try {
    changed = to_json_text(parse_vector_file(changed, file, true));
  } catch (const scene::Error&) {  // that is the point
  }
  put(file, changed);
}

}  // namespace clues::validate::tests
