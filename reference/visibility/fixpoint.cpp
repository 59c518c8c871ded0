#include "reference/visibility/fixpoint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "exact/simple_point.h"
#include "reference/visibility/apex.h"
#include "reference/visibility/contour.h"
#include "reference/visibility/sources.h"
#include "reference/visibility/walk.h"
#include "scene/error.h"

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

// The planted bug of a tolerance: strips that look narrow in doubles are taken for nothing.
bool is_narrow(const Strip& s, const Point3& center) {
  const auto c = exact::to_double_estimate(center), a = exact::to_double_estimate(s.on_ray0.p),
             b = exact::to_double_estimate(s.on_ray1.p);
  double dot = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    dot += (a[i] - c[i]) * (b[i] - c[i]);
    aa += (a[i] - c[i]) * (a[i] - c[i]);
    bb += (b[i] - c[i]) * (b[i] - c[i]);
  }
  return dot * dot > 0.98 * aa * bb;
}

// A sector waiting to become valid pieces: either a contour edge seen from a touching cell vertex, or a sector of an apex.
struct Job {
  std::size_t contour = 0;
  int touching = -1;  // index into ContourEdge::touching; -1: an apex sector
  Point3 lo, hi;      // the part of the contour edge
  Apex* apex = nullptr;
  std::size_t sector = 0;
  std::shared_ptr<const OnWedge>* slot = nullptr;
};

class Search {
 public:
  Search(const exact::SceneQuery& scene, const Options& options, Statistics& statistics)
      : scene_(scene),
        complex_(scene.complex()),
        options_(options),
        statistics_(statistics),
        walker_(scene, options.planted_bug != PlantedBug::no_rule_3),
        contours_(contour_edges(complex_, scene.cell())),
        cuts_(complex_.edges.size()),
        wedges_(scene) {
    edge_wedges_.resize(contours_.size());
    for (std::size_t i = 0; i < contours_.size(); ++i) {
      edge_wedges_[i].resize(contours_[i].touching.size());
      is_contour_.insert(contours_[i].edge);
    }
    if (options.planted_bug == PlantedBug::wrong_wedge_side) {
      for (ContourEdge& c : contours_) c.plane = c.plane.opposite();
    }
  }

  Fixpoint run() {
    vertex_sources_ = vertex_sources(
        scene_, walker_, [this](std::uint32_t p) -> const Apex& { return *corner(p); }, statistics_.walks);
    for (bool changed = true; changed;) {
      ++statistics_.rounds;
      changed = round();
    }
    count();
    Fixpoint out{std::move(wedges_), std::move(beyond_limit_), {}, {}};
    find_lit(out);
    return out;
  }

 private:
  // --- one round ------------------------------------------------------------------------------------------------------------

