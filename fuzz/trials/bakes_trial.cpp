// A case is a small scene, one in three with flags (D22). Its cells lie about the cell, by name: a grid, or boxes at random, of which some are flat; they are put into groups, and
// the groups now and then into one more. The fast kernel maps them, in one case of four the exact one, once in the groups and once each alone.
#include "fuzz/trials/bakes_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "exact/kernel.h"
#include "exact/threads.h"
#include "fastpath/bakes/cell_groups.h"
#include "fastpath/visibility/closure/closure.h"
#include "fuzz/findings/case_random.h"
#include "fuzz/generators/built_scenes.h"
#include "fuzz/generators/parts.h"
#include "fuzz/generators/random_scenes.h"
#include "fuzz/trials/cell_space.h"
#include "fuzz/trials/denied_sight.h"
#include "fuzz/trials/random_flags.h"
#include "scene/bakes/bake_store.h"
#include "scene/files/temporary_folder.h"
#include "scene/formats/file_bytes.h"
#include "scene/mesh/bounds.h"
#include "validate/see_through/exact_lister.h"
#include "validate/verdicts/judge_report.h"

namespace clues::fuzz {
namespace {

using fastpath::bakes::CellList;
using fastpath::bakes::CellLister;
using scene::BakePlan;
using scene::BakeStore;
using scene::PlaceKind;
using scene::Point;
using Ids = std::vector<std::uint32_t>;

constexpr const char* list_as_alone = "list-as-alone";
constexpr const char* child_in_parent = "child-in-parent";
constexpr const char* bake_sound = "bake-sound";
constexpr const char* bake_same_bytes = "bake-same-bytes";
constexpr std::size_t most_for_exact = 12;  // triangles
constexpr int lines_of_a_cell = 160;

// As `--cell` takes it.
std::string spec_of(const scene::BakePlace& cell) {
  const auto b = scene::bounds_of(cell.points);
  return fmt::format("box:{},{}", fmt::join(b.low, ","), fmt::join(b.high, ","));
}

// Cells within the box: a grid of up to 3 x 3 x 2, or up to eight boxes of sixteenths of it.
std::vector<scene::BakePlace> cells_within(const scene::Bounds& box, Random& random, bool few) {
  std::vector<scene::BakePlace> cells;
  const auto add_cell = [&](const scene::Bounds& b) {
    cells.push_back({std::to_string(cells.size()), 0, scene::corners_of(b), {}, -1});
  };
  const auto between = [&](std::size_t axis, int at, int of) {
    return at == of ? box.high[axis] : box.low[axis] + (box.high[axis] - box.low[axis]) * at / of;
  };
  if (!random.one_in(3)) {
    std::array<int, 3> n{random.between(1, few ? 2 : 3), random.between(1, few ? 2 : 3),
                         random.between(1, few ? 1 : 2)};
    if (n[0] * n[1] * n[2] == 1) n[0] = 2;
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i)
          add_cell({{between(0, i, n[0]), between(1, j, n[1]), between(2, k, n[2])},
                    {between(0, i + 1, n[0]), between(1, j + 1, n[1]), between(2, k + 1, n[2])}});
      }
    }
    return cells;
  }
  for (int n = random.between(2, few ? 4 : 8); n > 0; --n) {
    scene::Bounds b;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int from = random.between(0, 16), to = random.between(from, 16);
      b.low[axis] = between(axis, from, 16);
      b.high[axis] = between(axis, to, 16);
    }
    add_cell(b);
  }
  return cells;
}

