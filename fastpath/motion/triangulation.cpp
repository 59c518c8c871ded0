// Location, insertion, removal.
#include "fastpath/motion/triangulation.h"

#include <algorithm>
#include <cmath>

#include "fastpath/motion/base_mesh.h"
#include "scene/messages/error.h"

namespace clues::fastpath::motion {
namespace {

const auto any_edge = [](std::uint32_t, std::uint32_t) { return true; };

}  // namespace

void View::look_from(const MotionPoint& at) {
  at_ = at;
  ++now_;
}

void View::forget(std::uint32_t vertex) {
  if (vertex < stamps_.size()) stamps_[vertex] = 0;
}

void View::make(std::uint32_t vertex) const {
  if (vertex >= stamps_.size()) {
    stamps_.resize(mesh_->samples().size(), 0);
    rows_.resize(mesh_->samples().size());
  }
  rows_[vertex] = row_of(mesh_->samples()[vertex], at_);
  stamps_[vertex] = now_;
}

Triangulation::Triangulation(const scene::MotionThresholds& thresholds, const MotionPoint& at)
    : constraints_(thresholds),
      mesh_(icosahedral_base()),
      view_(mesh_),
      base_vertices_(static_cast<std::uint32_t>(mesh_.samples().size())) {
  view_.look_from(at);
  for (std::uint32_t f = 0; f < mesh_.faces().size(); ++f) {
    if (face_holds(f)) continue;
    throw scene::Error(scene::ErrorCode::bad_argument,
                       "motion: the thresholds forbid the base mesh itself; take a larger kappa and a smaller sigma");
  }
  for (std::uint32_t f = 0; f < mesh_.faces().size(); ++f) stack_.push_back(f);
  legalise(stack_, any_edge);
  mesh_.changed().clear();
}

int Triangulation::facing(const View& view, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  // Rows of one view may move in memory when a later one is made: all are made first.
  view.row(a), view.row(b), view.row(c);
  return constraints_.facing(view.seen(a), view.seen(b), view.seen(c), view.at());
}

bool Triangulation::edge_holds(std::uint32_t a, std::uint32_t b) {
  view_.row(a), view_.row(b);
  return constraints_.edge_length(view_.seen(a), view_.seen(b), view_.at());
}

bool Triangulation::face_holds(std::uint32_t f) {
  const auto [a, b, c] = mesh_.face(f).corner;
  view_.row(a), view_.row(b), view_.row(c);
  return constraints_.triangle(view_.seen(a), view_.seen(b), view_.seen(c), view_.at());
}

int Triangulation::delaunay(std::uint32_t f, std::size_t i) {
  const Face& face = mesh_.face(f);
  const std::uint32_t a = face.corner[i], b = face.corner[(i + 1) % 3], c = face.corner[(i + 2) % 3],
                      g = face.across[i];
  const std::uint32_t d = mesh_.face(g).corner[mesh_.face(g).place_of_face(f)];
  view_.row(a), view_.row(b), view_.row(c), view_.row(d);
  return constraints_.delaunay(view_.seen(a), view_.seen(b), view_.seen(c), view_.seen(d), view_.at());
}

// G < 0; or cocircular, and the least of the four numbers is not on the edge. Between front facing triangles both are strictly convex quadrangles, so
// that the other diagonal lies in them. Flips end: each of the first kind lowers the lifted surface, each of the second leaves it
// and lowers the sum of the least numbers of all edges.
bool Triangulation::wants_flip(std::uint32_t f, std::size_t i) {
  const int sign = delaunay(f, i);
  if (sign != 0) return sign < 0;
  const Face& face = mesh_.face(f);
  const std::uint32_t g = face.across[i];
  const std::uint32_t d = mesh_.face(g).corner[mesh_.face(g).place_of_face(f)];
  return std::min(face.corner[i], d) < std::min(face.corner[(i + 1) % 3], face.corner[(i + 2) % 3]);
}

// A walk: across an edge that has the sample on its other side, the first from a corner that changes with each step. In a mesh that is not Delaunay a
// walk may go in circles: after as many steps as there are faces, all faces are looked at.
Triangulation::Place Triangulation::locate(const Seen& sample, std::uint32_t from) {
  const auto place_in = [&](std::uint32_t f, std::size_t first, std::uint32_t& next) {
    const Face& face = mesh_.face(f);
    Place place{f, 0, 0};
    next = kNone;
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t i = (first + n) % 3;
      const std::uint32_t b = face.corner[(i + 1) % 3], c = face.corner[(i + 2) % 3];
      view_.row(b), view_.row(c);
      const int side = constraints_.facing(view_.seen(b), view_.seen(c), sample, view_.at());
      if (side < 0) {
        next = face.across[i];
        return place;
      }
      if (side == 0) {
        ++place.zeros;
        place.edge = i;
      }
    }
    return place;
  };
  std::uint32_t f = from < mesh_.faces().size() && mesh_.face(from).alive() ? from : last_;
  while (!mesh_.face(f).alive()) f = (f + 1) % static_cast<std::uint32_t>(mesh_.faces().size());
  std::uint32_t next = kNone;
  for (std::size_t step = 0; step < mesh_.faces().size(); ++step) {
    const Place place = place_in(f, step % 3, next);
    if (next == kNone) return place;
    f = next;
  }
  for (f = 0; f < mesh_.faces().size(); ++f) {
    if (!mesh_.face(f).alive()) continue;
    const Place place = place_in(f, 0, next);
    if (next == kNone) return place;
  }
  return {};
}

