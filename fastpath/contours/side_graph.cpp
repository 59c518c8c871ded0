#include "fastpath/contours/side_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clues::fastpath {
namespace {

double middle(const Interval& x) { return x.inf() / 2 + x.sup() / 2; }

Interval cross2(const FlatBox& a, const FlatBox& b) { return a.x * b.y - a.y * b.x; }
Interval dot2(const FlatBox& a, const FlatBox& b) { return a.x * b.x + a.y * b.y; }

bool is_left_turn(const FlatBox& a, const FlatBox& b) { return filtered_sign(cross2(a, b)) == 1; }

}  // namespace

int longest_axis(const Box3& a, const Box3& b) {
  std::array<double, 3> size{};
  for (int i = 0; i < 3; ++i) {
    const double x = middle(coordinate(a, i)), y = middle(coordinate(b, i));
    size[static_cast<std::size_t>(i)] =
        std::max(x, y) - std::min(x, y);  // however it is rounded, the same from both ends
  }
  return static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
}

JoinedNumbers::JoinedNumbers(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), 0U); }

std::optional<std::vector<std::size_t>> turning_order(const std::vector<FlatBox>& directions) {
  // From the first direction on: less than half a turn, half a turn, more. In a half the sign of the product of two is
  // their order, and is asked of neighbours.
  const FlatBox& first = directions[0];
  std::vector<std::size_t> less, opposite, more;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    switch (filtered_sign(cross2(first, directions[i]))) {
      case 1:
        less.push_back(i);
        break;
      case -1:
        more.push_back(i);
        break;
      default:
        if (filtered_sign(dot2(first, directions[i])) != -1) return std::nullopt;
        opposite.push_back(i);
    }
  }
  if (opposite.size() > 1) return std::nullopt;
  std::vector<double> angles;  // where they begin
  for (const FlatBox& direction : directions) {
    angles.push_back(std::atan2(middle(cross2(first, direction)), middle(dot2(first, direction))));
    if (std::isnan(angles.back())) return std::nullopt;
  }
  for (auto* half : {&less, &more})
    std::sort(half->begin(), half->end(), [&](std::size_t i, std::size_t j) { return angles[i] < angles[j]; });
  std::vector<std::size_t> out{0};
  out.insert(out.end(), less.begin(), less.end());
  out.insert(out.end(), opposite.begin(), opposite.end());
  out.insert(out.end(), more.begin(), more.end());
  // Between the halves it follows, but next to a direction that is nearly opposite.
  for (std::size_t i = 1; i + 1 < out.size(); ++i) {
    const bool between_halves = i == less.size() && opposite.empty();
    if (!between_halves && !is_left_turn(directions[out[i]], directions[out[i + 1]])) return std::nullopt;
  }
  return out;
}

