// The envelope as a sweep of one ray about the centre, with the traces that it meets kept in order of distance. Pieces form a conforming
// complex, so traces never cross and their order is the same on every ray that meets both.
#include "fastpath/visibility/wedges/on_wedge.h"

#include <algorithm>

#include "fastpath/visibility/points/integers.h"

namespace clues::fastpath {

namespace {

struct Flat {
  Interval x, y;
};

Flat flat(const Plane& h, const ExactPoint& center, const ExactPoint& p) {
  const auto& [i, j] = h.axes();
  const auto &c = center.approximate(), &q = p.approximate();
  return {coordinate(q, i) - coordinate(c, i), coordinate(q, j) - coordinate(c, j)};
}

[[gnu::noinline]] int exact_turn(const Plane& h, const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  ++exact_decisions();
  const auto& [i, j] = h.axes();
  const Integer3 u = direction<Integer>(a, b), w = direction<Integer>(a, c);
  return sign_of(Integer(coordinate(u, i) * coordinate(w, j) - coordinate(u, j) * coordinate(w, i)));
}

[[gnu::flatten]] int filtered_turn(const Flat& u, const Flat& w) { return filtered_sign(u.x * w.y - u.y * w.x); }
Flat minus(const Flat& a, const Flat& b) { return {a.x - b.x, a.y - b.y}; }

// Boxes that may meet the sector: on its plane, between its rays, beyond its near bound.
class SectorTest {
 public:
  explicit SectorTest(const Sector& s) : normal_(s.plane->normal_approximate()), center_(s.center->approximate()) {
    const IntervalBox r0 = s.ray0->approximate() - center_, r1 = s.ray1->approximate() - center_;
    inward0_ = cross(normal_, r0);
    inward1_ = cross(r1, normal_);
    has_near_ = !s.from_apex;
    if (has_near_) {
      near_ = s.ray0->approximate();
      beyond_ = cross(s.ray1->approximate() - near_, normal_);
    }
  }
  [[gnu::flatten]] bool operator()(const IntervalBox& box) const {
    const IntervalBox r = box - center_;
    return may_be_zero(dot(normal_, r)) && dot(inward0_, r).sup() >= 0 && dot(inward1_, r).sup() >= 0 &&
           (!has_near_ || dot(beyond_, box - near_).sup() >= 0);
  }

 private:
  IntervalBox normal_, center_, inward0_{}, inward1_{}, near_{}, beyond_{};
  bool has_near_ = false;
};

}  // namespace

int OnWedge::turn(const ExactPoint* u, const ExactPoint* w) const {
  if (u == w) return 0;
  const int s = filtered_turn(flat(*plane, *center, *u), flat(*plane, *center, *w));
  return s != kUnsure ? s : exact_turn(*plane, *center, *u, *w);
}

int OnWedge::turn(const ExactPoint* a, const ExactPoint* b, const ExactPoint* c) const {
  if (a == b || b == c || a == c) return 0;
  const int s = filtered_turn(flat(*plane, *a, *b), flat(*plane, *a, *c));
  return s != kUnsure ? s : exact_turn(*plane, *a, *b, *c);
}

bool OnWedge::reaches(int blocker, const ExactPoint* q) const {
  if (blocker < 0) return true;
  const Blocker& b = blockers[static_cast<std::size_t>(blocker)];
  return turn(b.u, b.w, q) >= 0;
}

struct OnWedgeMaker::Work {
  Work(const LocalScene& s, Pool& p)
      : scene(s),
        pool(p),
        side_stamp(s.points.size()),
        side(s.points.size()),
        vertex_stamp(s.points.size()),
        vertex_spot(s.points.size()),
        edge_stamp(s.edges.size()),
        edge_spot(s.edges.size()) {}

  struct Spot {
    const ExactPoint* p = nullptr;
    Flat d{};
    bool kept = false;  // p is in the pool, or outlives it
  };
  struct Trace {
    std::uint32_t piece = 0;
    int u = 0, w = 0;      // spots
    int from = 0, to = 0;  // the rays of the sector that it covers, as spots
  };

  const LocalScene& scene;
  Pool& pool;
  std::uint32_t stamp = 0;
  std::vector<std::uint32_t> side_stamp;
  std::vector<signed char> side;
  std::vector<std::uint32_t> vertex_stamp;
  std::vector<int> vertex_spot;
  std::vector<std::uint32_t> edge_stamp;
  std::vector<int> edge_spot;
  std::deque<ExactPoint> made;  // crossings of this wedge
  std::vector<Spot> spots;
  std::vector<Trace> traces;
  std::vector<std::uint32_t> met_edges, met_vertices;
  const Sector* sector = nullptr;
  int center = 0, ray0 = 0, ray1 = 0;
  OnWedge out;

