#include "fastpath/visibility/apex.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "fastpath/visibility/integers.h"
#include "scene/error.h"

namespace clues::fastpath {

namespace {

// The first sign that is not zero.
template <class NT>
int leading(const NT& a, const NT& b, const NT& c) {
  const int s = sign_of(a);
  if (s != 0) return s;
  const int t = sign_of(b);
  return t != 0 ? t : sign_of(c);
}

// A direction beside another: limit, moved a little to aside, and by much less to off.
template <class NT>
struct Beside {
  Vec3<NT> limit, aside, off;
  SpotName at;  // in which limit points, if that is of the mesh
  int side_of(const Vec3<NT>& normal) const {
    return leading(dot(normal, limit), dot(normal, aside), dot(normal, off));
  }
};

// For x in the plane of the arc ab with this normal: whether it lies in the closed arc.
template <class NT>
bool in_arc(const Vec3<NT>& a, const Vec3<NT>& b, const Vec3<NT>& normal, const Vec3<NT>& x) {
  return det_sign(normal, a, x) >= 0 && det_sign(normal, x, b) >= 0;
}

// Intervals that find no way leave the question to whole numbers.
template <class NT>
[[noreturn]] void give_up(const char* what) {
  if constexpr (std::is_same_v<NT, Interval>) throw Unsure{};
  throw scene::Error(scene::ErrorCode::internal, what);
}

}  // namespace

// The arcs around x, in one number type.
template <class NT>
class Apex::Star {
 public:
  using V = Vec3<NT>;

  explicit Star(const Apex& apex) : scene_(apex.scene_), x_(apex.x_) {
    std::map<std::uint32_t, int> node_of;
    const auto node = [&](std::uint32_t v) {
      const auto [it, fresh] = node_of.try_emplace(v, static_cast<int>(nodes_.size()));
      if (fresh) nodes_.push_back(to(apex.scene_->points[v]));
      return it->second;
    };
    if (apex.on_edge_) {  // nodes 0 and 1: along the edge
      node(apex.scene_->edges[apex.id_].b);
      node(apex.scene_->edges[apex.id_].a);
    }
    for (const Apex::Arc& arc : apex.arcs_) {
      const int a = node(arc.a), b = node(arc.b);
      arcs_.push_back({a, b, arc.piece, cross(nodes_[idx(a)], nodes_[idx(b)])});
    }
    find_faces();
  }

  V to(const ExactPoint& p) const { return direction<NT>(*x_, p); }

  // limit, moved so little that no arc's great circle lies between.
  std::optional<V> moved_if_possible(const Beside<NT>& d) const {
    for (const int exponent : {10, 30, 60, 120, 250, 500, 1000, 2000, 4000, 8000}) {
      const V m = moved_by<NT>(d.limit, d.aside, d.off, exponent);
      if (std::all_of(arcs_.begin(), arcs_.end(),
                      [&](const Arc& arc) { return sign_of(NT(dot(arc.normal, m))) == side_of(arc, d); }))
        return m;
    }
    return std::nullopt;
  }
  V moved(const Beside<NT>& d) const {
    if (const std::optional<V> m = moved_if_possible(d)) return *m;
    give_up<NT>("apex: a direction has no neighbour on its side");
  }

  // Names the face of the sphere that holds d, which is on no arc.
  std::vector<int> face_of(const V& d) const {
    std::vector<int> name, done;
    for (std::size_t first = 0; first < arcs_.size(); ++first) {
      const int component = component_[first];
      if (std::find(done.begin(), done.end(), component) != done.end()) continue;
      done.push_back(component);
      int side = -1;
      for (int aim = 0; aim < 40 && side < 0; ++aim) {
        if (aim == 0) {
          side = side_met(d, first, aim);
        } else {  // from a direction beside it: it may lie on great circles of arcs
          const V by{NT(aim % 7 - 3), NT((aim * 3) % 11 - 5), NT((aim * 5) % 13 - 6)};
          if (const std::optional<V> start = moved_if_possible({d, by, by, {}})) side = side_met(*start, first, aim);
        }
      }
      if (side < 0) give_up<NT>("apex: no clean way to an incident piece");
      name.push_back(root(side));
    }
    return name;
  }