// A node more, around all that there are.
void add_root(BakePlan& plan) {
  std::optional<scene::Bounds> box;
  const auto widen = [&](const std::vector<Point>& points) {
    if (!points.empty()) box = box ? scene::hull_of(*box, scene::bounds_of(points)) : scene::bounds_of(points);
  };
  for (const auto& node : plan.nodes) widen(node.points);
  for (const auto& cell : plan.cells) widen(cell.points);
  for (std::size_t i = 0; i < 3; ++i) {  // the inside of what is flat is in that of the root
    const double by = std::max({box->high[i] - box->low[i], std::abs(box->low[i]), std::abs(box->high[i]), 1.0}) / 8;
    box->low[i] -= by;
    box->high[i] += by;
  }
  plan.nodes.insert(plan.nodes.begin() + 1, {"", 0, scene::corners_of(*box), {}, -1});
  for (std::size_t i = 2; i < plan.nodes.size(); ++i) ++plan.nodes[i].node;
  for (auto& cell : plan.cells) ++cell.node;
}

// Of what does not block, both kernels list all that they cannot prove to be dark or behind another layer (fastpath/visibility/see_through.h, validate/see_through/layers.h); how much that is, depends on what is
// in the scene besides, so that only what blocks has a list of its own (T6).
Ids blocking_of(Ids ids, const scene::FlaggedMesh& scene, Outcome& outcome) {
  const auto passing = std::erase_if(ids, [&](std::uint32_t t) { return !scene.blocking(t); });
  outcome.counters["panes passed over"] += passing;
  return ids;
}

// And what has a point in common with one of these.
Ids with_what_touches(const scene::FlaggedMesh& scene, const Ids& ids) {
  const auto surface_of = [&](std::uint32_t t) {
    const auto& [a, b, c] = scene.mesh.triangles[t];
    return exact::Kernel::Triangle_3(exact::to_exact(scene.mesh.points[a]), exact::to_exact(scene.mesh.points[b]),
                                     exact::to_exact(scene.mesh.points[c]));
  };
  Ids out = ids;
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const auto surface = surface_of(t);
    if (surface.is_degenerate() || std::binary_search(ids.begin(), ids.end(), t)) continue;
    if (std::any_of(ids.begin(), ids.end(), [&](std::uint32_t k) {
          const auto other = surface_of(k);
          return !other.is_degenerate() && CGAL::do_intersect(surface, other);
        }))
      out.push_back(t);
  }
  std::sort(out.begin(), out.end());
  return out;
}

Ids without(const Ids& from, const Ids& what) {
  Ids out;
  std::set_difference(from.begin(), from.end(), what.begin(), what.end(), std::back_inserter(out));
  return out;
}

// All that was mapped, as it stands before the file is written anew.
struct Baked {
  std::vector<scene::BakedPlace> nodes, cells;  // nodes[0] is empty
  std::string bytes;
};

class BakesTrial : public Trial {
 public:
  explicit BakesTrial(BakeMakers makers) : makers_(std::move(makers)) {
    const auto add_generator = [this](const std::string& name, const char* what, auto make) {
      generators_.push_back({name, what, [name, make](std::uint64_t seed, std::uint64_t index) {
                               GeneratedScene made = make(seed, index);
                               Case scene{name, seed, index, std::move(made.mesh), std::move(made.cell), false};
                               Random random = random_for(scene, "flags");
                               if (random.one_in(3)) add_random_flags(scene, random);
                               return scene;
                             }});
    };
    for (const Kind kind : all_kinds)
      add_generator(name_of(kind), "as for clues fuzz; the cells lie about the cell",
                    [kind](std::uint64_t seed, std::uint64_t index) { return generate(kind, seed, index); });
    for (const DegenerateGenerator& g : built_generators()) {
      if (std::string(g.name) == "interiors" || std::string(g.name) == "forests")
        add_generator(g.name, "as for clues fuzz; the cells lie about the cell", g.make);
    }
  }

