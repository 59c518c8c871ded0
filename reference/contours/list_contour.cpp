#include "reference/contours/list_contour.h"

#include <algorithm>

#include "scene/stream/varints.h"

namespace clues::reference {
namespace {

enum class Place : std::uint8_t { outside, known, wanted };

std::vector<Place> places(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                          const std::vector<std::uint32_t>& wanted) {
  std::vector<Place> out(edges.triangle_count(), Place::outside);
  for (const std::uint32_t t : known) out[t] = Place::known;
  for (const std::uint32_t t : wanted) out[t] = Place::wanted;
  return out;
}

// Marks what can be reached from the triangle among those that are not outside; they are outside afterwards.
void flood(const EdgeUsers& edges, const std::vector<bool>& blocked, std::uint32_t from, std::vector<Place>& place,
           std::vector<std::uint32_t>& reached) {
  if (place[from] == Place::outside) return;
  place[from] = Place::outside;
  std::vector<std::uint32_t> queue{from};
  while (!queue.empty()) {
    const std::uint32_t t = queue.back();
    queue.pop_back();
    reached.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t e = edges.edge(t, k);
      if (blocked[e]) continue;
      for (const std::uint32_t next : edges.at(e)) {
        if (place[next] == Place::outside) continue;
        place[next] = Place::outside;
        queue.push_back(next);
      }
    }
  }
}

}  // namespace

EdgeUsers::EdgeUsers(const scene::TriangleMesh& mesh) : edges_(mesh), users_(edges_.count()) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& users = users_[edge(t, k)];
      if (users.empty() || users.back() != t) users.push_back(t);
    }
  }
}

ListContour list_contour(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                         const std::vector<std::uint32_t>& wanted) {
  std::vector<Place> place = places(edges, known, wanted);
  ListContour contour;
  std::vector<bool> blocked(edges.edge_count(), false);
  for (const std::uint32_t t : wanted) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t e = edges.edge(t, k);
      const auto& users = edges.at(e);
      if (blocked[e] || std::none_of(users.begin(), users.end(), [&](auto u) { return place[u] == Place::known; }))
        continue;
      blocked[e] = true;
      contour.boundary.push_back(e);
    }
  }
  std::sort(contour.boundary.begin(), contour.boundary.end());
  std::vector<std::uint32_t> reached;
  for (const std::uint32_t t : wanted) {
    if (place[t] == Place::outside) continue;
    contour.seeds.push_back(t);
    flood(edges, blocked, t, place, reached);
  }
  return contour;
}

std::vector<std::uint32_t> flooded_list(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                                        const ListContour& contour) {
  std::vector<Place> place = places(edges, known, {});
  std::vector<bool> blocked(edges.edge_count(), false);
  for (const std::uint32_t e : contour.boundary) blocked[e] = true;
  std::vector<std::uint32_t> reached;
  for (const std::uint32_t t : contour.seeds) flood(edges, blocked, t, place, reached);
  std::sort(reached.begin(), reached.end());
  return reached;
}

std::string to_bytes(const ListContour& contour) {
  scene::VarintWriter out;
  for (const auto* list : {&contour.seeds, &contour.boundary}) {
    out.number(list->size());
    std::uint32_t before = 0;
    for (const std::uint32_t x : *list) {
      out.number(x - before);
      before = x;
    }
  }
  return out.bytes;
}

ListContour parse_list_contour(std::string_view bytes, const EdgeUsers& edges) {
  scene::VarintReader in(bytes);
  ListContour contour;
  const auto read = [&in](std::vector<std::uint32_t>& list, std::uint64_t below) {
    std::uint64_t at = 0;
    for (std::uint64_t n = in.number(below + 1); n > 0; --n) {
      at += in.number(below - at);
      list.push_back(static_cast<std::uint32_t>(at));
    }
  };
  read(contour.seeds, edges.triangle_count());
  read(contour.boundary, edges.edge_count());
  if (!in.done()) in.fail();
  return contour;
}

}  // namespace clues::reference
