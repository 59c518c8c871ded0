#include "reference/visibility/search/fixpoint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "reference/visibility/labels/walk.h"
#include "reference/visibility/search/circles.h"
#include "reference/visibility/search/doubtful_sources.h"
#include "reference/visibility/search/sources.h"
#include "reference/visibility/wedges/apex.h"
#include "reference/visibility/wedges/contour.h"
#include "reference/visibility/wedges/valid_pieces.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

using Job = PieceMaker::Job;

constexpr int kOtherWalks = 100;               // for the label of an edge piece; then it counts as visible
constexpr std::size_t kLeast = 8, kMost = 32;  // legs of a walk, where the last one says more than sight lines do

class Search {
 public:
  Search(const exact::SceneQuery& scene, const Options& options, const Statistics& statistics)
      : scene_(scene),
        complex_(scene.complex()),
        options_(options),
        statistics_(statistics),
        walker_(scene, options.dials.longest_walk),
        contours_(contour_edges(complex_, scene.cell())),
        maker_(scene, contours_),
        contour_planes_(complex_.points.size()),
        cuts_(complex_.edges.size()),
        wedges_(scene) {
    for (const ContourEdge& c : contours_) is_contour_.insert(c.edge);
    for (const ContourEdge& c : contours_) {
      for (const std::uint32_t end : {complex_.edges[c.edge].a, complex_.edges[c.edge].b})
        contour_planes_[end].push_back(c.plane);
    }
  }

  Fixpoint run() {
    vertex_sources_ = vertex_sources(
        scene_, walker_, [this](std::uint32_t p) -> const Apex& { return *corner(p); }, statistics_.walks);
    for (bool changed = true; changed;) {
      ++statistics_.rounds;
      changed = round();
    }
    const std::size_t in_doubt = that_count_as_visible(sources_) + that_count_as_visible(vertex_sources_);
    statistics_.conservative_fallbacks += in_doubt;
    Fixpoint out{std::move(wedges_), {}, in_doubt > 0, {}, {}, {}};
    for (const Apex* apex : left_out_) out.left_out.add(apex->x(), scene_.cell());
    if (!out.left_out.empty())
      leave_out_doubtful_sources(sources_, vertex_sources_, contours_, scene_.cell(), out.left_out);
    count(out);
    find_lit(out);
    return out;
  }

  const Statistics& statistics() const { return statistics_; }

  // D17b, when the rounds are over.
  WedgeSet find_known() {
    start_light();
    spread(Light::known);
    return std::move(wedges_);
  }

 private:
  // --- one round ------------------------------------------------------------------------------------------------------------

  bool round() {
    left_out_.clear();
    new_cuts_.assign(complex_.edges.size(), {});
    sources_ = edge_sources(scene_, walker_, contours_, cuts_, std::move(sources_), statistics_.walks);
    start_light();
    spread(Light::sure);
    spread(Light::in_doubt);

    // From here on the visible parts of an edge that touch are one: the seams between them are no event surfaces.
    wedges_ = WedgeSet(scene_);
    wedges_.add(maker_.build(merged_jobs()));
    for (const ValidPiece& piece : wedges_.pieces()) {
      for (const std::uint32_t e : piece.on_wedge->coplanar_edges) cut_coplanar(piece, e);
    }

    if (take_new_cuts()) return true;
    for (const auto& [e, x] : cuts_of_circles(scene_, contours_, sources_)) new_cuts_[e].push_back(x);
    return take_new_cuts();
  }

