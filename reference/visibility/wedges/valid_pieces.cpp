#include "reference/visibility/wedges/valid_pieces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "exact/cell/cell_plane.h"

namespace clues::reference {

using exact::Point3;

namespace {

// Where the ray through `on_ray` starts: on the sector's near bound.
Point3 near_point(const Sector& sector, const OnWedge& on, const Spot& on_ray) {
  if (sector.from_apex()) return sector.center;
  if (on_ray.p == sector.near0 || on_ray.p == sector.near1) return on_ray.p;
  const exact::Point2 a = on.frame(sector.near0), b = on.frame(sector.near1);
  const exact::Vector2 d = on_ray.q - on.center;
  const exact::FT at_a = CGAL::determinant(d, a - on.center), at_b = CGAL::determinant(d, b - on.center);
  return exact::zero_on_line(sector.near0, sector.near1, at_a, at_b);
}

}  // namespace

PieceMaker::PieceMaker(const exact::SceneQuery& scene, const std::vector<ContourEdge>& contours)
    : scene_(scene), contours_(contours) {
  for (const ContourEdge& c : contours) edge_wedges_.emplace_back(c.touching.size());
}

void PieceMaker::add_jobs(std::size_t contour, const Point3& lo, const Point3& hi, std::vector<Job>& jobs) {
  for (std::size_t k = 0; k < edge_wedges_[contour].size(); ++k)
    jobs.push_back({contour, static_cast<int>(k), lo, hi, nullptr, 0, &edge_wedges_[contour][k]});
}

void PieceMaker::add_job(Apex& apex, std::size_t sector, std::vector<Job>& jobs) {
  jobs.push_back({0, -1, {}, {}, &apex, sector, &apex.sectors()[sector].on_wedge});
}

std::vector<ValidPiece> PieceMaker::build(const std::vector<Job>& jobs) {
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

Sector PieceMaker::sector_of(const Job& job) const {
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
  const exact::Complex& complex = scene_.complex();
  const exact::Edge& e = complex.edges[c.edge];
  out.plane = c.plane;
  out.center = scene_.cell().vertices()[static_cast<std::size_t>(c.touching[static_cast<std::size_t>(job.touching)])];
  out.near0 = complex.points[e.a];
  out.near1 = complex.points[e.b];
  if (CGAL::is_negative(c.plane.orthogonal_vector() *
                        CGAL::cross_product(out.near0 - out.center, out.near1 - out.center))) {
    std::swap(out.near0, out.near1);
  }
  out.on_ray0 = out.near0;
  out.on_ray1 = out.near1;
  out.on_plane = {e.a, e.b};
  return out;
}

std::vector<ValidPiece> PieceMaker::pieces_of(const Job& job) const {
  const Sector sector = sector_of(job);
  const std::shared_ptr<const OnWedge>& on = *job.slot;
  std::vector<Strip> strips = on->strips;
  if (job.touching >= 0) {
    Spot lo{job.lo, on->frame(job.lo)}, hi{job.hi, on->frame(job.hi)};
    if (CGAL::orientation(on->center, lo.q, hi.q) == CGAL::RIGHT_TURN) std::swap(lo, hi);
    strips = strips_between(*on, lo, hi);
  }
  const bool holds_cell = exact::lies_in(scene_.cell(), sector.plane);
  std::vector<ValidPiece> pieces;
  for (const Strip& strip : strips) {
    ValidPiece piece{{}, on, strip, holds_cell};
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

std::uint64_t PieceMaker::wedges_on_edges() const {
  std::uint64_t built = 0;
  for (const auto& of_edge : edge_wedges_)
    built += static_cast<std::uint64_t>(
        std::count_if(of_edge.begin(), of_edge.end(), [](const auto& on) { return on != nullptr; }));
  return built;
}

}  // namespace clues::reference
