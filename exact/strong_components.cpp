#include "exact/strong_components.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace clues::exact {

std::vector<std::vector<std::uint32_t>> circles_of(const std::vector<std::vector<std::uint32_t>>& arcs) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  Graph graph(arcs.size());
  for (std::size_t v = 0; v < arcs.size(); ++v) {
    for (const std::uint32_t w : arcs[v]) boost::add_edge(v, w, graph);
  }
  std::vector<std::size_t> component(arcs.size());
  const std::size_t count = boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), get(boost::vertex_index, graph)));
  std::vector<std::vector<std::uint32_t>> members(count);
  for (std::uint32_t v = 0; v < arcs.size(); ++v) members[component[v]].push_back(v);
  std::erase_if(members, [](const auto& list) { return list.size() < 2; });
  std::sort(members.begin(), members.end());
  return members;
}

// Over the nodes stands a binary tree: an inner one has arcs to both below it, so that an arc to it is one to all nodes below. Children of number j are 2j and 2j + 1, and the
// nodes themselves are the numbers from n on; a range is at most two inner ones of each level.
std::vector<std::vector<std::uint32_t>> circles_of(const std::vector<std::vector<NodeRange>>& arcs) {
  const auto n = static_cast<std::uint32_t>(arcs.size());
  const auto node_of = [n](std::uint32_t number) { return number >= n ? number - n : number + n; };
  std::vector<std::vector<std::uint32_t>> plain(2 * arcs.size());
  for (std::uint32_t j = 1; j < n; ++j) plain[node_of(j)] = {node_of(2 * j), node_of(2 * j + 1)};
  for (std::uint32_t v = 0; v < n; ++v) {
    for (const NodeRange& range : arcs[v]) {
      for (std::uint32_t low = range.begin + n, high = range.end + n; low < high; low /= 2, high /= 2) {
        if (low % 2 != 0) plain[v].push_back(node_of(low++));
        if (high % 2 != 0) plain[v].push_back(node_of(--high));
      }
    }
  }
  std::vector<std::vector<std::uint32_t>> circles = circles_of(plain);
  for (auto& circle : circles) std::erase_if(circle, [n](std::uint32_t v) { return v >= n; });
  std::erase_if(circles, [](const auto& circle) { return circle.size() < 2; });
  return circles;
}

}  // namespace clues::exact
