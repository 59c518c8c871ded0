#include "fastpath/visibility/search/search.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "fastpath/visibility/scene/surface_vertices.h"
#include "fastpath/visibility/search/circles.h"
#include "fastpath/visibility/search/coplanar_cuts.h"
#include "fastpath/visibility/search/doubtful_sources.h"
#include "fastpath/visibility/search/pieces_before.h"
#include "fastpath/visibility/search/sources.h"
#include "fastpath/visibility/wedges/contacts.h"

namespace clues::fastpath {

class Search::Work {
 public:
  Work(const LocalScene& s, const IntervalBox& b, const LocalMapOptions& o, LocalMapCounts& c, Workers& w)
      : scene(s),
        bounds(b),
        options(o),
        counts(c),
        workers(w),
        is_vertex(surface_vertices(s)),
        contours(contour_edges(s, w)),
        walker(s, set, o.dials.longest_walk),
        fresh_walker(s, fresh, o.dials.longest_walk),
        contacts(s, contours, workers),
        sources(s, is_vertex, contours, set, walker, contacts, workers),
        edge_wedges(contours.size()),
        is_contour(s.edges.size(), false),
        cuts(s.edges.size()),
        coplanar_cuts(s, is_contour, w),
        left_out(s.cell.bounds()),
        doubtful_sources(s, contours, sources, contacts, left_out, w) {}