  // Whether a contour edge has one.
  bool take_new_cuts() {
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

  enum class Light {
    sure,      // from what is visible
    in_doubt,  // also from what counts as visible
    known      // only from what is visible whatever is in doubt or left out
  };

  // Nothing has been lit yet.
  void start_light() {
    wedges_ = WedgeSet(scene_);
    csvs_met_.clear();
    for (auto& [key, apex] : csvs_) apex->start_round();
    for (auto& [key, apex] : corners_) apex->start_round();
    for (Source& s : sources_) s.lit = false;
    for (VertexSource& s : vertex_sources_) s.lit = false;
  }

  // Lights sources, and all that follows from it.
  void spread(Light light_that_spreads) {
    light_ = light_that_spreads;
    std::vector<Job> waiting = light_new(wedges_.pieces().size());
    while (!waiting.empty()) {
      report();
      const std::size_t first = wedges_.pieces().size();
      wedges_.add(maker_.build(next_batch(waiting)));
      for (std::size_t i = first; i < wedges_.pieces().size(); ++i) meet_edges(i);
      const std::vector<Job> jobs = light_new(first);
      waiting.insert(waiting.end(), jobs.begin(), jobs.end());
    }
  }

  // What the pieces from index `first` on light.
  std::vector<Job> light_new(std::size_t first) {
    for (VertexSource& s : vertex_sources_) {
      if (!s.lit && reached(s, first)) light_vertex(s);
    }
    return light(newly_lit(first));
  }

  // By the pieces from index `first` on, along sight lines. Where the walk's last leg says more, other walks are made, by `seed`, with ever more legs.
  template <class Any>
  Meets label_of(Any& s, const Start& start, std::uint64_t seed, std::size_t first) const {
    for (;;) {
      const Meets label = walker_.visible(start, s.walk, wedges_, first);
      if (label != Meets::no || light_ == Light::known) return label;
      if (walker_.visible_by_last_leg(start, s.walk, wedges_, first) == Meets::no) return label;
      if (s.least == kMost) {
        s.walk.unresolved = true;
        return Meets::yes;
      }
      s.least = std::max(kLeast, 2 * s.least);
      s.walk = walker_.walk(start, seed, s.least);
      first = 0;
    }
  }

  bool in_doubt() const { return light_ == Light::in_doubt; }

  // A wedge that only separates (T10) makes nothing visible, also where it should not exist.
  bool separates(const Source& s) const { return contours_[s.contour].holds_cell; }
  static bool separates(const VertexSource& s) { return s.separates; }
  // Whether a source that counts as visible for want of an answer is left for later.
  template <class Any>
  bool waits(const Any& s) const {
    if (light_ == Light::known) return s.walk.unresolved || !keeps_out(s);
    return light_ == Light::sure && s.walk.unresolved && !separates(s);
  }
  static bool keeps_out(const Source& s) { return s.keeps_out; }
  static bool keeps_out(const VertexSource&) { return true; }  // it is one point

  // Visible for want of an answer, in the end.
  template <class Any>
  bool counts_as_visible(const Any& s) const {
    return s.walk.unresolved && !separates(s);
  }
  template <class Any>
  std::size_t that_count_as_visible(const std::vector<Any>& sources) const {
    return static_cast<std::size_t>(
        std::count_if(sources.begin(), sources.end(), [this](const Any& s) { return this->counts_as_visible(s); }));
  }

  // Whether the pieces from index `first` on make the source visible.
  bool reached(VertexSource& s, std::size_t first) {
    Meets label = label_of(s, start_of(s), kSourceSeed, first);
    for (int attempt = 1; label == Meets::degenerate && !s.separates && attempt < kViews; ++attempt) {
      if (!look_again(scene_, *corner(s.point), s, attempt)) continue;
      s.walk = walker_.walk(start_of(s), kSourceSeed, s.least);
      label = label_of(s, start_of(s), kSourceSeed, 0);
    }
    s.walk.unresolved |= label == Meets::degenerate;
    return label != Meets::no && !waits(s);
  }

  // Takes what is built before the next look at what it lights: all, but for a dial.
  std::vector<Job> next_batch(std::vector<Job>& waiting) const {
    const std::size_t most = options_.dials.batch == 0 ? waiting.size() : options_.dials.batch;
    std::vector<Job> rest;
    if (most < waiting.size()) {
      rest.assign(waiting.begin() + static_cast<std::ptrdiff_t>(most), waiting.end());
      waiting.resize(most);
    }
    return std::exchange(waiting, std::move(rest));
  }

  void light_vertex(VertexSource& s) {
    s.lit = true;
    Apex* apex = corner(s.point);
    s.probe.doubtful = in_doubt() || s.walk.unresolved;
    apex->add_probe(s.probe);
    touched_.insert(apex);
  }

  // Sources that are not lit and that the pieces from index `first` on make visible.
  std::vector<std::size_t> newly_lit(std::size_t first) {
    std::vector<Meets> label(sources_.size(), Meets::no);
    tbb::parallel_for(std::size_t{0}, sources_.size(), [&](std::size_t i) {
      Source& s = sources_[i];
      if (s.lit) return;
      label[i] = label_of(s, start_of(s, contours_), s.seed, first);
      for (int attempt = 0; label[i] == Meets::degenerate; ++attempt) {  // walk elsewhere, and ask all pieces
        if (attempt == kOtherWalks) {
          s.walk.unresolved = true;
          label[i] = Meets::yes;
          break;
        }
        if (attempt % 4 == 3) ask_elsewhere(s, attempt);
        s.walk = walker_.walk(start_of(s, contours_), ++s.seed, s.least);
        label[i] = label_of(s, start_of(s, contours_), s.seed, 0);
      }
      if (waits(s)) label[i] = Meets::no;
    });
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < label.size(); ++i) {
      if (label[i] == Meets::yes) lit.push_back(i);
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
      maker_.add_jobs(s.contour, s.lo, s.hi, jobs);
      const exact::Edge& e = complex_.edges[c.edge];
      for (const auto& [end, other] : {std::pair(e.a, e.b), std::pair(e.b, e.a)}) {
        const Point3& x = complex_.points[end];
        if (s.lo != x && s.hi != x) continue;
        Apex* apex = corner(end);
        const Vector3 along = complex_.points[other] - x;
        Probe probe = apex->probe(along, CGAL::NULL_VECTOR, c.plane.orthogonal_vector());
        probe.doubtful = in_doubt() || s.walk.unresolved;
        apex->add_probe(probe);
        touched_.insert(apex);
      }
    }
    const auto order = std::exchange(touched_, {});
    for (Apex* apex : order) {
      if (apex->on_edge()) csvs_met_.insert(apex);
    }
    const exact::Dials& dials = options_.dials;
    const bool too_many = csvs_met_.size() > dials.csv_limit + dials.csv_limit_per_edge * complex_.edges.size();
    for (Apex* apex : order) {
      if (apex->sectors().empty()) continue;
      if (apex->generation > dials.generation_limit || (too_many && apex->on_edge())) {
        left_out_.insert(apex);
        continue;
      }
      for (const std::size_t k : apex->new_sectors()) PieceMaker::add_job(*apex, k, jobs);
    }
    return jobs;
  }

