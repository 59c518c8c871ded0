#include "fastpath/visibility/apex.h"

#include <algorithm>

#include "fastpath/visibility/star.h"

namespace clues::fastpath {

Apex::Apex(const LocalScene& scene, Pool& pool, bool on_edge, std::uint32_t id, const ExactPoint* x)
    : scene_(&scene), on_edge_(on_edge), id_(id), x_(x) {
  find_arcs();
  find_sectors(pool);
}

void Apex::find_arcs() {
  const auto& incident = on_edge_ ? scene_->edges[id_].pieces : scene_->point_pieces[id_];
  for (const std::uint32_t t : incident) {
    const LocalPiece& piece = scene_->pieces[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t e = piece.edges[i], a = piece.corners[i], b = piece.corners[(i + 1) % 3];
      if (on_edge_ ? e == id_ : a == id_ || b == id_) continue;
      arcs_.push_back({a, b, e, t});
    }
  }
}

void Apex::find_sectors(Pool& pool) {
  const LocalCell& cell = scene_->cell;
  const auto vertex = [&](int i) -> const ExactPoint& { return cell.vertices[static_cast<std::size_t>(i)]; };
  if (cell.dimension == 0 || cell.contains(*x_)) {
    if (cell.dimension < 3 || cell.interior_contains(*x_)) return;
    // On the border: A(x) is the cone opposite to V at x, bounded by the planes of the facets at x.
    for (std::size_t f = 0; f < cell.facets.size(); ++f) {
      const Plane& plane = cell.facet_planes[f];
      if (plane.side(*x_) != 0) continue;
      std::vector<const ExactPoint*> rays;
      for (const int c : cell.facets[f]) {
        if (!equal(*x_, vertex(c))) rays.push_back(pool.keep(ExactPoint::reflected(*x_, vertex(c))));
      }
      const OnWedge frame{&plane, x_, {}, {}, {}, {}, {}, {}};
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const ExactPoint *a = rays[i], *b = rays[(i + 1) % rays.size()];
        if (frame.turn(a, b) > 0) split(pool, &plane, a, b);
      }
    }
    return;
  }
  std::vector<std::vector<int>> seen;  // a facet of V seen edge-on is met once for each of its edges
  for (const auto& [i, j] : cell.edges) {
    const ExactPoint &p = vertex(i), &q = vertex(j);
    std::vector<int> touching{i, j};
    bool above = false, below = false;
    for (int k = 0; k < static_cast<int>(cell.vertices.size()) && !(above && below); ++k) {
      if (k == i || k == j) continue;
      const int o = orientation(*x_, p, q, vertex(k));
      above |= o > 0;
      below |= o < 0;
      if (o == 0) touching.push_back(k);
    }
    if ((above && below) || collinear(*x_, p, q)) continue;
    std::sort(touching.begin(), touching.end());
    if (std::find(seen.begin(), seen.end(), touching) != seen.end()) continue;
    seen.push_back(touching);
    std::vector<const Plane*> planes;
    if (!above) planes.push_back(pool.plane(*x_, p, q));
    if (!below) planes.push_back(pool.plane(*x_, q, p));
    std::vector<const ExactPoint*> rays;
    for (const int k : touching) rays.push_back(pool.keep(ExactPoint::reflected(*x_, vertex(k))));
    for (const Plane* plane : planes) {
      const OnWedge frame{plane, x_, {}, {}, {}, {}, {}, {}};
      const ExactPoint *first = rays.front(), *last = first;  // they span less than a half turn
      for (const ExactPoint* w : rays) {
        if (frame.turn(w, first) > 0) first = w;
        if (frame.turn(last, w) > 0) last = w;
      }
      split(pool, plane, first, last);
    }
  }
}

