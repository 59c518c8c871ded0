#include "reference/contours/list_contour.h"

#include <algorithm>

#include "scene/stream/varints.h"

namespace clues::reference {

EdgeUsers::EdgeUsers(const scene::TriangleMesh& mesh) : edges_(mesh), users_(edges_.count()) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& users = users_[edge(t, k)];
      if (users.empty() || users.back() != t) users.push_back(t);
    }
  }
}

ListFloods::ListFloods(const EdgeUsers& edges)
    : edges_(&edges), place_(edges.triangle_count(), Place::outside), blocked_(edges.edge_count(), false) {}

void ListFloods::mark(const std::vector<std::uint32_t>& triangles, Place place) {
  for (const std::uint32_t t : triangles) place_[t] = place;
}

void ListFloods::block(const std::vector<std::uint32_t>& boundary, bool blocked) {
  for (const std::uint32_t e : boundary) blocked_[e] = blocked;
}

bool ListFloods::is_boundary(std::uint32_t edge) const {
  const auto& users = edges_->at(edge);
  return std::any_of(users.begin(), users.end(), [this](auto t) { return place_[t] == Place::known; });
}

// Marks what can be reached from the triangle among those that are not outside; they are outside afterwards.
void ListFloods::flood(std::uint32_t from, std::vector<std::uint32_t>& reached) {
  if (place_[from] == Place::outside) return;
  place_[from] = Place::outside;
  std::vector<std::uint32_t> queue{from};
  while (!queue.empty()) {
    const std::uint32_t t = queue.back();
    queue.pop_back();
    reached.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t e = edges_->edge(t, k);
      if (blocked_[e]) continue;
      for (const std::uint32_t next : edges_->at(e)) {
        if (place_[next] == Place::outside) continue;
        place_[next] = Place::outside;
        queue.push_back(next);
      }
    }
  }
}

ListContour ListFloods::contour(const std::vector<std::uint32_t>& known, const std::vector<std::uint32_t>& wanted) {
  mark(known, Place::known);
  mark(wanted, Place::wanted);
  ListContour contour;
  for (const std::uint32_t t : wanted) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t e = edges_->edge(t, k);
      if (blocked_[e] || !is_boundary(e)) continue;
      blocked_[e] = true;
      contour.boundary.push_back(e);
    }
  }
  std::sort(contour.boundary.begin(), contour.boundary.end());
  std::vector<std::uint32_t> reached;
  for (const std::uint32_t t : wanted) {
    if (place_[t] == Place::outside) continue;
    contour.seeds.push_back(t);
    flood(t, reached);
  }
  mark(known, Place::outside);
  block(contour.boundary, false);
  return contour;
}

std::vector<std::uint32_t> ListFloods::list(const std::vector<std::uint32_t>& known, const ListContour& contour) {
  mark(known, Place::known);
  block(contour.boundary, true);
  std::vector<std::uint32_t> reached;
  for (const std::uint32_t t : contour.seeds) flood(t, reached);
  mark(known, Place::outside);
  block(contour.boundary, false);
  std::sort(reached.begin(), reached.end());
  return reached;
}

ListContour list_contour(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                         const std::vector<std::uint32_t>& wanted) {
  return ListFloods(edges).contour(known, wanted);
}

std::vector<std::uint32_t> flooded_list(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                                        const ListContour& contour) {
  return ListFloods(edges).list(known, contour);
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
