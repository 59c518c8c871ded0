#include "fastpath/visibility/search/sources.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "fastpath/visibility/points/near_enough.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

Sources::Sources(const LocalScene& scene, const std::vector<bool>& is_vertex, const std::vector<ContourEdge>& contours,
                 const PieceSet& pieces, const Walker& walker, Contacts& contacts, Workers& workers)
    : scene_(scene), contours_(contours), pieces_(pieces), walker_(walker), contacts_(contacts), workers_(workers) {
  std::vector<std::vector<OfVertex>> found(scene.points.size());
  workers.for_each(found.size(), [&](std::size_t v, Workers::Worker& worker) {
    if (is_vertex[v]) found[v] = beside_vertex(static_cast<std::uint32_t>(v), worker.pool);
  });
  for (auto& list : found) std::move(list.begin(), list.end(), std::back_inserter(of_vertices_));
}

std::vector<Sources::OfVertex> Sources::beside_vertex(std::uint32_t v, Pool& pool) {
  const Apex& apex = contacts_.apex_of(v, pool);
  if (apex.sectors().empty()) return {};
  const ExactPoint& inside = *walker_.viewpoint(v);
  std::vector<OfVertex> found;
  const auto add = [&](const ExactPoint& view) {
    found.push_back(towards(v, view, pool));
    found.back().separates = apex.flat();
  };
  if (apex.has_piece_in_plane()) {
    found.push_back(unresolved(v, inside, pool));
    found.back().separates = true;
    return found;
  }
  try {
    if (apex.sees_cell_in_one_part()) {
      add(inside);
      return found;
    }
    for (const ExactPoint& view : apex.views_of_cell(inside)) add(view);
    if (apex.flat()) return found;
  } catch (const scene::Error& error) {
    if (error.code() != scene::ErrorCode::internal) throw;
    contacts_.corner(v)->has_all_sectors = true;
    found.assign(1, unresolved(v, inside, pool));
    found.back().separates = apex.flat();
  }
  // Not needed, but the more directions are known to be visible, the fewer sectors bound anything: those to V's vertices.
  for (std::size_t i = 0; i < scene_.cell.vertices.size(); ++i) {
    std::vector<double> weights(scene_.cell.vertices.size());
    for (std::size_t j = 0; j < weights.size(); ++j)
      weights[j] = j == i ? 1 : 0x1p-12 * static_cast<double>(3 + (7 * j + 11 * i) % 13);
    OfVertex s = towards(v, scene_.cell.interior_point(weights), pool);
    s.view = nullptr;
    if (s.walk.end != Walk::End::unresolved) found.push_back(std::move(s));
  }
  return found;
}

// Beside x on the way to `view`.
Sources::OfVertex Sources::towards(std::uint32_t v, const ExactPoint& view, Pool& pool) {
  OfVertex s;
  s.point = v;
  s.view = pool.keep(view);
  place(s, pool);
  return s;
}

// Of those that do not only separate (T10): they hold V, and may hold the way into V.
bool Sources::piece_between(const ExactPoint& beside, const ExactPoint& x, std::size_t first) const {
  return pieces_.may_meet(beside, x, first, [&](const Plane& h) { return scene_.cell.lies_in(h); });
}

// From level s.level on. Without a place the source counts as visible.
void Sources::place(OfVertex& s, Pool& pool) {
  const ExactPoint& x = scene_.points[s.point];
  const Apex& apex = contacts_.apex_of(s.point, pool);
  std::optional<ExactPoint> beside;
  try {
    beside = near_enough(
        s.level, kPointNearLevels, [&](int level) { return point_near(x, *s.view, level); },
        [&](const ExactPoint& p) {
          return !equal(p, x) && !scene_.may_meet(p, x) && !scene_.is_on_surface(p) && apex.in_one_face(p, *s.view) &&
                 !piece_between(p, x, 0);
        });
  } catch (const scene::Error& error) {  // the vertex is too intricate
    if (error.code() != scene::ErrorCode::internal) throw;
  }
  s.beside = beside ? pool.keep(*beside) : s.view;
  if (beside) {
    s.walk = walk(s.beside, s.seed, pool);
  } else {
    s.walk = Walk{};
    s.walk.end = Walk::End::unresolved;
  }
}

// It counts as visible.
Sources::OfVertex Sources::unresolved(std::uint32_t v, const ExactPoint& view, Pool& pool) {
  OfVertex s;
  s.point = v;
  s.beside = pool.keep(view);
  s.walk.end = Walk::End::unresolved;
  return s;
}

Walk Sources::walk(const ExactPoint* p, std::uint64_t seed, Pool& pool) {
  ++walks_;
  return walker_.walk(p, pool, seed);
}