  const char* what() const override { return "bakes of clues bake: cells in groups (T6), shards, interruptions"; }
  std::vector<NamedGenerator> generators(const GivenScenes&) const override { return generators_; }
  const std::vector<Check>& checks() const override {
    static const std::vector<Check> all{
        {list_as_alone,
         "a cell's list is that of the cell mapped alone, or would be, had its group what touches what it sees",
         {"lists compared", "lists of the exact kernel compared", "cells in a group", "bakes of three levels"}},
        {child_in_parent,
         "what a cell sees alone, its group sees, and what a group sees, the one around it (T6)",
         {"children compared"}},
        {bake_sound,
         "no sight line from a cell shows what its list lacks",
         {"lists searched", "sight lines that end on a surface", "panes crossed"}},
        {bake_same_bytes,
         "shards that are merged, and a bake that was interrupted, leave the same file",
         {"bakes in shards", "bakes interrupted"}}};
    return all;
  }
  bool is_a_mesh(const Case&) const override { return true; }

  void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const override {
    const auto flagged_scene = flagged(scene);
    Random random = random_for(scene, "bakes");
    const bool exact = random.one_in(4) && scene.mesh.triangles.size() <= most_for_exact;
    const BakePlan plan = plan_for(scene, random, exact);
    const auto& maker = exact ? makers_.exact : makers_.fast;
    outcome.counters["bakes of three levels"] += plan.nodes.size() > 2 && plan.nodes[2].node == 1 ? 1 : 0;
    const scene::TemporaryFolder folder;
    const Baked baked = bake_all(flagged_scene, plan, maker, folder.file("whole.bake"));
    const auto whole = maker(flagged_scene);
    const bool by_guesses = !exact && lists_hang_on_guesses(flagged_scene);
    outcome.counters["bakes whose lists hang on guesses"] += by_guesses ? 1 : 0;
    const auto compares = [&](const char* check) { return !by_guesses && is_asked(asked, check); };
    std::vector<CellList> alone;
    if (compares(list_as_alone) || compares(child_in_parent)) {
      for (const auto& cell : plan.cells) alone.push_back(whole->list(cell.points, {}));
    }
    if (compares(list_as_alone)) compare_alone(scene, plan, baked, alone, maker, exact, outcome);
    if (compares(child_in_parent)) compare_parents(scene, plan, baked, *whole, alone, outcome);
    if (is_asked(asked, bake_sound)) search(scene, flagged_scene, plan, baked, outcome);
    if (is_asked(asked, bake_same_bytes))
      compare_bytes(scene, flagged_scene, plan, maker, baked.bytes, folder, random, outcome);
  }

 private:
  BakePlan plan_for(const Case& scene, Random& random, bool few) const {
    BakePlan plan;
    plan.scene_file = "scene.off";
    plan.scene_sha256 = std::string(64, '0');
    plan.triangles = static_cast<std::uint32_t>(scene.mesh.triangles.size());
    plan.question = "{}";
    plan.cells = cells_within(space_for_cells(scene, random), random, few);
    const bool deep = random.one_in(3);
    makers_.add_groups(plan, static_cast<std::size_t>(random.between(2, 5)));
    if (deep) add_root(plan);
    return plan;
  }

  static void bake_into(const scene::FlaggedMesh& scene, const BakePlan& plan, BakeStore& store,
                        const fastpath::bakes::ListerMaker& maker, std::uint32_t shard, std::uint32_t shards,
                        std::uint64_t most) {
    std::atomic<bool> stop{false};
    exact::by_threads(1, [&] {
      fastpath::bakes::bake(scene, plan, store, maker, shard, shards, stop,
                            [&](std::uint64_t cells) { stop = cells >= most; });
    });
  }

  static std::string finished(BakeStore& store, const std::filesystem::path& file) {
    if (!store.has_all_cells()) return "not all cells are in it";
    store.finish();
    return scene::read_file_bytes(file);
  }

  static Baked bake_all(const scene::FlaggedMesh& scene, const BakePlan& plan,
                        const fastpath::bakes::ListerMaker& maker, const std::filesystem::path& file) {
    Baked out;
    BakeStore store(file, plan);
    bake_into(scene, plan, store, maker, 0, 1, std::numeric_limits<std::uint64_t>::max());
    out.nodes.emplace_back();
    for (std::uint32_t i = 1; i < plan.nodes.size(); ++i)
      out.nodes.push_back(store.find(PlaceKind::node, i).value_or(scene::BakedPlace{}));
    for (std::uint32_t i = 0; i < plan.cells.size(); ++i)
      out.cells.push_back(store.find(PlaceKind::cell, i).value_or(scene::BakedPlace{}));
    out.bytes = finished(store, file);
    return out;
  }

