#include "fastpath/visibility/refinement/refinement.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "exact/complex/cell_cut.h"
#include "exact/sight/scene_query.h"
#include "exact/threads.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/closure/sight_lines.h"
#include "fastpath/visibility/refinement/adjusted_cut.h"
#include "fastpath/visibility/refinement/area_bounds.h"
#include "fastpath/visibility/scene/mesh_part.h"

namespace clues::fastpath {
namespace {

using exact::ConvexCell;
using Flags = std::vector<bool>;  // by triangle of K

// What the map of a part of V says of the triangles that were asked about.
struct Part {
  ConvexCell cell;
  Flags seen;
  std::vector<LocalRegion> regions;  // visible ones; with areas only
  std::vector<WedgePiece> wedges;    // for the choice of a plane; with backprojection only
  bool mapped = true;                // until then `seen` is what is to be asked about
};

class Refiner {
 public:
  Refiner(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
          const RefinementOptions& refinement)
      : bvh_(bvh),
        options_(options),
        refinement_(refinement),
        sight_tries_(options.dials.sight_tries(refinement.sight_lines)),
        with_areas_(refinement.regions || refinement.tolerance_area > 0),
        whole_(ConvexCell::from_doubles(cell)),
        viewpoints_to_ask_(whole_),
        sight_lines_(bvh, cell, whole_, options.mode) {
    result_.first_order = first_order_visibility(bvh, cell, options, {.regions = with_areas_});
    result_.visible = result_.first_order.visible;
    ids_ = result_.first_order.part;
    mesh_ = mesh_of(bvh.mesh(), ids_);
    complex_ = exact::build_complex(mesh_, &whole_);
    listed_.assign(ids_.size(), false);
    for (const std::uint32_t t : result_.visible) listed_[index_of(t)] = true;
    known_.assign(ids_.size(), false);
    for (std::uint32_t t = 0; t < complex_.pieces.size(); ++t) {
      const auto& c = complex_.pieces[t].corners;
      if (!exact::meets_cell({complex_.points[c[0]], complex_.points[c[1]], complex_.points[c[2]]}, whole_)) continue;
      for (const exact::Origin& o : complex_.pieces[t].origins) known_[o.triangle] = true;
    }
    if (with_areas_) {
      // Regions of K from here on; what is not in K is all hidden.
      std::vector<LocalRegion> regions;
      for (LocalRegion& r : result_.first_order.regions) {
        if (!std::binary_search(ids_.begin(), ids_.end(), r.triangle)) {
          settled_.push_back(std::move(r));
          continue;
        }
        r.triangle = static_cast<std::uint32_t>(index_of(r.triangle));
        regions.push_back(std::move(r));
      }
      areas_.emplace(std::move(regions));
    }
  }

  RefinedVisibility run() {
    find_witnesses({{whole_, listed_, {}, {}}}, sight_tries_);
    if (refinement_.by != RefineBy::cells) refine(true);
    if (refinement_.by != RefineBy::backprojection) refine(false);
    result_.visible.clear();
    for (std::size_t t = 0; t < ids_.size(); ++t) {
      if (listed_[t]) result_.visible.push_back(ids_[t]);
    }
    take_regions();
    return std::move(result_);
  }

 private:
  std::size_t index_of(std::uint32_t id) const {
    return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  }

  void refine(bool backprojection) {
    look_around(0);
    std::vector<Part> parts{first_part(backprojection)};
    note(backprojection, 0, 1);
    for (int depth = 1; depth <= refinement_.max_depth && !done(); ++depth) {
      const Flags open = open_triangles();
      parts = cut_parts(std::move(parts), open, backprojection);
      for (std::size_t t = 0; t < open.size(); ++t) {
        if (!open[t] || known_[t]) continue;
        listed_[t] = std::any_of(parts.begin(), parts.end(), [t](const Part& part) { return part.seen[t]; });
      }
      if (areas_) {
        std::vector<const std::vector<LocalRegion>*> regions;
        for (const Part& part : parts) regions.push_back(&part.regions);
        areas_->restrict_to(regions, open);
      }
      find_witnesses(parts, sight_tries_ / 4);
      look_around(depth);
      note(backprojection, depth, parts.size());
    }
  }

  // All of V. Its map is there already; only backprojection wants to see the wedges.
  Part first_part(bool backprojection) {
    Part part{whole_, listed_, {}, {}};
    if (areas_) {
      part.regions = areas_->regions();
      std::erase_if(part.regions, [](const LocalRegion& r) { return !r.visible; });
    }
    if (backprojection && !done()) {
      part.wedges = make_local_map_in(complex_, whole_, whole_, options_, Flags(ids_.size(), false)).pieces();
      ++maps_;
    }
    return part;
  }