// At the traces of incident pieces: each part has one face beside it.
void Apex::split(Pool& pool, const Plane* plane, const ExactPoint* ray0, const ExactPoint* ray1) {
  const OnWedge frame{plane, x_, {}, {}, {}, {}, {}, {}};
  struct Ray {
    const ExactPoint* p;
    SpotName name;
  };
  std::vector<Ray> rays;
  std::vector<std::uint32_t> vertices, crossed;
  for (const LocalArc& arc : arcs_) {
    const int a = plane->side(scene_->points[arc.a]), b = plane->side(scene_->points[arc.b]);
    if (a == 0) vertices.push_back(arc.a);
    if (b == 0) vertices.push_back(arc.b);
    if (a * b < 0) crossed.push_back(arc.edge);
  }
  const auto unique = [](std::vector<std::uint32_t>& v) {
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
  };
  unique(vertices);
  unique(crossed);
  const auto add = [&](const ExactPoint* p, SpotName name) {
    if (frame.turn(ray0, p) > 0 && frame.turn(p, ray1) > 0) rays.push_back({p, name});
  };
  for (const std::uint32_t v : vertices) add(&scene_->points[v], {SpotName::Kind::vertex, v});
  for (const std::uint32_t e : crossed) {
    const LocalEdge& edge = scene_->edges[e];
    add(pool.keep(ExactPoint::on_plane(scene_->points[edge.a], scene_->points[edge.b], *plane)),
        {SpotName::Kind::edge, e});
  }
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) { return frame.turn(a.p, b.p) > 0; });
  rays.insert(rays.begin(), {ray0, {}});
  rays.push_back({ray1, {}});
  for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
    if (frame.turn(rays[i].p, rays[i + 1].p) <= 0) continue;
    sectors_.push_back({plane, rays[i].p, rays[i + 1].p, rays[i].name, rays[i + 1].name});
  }
}

std::vector<std::uint32_t> Apex::existing(const std::vector<Probe>& probes) const {
  if (sectors_.empty() || probes.empty()) return {};
  return decide<Integer>([&]<class NT>() { return existing_in<NT>(probes); });
}

template <class NT>
std::vector<std::uint32_t> Apex::existing_in(const std::vector<Probe>& probes) const {
  using V = Vec3<NT>;
  const Star<NT> star(*scene_, on_edge_, id_, x_, arcs_);
  const LocalCell& cell = scene_->cell;
  struct Lit {
    Beside<NT> beside;
    std::vector<int> face;
    const ExactPoint *to, *lit_end;
    bool doubtful;
  };
  const V nothing{NT(0), NT(0), NT(0)};
  std::vector<Lit> lit;
  for (const Probe& p : probes) {
    Lit l{{star.to(*p.to), nothing, nothing, p.at}, {}, p.to, p.lit_end, p.doubtful};
    if (p.plane) {
      const V n = normal_direction<NT>(*p.plane);
      l.beside.aside = n;
      l.beside.off = n;
      if (p.kind == Probe::Kind::csv) {
        const V ccw = cross(n, -l.beside.limit);
        l.beside.aside = p.aside > 0 ? ccw : -ccw;
      }
    }
    l.face = star.face_of(p.plane ? star.moved(l.beside) : l.beside.limit);
    lit.push_back(std::move(l));
  }
  std::vector<V> anticone;
  for (const ExactPoint& s : cell.vertices) anticone.push_back(direction<NT>(s, *x_));
  V away = anticone.front();
  for (std::size_t i = 1; i < anticone.size(); ++i) away = away + anticone[i];

  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < sectors_.size(); ++i) {
    const ApexSector& s = sectors_[i];
    const V n = normal_direction<NT>(*s.plane), middle = balanced_sum<NT>(star.to(*s.ray0), star.to(*s.ray1));
    bool bounds_nothing = false;
    for (const Lit& l : lit) {
      // Visible space strictly in H+ that surely reaches the points just off `middle` in H+.
      if (!l.doubtful && s.plane->side(*l.to) < 0 && star.free_between(l.beside, middle)) {
        bounds_nothing = true;
        break;
      }
    }
    if (bounds_nothing) continue;
    const V inner = star.moved({middle, sign_of(NT(dot(n, away))) > 0 ? away : n, nothing, {}});
    const std::vector<int> face = star.face_of(inner);
    bool exists = false;
    for (const Lit& l : lit) {
      if (l.face != face) continue;
      const auto along = [&](std::size_t k) {
        const LocalEdge& e = scene_->edges[id_];
        return orientation(scene_->points[e.a], scene_->points[e.b], *l.to, cell.vertices[k]) == 0;
      };
      if (on_edge_ && !star.spreads(l.beside, inner, anticone, along)) continue;
      exists = true;
      // A point of the visible part of a crossed edge reaches whatever its face allows.
      if (!l.doubtful && l.lit_end && s.plane->side(*l.lit_end) < 0) bounds_nothing = true;
    }
    if (exists && !bounds_nothing) found.push_back(i);
  }
  return found;
}

}  // namespace clues::fastpath
