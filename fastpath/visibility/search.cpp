#include "fastpath/visibility/search.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "fastpath/visibility/apex.h"
#include "fastpath/visibility/beside.h"
#include "fastpath/visibility/contour.h"
#include "scene/error.h"

namespace clues::fastpath {

namespace {

constexpr std::uint64_t kSourceSeed = 0x51, kVertexSeed = 0xa7;
constexpr int kRetries = 12;

}  // namespace

class Search::Work {
 public:
  Work(const LocalScene& s, const IntervalBox& b, const LocalMapOptions& o, LocalMapCounts& c)
      : scene(s),
        bounds(b),
        options(o),
        counts(c),
        walker(s, set),
        maker(s, pool),
        on_edge(s.edges.size()),
        corners(s.points.size()) {}

  void run() {
    contours = contour_edges(scene, pool);
    edge_wedges.resize(contours.size());
    is_contour.assign(scene.edges.size(), false);
    for (std::size_t i = 0; i < contours.size(); ++i) {
      edge_wedges[i].resize(contours[i].touching.size());
      is_contour[contours[i].edge] = true;
    }
    cuts.resize(scene.edges.size());
    make_vertex_sources();
    do ++counts.rounds;
    while (round());
    count();
  }

  // --- what there is ------------------------------------------------------------------------------------------------------------

  // A contour vertex: its local picture, and the probes of this round.
  struct Contact {
    std::unique_ptr<Apex> apex;
    const ExactPoint* x = nullptr;
    int generation = 0;  // of its wedges
    std::vector<Probe> probes;
    bool fresh = false;
    std::vector<bool> built;  // per sector, in this round
    std::vector<std::unique_ptr<OnWedge>> wedges;
    std::vector<std::pair<std::vector<Probe>, std::vector<std::uint32_t>>> known;  // existing sectors by probes
  };

  // A part of a contour edge between neighbouring cuts, seen from one supporting plane (D13a), with a point beside it.
  struct Source {
    std::size_t contour = 0;
    EdgePart part;
    const ExactPoint* beside = nullptr;
    int level = 0;  // of nearness of `beside`
    std::uint64_t seed = kSourceSeed;
    Walk walk;
    bool lit = false;
  };

  // A mesh vertex x and a point beside it on the way to the cell.
  struct VertexSource {
    std::uint32_t point = 0;
    const ExactPoint* beside = nullptr;
    std::uint64_t seed = kVertexSeed;
    Walk walk;
    bool lit = false;
  };

  struct Job {
    std::size_t contour = 0;
    int touching = -1;  // index into ContourEdge::touching; -1: a sector of a contact
    const ExactPoint *lo = nullptr, *hi = nullptr;
    Contact* contact = nullptr;
    std::uint32_t sector = 0;
  };

  // --- one round ----------------------------------------------------------------------------------------------------------------

