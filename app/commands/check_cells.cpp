// D23: accused is with the inner cell only.
#include "app/commands/check_cells.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "app/whole_level.h"
#include "exact/cell/convex_cell.h"
#include "exact/threads.h"
#include "scene/bakes/bake_deltas.h"
#include "scene/bakes/bake_store.h"
#include "scene/levels/bsp_scene.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "validate/cells/judge_cell.h"
#include "validate/verdicts/judge_report.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;
using Ids = std::vector<std::uint32_t>;

constexpr std::size_t shown_holes = 10;

struct JudgedCell {
  std::string name;
  std::int64_t group = -1;
  std::vector<scene::Point> points;  // W_in
  Ids list;
  validate::CellJudgement judgement;
};

struct Asked {
  std::vector<JudgedCell> cells;
  double far_plane = 0;       // 0: none
  std::uint64_t slivers = 0;  // without an inner cell
};

Asked shipped_with(const scene::BspFile& level, const scene::LevelScene& scene) {
  Asked asked;
  std::map<std::uint32_t, Ids> lists;
  for (auto& leaf : scene::cells_of_level(level)) {
    if (leaf.inner.empty()) {
      ++asked.slivers;
      continue;
    }
    if (!lists.contains(leaf.cluster)) lists[leaf.cluster] = scene::shipped_set(level, scene, leaf.cluster);
    asked.cells.push_back({std::to_string(leaf.leaf), leaf.cluster, std::move(leaf.inner), lists[leaf.cluster], {}});
  }
  return asked;
}

// D23: what an inner cell sees the cell sees, as it lies in it.
void require_inner_within(const scene::BakePlace& cell, const std::string& bake) {
  if (cell.inner.empty()) return;
  const auto outer = exact::ConvexCell::from_doubles(cell.points);
  const bool within = std::all_of(cell.inner.begin(), cell.inner.end(), [&](const scene::Point& p) {
    return outer.contains(exact::Point3(p[0], p[1], p[2]));
  });
  if (!within)
    throw Error(ErrorCode::malformed,
                fmt::format("{}: the inner cell of cell {} is not within it; the store was damaged", bake, cell.name));
}

Asked baked_in(const CheckCellsRequest& request, const std::string& sha256, std::size_t triangles) {
  const scene::FinishedBake bake(request.bake);
  if (bake.plan().scene_sha256 != sha256)
    throw Error(ErrorCode::bad_argument, request.bake + ": is of another scene than " + request.scene);
  // The same bytes, read by another version: its ids may be those of other triangles.
  if (bake.plan().triangles != triangles)
    throw Error(ErrorCode::bad_argument, fmt::format("{}: is of {} triangles, and {} has {}; bake it again",
                                                     request.bake, bake.plan().triangles, request.scene, triangles));
  std::vector<std::vector<std::uint32_t>> lists;
  for (std::uint32_t c = 0; c < bake.plan().cells.size(); ++c) lists.push_back(bake.cell(c).list);
  scene::require_deltas_of_lists(request.bake, lists, bake.plan().triangles);
  Asked asked;
  for (std::uint32_t c = 0; c < bake.plan().cells.size(); ++c) {
    const auto& cell = bake.plan().cells[c];
    require_inner_within(cell, request.bake);
    asked.cells.push_back(
        {cell.name, cell.group, cell.inner.empty() ? cell.points : cell.inner, std::move(lists[c]), {}});
  }
  return asked;
}

// Of lines that no brush stops: whether all sides of hulls let them through.
void confirm(Asked& asked, const WholeLevel& whole, int threads, ProgressBar& bar) {
  std::vector<JudgedCell*> accused;
  std::uint64_t lines = 0, done = 0;
  for (auto& cell : asked.cells) {
    const std::uint64_t found = cell.judgement.holes.size() + cell.judgement.beyond.size();
    if (found == 0) continue;
    accused.push_back(&cell);
    lines += found;
  }
  bar.show("sight lines confirmed", 0, lines);
  std::mutex mutex;
  exact::by_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, accused.size(), [&](std::size_t i) {
      auto& judgement = accused[i]->judgement;
      const auto cell = exact::ConvexCell::from_doubles(accused[i]->points);
      const std::uint64_t asked_here = judgement.holes.size() + judgement.beyond.size();
      for (auto* witnesses : {&judgement.holes, &judgement.beyond}) {
        std::erase_if(*witnesses, [&](const validate::Witness& w) {
          if (whole.is_free_of_hulls(cell, w)) return false;
          judgement.undecided.push_back(w.triangle);
          return true;
        });
      }
      std::sort(judgement.undecided.begin(), judgement.undecided.end());
      const std::lock_guard lock(mutex);
      bar.show("sight lines confirmed", done += asked_here, lines);
    });
  });
}

