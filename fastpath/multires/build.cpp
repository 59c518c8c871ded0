#include "fastpath/multires/build.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <optional>

#include "exact/dials.h"
#include "exact/threads.h"
#include "fastpath/multires/carry.h"
#include "fastpath/multires/vertex_places.h"
#include "fastpath/predicates/float_rules.h"
#include "scene/messages/error.h"

namespace clues::fastpath::multires {
namespace {

using scene::StarKind;

template <class Work>
void for_all(std::size_t count, std::size_t grain, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) work(k);
  });
}

// One way to remove a vertex, as far as it has been looked at.
struct Proposal {
  SurfaceStar star;
  RingEdges joined{};
  DiskLayout layout;
  HoleCover cover;
  int number = 0;        // of the layout
  bool covered = false;  // nothing forbids the cover
};

class Build {
 public:
  Build(const scene::TriangleMesh& mesh, const BuildOptions& options, const std::string& name, BuildCounts& counts)
      : options_(options),
        counts_(counts),
        domain_(mesh, name),
        pieces_(mesh),
        places_(mesh),
        points_(exact::points_for_estimates(mesh)),
        tagged_(mesh.points.size(), {scene::no_vertex, scene::no_vertex}),
        fixed_(mesh.points.size(), 0),
        carriers_([this] { return Carrier(pieces_, hierarchy_.input.triangles); }) {
    hierarchy_.input = mesh;
    sure_ = !exact::process_dials::is_on(exact::process_dials::unsure_doubles);
    add_features();
    for (std::uint32_t v = 0; v < fixed_.size(); ++v) {
      if (fixed_[v] == 0) vertices_.push_back(v);
    }
  }

  scene::Hierarchy run() {
    while (domain_.triangle_count() > options_.base_triangles) {
      scene::HierarchyLevel level = one_level();
      if (level.removals.empty()) break;
      hierarchy_.levels.push_back(std::move(level));
      if (options_.progress) options_.progress(domain_.triangle_count());
    }
    const auto left = domain_.triangles_left();
    for (const std::uint32_t t : left) hierarchy_.base.push_back(domain_.triangles()[t]);
    if (options_.overlay) {
      pieces_.write_to(left, hierarchy_);
    } else {
      places_.write_to(hierarchy_);
    }
    return std::move(hierarchy_);
  }