  Flags open_triangles() const {
    Flags open(ids_.size(), false);
    for (std::uint32_t t = 0; t < open.size(); ++t)
      open[t] = listed_[t] && (!known_[t] || (areas_ && areas_->in_doubt(t)));
    return open;
  }

  bool done() const {
    const Flags open = open_triangles();
    if (std::none_of(open.begin(), open.end(), [](bool o) { return o; })) return true;
    return refinement_.tolerance_area > 0 && areas_->in_doubt() <= refinement_.tolerance_area;
  }

  // What a part may see of that.
  bool sees_open(const Part& part, const Flags& open) const {
    for (std::size_t t = 0; t < open.size(); ++t) {
      if (open[t] && part.seen[t] && !known_[t]) return true;
    }
    return areas_ && areas_->reach_doubt(part.regions);
  }

  // Every part that sees something open is replaced by its halves; others that may see open triangles stay.
  std::vector<Part> cut_parts(std::vector<Part> parts, const Flags& open, bool backprojection) {
    std::vector<std::vector<Part>> cut(parts.size());
    tbb::enumerable_thread_specific<SegmentQueries> queries(std::cref(bvh_));
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      Part& part = parts[i];
      std::vector<ConvexCell> cells;
      if (sees_open(part, open)) cells = halves_of(part, open, backprojection, queries.local());
      if (cells.size() < 2) {
        cut[i].push_back(std::move(part));
        return;
      }
      Flags wanted = open;
      for (std::size_t t = 0; t < wanted.size(); ++t) wanted[t] = wanted[t] && part.seen[t];
      for (ConvexCell& cell : cells) cut[i].push_back({std::move(cell), wanted, {}, {}, false});
    });
    std::vector<Part> next;
    std::vector<std::size_t> fresh;
    for (std::vector<Part>& pieces : cut) {
      for (Part& part : pieces) {
        if (!part.mapped) fresh.push_back(next.size());
        next.push_back(std::move(part));
      }
    }
    std::vector<std::uint64_t> fallbacks(fresh.size(), 0);
    tbb::parallel_for(std::size_t{0}, fresh.size(),
                      [&](std::size_t i) { fallbacks[i] = map_part(next[fresh[i]], backprojection); });
    for (const std::uint64_t f : fallbacks) result_.conservative_fallbacks += f;
    maps_ += fresh.size();
    return next;
  }

  std::vector<ConvexCell> halves_of(const Part& part, const Flags& open, bool backprojection,
                                    SegmentQueries& queries) const {
    if (!backprojection) return exact::halves(part.cell);
    const auto plane = choose_cut(part.wedges, part.cell, sight_lines_.cell(), open_places(part, open), queries);
    return plane ? parts_along(part.cell, *plane) : std::vector<ConvexCell>{};
  }

  std::uint64_t map_part(Part& part, bool backprojection) const {
    const LocalMap map = make_local_map_in(complex_, whole_, part.cell, options_, part.seen);
    part.seen.assign(ids_.size(), false);
    for (const std::uint32_t t : map.visible()) part.seen[t] = true;
    if (areas_) {
      part.regions = map.regions();
      std::erase_if(part.regions, [](const LocalRegion& r) { return !r.visible; });
    }
    if (backprojection) part.wedges = map.pieces();
    part.mapped = true;
    return map.counts().conservative_fallbacks + map.conservative_labels();
  }

  // What a plane may gain: with areas the middles of the polygons in doubt, else a grid on each open triangle.
  std::vector<OpenPlace> open_places(const Part& part, const Flags& open) const {
    std::vector<OpenPlace> places;
    if (areas_) {
      for (const LocalRegion& r : areas_->doubtful(part.seen)) {
        Point middle{};
        for (const Point& p : r.outline_estimate) {
          for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<double>(r.outline_estimate.size());
        }
        places.push_back({middle, r.area_estimate});
      }
    } else {
      constexpr int kRows = 8;
      for (std::size_t t = 0; t < open.size(); ++t) {
        if (!open[t] || !part.seen[t]) continue;
        const Corners c = bvh_.corners(ids_[t]);
        for (int i = 0; i <= kRows; ++i) {
          for (int j = 0; i + j <= kRows; ++j) {
            const double u = static_cast<double>(i) / kRows, w = static_cast<double>(j) / kRows;
            OpenPlace place;
            for (std::size_t k = 0; k < 3; ++k) place.at[k] = (1 - u - w) * c[0][k] + u * c[1][k] + w * c[2][k];
            places.push_back(place);
          }
        }
      }
    }
    // Sums of areas are rounded: the same for any order of triangles.
    std::sort(places.begin(), places.end(), [](const OpenPlace& a, const OpenPlace& b) { return a.at < b.at; });
    return places;
  }

