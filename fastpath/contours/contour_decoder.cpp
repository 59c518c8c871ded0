#include "fastpath/contours/contour_decoder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "fastpath/contours/side_graph.h"
#include "fastpath/predicates/float_rules.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

// Two atoms of sides that meet along a stretch of an edge of the scene.
struct Meeting {
  std::uint32_t one = 0, other = 0;
  std::vector<int> blocked;  // at these levels
};

// The sides that count, and the atoms of their drawings, with numbers of their own.
class Atlas {
 public:
  Atlas(const SceneEdges& edges, const IntervalDrawings& drawings, std::size_t triangles, bool is_solid)
      : edges_(edges), first_(2 * triangles, none), graph_(2 * triangles, none) {
    graphs_.reserve(drawings.sides().size());
    for (const auto& [side, drawn] : drawings.sides()) {
      graph_[side] = static_cast<std::uint32_t>(graphs_.size());
      graphs_.emplace_back(drawn);
    }
    for (std::uint32_t side = 0; side < 2 * triangles; side += is_solid ? 2 : 1) {
      if (!edges.has_area(side / 2)) continue;
      first_[side] = static_cast<std::uint32_t>(atoms_);
      atoms_ += graph_[side] == none ? 1 : graphs_[graph_[side]].atoms();
    }
    for (std::uint32_t side = 0; side < first_.size(); ++side) {
      for (std::size_t k = 0; k < 3 && first_[side] != none; ++k) {
        const auto beyond = edges.beyond(side, k);
        if (beyond.side > side && first_[beyond.side] != none) meet(side, k, beyond.side, beyond.k);
      }
    }
  }

  std::size_t atoms() const { return atoms_; }
  bool counts(std::uint32_t side) const { return side < first_.size() && first_[side] != none; }
  std::uint32_t first(std::uint32_t side) const { return first_[side]; }
  const SideGraph* graph(std::uint32_t side) const { return graph_[side] == none ? nullptr : &graphs_[graph_[side]]; }
  const std::vector<SideGraph>& graphs() const { return graphs_; }
  const std::vector<Meeting>& meetings() const { return meetings_; }
  std::uint32_t sides() const { return static_cast<std::uint32_t>(first_.size()); }

 private:
  // A stop of a side on the edge, along it.
  struct Place {
    Interval at;
    std::uint32_t number = 0;  // of the point of the scene's edge; 0, 1: its ends
    std::size_t who = 0, stop = 0;
  };
  // One side's part in what follows.
  struct AlongEdge {
    const SideGraph* graph = nullptr;
    std::uint32_t first = 0;
    std::size_t k = 0;
    bool up = true;
    std::vector<std::size_t> group_of;  // of each stop, as they are on the side

    std::size_t stops() const { return graph->on_edge(k).stops.size(); }
    std::uint32_t between(std::size_t stop) const {  // this one and the next
      return first + graph->inner_atom(graph->on_edge(k).edges[stop]);
    }
    // The edge of the side along which groups g and g + 1 follow each other.
    std::uint32_t at_stretch(std::size_t g) const {
      for (std::size_t s = 0; s + 1 < stops(); ++s) {
        const auto [low, high] = std::minmax(group_of[s], group_of[s + 1]);
        if (low <= g && g < high) return between(s);
      }
      return none;  // it has no edge there
    }
    // All that touches the group.
    void add_at(std::size_t g, std::vector<std::uint32_t>& out) const {
      for (std::size_t s = 0; s + 1 < stops(); ++s) {
        const auto [low, high] = std::minmax(group_of[s], group_of[s + 1]);
        if (low <= g && g <= high) out.push_back(between(s));
      }
      for (std::size_t s = 0; s < stops(); ++s) {
        const std::uint32_t v = graph->on_edge(k).stops[s].vertex;
        if (group_of[s] == g && graph->is_wild(v)) out.push_back(first + graph->atom_of_vertex(v));
      }
    }
  };