  int side_of(std::uint32_t point) {
    if (side_stamp[point] != stamp) {
      side_stamp[point] = stamp;
      side[point] = static_cast<signed char>(sector->plane->side(scene.points[point]));
    }
    return side[point];
  }

  int add_spot(const ExactPoint* p, bool kept) {
    spots.push_back({p, flat(*sector->plane, *sector->center, *p), kept});
    return static_cast<int>(spots.size()) - 1;
  }

  int spot_of_vertex(std::uint32_t v) {
    if (vertex_stamp[v] != stamp) {
      vertex_stamp[v] = stamp;
      vertex_spot[v] = add_spot(&scene.points[v], true);
    }
    return vertex_spot[v];
  }

  int spot_of_edge(std::uint32_t e) {
    if (edge_stamp[e] != stamp) {
      edge_stamp[e] = stamp;
      const LocalEdge& edge = scene.edges[e];
      made.push_back(ExactPoint::on_plane(scene.points[edge.a], scene.points[edge.b], *sector->plane));
      edge_spot[e] = add_spot(&made.back(), false);
      met_edges.push_back(e);
    }
    return edge_spot[e];
  }

  // A named point of the sector itself.
  int own_spot(const ExactPoint* p, const SpotName& name) {
    const int spot = add_spot(p, true);
    if (name.kind == SpotName::Kind::vertex) {
      vertex_stamp[name.id] = stamp;
      vertex_spot[name.id] = spot;
      side_stamp[name.id] = stamp;
      side[name.id] = 0;
    } else if (name.kind == SpotName::Kind::edge) {
      edge_stamp[name.id] = stamp;
      edge_spot[name.id] = spot;
      met_edges.push_back(name.id);
    }
    return spot;
  }

  const ExactPoint* kept(int spot) {
    Spot& s = spots[static_cast<std::size_t>(spot)];
    if (!s.kept) {
      s.p = pool.keep(*s.p);
      s.kept = true;
    }
    return s.p;
  }

  int turn(int u, int w) const {
    if (u == w) return 0;
    const Spot &a = spots[static_cast<std::size_t>(u)], &b = spots[static_cast<std::size_t>(w)];
    const int s = filtered_turn(a.d, b.d);
    return s != kUnsure ? s : exact_turn(*sector->plane, *sector->center, *a.p, *b.p);
  }
  int turn(int a, int b, int c) const {
    if (a == b || b == c || a == c) return 0;
    const Spot &p = spots[static_cast<std::size_t>(a)], &q = spots[static_cast<std::size_t>(b)],
               &r = spots[static_cast<std::size_t>(c)];
    const int s = filtered_turn(minus(q.d, p.d), minus(r.d, p.d));
    return s != kUnsure ? s : exact_turn(*sector->plane, *p.p, *q.p, *r.p);
  }
  // Of less than a half turn, from u to w; neither is the centre.
  bool in_cone(int u, int w, int x) const { return turn(u, x) >= 0 && turn(x, w) >= 0; }
  bool in_sector(int x) const { return x != center && in_cone(ray0, ray1, x) && !is_center(x); }
  bool is_center(int x) const {
    const Spot& s = spots[static_cast<std::size_t>(x)];
    return may_be_zero(s.d.x) && may_be_zero(s.d.y) && equal(*s.p, *sector->center);
  }

  void add_piece(std::uint32_t t);
  int turn_of_trace(std::uint32_t t, int down, int up) const;
  void add_radial(std::uint32_t t, int u, int w);
  void add_trace(std::uint32_t t, int u, int w);
  bool beyond_near(int u, int w) const;
  bool nearer(const Trace& a, const Trace& b) const;
  void sweep();
  void add_meetings();
  void add_meeting(bool at_vertex, std::uint32_t id, int spot);
};

void OnWedgeMaker::Work::add_piece(std::uint32_t t) {
  const LocalPiece& piece = scene.pieces[t];
  int on = 0, above = 0;
  for (const std::uint32_t c : piece.corners) {
    const int s = side_of(c);
    on += s == 0;
    above += s > 0;
  }
  if (on >= 2) {
    for (const std::uint32_t e : piece.edges) {
      if (side_of(scene.edges[e].a) == 0 && side_of(scene.edges[e].b) == 0) out.coplanar_edges.push_back(e);
    }
  }
  if (above == 0) return;
  // Where the corners, counter-clockwise about the piece's normal, come up through the plane, and where they go down.
  int up = 0, down = 0, count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t c = piece.corners[i];
    const int before = side_of(piece.corners[(i + 2) % 3]), here = side_of(c),
              after = side_of(piece.corners[(i + 1) % 3]);
    if (here == 0) {
      met_vertices.push_back(c);
      (after > 0 || before < 0 ? up : down) = spot_of_vertex(c);
      ++count;
    } else if (here * after < 0) {
      (here < 0 ? up : down) = spot_of_edge(piece.edges[i]);
      ++count;
    }
  }
  if (count != 2) return;  // touches the plane in one corner
  const int s = down == center || up == center ? 0 : turn_of_trace(t, down, up);
  if (s == 0) {
    add_radial(t, down, up);
  } else if (s > 0) {
    add_trace(t, down, up);
  } else {
    add_trace(t, up, down);
  }
}