  bool round() {
    wedges_ = WedgeSet(scene_);
    beyond_limit_.clear();
    csvs_met_.clear();
    for (auto& [key, apex] : csvs_) apex->start_round();
    for (auto& [key, apex] : corners_) apex->start_round();
    new_cuts_.assign(complex_.edges.size(), {});
    sources_ = edge_sources(scene_, walker_, contours_, cuts_, std::move(sources_), statistics_.walks);

    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].walk.ends_at_cell || sources_[i].walk.unresolved) lit.push_back(i);
    }
    for (VertexSource& s : vertex_sources_) {
      s.lit = false;
      if (s.walk.ends_at_cell || s.walk.unresolved) light_vertex(s);
    }
    std::vector<Job> jobs = light(lit);
    while (!jobs.empty()) {
      report();
      const std::size_t first = wedges_.pieces().size();
      std::vector<ValidPiece> batch = build(jobs);
      wedges_.add(std::move(batch));
      for (std::size_t i = first; i < wedges_.pieces().size(); ++i) meet_edges(i);
      for (VertexSource& s : vertex_sources_) {
        if (!s.lit && walker_.visible(start_of(s), s.walk, wedges_, first) == Meets::yes) light_vertex(s);
      }
      jobs = light(newly_lit(first));
    }

    // From here on the visible parts of an edge that touch are one: the seams between them are no event surfaces.
    wedges_ = WedgeSet(scene_);
    wedges_.add(build(merged_jobs()));
    for (const ValidPiece& piece : wedges_.pieces()) {
      for (const std::uint32_t e : piece.on_wedge->coplanar_edges) cut_coplanar(piece, e);
    }

    bool changed = false;
    for (std::size_t e = 0; e < cuts_.size(); ++e) {
      std::set<Point3, decltype(&before)> all(cuts_[e].begin(), cuts_[e].end(), &before);
      all.insert(new_cuts_[e].begin(), new_cuts_[e].end());
      if (all.size() == cuts_[e].size()) continue;
      cuts_[e].assign(all.begin(), all.end());
      if (is_contour_.contains(static_cast<std::uint32_t>(e))) changed = true;
    }
    return changed;
  }

  void light_vertex(VertexSource& s) {
    s.lit = true;
    Apex* apex = corner(s.point);
    apex->add_probe(s.probe);
    touched_.insert(apex);
  }

  // Hidden sources that the pieces from index `first` on make visible.
  std::vector<std::size_t> newly_lit(std::size_t first) {
    std::vector<Meets> label(sources_.size(), Meets::no);
    tbb::parallel_for(std::size_t{0}, sources_.size(), [&](std::size_t i) {
      Source& s = sources_[i];
      if (s.lit) return;
      label[i] = walker_.visible(start_of(s, contours_), s.walk, wedges_, first);
      for (int attempt = 0; label[i] == Meets::degenerate && attempt < 100;
           ++attempt) {  // walk elsewhere, and ask all pieces
        s.walk = walker_.walk(start_of(s, contours_), ++s.seed);
        label[i] = walker_.visible(start_of(s, contours_), s.walk, wedges_, 0);
      }
    });
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < label.size(); ++i) {
      if (label[i] == Meets::yes) lit.push_back(i);
      if (label[i] == Meets::degenerate)
        throw scene::Error(scene::ErrorCode::internal, "fixpoint: an edge piece without a walk in general position");
    }
    return lit;
  }

  // The wedges that newly visible sources make: their own (D10, D11), and those at the corners and CSVs they light (D12).
  std::vector<Job> light(const std::vector<std::size_t>& lit) {
    std::vector<Job> jobs;
    for (const std::size_t i : lit) {
      Source& s = sources_[i];
      s.lit = true;
      const ContourEdge& c = contours_[s.contour];
      for (int k = 0; k < static_cast<int>(c.touching.size()); ++k) {
        jobs.push_back({s.contour, k, s.lo, s.hi, nullptr, 0, &edge_wedges_[s.contour][static_cast<std::size_t>(k)]});
      }
      const exact::Edge& e = complex_.edges[c.edge];
      for (const auto& [end, other] : {std::pair(e.a, e.b), std::pair(e.b, e.a)}) {
        const Point3& x = complex_.points[end];
        if (s.lo != x && s.hi != x) continue;
        Apex* apex = corner(end);
        const Vector3 along = complex_.points[other] - x;
        apex->add_probe(apex->probe(along, CGAL::NULL_VECTOR, c.plane.orthogonal_vector()));
        touched_.insert(apex);
      }
    }
    std::vector<Apex*> order(touched_.begin(), touched_.end());
    touched_.clear();
    std::sort(order.begin(), order.end(), [](const Apex* a, const Apex* b) {
      if (a->on_edge() != b->on_edge()) return b->on_edge();
      if (a->id() != b->id()) return a->id() < b->id();
      return before(a->x(), b->x());
    });
    for (Apex* apex : order) {
      if (apex->on_edge()) csvs_met_.insert(apex);
    }
    const bool too_many = csvs_met_.size() > options_.csv_limit + complex_.edges.size();
    for (Apex* apex : order) {
      if (apex->generation > options_.generation_limit || (too_many && apex->on_edge())) {
        beyond_limit_.push_back(apex->x());
        continue;
      }
      for (const std::size_t k : apex->new_sectors())
        jobs.push_back({0, -1, {}, {}, apex, k, &apex->sectors()[k].on_wedge});
    }
    return jobs;
  }

  // All wedges of the round, with one job for each maximal visible part of a contour edge.
  std::vector<Job> merged_jobs() {
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < sources_.size();) {
      std::size_t j = i;
      while (j < sources_.size() && sources_[j].contour == sources_[i].contour && sources_[j].lit) ++j;
      if (j > i) {
        const std::size_t c = sources_[i].contour;
        for (int k = 0; k < static_cast<int>(contours_[c].touching.size()); ++k) {
          jobs.push_back(
              {c, k, sources_[i].lo, sources_[j - 1].hi, nullptr, 0, &edge_wedges_[c][static_cast<std::size_t>(k)]});
        }
      }
      i = std::max(j, i + 1);
    }
    const auto add = [&jobs](Apex& apex) {
      for (std::size_t k = 0; k < apex.sectors().size(); ++k) {
        if (apex.sectors()[k].built) jobs.push_back({0, -1, {}, {}, &apex, k, &apex.sectors()[k].on_wedge});
      }
    };
    for (auto& [key, apex] : corners_) add(*apex);
    for (auto& [key, apex] : csvs_) add(*apex);
    return jobs;
  }

  // --- wedges -----------------------------------------------------------------------------------------------------------------

  Sector sector_of(const Job& job) const {
    Sector out;
    if (job.touching < 0) {
      const ApexSector& s = job.apex->sectors()[job.sector];
      out.plane = s.plane;
      out.center = out.near0 = out.near1 = job.apex->x();
      out.on_ray0 = out.center + s.ray0;
      out.on_ray1 = out.center + s.ray1;
      if (!job.apex->on_edge()) out.on_plane = {job.apex->id()};
      return out;
    }
    const ContourEdge& c = contours_[job.contour];
    const exact::Edge& e = complex_.edges[c.edge];
    out.plane = c.plane;
    out.center = scene_.cell().vertices()[static_cast<std::size_t>(c.touching[static_cast<std::size_t>(job.touching)])];
    out.near0 = complex_.points[e.a];
    out.near1 = complex_.points[e.b];
    if (CGAL::is_negative(c.plane.orthogonal_vector() *
                          CGAL::cross_product(out.near0 - out.center, out.near1 - out.center))) {
      std::swap(out.near0, out.near1);
    }
    out.on_ray0 = out.near0;
    out.on_ray1 = out.near1;
    out.on_plane = {e.a, e.b};
    return out;
  }

  std::vector<ValidPiece> build(const std::vector<Job>& jobs) {
    std::vector<const Job*> missing;
    std::set<std::shared_ptr<const OnWedge>*> claimed;
    for (const Job& job : jobs) {
      if (!*job.slot && claimed.insert(job.slot).second) missing.push_back(&job);
    }
    tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t i) {
      *missing[i]->slot = std::make_shared<const OnWedge>(on_wedge_visibility(sector_of(*missing[i]), scene_));
    });
    std::vector<std::vector<ValidPiece>> made(jobs.size());
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) { made[i] = pieces_of(jobs[i]); });
    std::vector<ValidPiece> batch;
    for (auto& pieces : made) std::move(pieces.begin(), pieces.end(), std::back_inserter(batch));
    return batch;
  }

  // Where the ray through `on_ray` starts: on the sector's near bound.
  static Point3 near_point(const Sector& sector, const OnWedge& on, const Spot& on_ray) {
    if (sector.from_apex()) return sector.center;
    if (on_ray.p == sector.near0 || on_ray.p == sector.near1) return on_ray.p;
    const exact::Point2 a = on.frame(sector.near0), b = on.frame(sector.near1);
    const exact::Vector2 d = on_ray.q - on.center;
    const exact::FT at_a = CGAL::determinant(d, a - on.center), at_b = CGAL::determinant(d, b - on.center);
    return exact::collapsed(sector.near0 + (at_a / (at_a - at_b)) * (sector.near1 - sector.near0));
  }

  std::vector<ValidPiece> pieces_of(const Job& job) const {
    const Sector sector = sector_of(job);
    const std::shared_ptr<const OnWedge>& on = *job.slot;
    std::vector<Strip> strips = on->strips;
    if (job.touching >= 0) {
      Spot lo{job.lo, on->frame(job.lo)}, hi{job.hi, on->frame(job.hi)};
      if (CGAL::orientation(on->center, lo.q, hi.q) == CGAL::RIGHT_TURN) std::swap(lo, hi);
      strips = strips_between(*on, lo, hi);
    }
    std::vector<ValidPiece> pieces;
    for (const Strip& strip : strips) {
      if (options_.planted_bug == PlantedBug::rounded_comparison && is_narrow(strip, sector.center)) continue;
      ValidPiece piece{{}, on, strip};
      Wedge& w = piece.wedge;
      w.kind = job.touching < 0                             ? WedgeKind::se_mv
               : contours_[job.contour].touching.size() > 1 ? WedgeKind::se_me
                                                            : WedgeKind::sv_me;
      w.generation = job.touching < 0 ? job.apex->generation : 0;
      w.plane = sector.plane;
      w.center = sector.center;
      w.near0 = near_point(sector, *on, strip.on_ray0);
      w.near1 = near_point(sector, *on, strip.on_ray1);
      w.on_ray0 = strip.on_ray0.p;
      w.on_ray1 = strip.on_ray1.p;
      w.unbounded = !strip.blocker;
      if (strip.blocker) {
        const Blocker& b = on->blockers[*strip.blocker];
        w.blocker = b.piece;
        w.far0 = far_point(*on, b, strip.on_ray0);
        w.far1 = far_point(*on, b, strip.on_ray1);
      }
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  // --- CSVs -------------------------------------------------------------------------------------------------------------------

  // The edges and vertices that valid piece i meets: cuts for the next round, and apexes of secondary wedges.
  void meet_edges(std::size_t i) {
    const ValidPiece& piece = wedges_.pieces()[i];
    const OnWedge& on = *piece.on_wedge;
    for (const Crossing& c : on.crossings) {
      if (CGAL::orientation(on.center, piece.strip.on_ray0.q, c.at.q) == CGAL::RIGHT_TURN) continue;
      if (CGAL::orientation(on.center, piece.strip.on_ray1.q, c.at.q) == CGAL::LEFT_TURN) continue;
      if (!reaches(on, piece.strip, c.at.q)) continue;
      if (!c.at_vertex) new_cuts_[c.id].push_back(c.at.p);
      add_csv(piece, c);
    }
  }

  void add_csv(const ValidPiece& piece, const Crossing& c) {
    if (options_.planted_bug == PlantedBug::retested_csv) {
      const Start start{c.at.p, std::nullopt, nullptr};
      if (walker_.visible(start, walker_.walk(start, kSourceSeed), wedges_, 0) != Meets::yes) return;
    }
    Apex* apex = c.at_vertex ? corner(c.id) : csv(c.id, c.at.p);
    const int generation = piece.wedge.generation + 1;
    if (apex->on_edge() && (apex->generation < 0 || generation < apex->generation)) apex->generation = generation;
    const Point3& x = c.at.p;
    const Wedge& w = piece.wedge;
    const Vector3 n = w.plane.orthogonal_vector(), back = w.center - x;
    // The piece lies on both sides of the ray through x, or on one. aside: counter-clockwise about n, or clockwise.
    const Vector3 ccw = CGAL::cross_product(n, x - w.center);
    const OnWedge& on = *piece.on_wedge;
    const auto add = [&](const Vector3& aside) {
      Probe probe = apex->probe(back, aside, n);
      if (apex->on_edge()) {
        const Vector3 along = complex_.points[complex_.edges[c.id].b] - complex_.points[complex_.edges[c.id].a];
        probe.lit_edge = CGAL::is_positive(n * along) ? along : -along;
      }
      apex->add_probe(probe);
    };
    if (CGAL::orientation(on.center, c.at.q, piece.strip.on_ray1.q) == CGAL::LEFT_TURN) add(ccw);
    if (CGAL::orientation(on.center, piece.strip.on_ray0.q, c.at.q) == CGAL::LEFT_TURN) add(-ccw);
    touched_.insert(apex);
  }

  // The outline of a piece that runs over an edge in its plane changes the label along that edge.
  void cut_coplanar(const ValidPiece& piece, std::uint32_t e) {
    const Point3 &a = complex_.points[complex_.edges[e].a], &b = complex_.points[complex_.edges[e].b];
    const OnWedge& on = *piece.on_wedge;
    const exact::Point2 qa = on.frame(a), qb = on.frame(b);
    for (const Spot* ray : {&piece.strip.on_ray0, &piece.strip.on_ray1}) {
      const exact::Vector2 d = ray->q - on.center;
      const exact::FT at_a = CGAL::determinant(d, qa - on.center), at_b = CGAL::determinant(d, qb - on.center);
      if (CGAL::sign(at_a) * CGAL::sign(at_b) >= 0) continue;
      const Point3 x = exact::collapsed(a + (at_a / (at_a - at_b)) * (b - a));
      if (CGAL::is_positive((on.frame(x) - on.center) * d)) new_cuts_[e].push_back(x);
    }
  }

  Apex* csv(std::uint32_t edge, const Point3& x) {
    auto& slot = csvs_[{edge, x}];
    if (!slot) slot = std::make_unique<Apex>(Apex::at_edge(complex_, scene_.cell(), edge, x));
    return slot.get();
  }

  Apex* corner(std::uint32_t point) {
    auto& slot = corners_[point];
    if (!slot) slot = std::make_unique<Apex>(Apex::at_vertex(complex_, scene_.cell(), point));
    return slot.get();
  }

  // --- reporting --------------------------------------------------------------------------------------------------------------

  void report() const {
    if (options_.progress) options_.progress("wedges", statistics_.rounds, wedges_.pieces().size());
  }

  void count() {
    for (const auto& of_edge : edge_wedges_)
      statistics_.wedges_built += static_cast<std::uint64_t>(
          std::count_if(of_edge.begin(), of_edge.end(), [](const auto& on) { return on != nullptr; }));
    const auto built = [this](Apex& apex) {
      for (const ApexSector& s : apex.sectors()) statistics_.wedges_built += s.on_wedge != nullptr;
    };
    for (const auto& [key, apex] : csvs_) built(*apex);
    for (const auto& [key, apex] : corners_) built(*apex);
    for (const ValidPiece& p : wedges_.pieces()) {
      statistics_.sv_me += p.wedge.kind == WedgeKind::sv_me;
      statistics_.se_me += p.wedge.kind == WedgeKind::se_me;
      statistics_.se_mv += p.wedge.kind == WedgeKind::se_mv;
      statistics_.generations = std::max(statistics_.generations, p.wedge.generation);
      statistics_.inside_corners += p.wedge.kind == WedgeKind::se_mv && p.wedge.generation == 0;
    }
    for (const auto& [key, apex] : csvs_)
      statistics_.csv +=
          std::any_of(apex->sectors().begin(), apex->sectors().end(), [](const auto& s) { return s.built; });
    for (const ContourEdge& c : contours_) statistics_.parallel_edges += c.touching.size() > 1;
    statistics_.conservative_fallbacks += beyond_limit_.size();
    for (const Source& s : sources_) statistics_.conservative_fallbacks += s.walk.unresolved;
    for (const VertexSource& s : vertex_sources_) statistics_.conservative_fallbacks += s.walk.unresolved;
  }

  void find_lit(Fixpoint& out) const {
    for (const Source& s : sources_) {
      if (s.lit) out.lit_edges.push_back(contours_[s.contour].edge);
    }
    for (const auto& [key, apex] : csvs_) {
      if (apex->probed()) out.lit_edges.push_back(key.first);
    }
    for (const auto& [point, apex] : corners_) {
      if (apex->probed()) out.lit_points.push_back(point);
    }
    std::sort(out.lit_edges.begin(), out.lit_edges.end());
    out.lit_edges.erase(std::unique(out.lit_edges.begin(), out.lit_edges.end()), out.lit_edges.end());
  }

  struct CsvLess {
    bool operator()(const std::pair<std::uint32_t, Point3>& a, const std::pair<std::uint32_t, Point3>& b) const {
      return a.first != b.first ? a.first < b.first : before(a.second, b.second);
    }
  };

  const exact::SceneQuery& scene_;
  const exact::Complex& complex_;
  const Options& options_;
  Statistics& statistics_;
  Walker walker_;
  std::vector<ContourEdge> contours_;
  std::vector<std::vector<std::shared_ptr<const OnWedge>>> edge_wedges_;  // per contour edge and touching vertex
  std::set<std::uint32_t> is_contour_;
  std::vector<std::vector<Point3>> cuts_, new_cuts_;  // per edge; cuts_ in lexicographic order
  std::vector<Source> sources_;
  std::vector<VertexSource> vertex_sources_;
  WedgeSet wedges_;
  std::map<std::pair<std::uint32_t, Point3>, std::unique_ptr<Apex>, CsvLess> csvs_;
  std::map<std::uint32_t, std::unique_ptr<Apex>> corners_;
  std::set<Apex*> touched_;
  std::set<const Apex*> csvs_met_;  // in this round
  std::vector<Point3> beyond_limit_;
};

}  // namespace

Fixpoint find_wedges(const exact::SceneQuery& scene, const Options& options, Statistics& statistics) {
  return Search(scene, options, statistics).run();
}

}  // namespace clues::reference
