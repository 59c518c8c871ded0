// clues delta detail: which detail of what becomes visible goes unseen, by how fast the image moves (FIG. 50A).
#include "app/stream/command_detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "exact/cell/convex_cell.h"
#include "reference/delta/delta.h"
#include "reference/link/retinal_speed.h"
#include "reference/visibility/first_order.h"
#include "scene/cell_spec.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/perception_curve.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct DetailRequest {
  std::string scene, from, to, eye, velocity, curve, errors;
  MethodOptions method;
};

// Numbers with commas between.
std::vector<double> numbers_of(const std::string& text, const char* option, const char* form) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto number = scene::parse_number(std::string_view(text).substr(at, end - at));
    if (number.kind == scene::NumberKind::not_a_number)
      throw Error(ErrorCode::bad_argument, fmt::format("{} {}: give it as {}", option, text, form));
    if (number.kind == scene::NumberKind::non_finite)
      throw Error(ErrorCode::non_finite, fmt::format("{} {}: is not finite", option, text));
    numbers.push_back(number.value);
    at = end + 1;
  }
  return numbers;
}

std::vector<double> three_of(const std::string& text, const char* option) {
  auto numbers = numbers_of(text, option, "X,Y,Z");
  if (numbers.size() != 3) throw Error(ErrorCode::bad_argument, fmt::format("{} {}: give it as X,Y,Z", option, text));
  return numbers;
}

// Of the finest detail 0, and then as given.
std::vector<double> errors_of(const std::string& text) {
  std::vector<double> errors{0};
  for (const double e : numbers_of(text, "--errors", "E,E,...")) {
    if (e <= errors.back())
      throw Error(ErrorCode::bad_argument,
                  "--errors " + text + ": give rising numbers above 0, one for each detail but the finest");
    errors.push_back(e);
  }
  return errors;
}

int run_detail(const DetailRequest& request) {
  const auto options = request.method.to_reference();
  const auto at = three_of(request.eye, "--eye"), velocity = three_of(request.velocity, "--velocity");
  const auto errors = errors_of(request.errors);
  const auto curve = scene::read_perception_curve(request.curve);
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto from = exact::ConvexCell::from_doubles(scene::parse_cell(request.from).points),
             to = exact::ConvexCell::from_doubles(scene::parse_cell(request.to).points);
  const reference::MovingEye eye{{at[0], at[1], at[2]}, {velocity[0], velocity[1], velocity[2]}};
  if (!to.contains(eye.at))  // from the first cell nothing of the packet is seen, so nothing would be proved there
    throw Error(ErrorCode::bad_argument, "--eye " + request.eye + ": is not in the cell of --to");
  const auto plus = reference::packets_of(reference::first_order_visibility(mesh, from, options).visible,
                                          reference::first_order_visibility(mesh, to, options).visible)
                        .plus;
  std::vector<std::size_t> count(errors.size());
  for (const std::uint32_t t : plus) ++count[reference::detail_unseen(curve, eye, mesh, t, errors)];
  std::string text = fmt::format("packet +: {} triangles\ndetail       error  triangles\n", plus.size());
  for (std::size_t k = 0; k < errors.size(); ++k)
    text += fmt::format("{:>6}  {:>10.6g}  {:>9}\n", k, errors[k], count[k]);
  print(text);
  return fine;
}

}  // namespace

void add_delta_detail(CLI::App& delta, int& status) {
  auto* command = delta.add_subcommand("detail", "Which detail of what becomes visible goes unseen by a moving eye");
  auto request = std::make_shared<DetailRequest>();
  const auto required = [&](const char* name, std::string& value, const char* what, const char* type) {
    command->add_option(name, value, what)->type_name(type)->required();
  };
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  required("--from", request->from, "The cell that the viewer leaves", "SPEC");
  required("--to", request->to, "The cell that he enters", "SPEC");
  required("--eye", request->eye, "Where he is as he enters, in the second cell", "X,Y,Z");
  required("--velocity", request->velocity, "How he moves, in units of the scene a second", "X,Y,Z");
  required("--curve", request->curve, "Which error goes unseen at which speed of the image (docs/formats.md)", "FILE");
  required("--errors", request->errors, "How far each coarser detail is from the finest, at most: rising", "E,E,...");
  request->method.add_to(*command);
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  For each triangle of the packet +, the coarsest detail of which it is proved that it goes unseen: the "
          "triangle\n"
          "  moves over the eye at some speed at least, and at that speed, the curve says, so large an error is not "
          "seen.\n"
          "  Detail 0 is the finest. That is of an eye at that place with that velocity: nearer, or slower, it may see "
          "more.\n"
          "  docs/delta.md says what is proved; `clues maps --remesh` makes details with a "
          "proved error.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues delta detail town.obj --from box:0,0,1,1,2,2 --to box:1,0,1,2,2,2 --eye 1,1,1.5 --velocity 8,0,0 "
      "--curve seen.curve --errors 0.01,0.1\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_detail(*request); });
}

}  // namespace clues::app