// Seen from the centre. With n the normal of the plane and m that of the piece the trace runs along n x m from where corners go down to where they come up, and the centre is left of it where
// m . (centre - down) is negative: no point of the trace need be known for that. (Surfaces that are nearly flat have many traces which nearly run through a centre upon them.)
int OnWedgeMaker::Work::turn_of_trace(std::uint32_t t, int down, int up) const {
  const Spot &a = spots[static_cast<std::size_t>(down)], &b = spots[static_cast<std::size_t>(up)];
  const int s = filtered_turn(a.d, b.d);
  return s != kUnsure ? s : -scene.planes[t].side(*sector->center);
}

void OnWedgeMaker::Work::add_radial(std::uint32_t t, int u, int w) {
  const bool u_in = in_sector(u), w_in = in_sector(w);
  if (!u_in && !w_in) return;
  if (!u_in) u = center;  // on the other side of the centre, or the centre itself
  if (!w_in) {
    w = u;
    u = center;
  }
  if (!sector->from_apex && (turn(ray0, ray1, u) > 0 || turn(ray0, ray1, w) > 0)) return;  // before the near bound
  if (u != center) {
    // The nearer end first: on one ray from the centre, compare along the larger coordinate.
    const auto& [i, j] = sector->plane->axes();
    const ExactPoint &c = *sector->center, &pu = *spots[static_cast<std::size_t>(u)].p,
                     &pw = *spots[static_cast<std::size_t>(w)].p;
    const int axis = compare_coordinate(pu, c, i) != 0 ? i : j;
    if (compare_coordinate(pu, pw, axis) == compare_coordinate(pu, c, axis)) std::swap(u, w);
  }
  out.radials.push_back({t, kept(u), kept(w)});
}

// The near edge and the trace cover a common ray, and do not cross.
bool OnWedgeMaker::Work::beyond_near(int u, int w) const {
  for (const int x : {u, w}) {
    if (!in_cone(ray0, ray1, x)) continue;
    const int s = turn(ray0, ray1, x);
    if (s != 0) return s < 0;
  }
  for (const int x : {ray0, ray1}) {
    if (!in_cone(u, w, x)) continue;
    const int s = turn(u, w, x);
    if (s != 0) return s > 0;
  }
  return false;  // the edge itself
}

void OnWedgeMaker::Work::add_trace(std::uint32_t t, int u, int w) {
  Trace trace{t, u, w, u, w};
  if (!in_cone(ray0, ray1, u)) {
    if (!in_cone(u, w, ray0)) return;
    trace.from = ray0;
  }
  if (!in_cone(ray0, ray1, w)) {
    if (!in_cone(u, w, ray1)) return;
    trace.to = ray1;
  }
  if (turn(trace.from, trace.to) <= 0) return;
  if (!sector->from_apex && !beyond_near(u, w)) return;
  traces.push_back(trace);
}

bool OnWedgeMaker::Work::nearer(const Trace& a, const Trace& b) const {
  for (const int x : {a.u, a.w}) {
    if (!in_cone(b.u, b.w, x)) continue;
    const int s = turn(b.u, b.w, x);  // left: on the centre's side
    if (s != 0) return s > 0;
  }
  for (const int x : {b.u, b.w}) {
    if (!in_cone(a.u, a.w, x)) continue;
    const int s = turn(a.u, a.w, x);
    if (s != 0) return s < 0;
  }
  return &a < &b;
}

