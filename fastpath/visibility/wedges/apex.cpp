#include "fastpath/visibility/wedges/apex.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "fastpath/visibility/wedges/star.h"

namespace clues::fastpath {

Apex::Apex(const LocalScene& scene, Pool& pool, bool on_edge, std::uint32_t id, const ExactPoint* x,
           const std::vector<const Plane*>& contours)
    : scene_(&scene), on_edge_(on_edge), id_(id), x_(x), arcs_(arcs_around(scene, on_edge, id)) {
  find_sectors(pool);
  if (on_edge || flat_) return;
  const auto add = [&](const Plane* plane) {
    if (circles_.empty() || circles_.back().plane != plane) circles_.push_back({plane, {}, false, {}, {}, {}});
  };
  for (const Plane* plane : contours) add(plane);
  for (const ApexSector& s : sectors_) add(s.plane);
}

std::vector<LocalArc> arcs_around(const LocalScene& scene, bool on_edge, std::uint32_t id) {
  std::vector<LocalArc> arcs;
  for (const std::uint32_t t : on_edge ? scene.edges[id].pieces : scene.point_pieces[id]) {
    const LocalPiece& piece = scene.pieces[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t e = piece.edges[i], a = piece.corners[i], b = piece.corners[(i + 1) % 3];
      if (on_edge ? e == id : a == id || b == id) continue;
      arcs.push_back({a, b, e, t});
    }
  }
  return arcs;
}

void Apex::find_sectors(Pool& pool) {
  const LocalCell& cell = scene_->cell;
  const auto vertex = [&](int i) -> const ExactPoint& { return cell.vertices[static_cast<std::size_t>(i)]; };
  if (cell.dimension == 0 || cell.contains(*x_)) {
    if (cell.interior_contains(*x_)) return;
    // On the border: A(x) is the cone opposite to V at x, bounded by the planes of the facets at x; that of a polygon is flat. (Inside a polygon the rays turn all the way round.)
    for (std::size_t f = 0; f < cell.facets.size(); ++f) {
      const Plane& plane = cell.facet_planes[f];
      if (plane.side(*x_) != 0) continue;
      std::vector<const ExactPoint*> rays;
      for (const int c : cell.facets[f]) {
        if (!equal(*x_, vertex(c))) rays.push_back(pool.keep(ExactPoint::reflected(*x_, vertex(c))));
      }
      const OnWedge frame{&plane, x_, {}, {}, {}, {}, {}, {}};
      std::vector<std::pair<const ExactPoint*, const ExactPoint*>> turns;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const ExactPoint *a = rays[i], *b = rays[(i + 1) % rays.size()];
        if (frame.turn(a, b) > 0) turns.emplace_back(a, b);
      }
      if (cell.dimension == 3) {
        for (const auto& [a, b] : turns) split(pool, &plane, a, b);
      } else if (turns.size() < rays.size()) {
        const Plane* below =
            pool.plane(vertex(cell.facets[f][1]), vertex(cell.facets[f][0]), vertex(cell.facets[f][2]));
        for (const auto& [a, b] : turns) {
          sectors_.push_back({&plane, a, b, {}, {}});
          sectors_.push_back({below, b, a, {}, {}});
        }
      }
    }
    flat_ = cell.dimension < 3;
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
      if (cell.lies_in(*plane)) {
        flat_ = true;
        sectors_.push_back({plane, first, last, {}, {}});
      } else {
        split(pool, plane, first, last);
      }
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

bool Apex::has_piece_in_plane() const {
  return flat_ && std::any_of(arcs_.begin(), arcs_.end(),
                              [&](const LocalArc& arc) { return scene_->cell.lies_in(scene_->planes[arc.piece]); });
}

// What is around x, and where it is visible there, in one number type.
template <class NT>
struct Apex::Picture {
  using V = Vec3<NT>;
  struct Lit {
    Beside<NT> beside;
    std::vector<int> face;
    const ExactPoint *to, *lit_end;
    bool doubtful;
    bool into_cell;  // of a sight line: strictly in H+ of all planes with V on that side
  };

  Picture(const Apex& apex, const std::vector<Probe>& probes)
      : star(*apex.scene_, apex.on_edge_, apex.id_, apex.x_, apex.arcs_) {
    for (const Probe& p : probes) {
      Lit l{{star.to(*p.to), nothing, nothing, p.at}, {}, p.to, p.lit_end, p.doubtful, p.plane == nullptr};
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
    for (const ExactPoint& s : apex.scene_->cell.vertices) anticone.push_back(direction<NT>(s, *apex.x_));
    with_circles.resize(lit.size());
    away = anticone.front();
    for (std::size_t i = 1; i < anticone.size(); ++i) away = away + anticone[i];
  }

  const V nothing{NT(0), NT(0), NT(0)};
  Star<NT> star;
  std::vector<Lit> lit;
  std::vector<V> anticone;
  V away;
  mutable std::vector<std::vector<Face>> with_circles;  // of what is lit, in the star with each circle, once asked for
};

// Made when they are asked for.
class Apex::Pictures {
 public:
  Pictures(const Apex& apex, const std::vector<Probe>& probes) : apex_(apex), probes_(probes) {}
  // In intervals it may be Unsure, each time.
  template <class NT>
  const Picture<NT>& in() {
    auto& [picture, failed] = std::get<Slot<NT>>(slots_);
    if (failed) throw Unsure{};
    if (!picture) {
      failed = std::is_same_v<NT, Interval>;
      picture.emplace(apex_, probes_);
      failed = false;
    }
    return *picture;
  }

 private:
  template <class NT>
  struct Slot {
    std::optional<Picture<NT>> picture;
    bool failed = false;
  };
  const Apex& apex_;
  const std::vector<Probe>& probes_;
  std::tuple<Slot<Interval>, Slot<Integer>> slots_;
};

std::vector<std::uint32_t> Apex::existing(const std::vector<Probe>& probes) {
  if (sectors_.empty() || probes.empty()) return {};
  std::vector<std::uint32_t> found;
  Pictures pictures(*this, probes);
  for (std::uint32_t i = 0; i < sectors_.size(); ++i) {
    if (flat_ || decide<Integer>([&]<class NT>() { return exists(i, pictures.in<NT>()); })) found.push_back(i);
  }
  return found;
}

// T13. Let h be a plane through x with int V strictly in H+. Light gets next to x in directions into int V, which are in H+, and there its legs, being parts of rays from H+, cross the circle
// of h from H+ to H- alone, and where no arc is. The inside of a sector is in H-. So a free part of the circle lies between the face of such directions and that of the sector; and light
// that was in H- before stays in one face with it.
bool Apex::passes_circles(std::size_t k, std::size_t sector, const Vec3<Integer>& inner,
                          const Picture<Integer>& around) {
  const auto& lit = around.lit[k];
  std::vector<Face>& faces = around.with_circles[k];
  faces.resize(circles_.size());
  for (std::size_t i = 0; i < circles_.size(); ++i) {
    Circle& c = circles_[i];
    if (!c.normal) {
      c.normal = normal_direction<Integer>(*c.plane);
      c.divides = around.star.meets_circle(*c.normal);
    }
    const int side = !c.divides ? 0 : lit.into_cell ? -1 : lit.beside.side_of(*c.normal);
    if (side == 0) continue;
    if (!c.star) {
      c.star = around.star.with_circle(*c.normal);
      c.across = c.star->across_circle();
      c.inside.resize(sectors_.size());
    }
    Face &from = faces[i], &to = c.inside[sector];
    if (from.empty()) from = c.star->face_of(lit.into_cell ? lit.beside.limit : c.star->moved(lit.beside));
    if (to.empty()) to = c.star->face_of(inner);
    const bool passes =
        side > 0 ? from == to : std::find(c.across.begin(), c.across.end(), std::pair(from, to)) != c.across.end();
    if (!passes) return false;
  }
  return true;
}

// A sector that bounds nothing is left out. Let its plane have V on the side H+, and A(x) on the other; d
// be the direction of visible space beside x, strictly in H+, from which the great circle arc to `middle`
// meets no arc. Then
// 1. The points just off the sector in H+, near x, are in Omega. From x + r d, r small, sight lines go on
//    in the directions x + r d - v, v in int V, which are as near as one likes to those of A(x) (D8), so
//    also to `middle` on the border of A(x), and reach points that project to the arc from d towards
//    `middle`. With v near enough to where the plane touches V they stay in H+ until as near to the
//    sector as one likes. What touches x is a cone beside x and meets no such arc if they are near enough
//    to the one that was tested (arcs are closed); all else is farther away. From there in the same way
//    to all directions of the sector: no arc crosses it (split()), and one that lies along it covers all
//    of it, `middle` too, and then the test failed.
// 2. So they are farther out, too: from x + r m, m just off the sector in H+, sight lines go on beside
//    the plane to the first surface in H+ that touches it. Let y be a point of the valid piece beyond
//    that, in general position, with x + t (x - v) = y for a v of the touching edge of V. All such v near
//    by, and so all points x' of the plane near x, are behind the same: an edge e in the plane (a vertex
//    hides a line only, in the limit). All triangles at e are in the closed H+, or the piece of x would
//    end at e (D13); V touches the plane in v; and beside e, in H-, is Omega, for e is on the valid piece
//    of x. So y is on the wedge of e in this plane (D10, D11), or on a sector in this plane at an end of
//    a lit part of e, nearer to y than x is. If that sector is left out as well, the same holds of it;
//    this ends, as there are finitely many edges. So where the two sides of the sector differ in label,
//    another valid piece lies there.
// 3. At a CSV the edge's end in H- of the piece that crosses it is such a d, if that is strictly in H+ of
//    the sector: beside the edge towards that end, all that the face of the probe reaches by `spreads` is
//    in Omega (the probe looks back along the piece, so sight lines go on from it towards x, that is, in
//    the half plane of edge and probe as near to the edge as one likes; and `spreads` turns about the
//    edge). So beside the edge, where `inner` is as seen along the edge, is Omega; and every arc is a
//    half plane at the edge, so none is between there and `inner`.
template <class NT>
bool Apex::exists(std::size_t sector, const Picture<NT>& around) {
  const ApexSector& s = sectors_[sector];
  const Star<NT>& star = around.star;
  const Vec3<NT> n = normal_direction<NT>(*s.plane), middle = balanced_sum<NT>(star.to(*s.ray0), star.to(*s.ray1));
  // Visible space strictly in H+ that surely reaches the points just off `middle` in H+.
  if (std::any_of(around.lit.begin(), around.lit.end(), [&](const auto& l) {
        return !l.doubtful && s.plane->side(*l.to) < 0 && star.free_between(l.beside, middle);
      }))
    return false;
  const Vec3<NT> inner =
      star.moved({middle, sign_of(NT(dot(n, around.away))) > 0 ? around.away : n, around.nothing, {}});
  const std::vector<int> face = star.face_of(inner);
  bool exists = false;
  for (std::size_t k = 0; k < around.lit.size(); ++k) {
    const auto& l = around.lit[k];
    if (l.face != face) continue;
    const auto along = [&](std::size_t v) {
      const LocalEdge& e = scene_->edges[id_];
      return orientation(scene_->points[e.a], scene_->points[e.b], *l.to, scene_->cell.vertices[v]) == 0;
    };
    if (on_edge_ && !star.spreads(l.beside, inner, around.anticone, along)) continue;
    if (!on_edge_ && !star.free_between(l.beside, inner)) {
      if constexpr (std::is_same_v<NT, Interval>) {
        throw Unsure{};  // circles meet arcs in points that intervals do not know to be on both
      } else if (!passes_circles(k, sector, inner, around)) {
        continue;
      }
    }
    exists = true;
    // A point of the visible part of a crossed edge reaches whatever its face allows.
    if (!l.doubtful && l.lit_end && s.plane->side(*l.lit_end) < 0) return false;
  }
  return exists;
}

}  // namespace clues::fastpath