  // A search is made of very many small things, which all threads give back.
  ~Work() {
    workers.for_each(edge_wedges.size(), [this](std::size_t i, Workers::Worker&) { edge_wedges[i].clear(); });
    contacts.clear();
    sources.clear();
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  void run() {
    for (std::size_t i = 0; i < contours.size(); ++i) {
      edge_wedges[i].resize(contours[i].touching.size());
      is_contour[contours[i].edge] = true;
    }
    do ++counts.rounds;
    while (round());
    doubtful_sources.leave_out();
    count();
  }

  // A wedge of a part of a contour edge, or of a sector of a contact.
  struct Job {
    std::size_t contour = 0;
    int touching = -1;  // index into ContourEdge::touching; -1: a sector of a contact
    const ExactPoint *lo = nullptr, *hi = nullptr;
    Contact* contact = nullptr;
    std::uint32_t sector = 0;
    bool in_doubt = false;  // its source counts as visible without a proof
  };

  // --- one round ----------------------------------------------------------------------------------------------------------------

  // Whether another one is needed. If not, the set holds what is valid.
  bool round() {
    left_out.clear();
    left_out_contacts.clear();
    start_light();
    sources.start_round(cuts);
    counts.sources = std::max<std::uint64_t>(counts.sources, sources.of_edges().size());
    new_cuts.assign(scene.edges.size(), {});
    spread(Sources::Light::sure);
    spread(Sources::Light::in_doubt);
    sources.end_light();
    // From here on the visible parts of an edge that touch are one: the seams between them are no event surfaces.
    std::vector<ValidPiece> merged = build(merged_jobs());
    std::vector<ValidPiece> others = pieces_before.others(merged);
    spend_effort_on(others, 1);
    for (const auto& [e, p] : coplanar_cuts.of(merged)) new_cuts[e].push_back(p);

    std::vector<char> is_cut(cuts.size(), 0);
    workers.for_each(cuts.size(), [&](std::size_t e, Workers::Worker&) {
      if (!is_contour[e]) return;
      for (const ExactPoint* p : new_cuts[e]) {
        if (insert_cut(static_cast<std::uint32_t>(e), p)) is_cut[e] = 1;
      }
    });
    bool changed = std::find(is_cut.begin(), is_cut.end(), 1) != is_cut.end();
    fresh.clear();
    fresh.add(std::move(others), workers);
    const bool all_still_there = pieces_before.replace(merged);
    set.clear();
    set.add(std::move(merged), workers);
    if (sources.ask_nearer(fresh_walker, all_still_there)) changed = true;
    if (!changed) {
      for (const auto& [e, p] : cuts_of_circles(scene, contours, sources.of_edges(), workers))
        changed |= insert_cut(e, p);
    }
    if (changed) set.clear();
    return changed;
  }

  // D17b.
  void keep_known() {
    sources.start_known(left_out);
    set.clear();
    start_light();
    spread(Sources::Light::known);
  }

  // Nothing has been lit yet.
  void start_light() {
    contacts.start_round();
    csvs_met.clear();
    too_intricate.clear();
    fresh.clear();
  }

  // Lights sources, and all that follows from it.
  void spread(Sources::Light light_that_spreads) {
    light_of = light_that_spreads;
    first_fresh = fresh.pieces().size();
    for (std::vector<Job> waiting = light(set.pieces().size()); !waiting.empty();) {
      const std::size_t first = set.pieces().size();
      auto [batch, others] = build_within_effort(next_batch(waiting));
      first_fresh = fresh.pieces().size();
      fresh.add(std::move(others), workers);
      set.add(std::move(batch), workers);
      meet_edges(first);
      const std::vector<Job> jobs = light(first);
      waiting.insert(waiting.end(), jobs.begin(), jobs.end());
    }
  }

  // Takes what is built before the next look at what it lights: all, but for a dial.
  std::vector<Job> next_batch(std::vector<Job>& waiting) const {
    const std::size_t most = options.dials.batch == 0 ? waiting.size() : options.dials.batch;
    std::vector<Job> rest;
    if (most < waiting.size()) {
      rest.assign(waiting.begin() + static_cast<std::ptrdiff_t>(most), waiting.end());
      waiting.resize(most);
    }
    return std::exchange(waiting, std::move(rest));
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

  // What is lit now is lit because something counts as visible.
  bool in_doubt() const { return light_of == Sources::Light::in_doubt; }

  // --- lighting -----------------------------------------------------------------------------------------------------------------

  // The wedges that sources make which the pieces from number `first` on light: their own (D10, D11), and those at the contour vertices they light (D12).
  std::vector<Job> light(std::size_t first) {
    const auto [newly_lit_edges, newly_lit_vertices] = sources.newly_lit(first, {fresh_walker, first_fresh}, light_of);
    const auto is_doubtful = [this](const auto& source) {
      return in_doubt() || source.walk.end == Walk::End::unresolved;
    };
    for (const std::size_t i : newly_lit_vertices) {
      const Sources::OfVertex& v = sources.of_vertices()[i];
      contacts.add(contacts.corner(v.point), {Probe::Kind::sight, v.beside, {}, nullptr, 0, nullptr, is_doubtful(v)});
    }
    std::vector<Job> jobs;
    for (const std::size_t i : newly_lit_edges) {
      const Sources::OfEdge& s = sources.of_edges()[i];
      const ContourEdge& c = contours[s.contour];
      for (int k = 0; k < static_cast<int>(c.touching.size()); ++k)
        jobs.push_back({s.contour, k, s.part.lo, s.part.hi, nullptr, 0});
      const LocalEdge& e = scene.edges[c.edge];
      const auto probe_along = [&](std::uint32_t to) {
        return Probe{Probe::Kind::contour, &scene.points[to], {SpotName::Kind::vertex, to}, c.plane, 0, nullptr,
                     is_doubtful(s)};
      };
      if (is_vertex[e.a] && s.part.lo == &scene.points[e.a]) contacts.add(contacts.corner(e.a), probe_along(e.b));
      if (is_vertex[e.b] && s.part.hi == &scene.points[e.b]) contacts.add(contacts.corner(e.b), probe_along(e.a));
    }
    std::vector<Contact*> lit = contacts.lit();
    for (const Contact* c : lit) {
      if (c->on_edge) csvs_met.insert(c);
    }
    const exact::Dials& dials = options.dials;
    const std::size_t most = dials.csv_limit + dials.csv_limit_per_edge * scene.edges.size();
    const bool too_many = csvs_met.size() > (options.csvs_by_effort ? LocalMapOptions::kCsvsByEffort * most : most);
    std::erase_if(lit, [&](const Contact* c) {
      const bool out = c->generation > dials.generation_limit || (too_many && c->on_edge);
      if (out && light_of != Sources::Light::known && left_out_contacts.insert(c).second)
        left_out.add(LeftOut::around(*c->apex), c->x->approximate());
      return out;
    });
    contacts.find_sectors(lit);
    // That their sectors exist is in doubt.
    const auto known =
        std::stable_partition(lit.begin(), lit.end(), [](const Contact* c) { return !c->has_all_sectors; });
    too_intricate.insert(too_intricate.end(), known, lit.end());
    lit.erase(known, lit.end());
    if (in_doubt()) {
      std::copy_if(too_intricate.begin(), too_intricate.end(), std::back_inserter(lit),
                   [&](const Contact* c) { return !left_out_contacts.contains(c); });
    }
    for (Contact* c : lit) {
      for (const std::uint32_t k : c->sectors) {
        if (c->built[k]) continue;
        c->built[k] = true;
        jobs.push_back({0, -1, nullptr, nullptr, c, k});
      }
    }
    return jobs;
  }

  // All wedges of the round, with one job for each maximal visible part of a contour edge.
  std::vector<Job> merged_jobs() {
    std::vector<Job> jobs;
    const std::vector<Sources::OfEdge>& parts = sources.of_edges();
    for (std::size_t i = 0; i < parts.size();) {
      std::size_t j = i;
      while (j < parts.size() && parts[j].contour == parts[i].contour && parts[j].lit) ++j;
      if (j > i) {
        const std::size_t c = parts[i].contour;
        const bool unproved =
            std::any_of(parts.begin() + static_cast<std::ptrdiff_t>(i), parts.begin() + static_cast<std::ptrdiff_t>(j),
                        [](const Sources::OfEdge& s) { return s.walk.end == Walk::End::unresolved; });
        for (int k = 0; k < static_cast<int>(contours[c].touching.size()); ++k)
          jobs.push_back({c, k, parts[i].part.lo, parts[j - 1].part.hi, nullptr, 0, unproved});
      }
      i = std::max(j, i + 1);
    }
    contacts.for_all([&](Contact& c) {
      for (std::uint32_t k = 0; k < c.built.size(); ++k) {
        if (c.built[k]) jobs.push_back({0, -1, nullptr, nullptr, &c, k});
      }
    });
    return jobs;
  }

  // --- wedges -------------------------------------------------------------------------------------------------------------------

  std::unique_ptr<OnWedge>& slot(const Job& job) {
    return job.touching >= 0 ? edge_wedges[job.contour][static_cast<std::size_t>(job.touching)]
                             : job.contact->wedges[job.sector];
  }

  Sector sector_of(const Job& job) const {
    Sector s;
    if (job.touching < 0) {
      const Contact& c = *job.contact;
      const ApexSector& sector = c.apex->sectors()[job.sector];
      s = {sector.plane, c.x, sector.ray0, sector.ray1, sector.name0, sector.name1, true, {}};
      s.apex = {c.on_edge ? SpotName::Kind::edge : SpotName::Kind::vertex, c.id};
    } else {
      const ContourEdge& c = contours[job.contour];
      const LocalEdge& e = scene.edges[c.edge];
      s.plane = c.plane;
      s.center = &scene.cell.vertices[static_cast<std::size_t>(c.touching[static_cast<std::size_t>(job.touching)])];
      s.ray0 = &scene.points[e.a];
      s.ray1 = &scene.points[e.b];
      s.name0 = {SpotName::Kind::vertex, e.a};
      s.name1 = {SpotName::Kind::vertex, e.b};
      const OnWedge frame{s.plane, s.center, {}, {}, {}, {}, {}, {}};
      if (frame.turn(s.ray0, s.ray1) < 0) {
        std::swap(s.ray0, s.ray1);
        std::swap(s.name0, s.name1);
      }
    }
    return s;
  }

  std::vector<ValidPiece> build(const std::vector<Job>& jobs) {
    std::vector<const Job*> missing;
    std::set<const std::unique_ptr<OnWedge>*> wanted;
    for (const Job& job : jobs) {
      if (!slot(job) && wanted.insert(&slot(job)).second) missing.push_back(&job);
    }
    counts.wedges += missing.size();
    workers.for_each(missing.size(), [&](std::size_t i, Workers::Worker& worker) {
      slot(*missing[i]) = std::make_unique<OnWedge>(worker.maker.make(sector_of(*missing[i])));
    });
    std::vector<std::vector<ValidPiece>> made(jobs.size());
    workers.for_each(jobs.size(),
                     [&](std::size_t i, Workers::Worker&) { made[i] = pieces_of(jobs[i], *slot(jobs[i])); });
    std::vector<ValidPiece> batch;
    for (const auto& list : made) batch.insert(batch.end(), list.begin(), list.end());
    return batch;
  }

  // The pieces of the jobs, and those of them that were not there in the round before. Effort is spent on these by and by: where light leaks the last batch is far too large.
  std::pair<std::vector<ValidPiece>, std::vector<ValidPiece>> build_within_effort(const std::vector<Job>& jobs) {
    constexpr std::size_t kAtOnce = 1024;
    std::vector<ValidPiece> all, others;
    for (std::size_t first = 0; first < jobs.size(); first += kAtOnce) {
      const auto begin = jobs.begin() + static_cast<std::ptrdiff_t>(first);
      const std::vector<ValidPiece> some =
          build({begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, jobs.size() - first))});
      const std::vector<ValidPiece> others_of_these = pieces_before.others(some);
      spend_effort_on(others_of_these, in_doubt() ? cost_in_doubt() : 1);
      all.insert(all.end(), some.begin(), some.end());
      others.insert(others.end(), others_of_these.begin(), others_of_these.end());
    }
    return {std::move(all), std::move(others)};
  }