void judge(Asked& asked, const scene::FlaggedMesh& mesh, const std::optional<scene::BspFile>& level,
           const CheckCellsRequest& request) {
  const fastpath::SeeThroughScene scene(mesh);
  // Only who is accused needs it.
  std::optional<WholeLevel> whole;
  std::once_flag made;
  validate::Accuser accuser;
  accuser.far_plane = asked.far_plane;
  if (level) {
    accuser.accuses = [&](const validate::Witness& w) {
      std::call_once(made, [&] { whole.emplace(*level); });
      return whole->is_free_of_brushes(w);
    };
  }
  const auto judge_one = request.sight_lines_only ? validate::search_cell : validate::judge_cell;
  ProgressBar bar("clues check");
  bar.show("cells", 0, asked.cells.size());
  std::mutex mutex;
  std::uint64_t done = 0;
  exact::by_threads(request.threads, [&] {
    tbb::parallel_for(std::size_t{0}, asked.cells.size(), [&](std::size_t i) {
      auto& cell = asked.cells[i];
      cell.judgement = exact::by_threads(1, [&] { return judge_one(scene, cell.points, cell.list, accuser); });
      const std::lock_guard lock(mutex);
      bar.show("cells", ++done, asked.cells.size());
    });
  });
  if (whole) confirm(asked, *whole, request.threads, bar);
}

struct Hole {
  const JudgedCell* cell;
  const validate::Witness* witness;
  double length;
};

std::vector<Hole> holes_of(const std::vector<JudgedCell>& cells) {
  std::vector<Hole> holes;
  for (const auto& cell : cells) {
    for (const auto& w : cell.judgement.holes) {
      const auto d = w.p - w.v;
      holes.push_back({&cell, &w, std::sqrt(CGAL::to_double(d.squared_length()))});
    }
  }
  std::stable_sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.length > b.length; });
  return holes;
}

struct Totals {
  std::uint64_t listed = 0, ours = 0, witnessed = 0, with_holes = 0, holes = 0, undecided = 0, beyond = 0,
                contradictions = 0, sight_lines = 0, fallbacks = 0;
};

Totals totals_of(const std::vector<JudgedCell>& cells) {
  Totals t;
  for (const auto& cell : cells) {
    const auto& j = cell.judgement;
    t.listed += j.listed;
    t.ours += j.may_be_seen.size();
    t.witnessed += j.witnessed;
    t.with_holes += j.holes.empty() ? 0 : 1;
    t.holes += j.holes.size();
    t.undecided += j.undecided.size();
    t.beyond += j.beyond.size();
    t.contradictions += j.contradictions.size();
    t.sight_lines += j.sight_lines;
    t.fallbacks += j.fallbacks;
  }
  return t;
}

nlohmann::json exact_point(const exact::Point3& p) {
  return {exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())};
}

nlohmann::json json_of(const std::vector<validate::Witness>& witnesses, const scene::FlaggedMesh& mesh) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& w : witnesses) {
    all.push_back({{"triangle", w.triangle},
                   {"part", mesh.name_of(w.triangle)},
                   {"side", w.front ? "front" : "back"},
                   {"v", exact_point(w.v)},
                   {"p", exact_point(w.p)}});
  }
  return all;
}

nlohmann::json json_of(const JudgedCell& cell, const scene::FlaggedMesh& mesh) {
  Ids beyond;
  for (const auto& w : cell.judgement.beyond) beyond.push_back(w.triangle);
  return {{"cell", cell.name},
          {"cluster", cell.group},
          {"points", cell.points},
          {"listed", cell.judgement.listed},
          {"may_be_seen",
           cell.judgement.by_lines_alone ? nlohmann::json() : nlohmann::json(cell.judgement.may_be_seen.size())},
          {"witnessed", cell.judgement.witnessed},
          {"fallbacks", cell.judgement.fallbacks},
          {"holes", json_of(cell.judgement.holes, mesh)},
          {"contradictions", json_of(cell.judgement.contradictions, mesh)},
          {"undecided", cell.judgement.undecided},
          {"beyond", beyond}};
}

std::string json_text(const CheckCellsRequest& request, const std::string& sha256, const Asked& asked,
                      const scene::FlaggedMesh& mesh, const Totals& t) {
  nlohmann::json cells = nlohmann::json::array();
  for (const auto& cell : asked.cells) cells.push_back(json_of(cell, mesh));
  return nlohmann::json{
             {"format", "clues-check-cells/1"},
             {"scene", {{"file", std::filesystem::path(request.scene).filename().string()}, {"sha256", sha256}}},
             {"lists", request.bake.empty() ? "shipped" : std::filesystem::path(request.bake).filename().string()},
             {"cells_without_inner", asked.slivers},
             {"cells_with_holes", t.with_holes},
             {"holes", t.holes},
             {"undecided", t.undecided},
             {"far_plane", asked.far_plane > 0 ? nlohmann::json(asked.far_plane) : nlohmann::json()},
             {"beyond", t.beyond},
             {"contradictions", t.contradictions},
             {"sight_lines", t.sight_lines},
             {"cells", cells}}
             .dump(1) +
         "\n";
}