  bool round() {
    set.clear();
    beyond.clear();
    csvs_met.clear();
    const auto restart = [](Contact& c) {
      c.probes.clear();
      c.fresh = false;
      c.built.assign(c.apex->sectors().size(), false);
    };
    for (const auto& c : corners) {
      if (c) restart(*c);
    }
    for (auto& list : on_edge) {
      for (auto& c : list) {
        restart(*c);
        c->generation = -1;
      }
    }
    new_cuts.assign(scene.edges.size(), {});
    make_sources();
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].walk.end != Walk::End::surface) lit.push_back(i);
    }
    for (VertexSource& v : vertex_sources) {
      v.lit = false;
      if (v.walk.end == Walk::End::crossed) v.walk = walk(v.beside, v.seed);
      if (v.walk.end != Walk::End::surface) light_vertex(v);
    }
    std::vector<Job> jobs = light(lit);
    while (!jobs.empty()) {
      const std::size_t first = set.pieces().size();
      set.add(build(jobs));
      for (std::size_t i = first; i < set.pieces().size(); ++i) meet_edges(i);
      for (VertexSource& v : vertex_sources) {
        if (!v.lit && newly_visible(v.beside, v.walk, v.seed, first)) light_vertex(v);
      }
      jobs = light(newly_lit(first));
    }
    // From here on the visible parts of an edge that touch are one: the seams between them are no event surfaces.
    set.clear();
    set.add(build(merged_jobs()));
    for (const ValidPiece& piece : set.pieces()) cut_coplanar(piece);

    bool changed = false;
    for (std::uint32_t e = 0; e < cuts.size(); ++e) {
      if (!is_contour[e]) continue;
      for (const ExactPoint* p : new_cuts[e]) changed |= insert_cut(e, p);
    }
    return changed;
  }

  // Keeps the cuts of an edge in order from a to b; false if there was one at this point.
  bool insert_cut(std::uint32_t e, const ExactPoint* p) {
    std::vector<const ExactPoint*>& list = cuts[e];
    for (const ExactPoint* q : list) {
      if (p == q || equal(*p, *q)) return false;
    }
    const ExactPoint &a = scene.points[scene.edges[e].a], &b = scene.points[scene.edges[e].b];
    int axis = 0;
    while (compare_coordinate(a, b, axis) == 0) ++axis;
    const int way = compare_coordinate(a, b, axis);
    list.insert(std::lower_bound(
                    list.begin(), list.end(), p,
                    [&](const ExactPoint* x, const ExactPoint* y) { return compare_coordinate(*x, *y, axis) == way; }),
                p);
    return true;
  }

  Walk walk(const ExactPoint* p, std::uint64_t seed) {
    ++counts.walks;
    return walker.walk(p, pool, seed);
  }

  // --- sources ------------------------------------------------------------------------------------------------------------------

  void make_sources() {
    std::map<std::tuple<std::size_t, const ExactPoint*, const ExactPoint*>, Source> known;
    for (Source& s : sources) known.emplace(std::tuple(s.contour, s.part.lo, s.part.hi), std::move(s));
    sources.clear();
    for (std::size_t c = 0; c < contours.size(); ++c) {
      const LocalEdge& e = scene.edges[contours[c].edge];
      std::vector<const ExactPoint*> stops{&scene.points[e.a]};
      stops.insert(stops.end(), cuts[contours[c].edge].begin(), cuts[contours[c].edge].end());
      stops.push_back(&scene.points[e.b]);
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const auto it = known.find({c, stops[i], stops[i + 1]});
        if (it != known.end()) {
          Source& s = sources.emplace_back(std::move(it->second));
          s.lit = false;
          if (s.walk.end == Walk::End::crossed) s.walk = walk(s.beside, s.seed);
        } else {
          Source s;
          s.contour = c;
          s.part = {stops[i], stops[i + 1], pool.keep(ExactPoint::between(*stops[i], *stops[i + 1], 0.4716796875))};
          place(s);
          sources.push_back(std::move(s));
        }
      }
    }
    counts.sources = std::max<std::uint64_t>(counts.sources, sources.size());
  }

  // Without a place the source counts as visible.
  void place(Source& s) {
    const ContourEdge& c = contours[s.contour];
    const std::optional<ExactPoint> beside = beside_edge(scene, set, c, s.part, s.level);
    s.beside = beside ? pool.keep(*beside) : nullptr;
    if (beside) {
      s.walk = walk(s.beside, s.seed);
    } else {
      s.walk = Walk{};
      s.walk.end = Walk::End::unresolved;
    }
  }

  bool newly_visible(const ExactPoint* p, Walk& w, std::uint64_t& seed, std::size_t first) {
    Crossing c = walker.visible(w, first);
    for (int i = 0; c == Crossing::touch && i < kRetries; ++i) {
      w = walk(p, ++seed);
      c = walker.visible(w, 0);
    }
    return c != Crossing::no;
  }

  std::vector<std::size_t> newly_lit(std::size_t first) {
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      Source& s = sources[i];
      if (s.lit) continue;
      std::size_t from = first;
      if (s.beside && set.may_meet(*s.beside, *s.part.y, first, holds_edge(scene, contours[s.contour].edge))) {
        ++s.level;
        place(s);
        from = 0;
      }
      if (s.walk.end != Walk::End::surface || newly_visible(s.beside, s.walk, s.seed, from)) lit.push_back(i);
    }
    return lit;
  }

  // --- mesh vertices ------------------------------------------------------------------------------------------------------------

  void make_vertex_sources() {
    for (std::uint32_t v = 0; v < scene.points.size(); ++v) {
      if (scene.point_pieces[v].empty()) continue;
      Contact* c = corner(v);
      if (c->apex->sectors().empty()) continue;
      std::vector<ExactPoint> from;
      if (c->apex->sees_cell_in_one_part()) {
        from.push_back(*walker.viewpoint(v));
      } else {
        from = viewpoints_of_parts(scene, *c->apex, *walker.viewpoint(0));
      }
      for (const ExactPoint& p : from) add_vertex_source(v, p);
    }
  }

  void add_vertex_source(std::uint32_t v, const ExactPoint& from) {
    const ExactPoint& x = scene.points[v];
    const ExactPoint* kept = pool.keep(from);
    for (int level = 0; level < 7; ++level) {
      const ExactPoint beside = point_near(x, *kept, level);
      if (equal(beside, x) || scene.may_meet(beside, x)) continue;
      VertexSource s;
      s.point = v;
      s.beside = pool.keep(beside);
      s.walk = walk(s.beside, s.seed);
      vertex_sources.push_back(std::move(s));
      return;
    }
  }

  void light_vertex(VertexSource& v) {
    v.lit = true;
    add_probe(corner(v.point), {Probe::Kind::sight, v.beside, nullptr, 0, nullptr});
  }

  // --- lighting -----------------------------------------------------------------------------------------------------------------

  void add_probe(Contact* c, const Probe& p) {
    if (c->apex->sectors().empty()) return;
    if (std::find(c->probes.begin(), c->probes.end(), p) != c->probes.end()) return;
    c->probes.push_back(p);
    if (!c->fresh) touched.push_back(c);
    c->fresh = true;
  }

  // The wedges that newly visible sources make: their own (D10, D11), and those at the contour vertices they light (D12).
  std::vector<Job> light(const std::vector<std::size_t>& lit) {
    std::vector<Job> jobs;
    for (const std::size_t i : lit) {
      Source& s = sources[i];
      s.lit = true;
      const ContourEdge& c = contours[s.contour];
      for (int k = 0; k < static_cast<int>(c.touching.size()); ++k)
        jobs.push_back({s.contour, k, s.part.lo, s.part.hi, nullptr, 0});
      const LocalEdge& e = scene.edges[c.edge];
      const ExactPoint *a = &scene.points[e.a], *b = &scene.points[e.b];
      if (s.part.lo == a) add_probe(corner(e.a), {Probe::Kind::contour, b, c.plane, 0, nullptr});
      if (s.part.hi == b) add_probe(corner(e.b), {Probe::Kind::contour, a, c.plane, 0, nullptr});
    }
    std::vector<Contact*> order;
    order.swap(touched);
    for (const Contact* c : order) {
      if (c->apex->on_edge()) csvs_met.insert(c);
    }
    const bool too_many = csvs_met.size() > options.csv_limit + scene.edges.size();
    for (Contact* c : order) {
      c->fresh = false;
      if (c->generation > options.generation_limit || (too_many && c->apex->on_edge())) {
        beyond.push_back(c->x);
        continue;
      }
      for (const std::uint32_t k : existing(*c)) {
        if (c->built[k]) continue;
        c->built[k] = true;
        jobs.push_back({0, -1, nullptr, nullptr, c, k});
      }
    }
    return jobs;
  }

  const std::vector<std::uint32_t>& existing(Contact& c) {
    for (const auto& [probes, sectors] : c.known) {
      if (probes == c.probes) return sectors;
    }
    c.known.emplace_back(c.probes, existing_or_all(*c.apex, c.probes));
    return c.known.back().second;
  }

  // A sector too many only makes more visible: where the vertex is too intricate to decide, all of them.
  std::vector<std::uint32_t> existing_or_all(const Apex& apex, const std::vector<Probe>& probes) {
    try {
      return apex.existing(probes);
    } catch (const scene::Error& error) {
      if (error.code() != scene::ErrorCode::internal) throw;
      ++counts.conservative_fallbacks;
      std::vector<std::uint32_t> all(apex.sectors().size());
      std::iota(all.begin(), all.end(), 0U);
      return all;
    }
  }

  // All wedges of the round, with one job for each maximal visible part of a contour edge.
  std::vector<Job> merged_jobs() {
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < sources.size();) {
      std::size_t j = i;
      while (j < sources.size() && sources[j].contour == sources[i].contour && sources[j].lit) ++j;
      if (j > i) {
        const std::size_t c = sources[i].contour;
        for (int k = 0; k < static_cast<int>(contours[c].touching.size()); ++k)
          jobs.push_back({c, k, sources[i].part.lo, sources[j - 1].part.hi, nullptr, 0});
      }
      i = std::max(j, i + 1);
    }
    const auto add = [&](Contact& c) {
      for (std::uint32_t k = 0; k < c.built.size(); ++k) {
        if (c.built[k]) jobs.push_back({0, -1, nullptr, nullptr, &c, k});
      }
    };
    for (const auto& c : corners) {
      if (c) add(*c);
    }
    for (const auto& list : on_edge) {
      for (const auto& c : list) add(*c);
    }
    return jobs;
  }

  // --- wedges -------------------------------------------------------------------------------------------------------------------

  const OnWedge& wedge_of(const Job& job) {
    std::unique_ptr<OnWedge>& slot = job.touching >= 0
                                         ? edge_wedges[job.contour][static_cast<std::size_t>(job.touching)]
                                         : job.contact->wedges[job.sector];
    if (slot) return *slot;
    Sector s;
    if (job.touching < 0) {
      const Apex& apex = *job.contact->apex;
      const ApexSector& sector = apex.sectors()[job.sector];
      s = {sector.plane, job.contact->x, sector.ray0, sector.ray1, sector.name0, sector.name1, true, {}};
      s.apex = {apex.on_edge() ? SpotName::Kind::edge : SpotName::Kind::vertex, apex.id()};
    } else {
      const ContourEdge& c = contours[job.contour];
      const LocalEdge& e = scene.edges[c.edge];
      s.plane = c.plane;
      s.center = &scene.cell.vertices[static_cast<std::size_t>(c.touching[static_cast<std::size_t>(job.touching)])];
      s.ray0 = &scene.points[e.a];
      s.ray1 = &scene.points[e.b];
      s.name0 = {SpotName::Kind::vertex, e.a};
      s.name1 = {SpotName::Kind::vertex, e.b};
      const OnWedge frame{s.plane, s.center, {}, {}, {}, {}, {}};
      if (frame.turn(s.ray0, s.ray1) < 0) {
        std::swap(s.ray0, s.ray1);
        std::swap(s.name0, s.name1);
      }
    }
    ++counts.wedges;
    slot = std::make_unique<OnWedge>(maker.make(s));
    return *slot;
  }

  std::vector<ValidPiece> build(const std::vector<Job>& jobs) {
    std::vector<ValidPiece> batch;
    for (const Job& job : jobs) {
      const OnWedge& on = wedge_of(job);
      ValidPiece piece;
      piece.on = &on;
      const ExactPoint *lo = job.lo, *hi = job.hi;
      if (job.touching < 0) {
        piece.kind = PieceKind::se_mv;
        piece.generation = job.contact->generation;
      } else {
        const ContourEdge& c = contours[job.contour];
        piece.kind = c.touching.size() > 1 ? PieceKind::se_me : PieceKind::sv_me;
        piece.near0 = on.strips.front().ray0;
        piece.near1 = on.strips.back().ray1;
        if (piece.near0 != &scene.points[scene.edges[c.edge].a]) std::swap(lo, hi);
      }
      for (const Strip& strip : on.strips) {
        piece.ray0 = lo && on.turn(strip.ray0, lo) > 0 ? lo : strip.ray0;
        piece.ray1 = hi && on.turn(hi, strip.ray1) > 0 ? hi : strip.ray1;
        piece.blocker = strip.blocker;
        if (lo && on.turn(piece.ray0, piece.ray1) <= 0) continue;
        set_box(piece, bounds);
        batch.push_back(piece);
      }
    }
    return batch;
  }

  // --- CSVs ---------------------------------------------------------------------------------------------------------------------

  void meet_edges(std::size_t i) {
    const ValidPiece piece = set.pieces()[i];
    const OnWedge& on = *piece.on;
    for (const Meeting& m : on.meetings) {
      const int after = on.turn(piece.ray0, m.at);
      if (after < 0) continue;
      const int before = on.turn(m.at, piece.ray1);
      if (before < 0) continue;
      if (piece.blocker >= 0) {
        const Blocker& b = on.blockers[static_cast<std::size_t>(piece.blocker)];
        if (on.turn(b.u, b.w, m.at) < 0) continue;
      }
      Contact* c = m.at_vertex ? corner(m.id) : csv(m.id, m.at);
      if (!m.at_vertex) new_cuts[m.id].push_back(c->x);
      const int generation = piece.generation + 1;
      if (!m.at_vertex && (c->generation < 0 || generation < c->generation)) c->generation = generation;
      Probe probe{Probe::Kind::csv, on.center, on.plane, 0, nullptr};
      if (!m.at_vertex) {
        const LocalEdge& e = scene.edges[m.id];
        probe.lit_end = &scene.points[on.plane->side(scene.points[e.a]) > 0 ? e.a : e.b];
      }
      // The piece lies on both sides of the ray through the vertex, or on one.
      if (before > 0) {
        probe.aside = 1;
        add_probe(c, probe);
      }
      if (after > 0) {
        probe.aside = -1;
        add_probe(c, probe);
      }
    }
  }

  // The outline of a piece that runs over an edge in its plane changes the label along that edge.
  void cut_coplanar(const ValidPiece& piece) {
    const OnWedge& on = *piece.on;
    for (const std::uint32_t e : on.coplanar_edges) {
      if (!is_contour[e]) continue;
      const ExactPoint &a = scene.points[scene.edges[e].a], &b = scene.points[scene.edges[e].b];
      for (const ExactPoint* ray : {piece.ray0, piece.ray1}) {
        if (on.turn(ray, &a) * on.turn(ray, &b) >= 0) continue;
        const auto [known, fresh] = coplanar_cuts.try_emplace({&on, ray, e}, nullptr);
        if (fresh) known->second = crossing_in_plane(on, *ray, a, b);
        if (known->second) new_cuts[e].push_back(known->second);
      }
    }
  }

  // Where the edge crosses the plane through the ray that is normal to the wedge; in front of the centre, not behind it.
  const ExactPoint* crossing_in_plane(const OnWedge& on, const ExactPoint& ray, const ExactPoint& a,
                                      const ExactPoint& b) {
    const Exact3 &c = on.center->exact(), &n = on.plane->normal_exact();
    const Exact3 d = ray.exact() - c, beside = cross(n, d);
    const Rational at_a = dot(beside, a.exact() - c), at_b = dot(beside, b.exact() - c);
    const Exact3 x = a.exact() + Rational(at_a / (at_a - at_b)) * (b.exact() - a.exact());
    if (sgn(Rational(dot(x - c, d))) <= 0) return nullptr;
    return pool.keep(ExactPoint(x));
  }

  Contact* csv(std::uint32_t edge, const ExactPoint* x) {
    for (const auto& c : on_edge[edge]) {
      if (c->x == x || equal(*c->x, *x)) return c.get();
    }
    Contact* c = on_edge[edge].emplace_back(new_contact(true, edge, x)).get();
    c->generation = -1;
    return c;
  }

  Contact* corner(std::uint32_t point) {
    if (!corners[point]) corners[point] = new_contact(false, point, &scene.points[point]);
    return corners[point].get();
  }

  std::unique_ptr<Contact> new_contact(bool is_on_edge, std::uint32_t id, const ExactPoint* x) {
    ++counts.apexes;
    auto c = std::make_unique<Contact>();
    c->x = x;
    c->apex = std::make_unique<Apex>(scene, pool, is_on_edge, id, x);
    c->built.assign(c->apex->sectors().size(), false);
    c->wedges.resize(c->apex->sectors().size());
    return c;
  }

  void count() {
    for (const auto& list : on_edge) {
      for (const auto& c : list) counts.csv += std::find(c->built.begin(), c->built.end(), true) != c->built.end();
    }
    counts.conservative_fallbacks += beyond.size();
    for (const Source& s : sources) counts.conservative_fallbacks += s.walk.end == Walk::End::unresolved;
    for (const VertexSource& v : vertex_sources) counts.conservative_fallbacks += v.walk.end == Walk::End::unresolved;
  }

  const LocalScene& scene;
  const IntervalBox& bounds;
  const LocalMapOptions& options;
  LocalMapCounts& counts;
  Pool pool;
  PieceSet set;
  Walker walker;
  OnWedgeMaker maker;
  std::vector<ContourEdge> contours;
  std::vector<std::vector<std::unique_ptr<OnWedge>>> edge_wedges;  // per contour edge and touching vertex
  std::vector<bool> is_contour;
  std::vector<std::vector<const ExactPoint*>> cuts, new_cuts;  // per edge; cuts from a to b
  std::map<std::tuple<const OnWedge*, const ExactPoint*, std::uint32_t>, const ExactPoint*> coplanar_cuts;
  std::vector<Source> sources;
  std::vector<VertexSource> vertex_sources;
  std::vector<std::vector<std::unique_ptr<Contact>>> on_edge;
  std::vector<std::unique_ptr<Contact>> corners;
  std::vector<Contact*> touched;
  std::set<const Contact*> csvs_met;  // in this round
  std::vector<const ExactPoint*> beyond;
};

Search::Search(const LocalScene& scene, const IntervalBox& bounds, const LocalMapOptions& options,
               LocalMapCounts& counts)
    : work_(std::make_unique<Work>(scene, bounds, options, counts)) {}
Search::~Search() = default;
void Search::run() { work_->run(); }
const PieceSet& Search::pieces() const { return work_->set; }
const Walker& Search::walker() const { return work_->walker; }
const std::vector<const ExactPoint*>& Search::beyond_limit() const { return work_->beyond; }

}  // namespace clues::fastpath