  std::uint64_t cost_in_doubt() const {
    return options.csvs_by_effort ? LocalMapOptions::kInMuchDoubt : LocalMapOptions::kInDoubt;
  }

  void spend_effort_on(const std::vector<ValidPiece>& pieces, std::uint64_t each) {
    if (options.effort == 0) return;
    for (const ValidPiece& piece : pieces)
      effort += each * static_cast<std::uint64_t>((1 + piece.generation) * (1 + piece.generation));
    if (effort / std::max(scene.triangles, LocalMapOptions::kLeastTriangles) >= options.effort) throw EffortSpent{};
  }

  std::vector<ValidPiece> pieces_of(const Job& job, const OnWedge& on) const {
    std::vector<ValidPiece> pieces;
    ValidPiece piece;
    piece.on = &on;
    piece.holds_cell = scene.cell.lies_in(*on.plane);
    piece.in_doubt = piece.holds_cell && (job.touching < 0 || job.in_doubt);
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
    pieces.reserve(on.strips.size());
    for (const Strip& strip : on.strips) {
      piece.ray0 = lo && on.turn(strip.ray0, lo) > 0 ? lo : strip.ray0;
      piece.ray1 = hi && on.turn(hi, strip.ray1) > 0 ? hi : strip.ray1;
      piece.blocker = strip.blocker;
      if (lo && on.turn(piece.ray0, piece.ray1) <= 0) continue;
      set_box(piece, bounds);
      pieces.push_back(piece);
    }
    return pieces;
  }