  void meet(std::uint32_t one, std::size_t k, std::uint32_t other, std::size_t j) {
    if (graph_[one] == none && graph_[other] == none) {
      meetings_.push_back({first_[one], first_[other], {}});
      return;
    }
    // A side without a drawing is one atom all along.
    std::vector<AlongEdge> drawn;
    for (const auto& [side, place] : {std::pair(one, k), std::pair(other, j)}) {
      if (graph_[side] != none)
        drawn.push_back({&graphs_[graph_[side]], first_[side], place, edges_.runs_up(side / 2, place), {}});
    }
    const std::size_t groups = group(drawn);
    const auto atom = [&](std::size_t who, std::size_t g) {
      return who < drawn.size() ? drawn[who].at_stretch(g) : graph_[one] == none ? first_[one] : first_[other];
    };
    for (std::size_t g = 0; g + 1 < groups; ++g) {
      const std::uint32_t a = atom(0, g), b = atom(1, g);
      if (a != none && b != none) meetings_.push_back({a, b, blocked_at(drawn, g)});
    }
    // Where points cannot be told apart nobody knows who meets whom, and nothing is blocked.
    for (std::size_t g = 0; g < groups; ++g) {
      if (!is_unsure_[g]) continue;
      std::vector<std::uint32_t> of_one, of_other;
      drawn[0].add_at(g, of_one);
      if (drawn.size() > 1) {
        drawn[1].add_at(g, of_other);
      } else {
        of_other.push_back(atom(1, g));
      }
      for (const std::uint32_t a : of_one) {
        for (const std::uint32_t b : of_other) meetings_.push_back({a, b, {}});
      }
    }
  }

  // Groups of stops that cannot be told apart, along the edge.
  std::size_t group(std::vector<AlongEdge>& drawn) {
    std::vector<Place> places;
    const Vec3<Interval>& from = drawn[0].graph->drawn().points[drawn[0].k].at;
    const Vec3<Interval>& to = drawn[0].graph->drawn().points[(drawn[0].k + 1) % 3].at;
    const int axis = longest_axis(from, to);  // that of both sides: what is one stop there is in one group here
    for (std::size_t who = 0; who < drawn.size(); ++who) {
      AlongEdge& side = drawn[who];
      side.group_of.assign(side.stops(), 0);
      for (std::size_t s = 0; s < side.stops(); ++s) {
        for (const std::uint32_t p : side.graph->on_edge(side.k).stops[s].points) {
          const DrawnBox& box = side.graph->drawn().points[p];
          const Interval& x = axis == 0 ? box.at.x : axis == 1 ? box.at.y : box.at.z;
          places.push_back({x, p == (side.k + (side.up ? 0 : 1)) % 3 ? 0 : p < 3 ? 1 : box.place, who, s});
        }
      }
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      const double x = a.at.inf() / 2 + a.at.sup() / 2, y = b.at.inf() / 2 + b.at.sup() / 2;
      return x != y ? x < y : a.number < b.number;
    });
    struct Group {
      Interval at;
      std::vector<Place> places;
    };
    std::vector<Group> groups;
    for (const Place& place : places) {
      Group made{place.at, {place}};
      while (!groups.empty() && !(groups.back().at.sup() < made.at.inf())) {
        const Group& before = groups.back();
        made.at = {std::min(made.at.inf(), before.at.inf()), std::max(made.at.sup(), before.at.sup())};
        made.places.insert(made.places.end(), before.places.begin(), before.places.end());
        groups.pop_back();
      }
      groups.push_back(std::move(made));
    }
    is_unsure_.assign(groups.size(), false);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (const Place& place : groups[g].places) {
        drawn[place.who].group_of[place.stop] = g;
        if (place.number != groups[g].places[0].number) is_unsure_[g] = true;
      }
    }
    return groups.size();
  }

  static std::vector<int> blocked_at(const std::vector<AlongEdge>& drawn, std::size_t g) {
    std::vector<int> levels;
    for (const AlongEdge& side : drawn) {
      const auto& stops = side.graph->on_edge(side.k).stops;
      const auto group_of_point = [&](std::uint32_t p) -> std::optional<std::size_t> {
        for (std::size_t s = 0; s < stops.size(); ++s) {
          if (std::find(stops[s].points.begin(), stops[s].points.end(), p) != stops[s].points.end())
            return side.group_of[s];
        }
        return std::nullopt;
      };
      for (const auto& block : side.graph->drawn().blocks) {
        if (block.edge != side.k) continue;
        const auto a = group_of_point(block.ends[0]), b = group_of_point(block.ends[1]);
        if (a && b && std::min(*a, *b) <= g && g < std::max(*a, *b)) levels.push_back(block.level);
      }
    }
    return levels;
  }

  const SceneEdges& edges_;
  std::vector<std::uint32_t> first_, graph_;  // of each side
  std::vector<SideGraph> graphs_;
  std::size_t atoms_ = 0;
  std::vector<Meeting> meetings_;
  std::vector<bool> is_unsure_;  // of the groups of the edge in hand
};

