#include "fastpath/visibility/search/sources.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

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
bool Sources::piece_between(const ExactPoint& beside, const ExactPoint& x, const PieceSet& by,
                            std::size_t first) const {
  return by.may_meet(beside, x, first, [&](const Plane& h) { return scene_.cell.lies_in(h); });
}

// From level s.level on. Without a place the source counts as visible.
void Sources::place(OfVertex& s, Pool& pool) {
  const ExactPoint& x = scene_.points[s.point];
  const Apex& apex = contacts_.apex_of(s.point, pool);
  std::optional<ExactPoint> beside;
  try {
    beside = near_enough(s.level, x, *s.view, [&](const ExactPoint& p) {
      return !equal(p, x) && !scene_.may_meet(p, x) && !scene_.is_on_surface(p) && apex.in_one_part(p, *s.view) &&
             !piece_between(p, x, pieces_, 0);
    });
  } catch (const scene::Error& error) {  // the vertex is too intricate
    if (error.code() != scene::ErrorCode::internal) throw;
  }
  s.unmet = s.confirmed = s.alone = false;
  s.beside = beside ? pool.keep(*beside) : s.view;
  if (beside) {
    walk_from_place(s, pool);
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

void Sources::set_walk(Place& s, Walk made) {
  ++walks_;
  s.walk = std::move(made);
  s.stale = s.unmet = s.confirmed = false;
  s.alone = pieces_.pieces().empty();
}

void Sources::walk_from_place(OfEdge& s, Pool& pool) {
  const ContourEdge& contour = contours_[s.contour];
  Walker::MayCome next_to_edge;
  if (!contour.holds_cell)
    next_to_edge = [&](const ExactPoint& v) { return comes_next_to_edge(scene_, contour, s.part, v, *s.beside); };
  while (true) {
    set_walk(s, walker_.walk(s.beside, pool, s.manner, next_to_edge));
    if (!s.walk.from_nowhere) return;
    ++s.level;
    find_place(s, pool);
    if (!s.beside) return;
  }
}

void Sources::walk_from_place(OfVertex& s, Pool& pool) { set_walk(s, walker_.walk(s.beside, pool, s.manner)); }

void Sources::clear() {
  const std::size_t all = of_edges_.size() + of_vertices_.size();
  workers_.for_each(all, [this](std::size_t i, Workers::Worker&) { place_of(i).walk = {}; });
  of_edges_.clear();
  of_vertices_.clear();
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
    if (i < edges && !of_edges_[i].part.y) {
      OfEdge& s = of_edges_[i];
      s.part.y = worker.pool.keep(ExactPoint::between(*s.part.lo, *s.part.hi, 0.4716796875));
      find_place(s, worker.pool);
    }
    const auto renew = [&](auto& s) {
      if (s.stale || s.walk.end == Walk::End::crossed) walk_from_place(s, worker.pool);
    };
    i < edges ? renew(of_edges_[i]) : renew(of_vertices_[i - edges]);
  });
}

Sources::Place& Sources::place_of(std::size_t i) {
  const std::size_t edges = of_edges_.size();
  return i < edges ? static_cast<Place&>(of_edges_[i]) : of_vertices_[i - edges];
}

void Sources::find_place(OfEdge& s, Pool& pool) {
  const std::optional<ExactPoint> beside = beside_edge(scene_, pieces_, contours_[s.contour], s.part, s.level);
  s.beside = beside ? pool.keep(*beside) : nullptr;
  s.is_clear = s.unmet = s.confirmed = s.alone = false;
  s.stale = beside.has_value();
  if (beside) return;
  s.walk = Walk{};
  s.walk.end = Walk::End::unresolved;
}

template <class Source>
bool Sources::newly_visible_by_walk(Source& s, std::size_t first, Pool& pool) {
  constexpr int kRetries = 12;
  constexpr std::size_t kLeast = 8, kMost = 32;
  for (int i = 0;; ++i) {
    const Crossing c = walker_.visible(s.walk, first);
    if (c == Crossing::yes) return true;
    const bool by_last_leg = c == Crossing::no && walker_.visible_by_last_leg(s.walk, first) != Crossing::no;
    if (c == Crossing::no && !by_last_leg) return false;
    if (i == kRetries || (by_last_leg && s.manner.least == kMost)) break;
    if (by_last_leg) s.manner.least = std::max(kLeast, 2 * s.manner.least);
    ++s.manner.seed;
    walk_from_place(s, pool);
    first = 0;
  }
  s.walk.end = Walk::End::unresolved;
  return true;
}

// Whether a piece from number `first` on may divide the place from the part of the edge.
bool Sources::is_cut_off(const OfEdge& s, const PieceSet& by, std::size_t first) const {
  return s.beside && by.may_meet(*s.beside, *s.part.y, first, holds_edge(scene_, contours_[s.contour].edge));
}

// Whether one of these pieces meets what the label of the source hangs on.
bool Sources::is_met(const OfEdge& s, const Fresh& by) const {
  return is_cut_off(s, by.walker.pieces(), by.first) || by.walker.is_met(s.walk, by.first);
}