  // --- CSVs ---------------------------------------------------------------------------------------------------------------------

  // Where the pieces from number `first` on meet mesh edges and vertices, these become contour vertices, lit by the pieces.
  void meet_edges(std::size_t first) {
    std::vector<std::vector<Met>> met(set.pieces().size() - first);
    workers.for_each(met.size(),
                     [&](std::size_t i, Workers::Worker&) { met[i] = meetings_of(set.pieces()[first + i]); });
    std::vector<std::pair<std::uint32_t, const ExactPoint*>> on_edges;
    for (const auto& list : met) {
      for (const Met& m : list) {
        if (!m.at->at_vertex) on_edges.emplace_back(m.at->id, m.at->at);
      }
    }
    contacts.make_csvs(on_edges);
    for (std::size_t i = 0; i < met.size(); ++i) {
      for (const Met& m : met[i]) meet(set.pieces()[first + i], *m.at, m.after, m.before);
    }
  }

  // A meeting that a piece reaches: after its first ray, before its second, or upon one of them.
  struct Met {
    const Meeting* at = nullptr;
    bool after = false, before = false;
  };
  static std::vector<Met> meetings_of(const ValidPiece& piece) {
    std::vector<Met> met;
    const OnWedge& on = *piece.on;
    for (const Meeting& m : on.meetings) {
      const int after = on.turn(piece.ray0, m.at);
      if (after < 0) continue;
      const int before = on.turn(m.at, piece.ray1);
      if (before < 0 || !on.reaches(piece.blocker, m.at)) continue;
      met.push_back({&m, after > 0, before > 0});
    }
    return met;
  }

