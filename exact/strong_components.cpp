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

}  // namespace clues::exact
