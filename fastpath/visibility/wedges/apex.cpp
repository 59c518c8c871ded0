#include "fastpath/visibility/wedges/apex.h"

#include <algorithm>

namespace clues::fastpath {

namespace {

void add_arcs(const LocalScene& scene, bool on_edge, std::uint32_t id, const std::vector<std::uint32_t>& pieces,
              std::vector<LocalArc>& arcs) {
  for (const std::uint32_t t : pieces) {
    const LocalPiece& piece = scene.pieces[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t e = piece.edges[i], a = piece.corners[i], b = piece.corners[(i + 1) % 3];
      if (on_edge ? e == id : a == id || b == id) continue;
      arcs.push_back({a, b, e, t});
    }
  }
}

}  // namespace

Apex::Apex(const LocalScene& scene, Pool& pool, bool on_edge, std::uint32_t id, const ExactPoint* x)
    : scene_(&scene), on_edge_(on_edge), id_(id), x_(x), arcs_(arcs_around(scene, on_edge, id)) {
  add_arcs(scene, on_edge, id, on_edge ? scene.dark_at_edge[id] : scene.dark_at_point[id], arcs_);
  find_sectors(pool);
}

std::vector<LocalArc> arcs_around(const LocalScene& scene, bool on_edge, std::uint32_t id) {
  std::vector<LocalArc> arcs;
  add_arcs(scene, on_edge, id, on_edge ? scene.edges[id].pieces : scene.point_pieces[id], arcs);
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

}  // namespace clues::fastpath
