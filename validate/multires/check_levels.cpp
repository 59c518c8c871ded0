// E1, E2, E3 and E5: the levels, one after the other.
#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "validate/multires/check_hierarchy.h"
#include "validate/multires/level_replay.h"
#include "validate/multires/level_topology.h"

namespace clues::validate {
namespace {

using scene::CarrierPoint;
using scene::KeptFor;
using scene::Removal;
using scene::StarKind;

constexpr std::size_t degree_limit = 12;

struct Whole2 {
  mpz_class x, y;
};
mpz_class turn(const Whole2& a, const Whole2& b, const Whole2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class LevelJudge {
 public:
  LevelJudge(const scene::Hierarchy& hierarchy, HierarchyReport& report)
      : h_(hierarchy),
        report_(report),
        surface_(hierarchy.input.triangles, hierarchy.input.points.size()),
        fixed_(hierarchy.input.points.size(), false),
        gone_(hierarchy.input.points.size(), false),
        features_(hierarchy.features.begin(), hierarchy.features.end()) {
    for (const std::uint32_t v : h_.fixed) fixed_[v] = true;
    for (std::uint32_t v = 0; v < gone_.size(); ++v) {
      pi_.push_back(scene::at_vertex(v));
      at_[v].push_back(v);
    }
  }

  void run() {
    check_features();
    for (const std::uint32_t v : vertices_without_triangle(h_.input.triangles, gone_.size()))
      report_.find("E1", fmt::format("vertex {} of the input has no triangle", v));
    for (level_ = 0; level_ < h_.levels.size(); ++level_) {
      row();
      one_level(h_.levels[level_]);
    }
    row();
    auto base = h_.base;
    for (auto& t : base) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(base.begin(), base.end());
    if (base != surface_.all()) report_.find("E3", "the base domain is not what the levels leave");
    for (std::uint32_t v = 0; v < pi_.size(); ++v) {
      if (v < h_.points.size() && !(h_.points[v].image == pi_[v])) {
        report_.find("E5", fmt::format("vertex {}: its image is not what the levels make of it", v));
      }
    }
  }

 private:
  std::string place(std::uint32_t v) const { return fmt::format("level {}, vertex {}", level_ + 1, v); }

  void check_features() {
    std::vector<int> ends(gone_.size(), 0);
    for (const auto& e : features_) {
      if (!surface_.has_edge(e[0], e[1]))
        report_.find("E2", fmt::format("feature ({}, {}) is no edge of the input", e[0], e[1]));
      ++ends[e[0]];
      ++ends[e[1]];
    }
    for (std::uint32_t v = 0; v < ends.size(); ++v) {
      const bool open = surface_.neighbours(v).size() != surface_.triangles_at(v);
      if (ends[v] != 0 && (ends[v] != 2 || open) && !fixed_[v]) {
        report_.find("E2", fmt::format("vertex {} is an end or a crossing of features and not fixed", v));
      }
    }
  }

  void row() {
    LevelRow out;
    const auto topology = topology_of(surface_.all(), gone_.size());
    if (!topology.defect.empty()) report_.find("E1", fmt::format("level {}: {}", level_, topology.defect));
    // The set holds a triangle once, however often the input has it.
    if (const auto t = triangle_there_twice(level_ == 0 ? h_.input.triangles : surface_.all()))
      report_.find(
          "E1", fmt::format("level {}: two triangles have vertices {}, {} and {}", level_, (*t)[0], (*t)[1], (*t)[2]));
    out.vertices = topology.vertices;
    out.triangles = topology.triangles;
    out.euler = topology.euler();
    out.boundaries = topology.boundaries;
    if (!report_.levels.empty()) {
      const LevelRow& first = report_.levels.front();
      if (out.euler != first.euler || out.boundaries != first.boundaries) {
        report_.find("E1", fmt::format("level {}: Euler number {} and {} boundaries, the input has {} and {}", level_,
                                       out.euler, out.boundaries, first.euler, first.boundaries));
      }
    }
    report_.levels.push_back(out);
  }

  void one_level(const scene::HierarchyLevel& level) {
    std::vector<bool> removed(gone_.size(), false), blocked(gone_.size(), false);
    // The candidates of the level, before anything is removed.
    std::vector<std::uint32_t> candidates;
    LevelRow& row = report_.levels.back();
    for (std::uint32_t v = 0; v < gone_.size(); ++v) {
      if (gone_[v]) continue;
      if (fixed_[v]) {
        ++row.fixed;
      } else if (surface_.neighbours(v).size() >= degree_limit) {
        ++row.high;
      } else {
        candidates.push_back(v);
      }
    }
    for (const Removal& r : level.removals) {
      if (gone_[r.vertex]) report_.find("E2", place(r.vertex) + ": removed twice");
      if (fixed_[r.vertex]) report_.find("E2", place(r.vertex) + ": is fixed, and removed");
      if (blocked[r.vertex]) report_.find("E2", place(r.vertex) + ": a neighbour is removed in the same level");
      if (r.ring.size() >= degree_limit) report_.find("E2", place(r.vertex) + ": has 12 neighbours or more");
      if (removal_fits(r)) replace(r);
      removed[r.vertex] = gone_[r.vertex] = true;
      for (const std::uint32_t w : r.ring) blocked[w] = true;
      ++row.removed;
    }
    std::map<std::uint32_t, KeptFor> reasons;
    for (const auto& k : level.kept) {
      if (!reasons.emplace(k.vertex, k.reason).second)
        report_.find("E2", place(k.vertex) + ": two reasons are given why it stays");
    }
    for (const std::uint32_t v : candidates) {
      if (removed[v]) continue;
      if (blocked[v]) {
        ++row.blocked;
        continue;
      }
      const auto reason = reasons.find(v);
      if (reason == reasons.end()) {
        report_.find("E2", place(v) + ": could be removed, stays, and no reason is given (the level is not maximal)");
        continue;
      }
      check_reason(v, reason->second);
      reasons.erase(reason);
    }
    for (const auto& [v, unused] : reasons)
      report_.find("E2",
                   place(v) + ": a reason is given why it stays, and it is gone, blocked, fixed or of 12 neighbours");
  }

  // The vertices around v as the surface has them now; empty: they are not one path or cycle.
  std::vector<std::uint32_t> ring_of(std::uint32_t v, bool& open) const {
    std::map<std::uint32_t, std::uint32_t> next, previous;
    for (const auto& [a, unused] : surface_.neighbours(v)) {
      for (const auto& [b, unused2] : surface_.neighbours(v)) {
        if (surface_.has({v, a, b})) {
          next[a] = b;
          previous[b] = a;
        }
      }
    }
    if (next.empty()) return {};
    std::uint32_t start = next.begin()->first;
    open = false;
    for (const auto& [a, unused] : next) {
      if (previous.count(a) == 0) {
        start = a;
        open = true;
      }
    }
    std::vector<std::uint32_t> ring{start};
    for (auto at = next.find(start); at != next.end() && at->second != start; at = next.find(at->second)) {
      ring.push_back(at->second);
      if (ring.size() > next.size() + 1) return {};
    }
    return ring.size() == surface_.neighbours(v).size() ? ring : std::vector<std::uint32_t>{};
  }

  std::vector<std::uint32_t> feature_ends(std::uint32_t v) const {
    std::vector<std::uint32_t> ends;
    for (const auto& [w, unused] : surface_.neighbours(v)) {
      if (features_.count(scene::edge_of(v, w)) != 0) ends.push_back(w);
    }
    return ends;
  }

  void check_reason(std::uint32_t v, KeptFor reason) {
    LevelRow& row = report_.levels.back();
    bool open = false;
    const auto ring = ring_of(v, open);
    if (ring.empty()) return report_.find("E2", place(v) + ": a reason is given why it stays, and its star is no fan");
    const auto ends = feature_ends(v);
    std::vector<std::vector<std::uint32_t>> polygons{ring};
    if (!open && ends.size() == 2) {
      auto first = ring;
      std::rotate(first.begin(), std::find(first.begin(), first.end(), ends[0]), first.end());
      const auto second = std::find(first.begin(), first.end(), ends[1]);
      polygons = {{first.begin(), second + 1}, {second, first.end()}};
      polygons[1].push_back(first[0]);
    }
    const bool flat = (open || ends.size() == 2) &&
                      std::any_of(polygons.begin(), polygons.end(), [](const auto& p) { return p.size() < 3; });
    switch (reason) {
      case KeptFor::numbers:
        ++row.kept_numbers;
        return;
      case KeptFor::flat:
        ++row.kept_flat;
        if (!flat) report_.find("E2", place(v) + ": is said to stay for a side of one triangle, which it has not");
        return;
      case KeptFor::link:
        break;
    }
    ++row.kept_link;
    const bool new_edge_free =
        (!open && ends.size() != 2) || flat || !surface_.has_edge(polygons[0].front(), polygons[0].back());
    if (!flat && new_edge_free && std::all_of(polygons.begin(), polygons.end(), [&](const auto& p) {
          return has_free_triangulation(p, surface_);
        })) {
      report_.find("E2", place(v) + ": is said to stay because no triangulation of its hole is free, and one is");
    }
  }

  // Whether star and hole can be exchanged. Findings of E1 and E3.
  bool removal_fits(const Removal& r) {
    const std::size_t n = r.ring.size(), sectors = r.kind == StarKind::boundary ? n - 1 : n;
    const auto wrong = [&](const std::string& what) {
      report_.find("E3", place(r.vertex) + ": " + what);
      return false;
    };
    if (n < 2 || r.flat.size() != n || surface_.neighbours(r.vertex).size() != n ||
        surface_.triangles_at(r.vertex) != sectors) {
      return wrong("its star is not the one that is stated");
    }
    for (std::size_t k = 0; k < sectors; ++k) {
      if (!surface_.has({r.vertex, r.ring[k], r.ring[(k + 1) % n]}))
        return wrong("its star is not the one that is stated");
    }
    const auto ends = feature_ends(r.vertex);
    if (r.kind == StarKind::feature) {
      if (ends.size() != 2 || features_.count(scene::edge_of(r.vertex, r.ring[0])) == 0 ||
          features_.count(scene::edge_of(r.vertex, r.ring[r.across])) == 0) {
        return wrong("the ends of its features are not those stated");
      }
    } else if (!ends.empty()) {
      return wrong("features end at it, and it is removed as if none did");
    }
    std::map<std::uint32_t, Whole2> flat;
    for (std::size_t k = 0; k < n; ++k) flat[r.ring[k]] = {r.flat[k][0], r.flat[k][1]};
    const Whole2 zero{0, 0};
    mpz_class polygon = 0;
    int upward = 0;
    for (std::size_t k = 0; k < sectors; ++k) {
      const Whole2 &p = flat[r.ring[k]], &q = flat[r.ring[(k + 1) % n]];
      const mpz_class area = turn(zero, p, q);
      if (area <= 0) return wrong(fmt::format("sector {} of its flattened star does not turn counter-clockwise", k));
      polygon += area;
      upward += p.y < 0 && q.y >= 0 ? 1 : 0;
    }
    const auto on_axis = [&](std::size_t k, int direction) {
      return r.flat[k][1] == 0 && (direction > 0 ? r.flat[k][0] > 0 : r.flat[k][0] < 0);
    };
    if (upward != (r.kind == StarKind::boundary ? 0 : 1)) return wrong("its flattened star does not go round once");
    if (r.kind == StarKind::boundary && (!on_axis(0, 1) || !on_axis(n - 1, -1)))
      return wrong("it does not lie on its new boundary edge");
    if (r.kind == StarKind::feature && (!on_axis(0, 1) || !on_axis(r.across, -1)))
      return wrong("it does not lie on its new feature edge");

    // The new triangles: their edges are the polygon's, once each, and pairs.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    mpz_class filled = 0;
    for (const auto& t : r.triangles) {
      for (const std::uint32_t v : t) {
        if (flat.count(v) == 0) return wrong("a new triangle has a corner that is not in the ring");
      }
      const mpz_class area = turn(flat[t[0]], flat[t[1]], flat[t[2]]);
      if (area <= 0) return wrong(fmt::format("the new triangle ({}, {}, {}) is not positive", t[0], t[1], t[2]));
      filled += area;
      for (std::size_t k = 0; k < 3; ++k) {
        if (++edges[{t[k], t[(k + 1) % 3]}] > 1) return wrong("two new triangles lie on one side of an edge");
      }
      if (surface_.has_vertices(t)) {
        report_.find("E1",
                     place(r.vertex) + fmt::format(": the new triangle ({}, {}, {}) exists already", t[0], t[1], t[2]));
        return false;
      }
    }
    if (filled != polygon) return wrong("the new triangles do not fill the polygon of its star");
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t a = r.ring[k], b = r.ring[(k + 1) % n];
      if (edges.count({a, b}) == 0 || edges.count({b, a}) != 0)
        return wrong("the new triangles do not end at the ring");
      edges.erase({a, b});
    }
    for (const auto& [edge, unused] : edges) {
      if (edges.count({edge.second, edge.first}) == 0) return wrong("the new triangles leave a gap");
      if (surface_.has_edge(edge.first, edge.second)) {
        report_.find("E1",
                     place(r.vertex) + fmt::format(": the new edge ({}, {}) exists already", edge.first, edge.second));
        return false;
      }
    }
    if (r.kind == StarKind::boundary && surface_.has_edge(r.ring[0], r.ring[n - 1])) {
      report_.find("E1", place(r.vertex) + ": its new boundary edge exists already");
      return false;
    }
    check_delaunay(r, flat);
    if (r.kind == StarKind::feature && edges.count({r.ring[0], r.ring[r.across]}) == 0) {
      return wrong("the new feature edge is none of the new triangles'");
    }
    return true;
  }

  // Every new edge that could be flipped is Delaunay in the disk; of four corners on one circle the lowest is an end of it.
  void check_delaunay(const Removal& r, std::map<std::uint32_t, Whole2>& flat) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> beyond;
    for (const auto& t : r.triangles) {
      for (std::size_t k = 0; k < 3; ++k) beyond[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    }
    for (const auto& [edge, c] : beyond) {
      const auto [a, b] = edge;
      const auto other = beyond.find({b, a});
      if (a > b || other == beyond.end()) continue;
      if (r.kind == StarKind::feature && scene::edge_of(a, b) == scene::edge_of(r.ring[0], r.ring[r.across])) continue;
      const std::uint32_t d = other->second;
      if (surface_.has_edge(c, d) || turn(flat[d], flat[b], flat[c]) <= 0 || turn(flat[d], flat[c], flat[a]) <= 0)
        continue;
      const int inside = circle(flat[a], flat[b], flat[c], flat[d]);
      if (inside > 0 || (inside == 0 && std::min(c, d) < std::min(a, b))) {
        report_.find(
            "E3", place(r.vertex) + fmt::format(": the new edge ({}, {}) is not Delaunay, ({}, {}) would be{}", a, b, c,
                                                d, inside == 0 ? " (four on a circle: the lowest is an end)" : ""));
      }
    }
  }

  static int circle(const Whole2& a, const Whole2& b, const Whole2& c, const Whole2& d) {
    const auto lifted = [&](const Whole2& p) -> mpz_class {
      return (p.x - d.x) * (p.x - d.x) + (p.y - d.y) * (p.y - d.y);
    };
    return sgn(mpz_class(lifted(a) * turn(d, b, c) + lifted(b) * turn(d, c, a) + lifted(c) * turn(d, a, b)));
  }

  void replace(const Removal& r) {
    const std::size_t n = r.ring.size(), sectors = r.kind == StarKind::boundary ? n - 1 : n;
    for (std::size_t k = 0; k < sectors; ++k) surface_.erase({r.vertex, r.ring[k], r.ring[(k + 1) % n]});
    for (const auto& t : r.triangles) surface_.insert(t);
    if (r.kind == StarKind::feature) {
      features_.erase(scene::edge_of(r.vertex, r.ring[0]));
      features_.erase(scene::edge_of(r.vertex, r.ring[r.across]));
      features_.insert(scene::edge_of(r.ring[0], r.ring[r.across]));
    }
    relocate(r);
  }

  // E5: all vertices whose image has the removed one for a corner.
  void relocate(const Removal& r) {
    std::map<std::uint32_t, Whole2> flat;
    for (std::size_t k = 0; k < r.ring.size(); ++k) flat[r.ring[k]] = {r.flat[k][0], r.flat[k][1]};
    flat[r.vertex] = {0, 0};
    const auto moved = std::move(at_[r.vertex]);
    at_.erase(r.vertex);
    for (const std::uint32_t p : moved) {
      if (pi_[p].weight_of(r.vertex) == 0) continue;  // it has left since
      Whole2 q{0, 0};
      for (std::size_t k = 0; k < pi_[p].size(); ++k) {
        const Whole2& corner = flat[pi_[p].corner[k]];
        q.x += corner.x * pi_[p].weight[k];
        q.y += corner.y * pi_[p].weight[k];
      }
      bool found = false;
      for (std::size_t t = 0; t < r.triangles.size() && !found; ++t) found = place_in(r.triangles[t], flat, q, pi_[p]);
      if (!found)
        report_.find("E5",
                     place(r.vertex) + fmt::format(": the image of vertex {} lies in none of the new triangles", p));
      for (std::size_t k = 0; k < pi_[p].size(); ++k) {
        auto& list = at_[pi_[p].corner[k]];
        if (list.empty() || list.back() != p) list.push_back(p);
      }
    }
  }

  // Ratios of areas, rounded down to 2^-60; the rest goes to the largest, of equal ones to the lowest vertex.
  bool place_in(const scene::Triangle& t, std::map<std::uint32_t, Whole2>& flat, const Whole2& q, CarrierPoint& out) {
    const mpz_class unit(scene::whole_weight);
    const auto scaled = [&](std::uint32_t v) { return Whole2{flat[v].x * unit, flat[v].y * unit}; };
    const mpz_class area = turn(flat[t[0]], flat[t[1]], flat[t[2]]);
    std::map<std::uint32_t, mpz_class> weights;
    mpz_class rest = unit;
    bool vanished = false;
    for (std::size_t k = 0; k < 3; ++k) {
      // Twice the area in units of 2^-84 * 2^-84; divided by 2^60 and by the triangle's it is in units of 2^-60.
      const mpz_class part = turn(q, scaled(t[(k + 1) % 3]), scaled(t[(k + 2) % 3]));
      if (part < 0) return false;
      mpz_class weight;
      const mpz_class divisor = area * unit;
      mpz_fdiv_q(weight.get_mpz_t(), part.get_mpz_t(), divisor.get_mpz_t());
      vanished = vanished || (part > 0 && weight == 0);
      weights[t[k]] = weight;
      rest -= weight;
    }
    // Asked only of the triangle that holds the point: another one may be missed by less than 2^-60.
    if (vanished) report_.find("E5", fmt::format("level {}: a weight below 2^-60", level_ + 1));
    auto largest = weights.begin();
    for (auto w = weights.begin(); w != weights.end(); ++w) {
      if (w->second > largest->second) largest = w;
    }
    largest->second += rest;
    out = CarrierPoint{};
    std::size_t used = 0;
    for (const auto& [v, weight] : weights) {
      if (weight == 0) continue;
      out.corner[used] = v;
      out.weight[used++] = weight.get_si();
    }
    return true;
  }

  const scene::Hierarchy& h_;
  HierarchyReport& report_;
  TriangleSet surface_;
  std::vector<bool> fixed_, gone_;
  std::set<scene::Edge> features_;
  std::vector<CarrierPoint> pi_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>
      at_;  // by corner: the vertices whose image has it, or had it
  std::size_t level_ = 0;
};

}  // namespace

void check_levels(const scene::Hierarchy& hierarchy, HierarchyReport& report) { LevelJudge(hierarchy, report).run(); }

}  // namespace clues::validate