 private:
  void add_features() {
    const auto fails = [](const std::string& what) {
      throw scene::Error(scene::ErrorCode::bad_argument, "feature: " + what);
    };
    const std::size_t vertices = fixed_.size();
    for (const std::uint32_t v : options_.fixed) {
      if (v >= vertices) fails(fmt::format("vertex {} does not exist", v));
      fixed_[v] = 1;
    }
    auto& features = hierarchy_.features;
    for (const auto& e : options_.features) {
      if (e[0] >= vertices || e[1] >= vertices || e[0] == e[1] || !domain_.has_edge(e[0], e[1]))
        fails(fmt::format("vertices {} and {} are not joined by an edge", e[0], e[1]));
      std::size_t sides = 0;
      for (const std::uint32_t t : domain_.star(e[0])) {
        for (const std::uint32_t v : domain_.triangles()[t]) sides += v == e[1] ? 1U : 0U;
      }
      if (sides == 2) features.push_back(scene::edge_of(e[0], e[1]));  // the boundary stays anyway
    }
    std::sort(features.begin(), features.end());
    features.erase(std::unique(features.begin(), features.end()), features.end());
    std::vector<std::uint32_t> ends(vertices, 0);
    for (const auto& e : features) {
      for (std::size_t k = 0; k < 2; ++k) {
        if (ends[e[k]] < 2) tagged_[e[k]][ends[e[k]]] = e[1 - k];
        ++ends[e[k]];
      }
    }
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if (ends[v] != 0 && (ends[v] != 2 || domain_.is_open(v))) fixed_[v] = 1;
      if (fixed_[v] != 0) hierarchy_.fixed.push_back(v);
    }
  }

  // Ascending by weight; of equal ones by number.
  void find_order() {
    std::erase_if(vertices_, [&](std::uint32_t v) { return domain_.star(v).empty(); });
    // The largest star may be that of a vertex that stays.
    const std::size_t all = points_.size();
    sizes_.resize(all);
    for_all(all, 256, [&](std::size_t v) {
      const auto star = domain_.star(static_cast<std::uint32_t>(v));
      sizes_[v] = star.empty()
                      ? exact::StarSize{}
                      : exact::star_size_estimate(static_cast<std::uint32_t>(v), star, domain_.triangles(), points_);
    });
    exact::StarSize largest;
    for (const auto& size : sizes_) {
      largest.area = std::max(largest.area, size.area);
      largest.kappa = std::max(largest.kappa, size.kappa);
    }
    order_.clear();
    for (const std::uint32_t v : vertices_) order_.emplace_back(exact::removal_weight_estimate(sizes_[v], largest), v);
    tbb::parallel_sort(order_.begin(), order_.end());
  }

  bool cover(Proposal& p) const {
    if (!cover_hole(p.star, p.layout, p.joined, sure_, p.cover)) return false;
    const auto triangles = p.cover.triangles();
    return std::none_of(triangles.begin(), triangles.end(),
                        [&](const scene::Triangle& t) { return domain_.has_face(t[0], t[1], t[2]); });
  }

  // Who is removed if nothing forbids it, with the first layout.
  void prepare() {
    prepared_.clear();
    place_.assign(points_.size(), scene::no_vertex);
    blocked_.assign(points_.size(), 0);
    std::vector<std::uint32_t> likely;
    for (const auto& entry : order_) {
      const std::uint32_t v = entry.second;
      if (blocked_[v] != 0 || !is_low(domain_, v)) continue;
      place_[v] = static_cast<std::uint32_t>(likely.size());
      likely.push_back(v);
      for (const std::uint32_t t : domain_.star(v)) {
        for (const std::uint32_t w : domain_.triangles()[t]) blocked_[w] = 1;
      }
    }
    prepared_.resize(likely.size());
    for_all(likely.size(), 32, [&](std::size_t k) {
      Proposal& p = prepared_[k];
      p.star = star_of(domain_, likely[k], tagged_[likely[k]]);
      const exact::LayoutProposals layouts(p.star.kind, p.star.across, p.star.vertex, p.star.ring(), points_);
      p.number = exact::LayoutProposals::count;
      if (!layouts.possible()) return;
      layouts.lay_out(0, p.layout.of(p.star));
      if (!is_embedded(p.star, p.layout)) return;
      p.number = 0;
      p.joined = ring_edges(domain_, p.star);
      p.covered = cover(p);
    });
  }

  // Goes on where `carried` is true. With `carry`, whether it can be is found out at once.
  std::optional<scene::KeptFor> try_to_remove(std::uint32_t v, bool carry) {
    const std::uint32_t place = place_[v];
    const Proposal* ready = place == scene::no_vertex ? nullptr : &prepared_[place];
    Proposal p;
    if (ready != nullptr && ready->number == 0) {
      p = *ready;
    } else {
      p.star = star_of(domain_, v, tagged_[v]);
      p.number = -1;
    }
    // Within the level only edges between blocked vertices have come.
    std::size_t touched = 0;
    for (const std::uint32_t w : p.star.ring()) touched += blocked_[w];
    const auto joined = touched < 2 && p.number == 0 ? p.joined : ring_edges(domain_, p.star);
    const bool as_before = p.number == 0 && (touched < 2 || joined == p.joined);
    const bool usable = as_before && (touched < 2 || !p.covered || !has_any_face(p.cover));
    p.joined = joined;
    std::optional<exact::LayoutProposals> layouts;
    bool any = false, numbers = false;
    for (int k = 0; k < exact::LayoutProposals::count; ++k) {
      if (k == 0 && p.number == 0) {
        any = true;
        if (!as_before) {
          ++counts_.covered_again;
          p.covered = cover(p);
        } else if (!usable) {
          p.covered = false;
        }
      } else {
        if (!layouts) {
          layouts.emplace(p.star.kind, p.star.across, v, p.star.ring(), points_);
          if (!layouts->possible()) break;
        }
        layouts->lay_out(k, p.layout.of(p.star));
        if (!is_embedded(p.star, p.layout)) continue;
        any = true;
        p.number = k;
        p.covered = cover(p);
      }
      if (!p.covered) continue;
      if (carry && !carry_now(p)) {
        numbers = true;
        continue;
      }
      domain_.replace(v, p.cover.triangles());
      if (p.star.kind == StarKind::feature) {
        const std::uint32_t one = p.star.ring_[0], two = p.star.ring_[p.star.across];
        std::replace(tagged_[one].begin(), tagged_[one].end(), v, two);
        std::replace(tagged_[two].begin(), tagged_[two].end(), v, one);
      }
      for (const std::uint32_t w : p.star.ring()) blocked_[w] = 1;
      chosen_.push_back(p);
      return std::nullopt;
    }
    if (!any) return scene::KeptFor::flat;
    return numbers ? scene::KeptFor::numbers : scene::KeptFor::link;
  }

  bool has_any_face(const HoleCover& cover) const {
    const auto triangles = cover.triangles();
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const scene::Triangle& t) { return domain_.has_face(t[0], t[1], t[2]); });
  }

  void carry(const Proposal& p, Carried& out) {
    if (options_.overlay) {
      carriers_.local().carry(p.star, p.layout, p.cover, out);
    } else {
      places_.carry(p.star, p.layout, p.cover, out);
    }
  }

  // What the first round found out counts, where it was about the same.
  bool carry_now(const Proposal& p) {
    const std::uint32_t first = tried_[p.star.vertex];
    if (first != scene::no_vertex) {
      const Proposal& before = first_chosen_[first];
      const auto a = before.cover.triangles(), b = p.cover.triangles();
      if (before.number == p.number && std::equal(a.begin(), a.end(), b.begin(), b.end())) {
        if (first_carried_[first].done) carried_.push_back(std::move(first_carried_[first]));
        return carried_.size() > chosen_.size();
      }
    }
    Carried out;
    carry(p, out);
    if (!out.done) return false;
    carried_.push_back(std::move(out));
    return true;
  }

  void decide(bool carry, std::vector<scene::Kept>& kept) {
    blocked_.assign(points_.size(), 0);
    chosen_.clear();
    kept.clear();
    for (const auto& entry : order_) {
      const std::uint32_t v = entry.second;
      if (blocked_[v] != 0 || !is_low(domain_, v)) continue;
      if (const auto reason = try_to_remove(v, carry)) kept.push_back({v, *reason});
    }
    std::erase_if(kept, [&](const scene::Kept& k) { return blocked_[k.vertex] != 0; });  // that is reason enough
  }

  void carry_all() {
    carried_.resize(chosen_.size());
    for_all(chosen_.size(), 16, [&](std::size_t k) { carry(chosen_[k], carried_[k]); });
  }

  scene::HierarchyLevel one_level() {
    find_order();
    prepare();
    scene::HierarchyLevel level;
    const auto tagged = hierarchy_.features.empty() ? decltype(tagged_){} : tagged_;
    decide(false, level.kept);
    carry_all();
    if (!std::all_of(carried_.begin(), carried_.end(), [](const Carried& c) { return c.done; })) {
      ++counts_.levels_again;
      domain_.take_back();
      if (!tagged.empty()) tagged_ = tagged;
      first_chosen_ = std::move(chosen_);
      first_carried_ = std::move(carried_);
      chosen_ = {};
      carried_ = {};
      tried_.assign(points_.size(), scene::no_vertex);
      for (std::uint32_t k = 0; k < first_chosen_.size(); ++k) tried_[first_chosen_[k].star.vertex] = k;
      decide(true, level.kept);
    }
    counts_.stars += chosen_.size();
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      if (options_.overlay) {
        pieces_.put(chosen_[k].star.triangles(), carried_[k]);
      } else {
        places_.put(chosen_[k].star, chosen_[k].cover, carried_[k]);
      }
      level.removals.push_back(removal_of(chosen_[k]));
    }
    domain_.end_level();
    pieces_.end_level();
    return level;
  }

  static scene::Removal removal_of(const Proposal& p) {
    const auto ring = p.star.ring();
    const auto flat = p.layout.of(p.star);
    const auto triangles = p.cover.triangles();
    return {p.star.vertex,
            p.star.kind,
            {ring.begin(), ring.end()},
            p.star.across,
            {flat.begin(), flat.end()},
            {triangles.begin(), triangles.end()}};
  }

  const BuildOptions& options_;
  BuildCounts& counts_;
  scene::Hierarchy hierarchy_;
  Domain domain_;
  CommonPieces pieces_;
  VertexPlaces places_;  // without the overlay
  std::vector<scene::Point> points_;
  std::vector<std::array<std::uint32_t, 2>> tagged_;  // of a vertex at which two features end: their other ends
  std::vector<std::uint8_t> fixed_;
  bool sure_ = true;
  tbb::enumerable_thread_specific<Carrier> carriers_;

  // Of a level.
  std::vector<std::uint32_t> vertices_;  // that may be removed
  std::vector<exact::StarSize> sizes_;
  std::vector<std::pair<double, std::uint32_t>> order_;
  std::vector<std::uint8_t> blocked_;
  std::vector<Proposal> prepared_, chosen_, first_chosen_;
  std::vector<std::uint32_t> place_, tried_;  // by vertex: among prepared_ and first_chosen_
  std::vector<Carried> carried_, first_carried_;
};

}  // namespace

scene::Hierarchy build_hierarchy(const scene::TriangleMesh& mesh, const BuildOptions& options, const std::string& name,
                                 BuildCounts* counts) {
  require_float_rules();
  BuildCounts own;
  return exact::by_threads(options.threads,
                           [&] { return Build(mesh, options, name, counts != nullptr ? *counts : own).run(); });
}

}  // namespace clues::fastpath::multires