bool Sources::is_met(const OfVertex& s, const Fresh& by) const {
  return by.walker.is_met(s.walk, by.first) ||
         (s.view && piece_between(*s.beside, scene_.points[s.point], by.walker.pieces(), by.first));
}

bool Sources::newly_visible(OfEdge& s, std::size_t first, Pool& pool) {
  if (is_cut_off(s, pieces_, first)) {
    ++s.level;
    find_place(s, pool);
    if (s.stale) walk_from_place(s, pool);
    first = 0;
  }
  return newly_visible_by_walk(s, first, pool);
}

bool Sources::newly_visible(OfVertex& s, std::size_t first, Pool& pool) {
  if (newly_visible_by_walk(s, first, pool)) return true;
  if (!s.view) return false;
  if (!piece_between(*s.beside, scene_.points[s.point], pieces_, first)) return false;
  ++s.level;
  place(s, pool);
  return newly_visible_by_walk(s, 0, pool);
}

Sources::Numbers Sources::newly_lit(std::size_t first, const Fresh& fresh, Light light) {
  const std::size_t edges = of_edges_.size();
  std::vector<char> visible(edges + of_vertices_.size(), 0);
  workers_.for_each(visible.size(), [&](std::size_t i, Workers::Worker& worker) {
    const auto look = [&](auto& s) {
      if (s.lit || (light != Light::known && s.unmet && !is_met(s, fresh))) return;
      const bool lit = light == Light::known
                           ? s.known && walker_.visible(s.walk, first) == Crossing::yes
                           : newly_visible(s, first, worker.pool) && (light == Light::in_doubt || !is_in_doubt(s));
      visible[i] = lit ? 1 : 0;
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

void Sources::end_light() {
  for (OfEdge& s : of_edges_) s.unmet = !s.lit;
  for (OfVertex& s : of_vertices_) s.unmet = !s.lit;
}

bool Sources::ask_nearer(const Walker& fresh, bool all_still_there) {
  const std::size_t edges = of_edges_.size();
  std::vector<char> nearer(edges + of_vertices_.size(), 0);
  workers_.for_each(nearer.size(), [&](std::size_t i, Workers::Worker& worker) {
    Place& s = place_of(i);
    OfEdge* e = i < edges ? &of_edges_[i] : nullptr;
    if (e) e->is_clear = e->lit && !is_cut_off(*e, e->is_clear ? fresh.pieces() : pieces_, 0);
    if (!s.lit) return;
    if (e && !e->is_clear) {
      ++s.level;
      find_place(*e, worker.pool);  // where none of the pieces that are there now is between
    } else {
      if (!s.walk.has_places() || (s.confirmed && all_still_there && !fresh.is_met(s.walk, 0))) return;
      s.confirmed = walker_.visible(s.walk, 0) == Crossing::yes;
      if (s.confirmed) return;
      ++s.manner.seed;
      s.stale = ++s.manner.near < kPointNearLevels;
      if (!s.stale) s.walk.end = Walk::End::unresolved;
    }
    nearer[i] = 1;
  });
  if (std::find(nearer.begin(), nearer.end(), 1) == nearer.end()) return false;
  constexpr int kTimes = 4;
  if (++times_nearer_ > kTimes) return true;
  for (std::size_t i = 0; i < nearer.size(); ++i) {
    Place& s = place_of(i);
    const bool has_place =
        i < edges ? s.beside != nullptr : of_vertices_[i - edges].view && s.beside != of_vertices_[i - edges].view;
    if (s.alone && s.manner.least == 0) continue;  // the same walk would come of it
    if (!has_place || s.walk.end != Walk::End::unresolved || s.manner.near >= kPointNearLevels) continue;
    s.stale = true;
    s.manner.least = 0;
  }
  return true;
}

void Sources::start_known(const LeftOut& left_out) {
  const auto nothing = [](const Plane&) { return false; };
  const auto is_divided = [&](const Leg& leg) { return leg.next && pieces_.may_meet(*leg.next, *leg.p, 0, nothing); };
  const auto may_be_known = [&](const Place& s) {
    return s.lit && (s.walk.end == Walk::End::cell || s.walk.end == Walk::End::surface) &&
           std::none_of(s.walk.legs.begin(), s.walk.legs.end(), is_divided);
  };
  for (OfEdge& s : of_edges_) {
    s.known = may_be_known(s) && keeps_out(s.walk, left_out) &&
              left_out.surely_misses(s.part.lo->approximate(), s.part.hi->approximate()) &&
              left_out.surely_misses(s.part.y->approximate(), s.beside->approximate());
    s.lit = false;
  }
  for (OfVertex& s : of_vertices_) {  // where its place is visible it is: the place's sight lines go on to it
    s.known = may_be_known(s) && keeps_out(s.walk, left_out);
    s.lit = false;
  }
}

std::uint64_t Sources::unresolved() const {
  const auto edges =
      std::count_if(of_edges_.begin(), of_edges_.end(), [this](const OfEdge& s) { return is_in_doubt(s); });
  const auto vertices =
      std::count_if(of_vertices_.begin(), of_vertices_.end(), [](const OfVertex& s) { return is_in_doubt(s); });
  return static_cast<std::uint64_t>(edges + vertices);
}

}  // namespace clues::fastpath
