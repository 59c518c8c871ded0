#include "reference/multires/stars/star_complex.h"

#include <algorithm>

namespace clues::reference {
namespace {

bool has_corner(const scene::Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

}  // namespace

StarComplex::StarComplex(const scene::TriangleMesh& surface)
    : triangles_(surface.triangles),
      stars_(surface.points.size()),
      gone_(surface.triangles.size(), false),
      count_(surface.triangles.size()) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const std::uint32_t v : triangles_[t]) stars_[v].push_back(t);
  }
}

Ring StarComplex::ring(std::uint32_t vertex) const {
  struct Spoke {
    std::uint32_t from, to, triangle;
  };
  std::vector<Spoke> spokes;
  for (const std::uint32_t number : stars_[vertex]) {
    const auto& t = triangles_[number];
    const std::size_t k = t[0] == vertex ? 0 : (t[1] == vertex ? 1 : 2);
    spokes.push_back({t[(k + 1) % 3], t[(k + 2) % 3], number});
  }
  const auto that_starts_at = [&](std::uint32_t v) {
    return std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& s) { return s.from == v; });
  };
  Ring ring;
  std::uint32_t start = 0;
  for (const Spoke& s : spokes) {  // an end of an open fan is where nothing leads to
    if (std::none_of(spokes.begin(), spokes.end(), [&](const Spoke& other) { return other.to == s.from; })) {
      ring.open = true;
      start = s.from;
    }
  }
  if (!ring.open) {
    start = spokes.front().from;
    for (const Spoke& s : spokes) start = std::min(start, s.from);
  }
  ring.vertices.push_back(start);
  for (auto s = that_starts_at(start); s != spokes.end(); s = that_starts_at(s->to)) {
    ring.triangles.push_back(s->triangle);
    if (s->to == start) break;
    ring.vertices.push_back(s->to);
  }
  return ring;
}

std::size_t StarComplex::degree(std::uint32_t vertex) const {
  std::vector<std::uint32_t> around;
  for (const std::uint32_t number : stars_[vertex]) {
    for (const std::uint32_t v : triangles_[number]) {
      if (v != vertex && std::find(around.begin(), around.end(), v) == around.end()) around.push_back(v);
    }
  }
  return around.size();
}

bool StarComplex::has_edge(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(stars_[a].begin(), stars_[a].end(), [&](std::uint32_t t) { return has_corner(triangles_[t], b); });
}

bool StarComplex::has_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return std::any_of(stars_[a].begin(), stars_[a].end(),
                     [&](std::uint32_t t) { return has_corner(triangles_[t], b) && has_corner(triangles_[t], c); });
}

std::uint32_t StarComplex::replace(std::uint32_t vertex, const std::vector<scene::Triangle>& triangles) {
  const std::vector<std::uint32_t> old = stars_[vertex];
  for (const std::uint32_t number : old) {
    gone_[number] = true;
    for (const std::uint32_t v : triangles_[number]) std::erase(stars_[v], number);
  }
  const auto first = static_cast<std::uint32_t>(triangles_.size());
  for (const auto& t : triangles) {
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
    gone_.push_back(false);
    for (const std::uint32_t v : t) stars_[v].push_back(number);
  }
  count_ += triangles.size();
  count_ -= old.size();
  return first;
}

std::vector<std::uint32_t> StarComplex::triangles_left() const {
  std::vector<std::uint32_t> left;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!gone_[t]) left.push_back(t);
  }
  return left;
}

}  // namespace clues::reference