// Where the seed is from its point, flat.
FlatBox direction_of(const scene::ContourSeed& seed, const SideGraph& graph) {
  const auto weight = [&](std::size_t i) -> Interval {
    if (seed.bits != 0) return std::ldexp(static_cast<double>(seed.at[i]), -static_cast<int>(seed.bits));
    return interval_of(seed.fractions[i]);
  };
  const FlatBox a = graph.flat(0), b = graph.flat(1), c = graph.flat(2), from = graph.flat(seed.from);
  const Interval u = weight(0), v = weight(1);
  return {a.x + u * (b.x - a.x) + v * (c.x - a.x) - from.x, a.y + u * (b.y - a.y) + v * (c.y - a.y) - from.y};
}

// What is reached of the known atoms.
std::vector<bool> flooded(const Atlas& atlas, const scene::ContourCell& cell, int level,
                          const std::vector<bool>& known) {
  JoinedNumbers joined(atlas.atoms());
  for (const SideGraph& graph : atlas.graphs()) {
    if (atlas.counts(graph.drawn().side)) graph.join_faces(level, atlas.first(graph.drawn().side), joined);
  }
  for (const Meeting& meeting : atlas.meetings()) {
    const bool blocked = std::find(meeting.blocked.begin(), meeting.blocked.end(), level) != meeting.blocked.end();
    if (!blocked && known[meeting.one] && known[meeting.other]) joined.join(meeting.one, meeting.other);
  }
  std::vector<bool> lit(atlas.atoms(), false);  // by root
  for (const scene::ContourSeed& seed : cell.seeds) {
    if (!atlas.counts(seed.side))
      throw scene::Error(scene::ErrorCode::malformed, "contours: a seed on a triangle that has no area");
    const std::uint32_t first = atlas.first(seed.side);
    const SideGraph* graph = atlas.graph(seed.side);
    if (graph == nullptr) {
      lit[joined.root(first)] = true;
      continue;
    }
    for (const std::uint32_t atom : graph->atoms_towards(seed.from, direction_of(seed, *graph), level))
      lit[joined.root(first + atom)] = true;
  }
  std::vector<bool> reached(atlas.atoms(), false);
  for (std::uint32_t a = 0; a < reached.size(); ++a) reached[a] = known[a] && lit[joined.root(a)];
  return reached;
}

LitRegion::Flat middle_of(const FlatBox& box, double& radius) {
  LitRegion::Flat at{};
  const Interval* const side[2] = {&box.x, &box.y};
  for (std::size_t i = 0; i < 2; ++i) {
    const double low = side[i]->inf(), high = side[i]->sup();
    at[i] = low == high ? low : low / 2 + high / 2;
    radius = std::max({radius, high - at[i], at[i] - low});
  }
  return at;
}

// None: nothing is reached.
std::optional<LitRegion> region_of(std::uint32_t side, const SideGraph* graph, std::uint32_t first,
                                   const std::vector<bool>& reached) {
  LitRegion region;
  region.side = side;
  if (graph == nullptr) return reached[first] ? std::optional(region) : std::nullopt;
  region.axes = graph->axes();
  bool any = false;
  for (std::uint32_t a = 0; a < graph->atoms(); ++a) {
    if (!graph->is_used(a)) continue;
    any |= reached[first + a];
    region.whole &= reached[first + a];
  }
  if (!any) return std::nullopt;
  if (region.whole) return region;
  for (std::uint32_t e = 0; e < graph->edges().size(); ++e) {
    const bool left = !graph->is_outer(2 * e) && reached[first + 2 * e],
               right = !graph->is_outer(2 * e + 1) && reached[first + 2 * e + 1];
    if (left == right) continue;
    const auto& edge = graph->edges()[e];
    const std::size_t from = left ? 0 : 1;
    LitRegion::Border border;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t end = i == 0 ? from : 1 - from;
      border.ends[i] = middle_of(graph->flat(graph->box_of_vertex(edge.ends[end])), border.radius);
      border.points[i] = edge.ends[end];
    }
    region.border.push_back(border);
  }
  for (std::uint32_t v = 0; v < graph->drawn().points.size(); ++v) {
    if (!graph->is_used(graph->atom_of_vertex(v)) || !reached[first + graph->atom_of_vertex(v)]) continue;
    LitRegion::Border border;
    border.ends[0] = border.ends[1] = middle_of(graph->flat(graph->box_of_vertex(v)), border.radius);
    border.points = {v, v};
    region.border.push_back(border);
  }
  return region;
}

}  // namespace