  // Whether the great circle arc from just beside d0.limit to d1 surely meets no arc.
  bool free_between(const Beside<NT>& d0, const V& d1) const {
    for (const Arc& arc : arcs_) {
      const int s0 = side_of(arc, d0), s1 = sign_of(NT(dot(arc.normal, d1)));
      if (s0 != 0 && s0 == s1) continue;
      if (s0 == 0 && s1 != 0) continue;
      if (s0 == 0) return false;
      const NT l = is_on(arc, d0) ? NT(0) : NT(dot(arc.normal, d0.limit)), m = dot(arc.normal, d1);
      const NT at0 = sign_of(l) < 0 ? NT(-l) : l, at1 = sign_of(m) < 0 ? NT(-m) : m;
      const V y = sign_of(at0) == 0 ? d0.limit : V(at1 * d0.limit + at0 * d1);
      if (in_arc(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, y)) return false;
    }
    return true;
  }

  // Around an edge point; d and inner in one face, inner inside the cone spanned by `rays`: whether one can get from d to inner by ways that each
  // turn by less than a half turn towards a direction of the cone. Seen along the edge every piece is a ray.
  // `along(i)`: whether ray i is in one plane with d.limit and the edge.
  template <class Along>
  bool spreads(const Beside<NT>& d, const V& inner, const std::vector<V>& rays, const Along& along) const {
    const V& axis = nodes_[0];
    // Of d to w; `level`: limit, w and the edge are in one plane.
    const auto turn = [&](const V& w, bool level) {
      const V n = cross(w, axis);
      return level ? leading(NT(0), NT(dot(n, d.aside)), NT(dot(n, d.off))) : d.side_of(n);
    };
    const auto half = [&](const V& w, bool level) {  // 0: like d, 1: first half turn, 2: opposite, 3: second half turn
      const int s = turn(w, level);
      if (s != 0) return s > 0 ? 1 : 3;
      return sign_of(NT(dot(cross(axis, d.limit), cross(axis, w)))) > 0 ? 0 : 2;
    };
    bool ccw = true;  // inner comes before all pieces
    const int half_inner = half(inner, false);
    for (int i = 2; i < static_cast<int>(nodes_.size()) && ccw; ++i) {
      const bool level = std::any_of(arcs_.begin(), arcs_.end(),
                                     [&](const Arc& arc) { return (arc.a == i || arc.b == i) && is_on(arc, d); });
      const int h = half(nodes_[idx(i)], level);
      ccw = half_inner != h ? half_inner < h : det_sign(axis, inner, nodes_[idx(i)]) > 0;
    }
    const int way = ccw ? 1 : -1;
    if (turn(inner, false) == way) return true;
    // Too far for one step: by way of some w of the cone, less than a half turn from d and from inner.
    struct Forms {
      NT from_d[3], to_inner;
    };
    const NT sign(way);
    std::vector<Forms> forms;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const V n = cross(rays[i], axis);
      const NT at_limit = dot(n, d.limit);
      forms.push_back({{filtered_sign(at_limit) == kUnsure && along(i) ? NT(0) : NT(sign * at_limit),
                        NT(sign * dot(n, d.aside)), NT(sign * dot(n, d.off))},
                       NT(sign * NT(dot(axis, cross(rays[i], inner))))});
    }
    for (const Forms& a : forms) {
      if (leading(a.from_d[0], a.from_d[1], a.from_d[2]) <= 0) continue;
      for (const Forms& b : forms) {  // a alone, or a combination of a and b
        if (sign_of(b.to_inner) <= 0) continue;
        const auto minor = [&](int k) { return NT(NT(a.from_d[k] * b.to_inner) - NT(a.to_inner * b.from_d[k])); };
        if (sign_of(a.to_inner) > 0 || leading(minor(0), minor(1), minor(2)) > 0) return true;
      }
    }
    return false;
  }