void Sources::start_round(const std::vector<std::vector<const ExactPoint*>>& cuts) {
  std::map<std::tuple<std::size_t, const ExactPoint*, const ExactPoint*>, OfEdge> known;
  for (OfEdge& s : of_edges_) known.emplace(std::tuple(s.contour, s.part.lo, s.part.hi), std::move(s));
  of_edges_.clear();
  for (std::size_t c = 0; c < contours_.size(); ++c) {
    const LocalEdge& e = scene_.edges[contours_[c].edge];
    std::vector<const ExactPoint*> stops{&scene_.points[e.a]};
    stops.insert(stops.end(), cuts[contours_[c].edge].begin(), cuts[contours_[c].edge].end());
    stops.push_back(&scene_.points[e.b]);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const auto it = known.find({c, stops[i], stops[i + 1]});
      OfEdge& s = of_edges_.emplace_back(it != known.end() ? std::move(it->second) : OfEdge{});
      s.lit = false;
      s.contour = c;
      s.part.lo = stops[i];
      s.part.hi = stops[i + 1];
    }
  }
  for (OfVertex& s : of_vertices_) s.lit = false;
  const std::size_t edges = of_edges_.size();
  workers_.for_each(edges + of_vertices_.size(), [&](std::size_t i, Workers::Worker& worker) {
    const auto walk_again = [&](auto& s) {
      if (s.walk.end == Walk::End::crossed) s.walk = walk(s.beside, s.seed, worker.pool);
    };
    if (i >= edges) return walk_again(of_vertices_[i - edges]);
    OfEdge& s = of_edges_[i];
    if (s.part.y) return walk_again(s);
    s.part.y = worker.pool.keep(ExactPoint::between(*s.part.lo, *s.part.hi, 0.4716796875));
    place(s, worker.pool);
  });
}

// Without a place the source counts as visible.
void Sources::place(OfEdge& s, Pool& pool) {
  const std::optional<ExactPoint> beside = beside_edge(scene_, pieces_, contours_[s.contour], s.part, s.level);
  s.beside = beside ? pool.keep(*beside) : nullptr;
  if (beside) {
    s.walk = walk(s.beside, s.seed, pool);
  } else {
    s.walk = Walk{};
    s.walk.end = Walk::End::unresolved;
  }
}

Crossing Sources::label_of(const Walk& walk, std::size_t first) const {
  const Crossing label = walker_.visible(walk, first);
  if (label == Crossing::yes) return label;
  const Crossing last = walker_.visible_by_last_leg(walk, first);
  return last == Crossing::no ? label : last;
}

bool Sources::newly_visible(const ExactPoint* p, Walk& w, std::uint64_t& seed, std::size_t first, Pool& pool) {
  constexpr int kRetries = 12;
  Crossing c = label_of(w, first);
  for (int i = 0; c == Crossing::touch && i < kRetries; ++i) {
    w = walk(p, ++seed, pool);
    c = label_of(w, 0);
  }
  if (c == Crossing::touch) w.end = Walk::End::unresolved;
  return c != Crossing::no;
}

bool Sources::newly_visible(OfEdge& s, std::size_t first, Pool& pool) {
  if (s.beside && pieces_.may_meet(*s.beside, *s.part.y, first, holds_edge(scene_, contours_[s.contour].edge))) {
    ++s.level;
    place(s, pool);
    first = 0;
  }
  return newly_visible(s.beside, s.walk, s.seed, first, pool);
}

bool Sources::newly_visible(OfVertex& s, std::size_t first, Pool& pool) {
  if (newly_visible(s.beside, s.walk, s.seed, first, pool)) return true;
  if (!s.view) return false;
  if (!piece_between(*s.beside, scene_.points[s.point], first)) return false;
  ++s.level;
  place(s, pool);
  return newly_visible(s.beside, s.walk, s.seed, 0, pool);
}

Sources::Numbers Sources::newly_lit(std::size_t first, bool in_doubt) {
  const std::size_t edges = of_edges_.size();
  std::vector<char> visible(edges + of_vertices_.size(), 0);
  workers_.for_each(visible.size(), [&](std::size_t i, Workers::Worker& worker) {
    const auto look = [&](auto& s) {
      visible[i] = !s.lit && newly_visible(s, first, worker.pool) && (in_doubt || !is_in_doubt(s)) ? 1 : 0;
    };
    i < edges ? look(of_edges_[i]) : look(of_vertices_[i - edges]);
  });
  Numbers lit;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i] == 0) continue;
    (i < edges ? of_edges_[i].lit : of_vertices_[i - edges].lit) = true;
    i < edges ? lit.of_edges.push_back(i) : lit.of_vertices.push_back(i - edges);
  }
  return lit;
}

void Sources::note_doubt() {
  const auto look = [this](auto& s) {
    s.doubtful = s.lit && walker_.last_leg_is_in_doubt(s.walk) && walker_.visible(s.walk, 0) != Crossing::yes;
  };
  std::for_each(of_edges_.begin(), of_edges_.end(), look);
  std::for_each(of_vertices_.begin(), of_vertices_.end(), look);
}

std::uint64_t Sources::unresolved() const {
  const auto edges = std::count_if(of_edges_.begin(), of_edges_.end(), [this](const OfEdge& s) {
    return is_in_doubt(s) || (s.doubtful && !contours_[s.contour].holds_cell);
  });
  const auto vertices = std::count_if(of_vertices_.begin(), of_vertices_.end(),
                                      [](const OfVertex& s) { return is_in_doubt(s) || (s.doubtful && !s.separates); });
  return static_cast<std::uint64_t>(edges + vertices);
}

}  // namespace clues::fastpath
