#include "fastpath/multires/domain.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/messages/error.h"

namespace clues::fastpath::multires {
namespace {

bool is_corner(const scene::Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

}  // namespace

Domain::Domain(const scene::TriangleMesh& mesh, const std::string& name)
    : triangles_(mesh.triangles),
      gone_(mesh.triangles.size(), 0),
      first_of_level_(mesh.triangles.size()),
      count_(mesh.triangles.size()),
      stretches_(mesh.points.size()),
      open_(mesh.points.size(), false) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const auto& c = triangles_[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
      throw scene::Error(scene::ErrorCode::unsupported, fmt::format("{}: triangle {} has a vertex twice", name, t));
    }
    left_.push_back(t);
  }
  lay_out_stars();
  std::vector<std::uint32_t> next(mesh.points.size(), scene::no_vertex);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) check_fan(v, next, name);
}

// One fan at every vertex, over vertices that are all different, is all that D31 asks for: an edge of three triangles, or of two in one direction, is
// a vertex that two triangles of a star lead to or from; two triangles of the same three vertices make a fan of two that closes.
void Domain::check_fan(std::uint32_t vertex, std::vector<std::uint32_t>& next, const std::string& name) {
  const auto fails = [&] {
    throw scene::Error(scene::ErrorCode::unsupported,
                       fmt::format("{}: the triangles at vertex {} are no fan; this is no surface", name, vertex));
  };
  const auto around = star(vertex);
  if (around.empty()) fails();
  const auto spoke = [&](std::uint32_t number) {
    const auto& t = triangles_[number];
    const std::size_t k = t[0] == vertex ? 0 : (t[1] == vertex ? 1 : 2);
    return scene::Edge{t[(k + 1) % 3], t[(k + 2) % 3]};
  };
  // Two ways: who is led to by nobody is where an open fan begins.
  std::uint32_t start = spoke(around[0])[0];
  bool once = true;
  for (const std::uint32_t number : around) {
    const auto [from, to] = spoke(number);
    once = once && next[from] == scene::no_vertex;
    next[from] = to;
  }
  std::size_t begins = 0;
  for (const std::uint32_t number : around) next[spoke(number)[1]] |= 0x80000000U;  // somebody leads there
  for (const std::uint32_t number : around) {
    const std::uint32_t from = spoke(number)[0];
    if ((next[from] & 0x80000000U) == 0) {
      ++begins;
      start = from;
    }
  }
  std::size_t walked = 0;
  std::uint32_t at = start;
  while (walked < around.size() && next[at] != scene::no_vertex) {
    at = next[at] & 0x7fffffffU;
    ++walked;
    if (at == start) break;
  }
  const bool closed = begins == 0, ends = closed ? at == start && walked >= 3 : next[at] == scene::no_vertex;
  for (const std::uint32_t number : around) {
    const auto [from, to] = spoke(number);
    next[from] = next[to] = scene::no_vertex;
  }
  if (!once || begins > 1 || walked != around.size() || !ends) fails();
  open_[vertex] = !closed;
}

bool Domain::has_edge(std::uint32_t a, std::uint32_t b) const {
  const auto around = star(a);
  return std::any_of(around.begin(), around.end(), [&](std::uint32_t t) { return is_corner(triangles_[t], b); });
}

bool Domain::has_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const auto around = star(a);
  return std::any_of(around.begin(), around.end(),
                     [&](std::uint32_t t) { return is_corner(triangles_[t], b) && is_corner(triangles_[t], c); });
}

void Domain::add(std::uint32_t vertex, std::uint32_t triangle) {
  Stretch& s = stretches_[vertex];
  if (s.size == s.room) {
    const std::size_t begin = pool_.size();
    s.room = 2 * s.room + 4;
    pool_.resize(begin + s.room);
    std::copy_n(pool_.begin() + static_cast<std::ptrdiff_t>(s.begin), s.size,
                pool_.begin() + static_cast<std::ptrdiff_t>(begin));
    s.begin = begin;
  }
  pool_[s.begin + s.size++] = triangle;
}

void Domain::replace(std::uint32_t vertex, std::span<const scene::Triangle> closing) {
  const auto old = star(vertex);
  for (const std::uint32_t number : old) {
    gone_[number] = 1;
    taken_.push_back(number);
    for (const std::uint32_t v : triangles_[number]) {
      if (v == vertex) continue;
      Stretch& s = stretches_[v];
      const auto begin = pool_.begin() + static_cast<std::ptrdiff_t>(s.begin), end = begin + s.size;
      std::copy(std::find(begin, end, number) + 1, end, std::find(begin, end, number));
      --s.size;
    }
  }
  count_ += closing.size();
  count_ -= old.size();
  stretches_[vertex].size = 0;
  for (const auto& t : closing) {
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
    gone_.push_back(0);
    for (const std::uint32_t v : t) add(v, number);
  }
}

// With room for two more each: in a level vertices around those removed lose about as many triangles as they gain.
void Domain::lay_out_stars() {
  for (Stretch& s : stretches_) s = {};
  for (const std::uint32_t t : left_) {
    for (const std::uint32_t v : triangles_[t]) ++stretches_[v].room;
  }
  std::size_t used = 0;
  for (Stretch& s : stretches_) {
    s.begin = used;
    if (s.room > 0) s.room += 2;
    used += s.room;
  }
  pool_.assign(used, 0);
  for (const std::uint32_t t : left_) {
    for (const std::uint32_t v : triangles_[t]) add(v, t);
  }
}

void Domain::end_level() {
  left_ = triangles_left();
  taken_.clear();
  first_of_level_ = triangles_.size();
  lay_out_stars();
}

void Domain::take_back() {
  for (const std::uint32_t t : taken_) gone_[t] = 0;
  taken_.clear();
  triangles_.resize(first_of_level_);
  gone_.resize(first_of_level_);
  count_ = left_.size();
  lay_out_stars();
}

std::vector<std::uint32_t> Domain::triangles_left() const {
  std::vector<std::uint32_t> out;
  out.reserve(count_);
  for (const std::uint32_t t : left_) {
    if (gone_[t] == 0) out.push_back(t);
  }
  for (std::size_t t = first_of_level_; t < triangles_.size(); ++t) {
    if (gone_[t] == 0) out.push_back(static_cast<std::uint32_t>(t));
  }
  return out;
}

}  // namespace clues::fastpath::multires