  // Sight lines to the open triangles, from the parts that may see them.
  void find_witnesses(const std::vector<Part>& parts, int tries) {
    if (tries == 0) return;
    for (const Part& part : parts) {
      std::vector<std::uint32_t> wanted, ids;
      for (std::uint32_t t = 0; t < ids_.size(); ++t) {
        if (known_[t] || !listed_[t] || !part.seen[t]) continue;
        wanted.push_back(t);
        ids.push_back(ids_[t]);
      }
      if (ids.empty()) continue;
      const auto reached = sight_lines_.reach(ids, sight_lines_.viewpoints(part.cell), tries);
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (reached[i] != 0) known_[wanted[i]] = true;
      }
    }
  }

  // Maps of single points of V (exact::Viewpoints), for which first order is exact: for the lower bound of the areas, and for triangles that no sight line has met.
  void look_around(int depth) {
    if (!areas_ && sight_tries_ == 0) return;
    for (const auto& points : viewpoints_to_ask_.up_to(depth)) add_viewpoints(points);
  }

  void add_viewpoints(const std::vector<exact::Point3>& points) {
    const Flags open = open_triangles();
    if (std::none_of(open.begin(), open.end(), [](bool o) { return o; })) return;
    struct View {
      std::vector<LocalRegion> regions;
      std::vector<std::uint32_t> visible;
    };
    std::vector<std::optional<View>> seen(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
      if (exact::is_touched(complex_, points[i])) return;
      const ConvexCell cell(std::vector<exact::Point3>{points[i]});
      const LocalMap map = make_local_map_in(complex_, whole_, cell, options_, open);
      View view{areas_ ? map.regions() : std::vector<LocalRegion>{}, map.visible()};
      if (map.counts().conservative_fallbacks + map.conservative_labels() == 0) seen[i] = std::move(view);
    });
    for (const auto& view : seen) {
      if (!view) continue;
      ++viewpoints_;
      if (areas_) areas_->witness(view->regions);
      if (sight_tries_ == 0) continue;
      for (const std::uint32_t t : view->visible) known_[t] = true;
    }
  }

  void note(bool backprojection, int depth, std::size_t parts) {
    RefinementFigures f;
    f.backprojection = backprojection;
    f.depth = depth;
    f.parts = parts;
    f.maps = maps_;
    f.viewpoints = viewpoints_;
    for (std::size_t t = 0; t < ids_.size(); ++t) {
      f.visible += listed_[t];
      f.witnessed += listed_[t] && known_[t];
    }
    if (areas_) {
      f.first_order_area = areas_->first_order();
      f.witnessed_area = areas_->witnessed();
      f.refined_area = areas_->refined();
    }
    result_.depths.push_back(f);
  }

  void take_regions() {
    result_.first_order.regions.clear();
    if (!refinement_.regions) return;
    result_.first_order.regions = areas_->regions();
    for (LocalRegion& r : result_.first_order.regions) r.triangle = ids_[r.triangle];
    std::move(settled_.begin(), settled_.end(), std::back_inserter(result_.first_order.regions));
    std::stable_sort(result_.first_order.regions.begin(), result_.first_order.regions.end(),
                     [](const LocalRegion& a, const LocalRegion& b) { return a.triangle < b.triangle; });
  }

  const Bvh& bvh_;
  LocalMapOptions options_;
  RefinementOptions refinement_;
  int sight_tries_;
  bool with_areas_;
  ConvexCell whole_;
  exact::Viewpoints viewpoints_to_ask_;
  SightLines sight_lines_;
  RefinedVisibility result_;
  std::vector<std::uint32_t> ids_;  // K, ascending
  scene::TriangleMesh mesh_;
  exact::Complex complex_;
  Flags listed_, known_;  // still in the PVS; certainly visible
  std::optional<AreaBounds> areas_;
  std::vector<LocalRegion> settled_;  // of triangles outside K
  std::uint64_t maps_ = 0, viewpoints_ = 0;
};

}  // namespace

RefinedVisibility refined_visibility(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                                     const RefinementOptions& refinement) {
  return exact::by_dialed_threads(options.dials.threads, [&] {
    const exact::StandardRange range(bvh.mesh(), cell);
    if (!range.moves()) return Refiner(bvh, cell, options, refinement).run();
    const scene::TriangleMesh mesh = range.moved_in(bvh.mesh());
    const Bvh moved(mesh);
    RefinementOptions in_range = refinement;
    if (refinement.tolerance_area > 0)
      in_range.tolerance_area = std::max(range.area_moved_in(refinement.tolerance_area), 0x1p-1000);
    RefinedVisibility result = Refiner(moved, range.moved_in(cell), options, in_range).run();
    move_back(result.first_order.regions, range);
    for (RefinementFigures& f : result.depths) {
      for (double* area : {&f.first_order_area, &f.witnessed_area, &f.refined_area})
        *area = range.area_moved_back(*area);
    }
    return result;
  });
}

}  // namespace clues::fastpath
