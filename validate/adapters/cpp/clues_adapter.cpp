// SPDX-License-Identifier: MIT
// Copyright (c) the clues authors. Permission is granted to use, copy, modify and distribute this file under the MIT licence,
// whose text is in vectors/LICENSE; it comes without any warranty.
//
// An adapter for `clues conform`, to copy: JSON lines on standard input and output (docs/protocol.md).
//
//     g++ -std=c++17 -O2 clues_adapter.cpp -o clues_adapter        (Debian: nlohmann-json3-dev)
//     clues conform --impl ./clues_adapter
//
// Replace potentially_visible_set, and what start_reply says about your program.
#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

using Json = nlohmann::json;
using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

struct Case {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;  // vertex numbers
  std::vector<Point> cell;          // the view cell is the convex hull of these points
  std::vector<std::uint32_t> see_through,
      not_counted;     // triangles that sight lines pass; that block and are not asked about
  bool solid = false;  // closed meshes, only front sides can be seen; else both sides of every triangle can
};

// Throw it for input that your program does not support: counted, but no failure.
struct Skip : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// ---------------------------------------------------------------- replace this function ----------------------------------
// The numbers of all triangles that may be visible from some point of the cell. This one lists everything: sound, and as conservative as
// can be.
std::vector<std::uint32_t> potentially_visible_set(const Case& input) {
  std::vector<std::uint32_t> visible;
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t) {
    if (std::find(input.not_counted.begin(), input.not_counted.end(), t) == input.not_counted.end())
      visible.push_back(t);
  }
  return visible;
}
// ------------------------------------------------------------------------------------------------------------------------

Json start_reply() {
  return {
      {"protocol", 1},
      {"implementation", {{"name", "my implementation"}, {"version", "0.1"}, {"language", "C++"}}},
      // input: "float32" if coordinates are stored in single precision: then only such scenes are sent.
      // see_through: true if it knows triangles that do not block or do not count; without it such scenes are not sent.
      {"capabilities", {{"modes", {"sheet", "solid"}}, {"input", "float64"}, {"see_through", true}}}};
}

Json run_reply(const Json& request) {
  Json reply = {{"seq", request.at("seq")}};
  try {
    const Json& test = request.at("case");
    Case input;
    test.at("scene").at("vertices").get_to(input.vertices);
    test.at("scene").at("triangles").get_to(input.triangles);
    if (test.at("scene").contains("see_through")) test.at("scene").at("see_through").get_to(input.see_through);
    if (test.at("scene").contains("not_counted")) test.at("scene").at("not_counted").get_to(input.not_counted);
    test.at("cell").get_to(input.cell);
    input.solid = test.at("mode") == "solid";
    reply["result"] = {{"visible", potentially_visible_set(input)}};
  } catch (const Skip& reason) {
    reply["skipped"] = {{"message", reason.what()}};
  } catch (const std::exception& error) {  // the next case may work
    reply["errored"] = {{"message", error.what()}};
  }
  return reply;
}

// Nothing else may be printed to std::cout; std::cerr is free.
int main() {
  std::string line;
  while (std::getline(std::cin, line)) {
    const Json request = Json::parse(line);
    if (request.at("cmd") == "stop") break;
    std::cout << (request.at("cmd") == "start" ? start_reply() : run_reply(request)).dump() << std::endl;
  }
  return 0;
}