 private:
  struct Arc {
    int a, b;
    std::uint32_t piece;
    V normal;
  };
  static std::size_t idx(int i) { return static_cast<std::size_t>(i); }

  // Whether the arc's great circle holds the limit of d because both are of one piece: then no sign need be computed.
  bool is_on(const Arc& arc, const Beside<NT>& d) const {
    const LocalPiece& piece = scene_->pieces[arc.piece];
    const auto& ids = d.at.kind == SpotName::Kind::vertex ? piece.corners : piece.edges;
    return d.at.kind != SpotName::Kind::none && std::find(ids.begin(), ids.end(), d.at.id) != ids.end();
  }
  int side_of(const Arc& arc, const Beside<NT>& d) const {
    if (!is_on(arc, d)) return d.side_of(arc.normal);
    return leading(NT(0), NT(dot(arc.normal, d.aside)), NT(dot(arc.normal, d.off)));
  }

  int root(int side) const {
    while (face_[idx(side)] != side) side = face_[idx(side)];
    return side;
  }

  // Sides of arcs: 2 i to the left of arc i, 2 i + 1 to its right. Around a node neighbouring arcs face each other across one face.
  void find_faces() {
    face_.resize(2 * arcs_.size());
    std::iota(face_.begin(), face_.end(), 0);
    component_.resize(arcs_.size());
    std::iota(component_.begin(), component_.end(), 0);
    for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
      struct Spoke {
        int arc, to, left, right;
      };
      std::vector<Spoke> spokes;
      for (int i = 0; i < static_cast<int>(arcs_.size()); ++i) {
        if (arcs_[idx(i)].a == n) spokes.push_back({i, arcs_[idx(i)].b, 2 * i, 2 * i + 1});
        if (arcs_[idx(i)].b == n) spokes.push_back({i, arcs_[idx(i)].a, 2 * i + 1, 2 * i});
      }
      if (spokes.empty()) continue;
      if (spokes.size() > 2) {
        const V& axis = nodes_[idx(n)];
        const V& zero = nodes_[idx(spokes.front().to)];
        const auto half = [&](const Spoke& s) {
          const V& to = nodes_[idx(s.to)];
          const int side = det_sign(axis, zero, to);
          if (side != 0) return side > 0 ? 1 : 3;
          return sign_of(NT(dot(cross(axis, zero), cross(axis, to)))) > 0 ? 0 : 2;
        };
        std::sort(spokes.begin() + 1, spokes.end(), [&](const Spoke& s, const Spoke& t) {
          if (s.to == t.to) return false;
          const int hs = half(s), ht = half(t);
          return hs != ht ? hs < ht : det_sign(axis, nodes_[idx(s.to)], nodes_[idx(t.to)]) > 0;
        });
      }
      for (std::size_t i = 0; i < spokes.size(); ++i) {
        const Spoke &s = spokes[i], &t = spokes[(i + 1) % spokes.size()];
        face_[idx(root(s.left))] = root(t.right);
        const int from = component_[idx(s.arc)], to = component_[idx(t.arc)];
        std::replace(component_.begin(), component_.end(), from, to);
      }
    }
  }

  // The side of the first arc of this component on the way from d to a point of one of its arcs; -1: not a clean way, or not surely one. Every
  // clean way leads to the same face, so there is no need to decide what is unsure.
  int side_met(const V& d, std::size_t aim_arc, int aim) const {
    const V target =
        NT(1 + aim) * nodes_[idx(arcs_[aim_arc].a)] + NT(1 + (aim * 7) % 11) * nodes_[idx(arcs_[aim_arc].b)];
    int side = -1;
    NT nearest_above(2), nearest_below(1);  // of the way from d to the target, as a fraction
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      if (component_[i] != component_[aim_arc]) continue;
      const Arc& arc = arcs_[i];
      if (i != aim_arc && arc.piece == arcs_[aim_arc].piece)
        continue;  // in one great circle, which the way meets at its end
      const NT at_d = dot(arc.normal, d), at_target = i == aim_arc ? NT(0) : NT(dot(arc.normal, target));
      const int sd = filtered_sign(at_d), st = filtered_sign(at_target);
      if (sd == kUnsure || st == kUnsure || (sd == 0 && st == 0)) return -1;
      if (sd == 0 || sd == st) continue;
      const NT above = sd > 0 ? at_d : NT(-at_d), beyond = sd > 0 ? NT(-at_target) : at_target, below = above + beyond;
      const int later = side < 0 ? -1 : filtered_sign(NT(NT(above * nearest_below) - NT(nearest_above * below)));
      if (later == 0 || later == 1) continue;
      const V y = i == aim_arc ? target : V(beyond * d + above * target);
      const V &a = nodes_[idx(arc.a)], &b = nodes_[idx(arc.b)];
      const int after_a = filtered_sign(dot(arc.normal, cross(a, y)));
      if (after_a < 0) continue;
      const int before_b = filtered_sign(dot(arc.normal, cross(y, b)));
      if (before_b < 0) continue;
      if (after_a != 1 || before_b != 1 || later == kUnsure) return -1;
      nearest_above = above;
      nearest_below = below;
      side = static_cast<int>(2 * i) + (sd > 0 ? 0 : 1);
    }
    return side;
  }

  const LocalScene* scene_;
  const ExactPoint* x_;
  std::vector<V> nodes_;
  std::vector<Arc> arcs_;
  std::vector<int> face_, component_;
};

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
  for (const Arc& arc : arcs_) {
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
  const Star<NT> star(*this);
  const LocalCell& cell = scene_->cell;
  struct Lit {
    Beside<NT> beside;
    std::vector<int> face;
    const ExactPoint *to, *lit_end;
  };
  const V nothing{NT(0), NT(0), NT(0)};
  std::vector<Lit> lit;
  for (const Probe& p : probes) {
    Lit l{{star.to(*p.to), nothing, nothing, p.at}, {}, p.to, p.lit_end};
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
      if (s.plane->side(*l.to) < 0 && star.free_between(l.beside, middle)) {
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
      if (l.lit_end && s.plane->side(*l.lit_end) < 0) bounds_nothing = true;
    }
    if (exists && !bounds_nothing) found.push_back(i);
  }
  return found;
}

