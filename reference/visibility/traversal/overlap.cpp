#include "reference/visibility/traversal/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>
#include <map>
#include <numeric>
#include <set>

#include "reference/visibility/traversal/shaft.h"
#include "reference/visibility/wedges/contour.h"

namespace clues::reference {

using exact::Point3;

namespace {

std::vector<Point3> corners_of(const exact::Complex& complex, std::uint32_t t) {
  const auto& c = complex.pieces[t].corners;
  return {complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]};
}

// Polygons of nodes. Those of one group do not overlap each other.
struct Polygons {
  std::vector<std::vector<Point3>> corners;
  std::vector<std::uint32_t> node, group;
};

void find_arcs(const exact::ConvexCell& cell, const Polygons& polygons, OverlapGraph& graph) {
  std::vector<CGAL::Bbox_3> boxes;
  for (const auto& corners : polygons.corners) {
    boxes.emplace_back();
    for (const Point3& p : corners) boxes.back() += p.bbox();
  }
  const exact::BoxTree tree(std::move(boxes));
  std::set<std::pair<std::uint32_t, std::uint32_t>> arcs;
  for (std::size_t i = 0; i < polygons.corners.size(); ++i) {
    const Shaft shaft(polygons.corners[i], cell);
    for (const std::uint32_t j :
         tree.candidates([&](const CGAL::Bbox_3& b) { return CGAL::do_overlap(b, shaft.box()); })) {
      const std::pair arc(polygons.node[i], polygons.node[j]);
      if (polygons.group[i] == polygons.group[j] || arcs.contains(arc)) continue;
      if (shaft.is_entered_by(polygons.corners[j])) arcs.insert(arc);
    }
  }
  graph.arcs.assign(arcs.begin(), arcs.end());
}

void find_components(OverlapGraph& graph) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS> boost_graph(graph.members.size());
  for (const auto& [from, to] : graph.arcs) boost::add_edge(from, to, boost_graph);
  std::vector<std::uint32_t> found(graph.members.size());
  if (!found.empty()) {
    boost::strong_components(boost_graph,
                             boost::make_iterator_property_map(found.begin(), get(boost::vertex_index, boost_graph)));
  }
  std::map<std::uint32_t, std::uint32_t> renamed;  // by first member
  for (std::uint32_t n = 0; n < found.size(); ++n) {
    const auto [it, fresh] = renamed.try_emplace(found[n], static_cast<std::uint32_t>(graph.components.size()));
    if (fresh) graph.components.emplace_back();
    graph.component.push_back(it->second);
    graph.components[it->second].push_back(n);
  }
}

OverlapGraph graph_of(const exact::SceneQuery& scene, std::vector<std::vector<std::uint32_t>> members) {
  OverlapGraph graph;
  graph.members = std::move(members);
  Polygons polygons;
  for (std::uint32_t n = 0; n < graph.members.size(); ++n) {
    for (const std::uint32_t t : graph.members[n]) {
      polygons.corners.push_back(corners_of(scene.complex(), t));
      polygons.node.push_back(n);
    }
  }
  polygons.group = polygons.node;
  find_arcs(scene.cell(), polygons, graph);
  find_components(graph);
  return graph;
}

}  // namespace

std::vector<std::uint32_t> OverlapGraph::in_front() const {
  std::vector<bool> overlapped(components.size(), false);
  for (const auto& [from, to] : arcs) {
    if (component[from] != component[to]) overlapped[component[from]] = true;
  }
  std::vector<std::uint32_t> found;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (!overlapped[c]) found.push_back(c);
  }
  return found;
}

std::vector<std::uint32_t> OverlapGraph::cyclic() const {
  std::vector<std::uint32_t> found;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (components[c].size() > 1) found.push_back(c);
  }
  return found;
}

OverlapGraph overlap_of_pieces(const exact::SceneQuery& scene, const std::vector<std::uint32_t>& pieces) {
  std::vector<std::vector<std::uint32_t>> members;
  for (const std::uint32_t t : pieces) members.push_back({t});
  return graph_of(scene, std::move(members));
}