std::uint32_t Triangulation::face_holding(std::uint32_t vertex, std::uint32_t from) {
  view_.row(vertex);
  return locate(view_.seen(vertex), from).face;
}

std::uint32_t Triangulation::face_towards(const scene::DepthSample& sample) const {
  const Row row = row_of(sample, view_.at());
  std::uint32_t nearest = 0;
  double most = -HUGE_VAL;
  for (std::uint32_t v = 0; v < base_vertices_; ++v) {
    if (!mesh_.is_vertex(v)) continue;
    const Row& base = view_.row(v);
    const double cosine = dot(row.x, base.x) / base.length;
    if (cosine > most) {
      most = cosine;
      nearest = v;
    }
  }
  return mesh_.face_of(nearest);
}

std::uint32_t Triangulation::insert(const scene::DepthSample& sample, std::uint32_t from, std::uint32_t base) {
  const Row row = row_of(sample, view_.at());
  const Seen seen{&sample, &row};
  // The viewpoint, or so near or far that nothing can be said in doubles; no direction at all.
  if (!fits(row)) return kNone;
  const Place place = locate(seen, from);
  if (place.face == kNone || place.zeros > 1) return kNone;
  last_ = place.face;
  for (const std::uint32_t v : mesh_.face(place.face).corner) {
    view_.row(v);
    if (!constraints_.edge_length(seen, view_.seen(v), view_.at())) return kNone;
  }
  const std::uint32_t vertex = base == kNone ? mesh_.add_vertex(sample) : base;
  view_.forget(vertex);
  const std::size_t mark = mesh_.changed().size();
  if (place.zeros == 1) {
    mesh_.split_edge(place.face, place.edge, vertex);
  } else {
    mesh_.split_face(place.face, vertex);
  }
  stack_.assign(mesh_.changed().begin() + static_cast<std::ptrdiff_t>(mark), mesh_.changed().end());
  legalise(stack_, any_edge);
  mesh_.star_of(vertex, star_);
  const bool holds =
      std::all_of(star_.faces.begin(), star_.faces.end(), [&](std::uint32_t f) { return face_holds(f); });
  if (holds) return vertex;
  const std::size_t undone = mesh_.changed().size();
  if (!remove(vertex, view_, view_)) return vertex;  // for the caller to repair
  stack_.assign(mesh_.changed().begin() + static_cast<std::ptrdiff_t>(undone), mesh_.changed().end());
  legalise(stack_, any_edge);
  return kNone;
}

// Ears: three corners in a row whose triangle faces the view and holds no other corner. In the plane onto which a star within a half sphere projects every
// polygon has two. First those that face the preferred view, then the shortest diagonal; by doubles, as it is a matter of shape only.
bool Triangulation::remove(std::uint32_t vertex, const View& view, const View& preferred) {
  mesh_.star_of(vertex, inner_star_);
  const auto& ring = inner_star_.ring;
  // Rows may move in memory when a later one is made: all are made first.
  for (const std::uint32_t v : ring) view.row(v), preferred.row(v);
  corners_.clear();
  for (std::uint32_t k = 0; k < ring.size(); ++k) corners_.push_back({k, view.seen(ring[k]), &preferred.row(ring[k])});
  ears_.clear();
  const auto side = [&](const Corner& a, const Corner& b, const Corner& c) {
    return constraints_.facing(a.seen, b.seen, c.seen, view.at());
  };
  const auto is_ear = [&](std::size_t before, std::size_t at, std::size_t after) {
    const Corner &p = corners_[before], &q = corners_[at], &r = corners_[after];
    if (side(p, q, r) <= 0) return false;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      if (k == before || k == at || k == after) continue;
      const Corner& x = corners_[k];
      if (side(p, q, x) >= 0 && side(q, r, x) >= 0 && side(r, p, x) >= 0) return false;
    }
    return true;
  };
  while (corners_.size() > 3) {
    const std::size_t n = corners_.size();
    std::size_t best = n;
    double best_cosine = 0;
    bool best_faces = false;
    for (std::size_t at = 0; at < n; ++at) {
      const std::size_t before = at == 0 ? n - 1 : at - 1, after = at + 1 == n ? 0 : at + 1;
      const Row &a = *corners_[before].row, &b = *corners_[at].row, &c = *corners_[after].row;
      const bool faces = faces_filtered(a, b, c) == Answer::yes;
      const double cosine = dot(a.x, c.x) / (a.length * c.length);
      if (best < n && (best_faces != faces ? best_faces : best_cosine >= cosine)) continue;
      if (!is_ear(before, at, after)) continue;
      best = at;
      best_cosine = cosine;
      best_faces = faces;
    }
    if (best == n) return false;
    ears_.push_back({corners_[best == 0 ? n - 1 : best - 1].place, corners_[best].place,
                     corners_[best + 1 == n ? 0 : best + 1].place});
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(best));
  }
  if (side(corners_[0], corners_[1], corners_[2]) <= 0) return false;
  ears_.push_back({corners_[0].place, corners_[1].place, corners_[2].place});
  mesh_.replace_star(vertex, inner_star_, ears_);
  return true;
}

}  // namespace clues::fastpath::motion