SideGraph::SideGraph(const IntervalSide& drawn)
    : drawn_(&drawn), vertex_(drawn.points.size()), wild_(drawn.points.size(), false) {
  std::iota(vertex_.begin(), vertex_.end(), 0U);
  const auto at = [&](std::size_t p) -> const Box3& { return drawn.points[p].at; };
  const Vec3<Interval> normal = cross(at(1) - at(0), at(2) - at(0));
  int axis = 0;
  const std::array<Interval, 3> of{normal.x, normal.y, normal.z};
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(middle(of[static_cast<std::size_t>(i)])) > std::fabs(middle(of[static_cast<std::size_t>(axis)])))
      axis = i;
  }
  axes_ = {(axis + 1) % 3, (axis + 2) % 3};
  const int turn = filtered_sign(of[static_cast<std::size_t>(axis)]);
  inside_is_left_ = turn == 1;
  if (turn != 1 && turn != -1) wild_.assign(wild_.size(), true);
  std::vector<std::vector<std::uint32_t>> on(3 + drawn.segments.size());
  for (std::uint32_t p = 3; p < drawn.points.size(); ++p) {
    const std::uint32_t lies_on = drawn.points[p].lies_on;
    if (lies_on != 0) on[lies_on - 1].push_back(p);
  }
  for (std::uint32_t k = 0; k < 3; ++k) on_edges_[k] = add_line(k, (k + 1) % 3, on[k], -1, false);
  for (std::uint32_t s = 0; s < drawn.segments.size(); ++s)
    add_line(drawn.segments[s].ends[0], drawn.segments[s].ends[1], on[3 + s], drawn.segments[s].level, false);
  for (const auto& bridge : drawn.bridges) add_line(bridge[0], bridge[1], {}, 0, true);
  // Points that turned out to be one later.
  const auto root = [this](std::uint32_t v) {
    while (vertex_[v] != v) v = vertex_[v];
    return v;
  };
  for (std::uint32_t p = 0; p < vertex_.size(); ++p) {
    const std::uint32_t r = root(p);
    if (wild_[p]) wild_[r] = true;
  }
  for (std::uint32_t p = 0; p < vertex_.size(); ++p) vertex_[p] = root(p);
  for (auto& edge : on_edges_) {
    for (Stop& stop : edge.stops) stop.vertex = vertex_[stop.points[0]];
  }
  outs_.resize(vertex_.size());
  order_.resize(vertex_.size());
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    for (std::size_t i = 0; i < 2; ++i) {
      edges_[e].ends[i] = vertex_[edges_[e].points[i]];
      outs_[edges_[e].ends[i]].push_back({e, i == 0});
    }
  }
  for (std::uint32_t v = 0; v < outs_.size(); ++v) {
    if (wild_[v] || outs_[v].size() < 3) continue;
    order_[v] = in_order(outs_[v]);
    if (!order_[v]) wild_[v] = true;
  }
}

Box3 SideGraph::box_of_vertex(std::uint32_t vertex) const {
  Box3 box = drawn_->points[vertex].at;
  for (std::uint32_t p = 0; p < vertex_.size() && wild_[vertex]; ++p) {
    if (vertex_[p] == vertex) box = hull_of(box, drawn_->points[p].at);
  }
  return box;
}

FlatBox SideGraph::flat(const Box3& at) const { return {coordinate(at, axes_[0]), coordinate(at, axes_[1])}; }

SideGraph::OnEdge SideGraph::add_line(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& between,
                                      int level, bool is_bridge) {
  const auto box = [&](std::uint32_t p) -> const Box3& { return drawn_->points[p].at; };
  const int axis = longest_axis(box(a), box(b));
  const bool up = middle(coordinate(box(a), axis)) < middle(coordinate(box(b), axis));
  const auto place = [&](std::uint32_t p) {
    const Interval& x = coordinate(box(p), axis);
    return up ? x : -x;
  };
  std::vector<std::uint32_t> points = between;
  std::sort(points.begin(), points.end(), [&](std::uint32_t p, std::uint32_t q) {
    const double x = middle(place(p)), y = middle(place(q));
    return x != y ? x < y : p < q;
  });
  points.insert(points.begin(), a);
  points.push_back(b);
  OnEdge line;
  std::vector<Interval> reach;  // of the stops, which ascend
  for (const std::uint32_t p : points) {
    Stop stop{p, {p}};
    Interval x = place(p);
    while (!reach.empty() && !(reach.back().sup() < x.inf())) {  // not known to be before it
      auto& before = line.stops.back();
      stop.points.insert(stop.points.begin(), before.points.begin(), before.points.end());
      x = {std::min(x.inf(), reach.back().inf()), std::max(x.sup(), reach.back().sup())};
      line.stops.pop_back();
      reach.pop_back();
    }
    line.stops.push_back(std::move(stop));
    reach.push_back(x);
  }
  const FlatBox from = flat(box(a)), to = flat(box(b));
  for (std::size_t i = 0; i < line.stops.size(); ++i) {
    const auto& here = line.stops[i].points;
    if (here.size() > 1) {
      const auto root = [this](std::uint32_t v) {
        while (vertex_[v] != v) v = vertex_[v];
        return v;
      };
      for (const std::uint32_t p : here) {
        wild_[p] = true;
        const auto [low, high] = std::minmax({root(here[0]), root(p)});
        vertex_[high] = low;
      }
    }
    if (i == 0) continue;
    line.edges.push_back(static_cast<std::uint32_t>(edges_.size()));
    edges_.push_back(
        {{}, {line.stops[i - 1].points.back(), here[0]}, {to.x - from.x, to.y - from.y}, level, is_bridge});
  }
  return line;
}