OverlapGraph overlap_of_occluders(const exact::SceneQuery& scene) {
  const exact::Complex& complex = scene.complex();
  std::vector<bool> is_contour(complex.edges.size(), false);
  for (const ContourEdge& c : contour_edges(complex, scene.cell())) is_contour[c.edge] = true;
  std::vector<std::uint32_t> parent(complex.pieces.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](std::uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    if (is_contour[e]) continue;
    for (const std::uint32_t t : complex.edges[e].pieces) {
      const std::uint32_t a = root(t), b = root(complex.edges[e].pieces.front());
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;  // the least piece of each
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    if (!complex.in_cell[t]) by_root[root(t)].push_back(t);
  }
  std::vector<std::vector<std::uint32_t>> members;
  for (auto& [r, pieces] : by_root) members.push_back(std::move(pieces));
  return graph_of(scene, std::move(members));
}

std::optional<OverlapGraph> trimmed(const exact::SceneQuery& scene, const OverlapGraph& graph,
                                    std::uint32_t component) {
  OverlapGraph out;
  Polygons parts;
  const auto overlaps = [&](std::uint32_t node, std::uint32_t other) {
    return std::binary_search(graph.arcs.begin(), graph.arcs.end(), std::pair(other, node));
  };
  for (const std::uint32_t node : graph.components[component]) {
    for (const std::uint32_t t : graph.members[node]) {
      std::vector<std::vector<Point3>> of_piece{corners_of(scene.complex(), t)};
      for (const std::uint32_t other : graph.components[component]) {
        if (!overlaps(node, other)) continue;
        for (const std::uint32_t behind : graph.members[other]) {
          const Shaft shaft(corners_of(scene.complex(), behind), scene.cell());
          std::vector<std::vector<Point3>> cut;
          for (const auto& part : of_piece) std::ranges::move(shaft.cut(part), std::back_inserter(cut));
          of_piece = std::move(cut);
          if (parts.corners.size() + of_piece.size() > kMostParts) return std::nullopt;
        }
      }
      for (auto& part : of_piece) {
        parts.corners.push_back(std::move(part));
        parts.node.push_back(static_cast<std::uint32_t>(out.members.size()));
        parts.group.push_back(node);
        out.members.push_back({t});
      }
    }
  }
  find_arcs(scene.cell(), parts, out);
  find_components(out);
  return out;
}

Front pieces_in_front(const exact::SceneQuery& scene, const OverlapGraph& graph) {
  Front front;
  auto& pieces = front.pieces;
  const auto add = [&pieces](const OverlapGraph& g, std::uint32_t component) {
    for (const std::uint32_t n : g.components[component])
      pieces.insert(pieces.end(), g.members[n].begin(), g.members[n].end());
  };
  for (const std::uint32_t c : graph.in_front()) {
    const bool cycle = graph.components[c].size() > 1;
    const auto parts = cycle ? trimmed(scene, graph, c) : std::nullopt;
    front.cycles += cycle;
    front.clusters += cycle && (!parts || !parts->cyclic().empty());
    if (parts) {
      for (const std::uint32_t p : parts->in_front()) add(*parts, p);
    } else {
      add(graph, c);
    }
  }
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return front;
}

std::string to_graphviz(const OverlapGraph& graph, const exact::SceneQuery& scene) {
  const exact::Complex& complex = scene.complex();
  std::string text =
      "// An arc from A to B: B reaches into the shaft between A and the cell. Frames hold cycles.\n"
      "digraph overlap {\n  node [shape=box];\n";
  const auto line = [&](std::uint32_t node, const char* indent) {
    std::set<std::uint32_t> triangles;
    for (const std::uint32_t t : graph.members[node]) {
      for (const exact::Origin& o : complex.pieces[t].origins) triangles.insert(o.triangle);
    }
    std::string names;
    std::size_t listed = 0;
    for (const std::uint32_t t : triangles) {
      if (listed++ == 6) break;
      if (!names.empty()) names += ' ';
      names += std::to_string(t);
    }
    if (triangles.size() > 6) names += fmt::format(" ... ({} in all)", triangles.size());
    text += fmt::format("{}n{} [label=\"{}\"];\n", indent, node, names);
  };
  for (std::uint32_t c = 0; c < graph.components.size(); ++c) {
    if (graph.components[c].size() == 1) {
      line(graph.components[c].front(), "  ");
      continue;
    }
    const auto parts = trimmed(scene, graph, c);
    const char* outcome = !parts                    ? "too large to be trimmed"
                          : parts->cyclic().empty() ? "broken by trimming"
                                                    : "a cluster";
    text += fmt::format("  subgraph cluster_{} {{\n    color=red;\n    label=\"cycle of {}: {}\";\n", c,
                        graph.components[c].size(), outcome);
    for (const std::uint32_t node : graph.components[c]) line(node, "    ");
    text += "  }\n";
  }
  for (const auto& [from, to] : graph.arcs) {
    const bool in_cycle = graph.component[from] == graph.component[to];
    text += fmt::format("  n{} -> n{}{};\n", from, to, in_cycle ? " [color=red]" : "");
  }
  return text + "}\n";
}

}  // namespace clues::reference
