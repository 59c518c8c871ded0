// clues iut: the reference, or a shared library, as an implementation under test: a speaker of docs/protocol.md.

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "exact/cell/convex_cell.h"
#include "exact/threads.h"
#include "fastpath/solids/find_solids.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/see_through.h"
#include "reference/visibility/first_order.h"
#include "scene/messages/error.h"
#include "validate/conform/library_host.h"
#include "validate/conform/server.h"
#include "validate/see_through/layers.h"

namespace clues::app {
namespace {

struct IutRequest {
  std::string kernel, library;
};

// One thread: `clues conform --jobs` starts as many of us as it likes.
// Solid mode is of closed meshes, all of which block (D4).
scene::FlaggedMesh flagged(const validate::Request& request) {
  if (request.mode == validate::CaseMode::solid)
    throw scene::Error(scene::ErrorCode::unsupported, "some triangles do not block or do not count; use mode sheet");
  return {request.mesh, request.blocks, request.counts, {}};
}

std::vector<std::uint32_t> exact_pvs(const validate::Request& request) {
  reference::Options options;
  options.threads = 1;
  options.mode = request.mode == validate::CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet;
  const auto cell = exact::ConvexCell::from_doubles(request.cell);
  const auto list = [&](const scene::TriangleMesh& mesh) {
    return reference::first_order_visibility(mesh, cell, options).visible;
  };
  return request.is_plain() ? list(request.mesh) : validate::visible_in_layers(flagged(request), list);
}

std::vector<std::uint32_t> fast_pvs(const validate::Request& request) {
  fastpath::LocalMapOptions options;
  if (request.mode == validate::CaseMode::solid) {
    fastpath::require_solid(request.mesh);
    options.mode = fastpath::SideMode::solid;
  }
  if (!request.is_plain()) {
    const fastpath::SeeThroughScene scene(flagged(request));
    return exact::by_threads(
        1, [&] { return fastpath::visible_through(scene, request.cell, options).counting(scene.scene()); });
  }
  return exact::by_threads(
      1, [&] { return fastpath::first_order_visibility(fastpath::Bvh(request.mesh), request.cell, options).visible; });
}

// What sees in solid mode sees in sheet mode, so that nothing visible is missing in either.
std::vector<std::uint32_t> solids_pvs(const validate::Request& request) {
  if (request.mode == validate::CaseMode::solid) fastpath::require_solid(request.mesh);
  return fastpath::solids::not_hidden({request.mesh, request.blocks, request.counts, {}}, request.cell);
}

struct Kernel {
  const char *name, *about;
  std::vector<std::uint32_t> (*pvs)(const validate::Request&);
};

constexpr std::array kKernels{Kernel{"exact", "clues first-order reference", exact_pvs},
                              Kernel{"fast", "clues fast path", fast_pvs},
                              Kernel{"solids", "clues, what solids do not hide", solids_pvs}};

void serve_kernel(const std::string& name) {
  const auto kernel = std::find_if(kKernels.begin(), kKernels.end(), [&](const Kernel& k) { return k.name == name; });
  validate::Implementation about;
  about.name = kernel->about;
  about.version = CLUES_VERSION;
  about.language = "C++";
  about.see_through = true;
  validate::serve(std::cin, stdout, about, [&](const validate::Request& request) {
    validate::Answer answer;
    answer.visible = kernel->pvs(request);
    return answer;
  });
}

int run_iut(const IutRequest& request) {
  if (request.kernel.empty() == request.library.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "give one of --kernel and --library (see `clues iut --help`)");
  }
  try {
    if (!request.library.empty()) {
      validate::serve_library(request.library, std::cin);
    } else {
      serve_kernel(request.kernel);
    }
  } catch (const validate::ProtocolError& error) {
    throw scene::Error(scene::ErrorCode::malformed,
                       std::string("standard input: ") + error.what() + "; see docs/protocol.md");
  }
  return fine;
}

}  // namespace

void add_iut_command(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("iut", "Be an implementation under test: speak JSON lines on standard input and output");
  auto request = std::make_shared<IutRequest>();
  std::vector<std::string> names;
  for (const Kernel& kernel : kKernels) names.emplace_back(kernel.name);
  command
      ->add_option("--kernel", request->kernel,
                   "Answer ourselves: exact (the first-order reference), fast, or solids (what walls do not hide)")
      ->check(CLI::IsMember(names));
  command->add_option("--library", request->library, "Answer with the function clues_iut_pvs of a shared library")
      ->type_name("LIB.so");
  command->footer(
      "DESCRIPTION\n"
      "  Speaks docs/protocol.md until it is told to stop or its input ends: the program to look at when writing an "
      "adapter, and the\n"
      "  way in which `clues conform --impl LIB.so` runs a library.\n\n"
      "EXAMPLES\n"
      "  clues conform --impl 'clues iut --kernel exact'\n"
      "  echo '{\"cmd\":\"start\",\"protocol\":1}' | clues iut --kernel exact\n\n"
      "EXIT CODES\n"
      "  0 stopped as told   2 bad usage, a request that is none, or no such library");
  command->callback([request, &status] { status = run_iut(*request); });
}

}  // namespace clues::app