std::string table_of(const Asked& asked, const scene::FlaggedMesh& mesh, const Totals& t, bool by_lines_alone) {
  const auto cells = static_cast<double>(std::max<std::size_t>(asked.cells.size(), 1));
  const auto average = [&](std::uint64_t n) { return static_cast<double>(n) / cells; };
  std::string text = fmt::format(
      "{:>7}  {:>9}  {:>11}  {:>9}  {:>10}  {:>7}  {:>9}\n{:>7}  {:>9.1f}  {:>11}  {:>9.1f}  {:>10}  {:>7}  {:>9}\n",
      "cells", "listed", "may be seen", "witnessed", "with holes", "holes", "undecided", asked.cells.size(),
      average(t.listed), by_lines_alone ? "-" : fmt::format("{:.1f}", average(t.ours)), average(t.witnessed),
      t.with_holes, t.holes, t.undecided);
  if (t.beyond > 0)
    text += fmt::format(
        "{} missing triangles are not called holes: they are seen, and no sight line to them was found that is not "
        "longer than {}, the far plane\n",
        t.beyond, asked.far_plane);
  if (asked.cells.empty()) text += "no cell was judged\n";
  if (asked.slivers > 0) text += fmt::format("{} slivers without an inner cell were not judged\n", asked.slivers);
  text += fmt::format("{} sight lines decided exactly{}\n", t.sight_lines,
                      by_lines_alone ? ", and nothing else: where they found no hole, nothing is proved" : "");
  if (t.contradictions > 0)
    text += fmt::format(
        "CONTRADICTION: {} triangles that the fast kernel calls hidden are seen; please report this scene (--json has "
        "the sight lines)\n",
        t.contradictions);
  const auto holes = holes_of(asked.cells);
  if (!holes.empty()) text += fmt::format("the longest free sight lines to what is missing, of {}:\n", holes.size());
  for (std::size_t i = 0; i < std::min(holes.size(), shown_holes); ++i) {
    const auto& [cell, w, length] = holes[i];
    text += fmt::format("  cell {}, triangle {} ({}), {:.6g} long:\n    from {}\n    to   {}\n", cell->name,
                        w->triangle, mesh.name_of(w->triangle), length, validate::to_string_exact(w->v),
                        validate::to_string_exact(w->p));
  }
  return text;
}

// What nobody looked at is not fine: a sliver, or a level or bake without cells; and sight lines alone prove no list. Nor does it prove anything that those which were found are too long.
int exit_code_of(const Asked& asked, const Totals& t, bool by_lines_alone) {
  if (t.contradictions > 0) return oracle_contradiction;
  if (t.holes > 0) return findings;
  return by_lines_alone || t.undecided + t.beyond > 0 || asked.slivers > 0 || asked.cells.empty() ? not_everything_ran
                                                                                                  : fine;
}

}  // namespace

void require_far_plane(const std::optional<double>& far_plane) {
  if (far_plane && !(std::isfinite(*far_plane) && *far_plane >= 0))
    throw Error(ErrorCode::bad_argument, "--far-plane: give a distance, or 0 for none");
}

int check_all_cells(const CheckCellsRequest& request) {
  require_far_plane(request.far_plane);
  require_writable_parent(request.json.file());
  require_apart({&request.json.file()}, {&request.scene, &request.bake});
  const auto sha256 = scene::sha256_of_scene(request.scene);
  const auto level = scene::read_level(request.scene);
  if (!level && request.bake.empty())
    throw Error(ErrorCode::bad_argument,
                request.scene + ": no level (.bsp), so no lists were shipped with it; name those to judge with --bake");
  const auto of_level = level ? scene::scene_of_level(*level) : scene::LevelScene{};
  const auto mesh = level ? of_level.scene : scene::read_scene(request.scene);
  Asked asked =
      request.bake.empty() ? shipped_with(*level, of_level) : baked_in(request, sha256, mesh.mesh.triangles.size());
  asked.far_plane = request.far_plane.value_or(request.bake.empty() ? level->far_plane : 0);
  judge(asked, mesh, level, request);
  const Totals totals = totals_of(asked.cells);
  if (request.json.asked()) request.json.write(json_text(request, sha256, asked, mesh, totals));
  if (!request.json.on_stdout()) print(table_of(asked, mesh, totals, request.sight_lines_only));
  return exit_code_of(asked, totals, request.sight_lines_only);
}

}  // namespace clues::app