  void meet(const ValidPiece& piece, const Meeting& m, bool after, bool before) {
    const OnWedge& on = *piece.on;
    Contact* c = m.at_vertex ? contacts.corner(m.id) : contacts.csv(m.at);
    Probe probe{Probe::Kind::csv, on.center, on.apex, on.plane, 0, nullptr, in_doubt()};
    if (!m.at_vertex) {
      new_cuts[m.id].push_back(c->x);
      const int generation = piece.generation + 1;
      if (c->generation < 0 || generation < c->generation) c->generation = generation;
      const LocalEdge& e = scene.edges[m.id];
      // On the rim of the piece the lit space before it may meet the edge in this point alone.
      if (before && after) probe.lit_end = &scene.points[on.plane->side(scene.points[e.a]) > 0 ? e.a : e.b];
    }
    // The piece lies on both sides of the ray through the vertex, or on one.
    if (before) {
      probe.aside = 1;
      contacts.add(c, probe);
    }
    if (after) {
      probe.aside = -1;
      contacts.add(c, probe);
    }
  }

  void count() {
    contacts.for_all([&](const Contact& c) {
      counts.apexes += c.apex ? 1 : 0;
      counts.csv += c.on_edge && std::find(c.built.begin(), c.built.end(), true) != c.built.end() ? 1 : 0;
    });
    counts.walks += sources.walks();
    counts.conservative_fallbacks += contacts.conservative_fallbacks() + left_out.size() + sources.unresolved();
  }

  const LocalScene& scene;
  const IntervalBox& bounds;
  const LocalMapOptions& options;
  LocalMapCounts& counts;
  Workers& workers;
  const std::vector<bool> is_vertex;  // by point
  std::vector<ContourEdge> contours;
  PieceSet set;
  Walker walker;
  PieceSet fresh;  // those of the set that are no part of what there was at the end of the round before
  Walker fresh_walker;
  std::size_t first_fresh = 0;  // of the newest batch
  Contacts contacts;
  Sources sources;
  std::vector<std::vector<std::unique_ptr<OnWedge>>> edge_wedges;  // per contour edge and touching vertex
  std::vector<bool> is_contour;
  Sources::Light light_of = Sources::Light::sure;              // that spreads now
  std::vector<Contact*> too_intricate;                         // lit in this round
  std::vector<std::vector<const ExactPoint*>> cuts, new_cuts;  // per edge; cuts from a to b
  CoplanarCuts coplanar_cuts;
  std::set<const Contact*> csvs_met;  // in this round
  std::uint64_t effort = 0;           // of all rounds, so far (options.h)
  PiecesBefore pieces_before;
  std::set<const Contact*> left_out_contacts;
  LeftOut left_out;
  DoubtfulSources doubtful_sources;
};

Search::Search(const LocalScene& scene, const IntervalBox& bounds, const LocalMapOptions& options,
               LocalMapCounts& counts, Workers& workers)
    : scene_(scene), bounds_(bounds), options_(options), counts_(counts), workers_(workers) {}
Search::~Search() = default;
void Search::run() {
  work_ = std::make_unique<Work>(scene_, bounds_, options_, counts_, workers_);
  work_->run();
}
const PieceSet& Search::pieces() const { return work_->set; }
void Search::keep_known() { work_->keep_known(); }
const Walker& Search::walker() const { return work_->walker; }
const LeftOut& Search::left_out() const { return work_->left_out; }

}  // namespace clues::fastpath