bool LitRegion::may_hold(const scene::Point& point) const {
  if (whole) return true;
  const Flat p{point[static_cast<std::size_t>(axes[0])], point[static_cast<std::size_t>(axes[1])]};
  int turns = 0;
  for (const Border& edge : border) {
    const auto& [a, b] = edge.ends;
    // Roundings, here and of the point, are below 2^-46 of what is added up.
    const double size = std::max({std::fabs(a[0] - p[0]), std::fabs(a[1] - p[1]), std::fabs(b[0] - p[0]),
                                  std::fabs(b[1] - p[1]), std::fabs(p[0]), std::fabs(p[1])});
    const double slack = 2 * edge.radius + 0x1p-46 * size;
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
    const double ahead = dx * (p[0] - a[0]) + dy * (p[1] - a[1]);
    const double turn = dx * (p[1] - a[1]) - dy * (p[0] - a[0]);
    const double before = std::hypot(p[0] - a[0], p[1] - a[1]), behind = std::hypot(p[0] - b[0], p[1] - b[1]);
    if (!std::isfinite(turn) || !std::isfinite(ahead) || before <= slack || behind <= slack) return true;
    if (ahead >= -slack * length && ahead <= length * (length + slack) && std::fabs(turn) <= slack * length)
      return true;
    if ((a[1] <= p[1]) != (b[1] <= p[1])) turns += a[1] <= p[1] ? (turn > 0 ? 1 : 0) : (turn < 0 ? -1 : 0);
  }
  return turns != 0;
}

ContourDecoder::ContourDecoder(const scene::TriangleMesh& mesh) : mesh_(mesh), edges_(mesh) {}

ContourDecoding ContourDecoder::decode(const scene::ContourFile& file, std::uint32_t cell) const {
  require_float_rules();
  if (file.scene_triangles != mesh_.triangles.size() || file.scene_points != mesh_.points.size())
    throw scene::Error(scene::ErrorCode::malformed, "contours: of a scene of another size");
  const RoundedUp rounded_up;
  IntervalDrawings drawings(mesh_, edges_);
  const auto chain = scene::chain_of(file.cells, cell);
  for (std::size_t i = 0; i < chain.size(); ++i) drawings.add(file.cells[chain[i]], static_cast<int>(i));
  const Atlas atlas(edges_, drawings, mesh_.triangles.size(), file.mode == "solid");
  std::vector<bool> reached(atlas.atoms(), true);
  for (std::size_t i = 0; i < chain.size(); ++i)
    reached = flooded(atlas, file.cells[chain[i]], static_cast<int>(i), reached);
  ContourDecoding out;
  out.list = file.cells[cell].besides;
  for (std::uint32_t side = 0; side < atlas.sides(); ++side) {
    if (!atlas.counts(side)) continue;
    if (auto region = region_of(side, atlas.graph(side), atlas.first(side), reached)) {
      out.list.push_back(side / 2);
      out.regions.push_back(std::move(*region));
    }
  }
  std::sort(out.list.begin(), out.list.end());
  out.list.erase(std::unique(out.list.begin(), out.list.end()), out.list.end());
  for (const SideGraph& graph : atlas.graphs()) {
    out.points += graph.drawn().points.size();
    out.wild += graph.wild_count();
  }
  out.unbounded = drawings.unbounded();
  return out;
}

}  // namespace clues::fastpath