void OnWedgeMaker::Work::sweep() {
  struct Stop {
    int at, trace;
    bool end;
  };
  std::vector<Stop> stops;
  stops.reserve(2 * traces.size());
  for (std::size_t i = 0; i < traces.size(); ++i) {
    stops.push_back({traces[i].from, static_cast<int>(i), false});
    stops.push_back({traces[i].to, static_cast<int>(i), true});
  }
  std::stable_sort(stops.begin(), stops.end(), [&](const Stop& x, const Stop& y) {
    const int s = turn(x.at, y.at);
    return s != 0 ? s > 0 : x.end && !y.end;
  });
  std::vector<int> active;  // traces, nearest first
  std::vector<int> blocker_of(traces.size(), -1);
  struct Open {
    int ray0, trace;
  };
  std::optional<Open> open;
  const auto close = [&](int ray1_spot) {
    int blocker = -1;
    if (open->trace >= 0) {
      int& slot = blocker_of[static_cast<std::size_t>(open->trace)];
      if (slot < 0) {
        const Trace& t = traces[static_cast<std::size_t>(open->trace)];
        slot = static_cast<int>(out.blockers.size());
        out.blockers.push_back({t.piece, kept(t.u), kept(t.w)});
      }
      blocker = slot;
    }
    out.strips.push_back({kept(open->ray0), kept(ray1_spot), blocker});
  };
  int here = ray0;
  for (std::size_t i = 0; i <= stops.size();) {
    if (i == stops.size() || turn(here, stops[i].at) > 0) {  // a stretch of rays begins here
      const int nearest = active.empty() ? -1 : active.front();
      if (!open || open->trace != nearest) {
        if (open) close(here);
        open = Open{here, nearest};
      }
      if (i == stops.size()) break;
      here = stops[i].at;
      if (turn(here, ray1) <= 0) break;
    }
    if (stops[i].end) {
      active.erase(std::find(active.begin(), active.end(), stops[i].trace));
    } else {
      const auto place = std::lower_bound(active.begin(), active.end(), stops[i].trace, [&](int a, int b) {
        return nearer(traces[static_cast<std::size_t>(a)], traces[static_cast<std::size_t>(b)]);
      });
      active.insert(place, stops[i].trace);
    }
    ++i;
  }
  close(ray1);
}

void OnWedgeMaker::Work::add_meeting(bool at_vertex, std::uint32_t id, int spot) {
  if (spot == center || !in_sector(spot)) return;
  if (!sector->from_apex && turn(ray0, ray1, spot) >= 0) return;
  const ExactPoint* p = spots[static_cast<std::size_t>(spot)].p;
  bool reached = false;
  for (const Strip& s : out.strips) {
    if (out.turn(s.ray0, p) < 0) break;
    if (out.turn(p, s.ray1) < 0) continue;
    if (out.reaches(s.blocker, p)) {
      reached = true;
      break;
    }
  }
  if (reached) out.meetings.push_back({at_vertex, id, kept(spot)});
}

void OnWedgeMaker::Work::add_meetings() {
  std::sort(met_edges.begin(), met_edges.end());
  met_edges.erase(std::unique(met_edges.begin(), met_edges.end()), met_edges.end());
  std::sort(met_vertices.begin(), met_vertices.end());
  met_vertices.erase(std::unique(met_vertices.begin(), met_vertices.end()), met_vertices.end());
  for (const std::uint32_t e : met_edges) add_meeting(false, e, spot_of_edge(e));
  for (const std::uint32_t v : met_vertices) add_meeting(true, v, spot_of_vertex(v));
}

OnWedgeMaker::OnWedgeMaker(const LocalScene& scene, Pool& pool) : work_(std::make_unique<Work>(scene, pool)) {}
OnWedgeMaker::~OnWedgeMaker() = default;

OnWedge OnWedgeMaker::make(const Sector& sector) {
  Work& w = *work_;
  ++w.stamp;
  w.made.clear();
  w.spots.clear();
  w.traces.clear();
  w.met_edges.clear();
  w.met_vertices.clear();
  w.sector = &sector;
  w.out = OnWedge{};
  w.out.plane = sector.plane;
  w.out.center = sector.center;
  w.out.apex = sector.apex;
  w.center = w.own_spot(sector.center, sector.apex);
  w.ray0 = w.own_spot(sector.ray0, sector.name0);
  w.ray1 = w.own_spot(sector.ray1, sector.name1);
  w.scene.tree.any(SectorTest(sector), [&](std::uint32_t i) {
    w.add_piece(w.scene.occluders[i]);
    return false;
  });
  std::sort(w.out.coplanar_edges.begin(), w.out.coplanar_edges.end());
  w.out.coplanar_edges.erase(std::unique(w.out.coplanar_edges.begin(), w.out.coplanar_edges.end()),
                             w.out.coplanar_edges.end());
  w.sweep();
  w.add_meetings();
  return std::move(w.out);
}

}  // namespace clues::fastpath