  // Where triangles block that do not count, what else the fast kernel lists hangs on what it maps first (closure.h), unless that is all.
  static bool lists_hang_on_guesses(const scene::FlaggedMesh& scene) {
    const Ids blocking = scene::blocking_ids(scene);
    return blocking.size() > fastpath::kMappedWhole &&
           std::any_of(blocking.begin(), blocking.end(), [&](std::uint32_t t) { return !scene.counting(t); });
  }

  // A group's list lacks triangles of which it sees a border and nothing else; T6 has these, too. They touch something that it sees. So where a list is larger than alone, the cell is mapped twice
  // more: in the group's list, which has to give all of it, and with all that touches that list, which has to give what it lists alone.
  static void compare_alone(const Case& scene, const BakePlan& plan, const Baked& baked,
                            const std::vector<CellList>& all_alone, const fastpath::bakes::ListerMaker& maker,
                            bool exact, Outcome& outcome) {
    const auto flagged_scene = flagged(scene);
    std::string wrong;
    for (std::uint32_t c = 0; c < plan.cells.size() && wrong.empty(); ++c) {
      Ids alone = all_alone[c].visible;
      std::erase_if(alone, [&](std::uint32_t t) { return !flagged_scene.counting(t); });
      ++outcome.counters[exact ? "lists of the exact kernel compared" : "lists compared"];
      outcome.counters["cells in a group"] += plan.cells[c].node != 0 ? 1U : 0U;
      const auto less = blocking_of(without(alone, baked.cells[c].list), flagged_scene, outcome),
                 more = blocking_of(without(baked.cells[c].list, alone), flagged_scene, outcome);
      if (less.empty() && more.empty()) continue;
      if (less.empty() && plan.cells[c].node != 0) {
        const auto list_in = [&](const Ids& part) {
          Ids list = maker(scene::part_of(flagged_scene, part))->list(plan.cells[c].points, {}).visible;
          for (auto& t : list) t = part[t];
          return list;
        };
        const auto lacks = [&](const Ids& all, const Ids& list) {
          return !blocking_of(without(list, all), flagged_scene, outcome).empty();
        };
        const Ids& group = baked.nodes[plan.cells[c].node].list;
        const Ids in_group = list_in(group), with_touching = list_in(with_what_touches(flagged_scene, group));
        if (!lacks(in_group, baked.cells[c].list) && !lacks(all_alone[c].visible, with_touching) &&
            !lacks(with_touching, alone)) {
          ++outcome.counters["lists that are larger in a group"];
          continue;
        }
      }
      wrong = fmt::format("cell {}, {}: of what it sees alone the bake lacks [{}], and has [{}] more; fallbacks {}, {}",
                          c, spec_of(plan.cells[c]), fmt::join(less, ", "), fmt::join(more, ", "),
                          all_alone[c].fallbacks, baked.cells[c].fallbacks);
    }
    file(scene, list_as_alone, wrong, outcome);
  }

  static void compare_parents(const Case& scene, const BakePlan& plan, const Baked& baked, const CellLister& whole,
                              const std::vector<CellList>& alone, Outcome& outcome) {
    const auto flagged_scene = flagged(scene);
    std::string wrong;
    const auto compare = [&](const Ids& child, const std::string& name, std::uint32_t parent) {
      if (parent == 0 || !wrong.empty()) return;
      ++outcome.counters["children compared"];
      const auto outside = blocking_of(without(child, baked.nodes[parent].list), flagged_scene, outcome);
      if (!outside.empty())
        wrong =
            fmt::format("{} sees [{}] alone, and node {} around it does not", name, fmt::join(outside, ", "), parent);
    };
    for (std::uint32_t c = 0; c < plan.cells.size(); ++c)
      compare(alone[c].visible, fmt::format("cell {}, {},", c, spec_of(plan.cells[c])), plan.cells[c].node);
    for (std::uint32_t n = 1; n < plan.nodes.size() && wrong.empty(); ++n) {
      if (plan.nodes[n].node != 0)
        compare(whole.list(plan.nodes[n].points, {}).visible, fmt::format("node {}", n), plan.nodes[n].node);
    }
    file(scene, child_in_parent, wrong, outcome);
  }

