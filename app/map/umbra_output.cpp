#include "app/map/umbra_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/commands.h"
#include "app/common.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/hidden/umbra.h"
#include "scene/messages/error.h"
#include "validate/certificates/umbra_certificate.h"
#include "validate/certificates/umbra_file.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

std::optional<reference::Box> bounds_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (!text.starts_with("box:"))
    throw Error(ErrorCode::bad_argument, "--bounds " + text + ": write box:x0,y0,z0,x1,y1,z1");
  const auto corners = scene::parse_cell(text).points;
  if (corners.size() != 8) throw Error(ErrorCode::bad_argument, "--bounds " + text + ": the box must be solid");
  return reference::Box{exact::to_exact(corners.front()), exact::to_exact(corners.back())};
}

// Whether some triangle meets a cell that has no interior: then parts of it may see past it, and a facet may end inside.
bool stands_in_flat_cell(const scene::TriangleMesh& mesh, const reference::Omega& omega) {
  const exact::ConvexCell cell = omega.map().range.moved_back(omega.map().cell);
  if (cell.dimension() == 3) return false;
  const auto corner = [&](std::uint32_t i) { return exact::to_exact(mesh.points[i]); };
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const scene::Triangle& t) {
    return exact::meets_cell({corner(t[0]), corner(t[1]), corner(t[2])}, cell);
  });
}

}  // namespace

void UmbraRequest::add_to(CLI::App& command) {
  command
      .add_option("--umbra", file,
                  "With --cell: write the hidden space as a closed surface: *.json (exact; for `clues verify`),\n"
                  "*.off or *.ply (rounded)")
      ->type_name("FILE");
  command
      .add_option("--bounds", bounds,
                  "With --umbra: the box that ends what is unbounded; it must hold the cell. Default: three times "
                  "the\nextent of scene and cell")
      ->type_name("box:...");
}

void require_good(const UmbraRequest& request, bool many_cells) {
  if (request.file.empty()) {
    if (!request.bounds.empty()) throw Error(ErrorCode::bad_argument, "--bounds is of --umbra; give that too");
    return;
  }
  if (many_cells) throw Error(ErrorCode::bad_argument, "--umbra is for one cell: use --cell, not --cells");
  const auto extension = fs::path(request.file).extension();
  if (extension != ".json" && extension != ".off" && extension != ".ply")
    throw Error(ErrorCode::bad_argument, request.file + ": an umbra is written as *.json, *.off or *.ply");
  require_writable_parent(request.file);
  bounds_of(request.bounds);
}

reference::Umbra checked_umbra(const reference::Omega& omega, const scene::TriangleMesh& mesh,
                               const std::string& bounds, int threads) {
  reference::Umbra umbra = reference::build_umbra(omega, bounds_of(bounds), threads);
  const auto verdict = validate::check_umbra_certificate(mesh, omega.map().range.moved_back(omega.map().cell),
                                                         validate::record_of(umbra).facets);
  if (verdict.valid) return umbra;
  const std::uint64_t limits = umbra.fallbacks + omega.map().statistics.conservative_fallbacks;
  if (limits > 0)
    throw Unfinished(fmt::format("the umbra is not closed, because {} labels are visible only by a limit: {}", limits,
                                 verdict.reason));
  if (stands_in_flat_cell(mesh, omega))
    throw Unfinished("geometry stands in this cell, which is flat: its umbra has no certificate (" + verdict.reason +
                     ")");
  throw Error(ErrorCode::internal, "the umbra's certificate fails: " + verdict.reason);
}

UmbraOutput make_umbra(const reference::Omega& omega, const scene::FlaggedMesh& scene, const scene::CellSpec& cell,
                       const std::string& scene_path, const std::string& scene_sha256, const UmbraRequest& request,
                       int threads) {
  const auto blocking = scene::blocking_ids(scene);
  validate::UmbraRecord record =
      validate::record_of(checked_umbra(omega, scene::part_of(scene.mesh, blocking), request.bounds, threads));
  for (auto& facet : record.facets) {
    if (facet.triangle) facet.triangle = blocking[*facet.triangle];
  }
  record.scene_file = fs::path(scene_path).filename().string();
  record.scene_sha256 = scene_sha256;
  record.scene_triangles = scene.mesh.triangles.size();
  record.cell = cell.points;
  UmbraOutput out;
  const auto extension = fs::path(request.file).extension();
  out.bytes = extension == ".off"   ? validate::to_off_text(record)
              : extension == ".ply" ? validate::to_ply_text(record)
                                    : validate::to_json_text(record);
  out.summary = fmt::format("umbra: {} facets, volume {:.6g}, certificate verified\n", record.facets.size(),
                            validate::enclosed_volume(record.facets).get_d());
  return out;
}

}  // namespace clues::app