FlatBox SideGraph::direction_of(const Out& out) const {
  const FlatBox& d = edges_[out.edge].direction;
  return out.forth ? d : FlatBox{-d.x, -d.y};
}

std::optional<std::vector<SideGraph::Out>> SideGraph::in_order(const std::vector<Out>& outs) const {
  std::vector<FlatBox> directions;
  for (const Out& out : outs) directions.push_back(direction_of(out));
  const auto order = turning_order(directions);
  if (!order) return std::nullopt;
  std::vector<Out> sorted;
  for (const std::size_t i : *order) sorted.push_back(outs[i]);
  return sorted;
}

bool SideGraph::is_outer(std::uint32_t atom) const {
  if (atom >= 2 * edges_.size()) return false;
  return edges_[atom / 2].level == -1 && atom != inner_atom(atom / 2);
}

bool SideGraph::is_used(std::uint32_t atom) const {
  if (atom < 2 * edges_.size()) return !is_outer(atom);
  const auto p = static_cast<std::uint32_t>(atom - 2 * edges_.size());
  return vertex_[p] == p && wild_[p];
}

std::uint64_t SideGraph::wild_count() const {
  std::uint64_t count = 0;
  for (std::uint32_t p = 0; p < vertex_.size(); ++p) count += vertex_[p] == p && wild_[p] ? 1U : 0U;
  return count;
}

void SideGraph::join_faces(int level, std::uint32_t first, JoinedNumbers& joined) const {
  const auto join = [&](std::uint32_t a, std::uint32_t b) { joined.join(first + a, first + b); };
  for (std::uint32_t v = 0; v < outs_.size(); ++v) {
    const auto& outs = order_[v] ? *order_[v] : outs_[v];
    if (wild_[v]) {
      for (const Out& out : outs) {
        for (const std::uint32_t atom : {left_of(out), right_of(out)}) {
          if (!is_outer(atom)) join(atom_of_vertex(v), atom);
        }
      }
      continue;
    }
    for (std::size_t i = 0; i < outs.size(); ++i) join(left_of(outs[i]), right_of(outs[(i + 1) % outs.size()]));
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    if (edges_[e].is_bridge || edges_[e].level > level) join(2 * e, 2 * e + 1);
  }
}

std::vector<std::uint32_t> SideGraph::atoms_towards(std::uint32_t point, const FlatBox& direction, int level) const {
  const std::uint32_t v = vertex_[point];
  if (wild_[v]) return {atom_of_vertex(v)};
  std::vector<FlatBox> directions{direction};
  std::vector<Out> outs;
  for (const Out& out : outs_[v]) {
    if (edges_[out.edge].is_bridge || edges_[out.edge].level > level) continue;
    outs.push_back(out);
    directions.push_back(direction_of(out));
  }
  std::vector<std::uint32_t> atoms;
  const auto order = directions.size() > 2 ? turning_order(directions) : std::nullopt;
  if (order) {
    atoms = {right_of(outs[(*order)[1] - 1])};
  } else {
    for (const Out& out : outs) atoms.insert(atoms.end(), {left_of(out), right_of(out)});
  }
  std::erase_if(atoms, [this](std::uint32_t atom) { return is_outer(atom); });
  if (!atoms.empty()) return atoms;
  // A seed always lights something: what its point has besides.
  for (const Out& out : outs_[v]) {
    for (const std::uint32_t atom : {left_of(out), right_of(out)}) {
      if (!is_outer(atom)) atoms.push_back(atom);
    }
  }
  return atoms;
}

}  // namespace clues::fastpath