  // All wedges of the round, with one job for each maximal visible part of a contour edge.
  std::vector<Job> merged_jobs() {
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < sources_.size();) {
      std::size_t j = i;
      while (j < sources_.size() && sources_[j].contour == sources_[i].contour && sources_[j].lit) ++j;
      if (j > i) maker_.add_jobs(sources_[i].contour, sources_[i].lo, sources_[j - 1].hi, jobs);
      i = std::max(j, i + 1);
    }
    const auto add = [&jobs](Apex& apex) {
      for (std::size_t k = 0; k < apex.sectors().size(); ++k) {
        if (apex.sectors()[k].built) PieceMaker::add_job(apex, k, jobs);
      }
    };
    for (auto& [key, apex] : corners_) add(*apex);
    for (auto& [key, apex] : csvs_) add(*apex);
    return jobs;
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
    Apex* apex = c.at_vertex ? corner(c.id) : csv(c.id, c.at.p);
    const int generation = piece.wedge.generation + 1;
    if (apex->on_edge() && (apex->generation < 0 || generation < apex->generation)) apex->generation = generation;
    const Point3& x = c.at.p;
    const Wedge& w = piece.wedge;
    const Vector3 n = w.plane.orthogonal_vector(), back = w.center - x;
    // The piece lies on both sides of the ray through x, or on one. aside: counter-clockwise about n, or clockwise.
    const Vector3 ccw = CGAL::cross_product(n, x - w.center);
    const OnWedge& on = *piece.on_wedge;
    const bool before = CGAL::orientation(on.center, c.at.q, piece.strip.on_ray1.q) == CGAL::LEFT_TURN,
               after = CGAL::orientation(on.center, piece.strip.on_ray0.q, c.at.q) == CGAL::LEFT_TURN;
    const auto add = [&](const Vector3& aside) {
      Probe probe = apex->probe(back, aside, n);
      probe.doubtful = in_doubt();
      if (apex->on_edge() && before && after) {  // on its rim the lit space before it may meet the edge in x alone
        const Vector3 along = complex_.points[complex_.edges[c.id].b] - complex_.points[complex_.edges[c.id].a];
        probe.lit_edge = CGAL::is_positive(n * along) ? along : -along;
      }
      apex->add_probe(probe);
    };
    if (before) add(ccw);
    if (after) add(-ccw);
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
      const Point3 x = exact::zero_on_line(a, b, at_a, at_b);
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
    if (!slot) slot = std::make_unique<Apex>(Apex::at_vertex(complex_, scene_.cell(), point, contour_planes_[point]));
    return slot.get();
  }

  // --- reporting --------------------------------------------------------------------------------------------------------------

  void report() const {
    if (options_.progress) options_.progress("wedges", statistics_.rounds, wedges_.pieces().size());
  }

  void count(const Fixpoint& out) {
    statistics_.wedges_built += maker_.wedges_on_edges();
    const auto built = [this](Apex& apex) {
      for (const ApexSector& s : apex.sectors()) statistics_.wedges_built += s.on_wedge != nullptr;
    };
    for (const auto& [key, apex] : csvs_) built(*apex);
    for (const auto& [key, apex] : corners_) built(*apex);
    for (const ValidPiece& p : out.wedges.pieces()) {
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
    statistics_.conservative_fallbacks += out.left_out.size();
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

  // By what an apex is, and not by where it was allocated: what is left out next depends on what was before.
  struct ApexLess {
    bool operator()(const Apex* a, const Apex* b) const {
      if (a->on_edge() != b->on_edge()) return b->on_edge();
      if (a->id() != b->id()) return a->id() < b->id();
      return before(a->x(), b->x());
    }
  };

  struct CsvLess {
    bool operator()(const std::pair<std::uint32_t, Point3>& a, const std::pair<std::uint32_t, Point3>& b) const {
      return a.first != b.first ? a.first < b.first : before(a.second, b.second);
    }
  };

  const exact::SceneQuery& scene_;
  const exact::Complex& complex_;
  const Options options_;
  Statistics statistics_;
  Walker walker_;
  std::vector<ContourEdge> contours_;
  PieceMaker maker_;
  std::set<std::uint32_t> is_contour_;
  std::vector<std::vector<exact::Plane3>> contour_planes_;  // per vertex: of the contour edges there
  std::vector<std::vector<Point3>> cuts_, new_cuts_;        // per edge; cuts_ in lexicographic order
  std::vector<Source> sources_;
  std::vector<VertexSource> vertex_sources_;
  WedgeSet wedges_;
  Light light_ = Light::sure;  // that spreads now
  std::map<std::pair<std::uint32_t, Point3>, std::unique_ptr<Apex>, CsvLess> csvs_;
  std::map<std::uint32_t, std::unique_ptr<Apex>> corners_;
  std::set<Apex*, ApexLess> touched_;
  std::set<const Apex*, ApexLess> csvs_met_;  // in this round
  std::set<const Apex*, ApexLess> left_out_;  // by a limit, in this round
};

}  // namespace

Fixpoint find_wedges(const exact::SceneQuery& scene, const Options& options, Statistics& statistics) {
  const auto search = std::make_shared<Search>(scene, options, statistics);
  Fixpoint out = search->run();
  statistics = search->statistics();
  if (out.in_doubt || !out.left_out.empty()) out.find_known = [search] { return search->find_known(); };
  return out;
}

}  // namespace clues::reference