  static void search(const Case& scene, const scene::FlaggedMesh& flagged_scene, const BakePlan& plan,
                     const Baked& baked, Outcome& outcome) {
    const fastpath::SeeThroughScene trees(flagged_scene);
    for (std::uint32_t c = 0; c < plan.cells.size(); ++c) {
      ++outcome.counters["lists searched"];
      const auto seen = find_denied_sight(trees, plan.cells[c].points, baked.cells[c].list, lines_of_a_cell,
                                          random_for(scene, fmt::format("cell {}", c)), outcome);
      if (!seen) continue;
      return file(
          scene, bake_sound,
          seen->witness
              ? fmt::format("cell {}, {}: triangle {} is not listed, and a free sight line ({}) goes from {} to {}", c,
                            spec_of(plan.cells[c]), seen->triangle, seen->aim,
                            validate::to_string_exact(seen->witness->v), validate::to_string_exact(seen->witness->p))
              : fmt::format("cell {}, {}: triangle {} is not listed, and meets it", c, spec_of(plan.cells[c]),
                            seen->triangle),
          outcome);
    }
  }

  static void compare_bytes(const Case& scene, const scene::FlaggedMesh& flagged_scene, const BakePlan& plan,
                            const fastpath::bakes::ListerMaker& maker, const std::string& bytes,
                            const scene::TemporaryFolder& folder, Random& random, Outcome& outcome) {
    const auto none = std::numeric_limits<std::uint64_t>::max();
    const auto shards = static_cast<std::uint32_t>(random.between(2, 3));
    {
      ++outcome.counters["bakes in shards"];
      for (std::uint32_t i = 0; i < shards; ++i) {
        BakeStore store(folder.file(fmt::format("{}.bake", i)), plan);
        bake_into(flagged_scene, plan, store, maker, i, shards, none);
      }
      BakeStore store(folder.file("merged.bake"), plan);
      for (std::uint32_t i = 0; i < shards; ++i) store.take_from(folder.file(fmt::format("{}.bake", i)));
      if (finished(store, folder.file("merged.bake")) != bytes)
        return file(scene, bake_same_bytes, fmt::format("{} shards, merged, have other bytes", shards), outcome);
    }
    ++outcome.counters["bakes interrupted"];
    const auto most = static_cast<std::uint64_t>(random.between(1, static_cast<int>(plan.cells.size())));
    const auto cut = folder.file("cut.bake");
    {
      BakeStore store(cut, plan);
      bake_into(flagged_scene, plan, store, maker, 0, 1, most);
    }
    BakeStore store(cut, plan);
    bake_into(flagged_scene, plan, store, maker, 0, 1, none);
    if (finished(store, cut) != bytes)
      file(scene, bake_same_bytes, fmt::format("interrupted after {} cells and gone on with, it has other bytes", most),
           outcome);
  }

  BakeMakers makers_;
  std::vector<NamedGenerator> generators_;
};

}  // namespace

BakeMakers our_bake_makers() {
  return {fastpath::bakes::fast_lister(0), validate::exact_lister(), fastpath::bakes::add_groups};
}

std::unique_ptr<Trial> make_bakes_trial(BakeMakers makers) { return std::make_unique<BakesTrial>(std::move(makers)); }
std::unique_ptr<Trial> make_bakes_trial() { return make_bakes_trial(our_bake_makers()); }

}  // namespace clues::fuzz