std::vector<int> Apex::faces_of(const std::vector<const ExactPoint*>& to) const {
  const std::vector<std::vector<int>> names = decide<Integer>([&]<class NT>() {
    const Star<NT> star(*this);
    std::vector<std::vector<int>> out;
    for (const ExactPoint* p : to) out.push_back(star.face_of(star.to(*p)));
    return out;
  });
  std::vector<int> numbers;
  for (std::size_t i = 0; i < names.size(); ++i)
    numbers.push_back(static_cast<int>(std::find(names.begin(), names.end(), names[i]) - names.begin()));
  return numbers;
}

bool Apex::sees_cell_in_one_part() const {
  const LocalCell& cell = scene_->cell;
  for (const Arc& arc : arcs_) {
    // The arc's plane leaves V on one side, or both ends of the arc point away from V.
    const ExactPoint &a = scene_->points[arc.a], &b = scene_->points[arc.b];
    int above = 0, below = 0;
    for (const ExactPoint& s : cell.vertices) {
      const int o = orientation(*x_, a, b, s);
      above += o >= 0;
      below += o <= 0;
    }
    if (above == 0 || below == 0) continue;
    const Vec3<Interval> x = x_->approximate();
    Vec3<Interval> towards = cell.vertices.front().approximate() - x;
    for (std::size_t i = 1; i < cell.vertices.size(); ++i) towards = towards + (cell.vertices[i].approximate() - x);
    bool away = dot(towards, a.approximate() - x).sup() < 0 && dot(towards, b.approximate() - x).sup() < 0;
    for (const ExactPoint& s : cell.vertices) away &= dot(towards, s.approximate() - x).inf() > 0;
    if (!away) return false;
  }
  return true;
}

}  // namespace clues::fastpath
