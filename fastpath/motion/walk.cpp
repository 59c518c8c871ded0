// A frame: what is due, the repair, the flips, new samples, new bounds.
#include "fastpath/motion/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fastpath/motion/base_mesh.h"
#include "fastpath/motion/sketch_bound.h"
#include "scene/messages/error.h"

namespace clues::fastpath::motion {
namespace {

double sum_up(double a, double b) { return std::nextafter(a + b, kInfinity); }
double sum_down(double a, double b) { return std::isfinite(b) ? std::nextafter(a + b, -kInfinity) : b; }

void require_viewpoint(const MotionPoint& at) {
  for (const double x : at) {
    if (!std::isfinite(x)) throw scene::Error(scene::ErrorCode::non_finite, "motion: a viewpoint is not finite");
    if (std::fabs(x) > scene::farthest_viewpoint)
      throw scene::Error(scene::ErrorCode::bad_argument, "motion: a viewpoint is beyond 2^90");
  }
}

const WalkOptions& checked(const WalkOptions& options) {
  if (options.samples > kMostSamples)
    throw scene::Error(scene::ErrorCode::bad_argument, fmt::format("motion: at most {} samples", kMostSamples));
  if (options.thresholds.delaunay && options.bounds == WalkOptions::Bounds::sketch_unsound) {
    throw scene::Error(scene::ErrorCode::bad_argument, "motion: the sketch has no bound for the Delaunay condition");
  }
  return options;
}

}  // namespace

void Walk::Part::resize(std::size_t n) {
  bound.resize(n, kInfinity);
  key.resize(n, kInfinity);
  for (auto* list : {&x, &y, &z}) list->resize(n);
}

Walk::Walk(const Bvh& bvh, const WalkOptions& options, const MotionPoint& start)
    : options_(checked(options)), limits_(options.thresholds), sampler_(bvh), at_(start) {
  require_viewpoint(start);
  // Samples and base vertices with one area of the sphere each are at about this angle; an edge of twice that is long. cos x is above 1 - x^2 / 2.
  const double spacing = 14.6 / (options.samples + kBaseVertices);
  thin_cosine_ = 1 - 2 * spacing;
  rebuild();
  bounds_of_changed();
  first_.at = start;
  first_.triangles = mesh().face_count();
  first_.samples = mesh().vertex_count() - kBaseVertices;
  first_.examined = first_.tested = first_.triangles;
  first_.inserted = first_.samples;
  first_.rays = sampler_.rays;
  first_.exact = triangulation_->constraints().counts.exact;
  first_.rebuilt = true;
}

void Walk::rebuild() {
  triangulation_ = std::make_unique<Triangulation>(options_.thresholds, at_);
  old_view_ = std::make_unique<View>(triangulation_->mesh());
  old_view_->look_from(at_);
  removed_.clear();
  out_.clear();
  for (auto* of_the_old_mesh : {&failing_, &failed_, &not_delaunay_}) of_the_old_mesh->clear();
  calendar_.reset();
  for (Part& part : parts_) part = {};
  stamps_.clear();
  changed_.clear();
  changed_in_.clear();
  touched_.clear();
  for (const MotionPoint& direction : directions(options_.samples, options_.seed)) {
    if (const auto sample = sampler_.sample(at_, direction)) triangulation_->insert(*sample);
    triangulation_->mesh().changed().clear();
  }
  auto& changed = triangulation_->mesh().changed();
  for (std::uint32_t f = 0; f < mesh().faces().size(); ++f) {
    if (mesh().face(f).alive()) changed.push_back(f);
  }
  note_changes();
  FrameReport ignored;
  bool holds = settle(ignored);
  if (holds) {
    lift_covered_base_vertices();
    holds = settle(ignored);
  }
  if (!holds) throw scene::Error(scene::ErrorCode::internal, "motion: a new mesh does not hold");
}

void Walk::note_changes() {
  auto& changed = triangulation_->mesh().changed();
  changed_in_.resize(mesh().faces().size(), 0);
  for (const std::uint32_t f : changed) {
    touched_.push_back(f);
    if (changed_in_[f] == frame_) continue;
    changed_in_[f] = frame_;
    changed_.push_back(f);
  }
  changed.clear();
}

// ---- bounds

double Walk::part_bound(std::uint32_t f, std::size_t part) {
  const Face& face = mesh().face(f);
  const View& view = triangulation_->view();
  const auto [a, b, c] = face.corner;
  view.row(a), view.row(b), view.row(c);
  if (part == 0) {
    return options_.bounds == WalkOptions::Bounds::sketch_unsound
               ? sketch_bound_unsound(view.row(a), view.row(b), view.row(c), limits_)
               : triangle_bound(view.row(a), view.row(b), view.row(c), limits_);
  }
  const std::size_t i = part - 1;
  const std::uint32_t g = face.across[i], d = mesh().face(g).corner[mesh().face(g).place_of_face(f)];
  view.row(d);
  return delaunay_bound(view.row(face.corner[i]), view.row(face.corner[(i + 1) % 3]),
                        view.row(face.corner[(i + 2) % 3]), view.row(d));
}

bool Walk::part_holds(std::uint32_t f, std::size_t part) {
  return part == 0 ? triangulation_->face_holds(f) : triangulation_->delaunay(f, part - 1) >= 0;
}

void Walk::set_part(std::uint32_t f, std::size_t part, double bound) {
  Part& p = parts_[part];
  p.bound[f] = bound;
  p.key[f] = sum_down(odometer_, bound);
  p.x[f] = at_[0];
  p.y[f] = at_[1];
  p.z[f] = at_[2];
}

void Walk::queue(std::uint32_t f) {
  ++stamps_[f];
  double key = parts_[0].key[f];
  if (delaunay()) key = std::min({key, parts_[1].key[f], parts_[2].key[f], parts_[3].key[f]});
  if (calendar_) calendar_->put({key, f, stamps_[f]});
}

// Each edge is kept by one of its triangles: a changed one, and of two such the one with the lesser number. All changed triangles hold.
void Walk::bounds_of_changed() {
  if (options_.bounds != WalkOptions::Bounds::sound && options_.bounds != WalkOptions::Bounds::sketch_unsound) return;
  const std::size_t n = mesh().faces().size();
  for (Part& part : parts_) part.resize(n);
  stamps_.resize(n, 0);
  for (const std::uint32_t f : changed_) {
    if (!mesh().face(f).alive()) {
      ++stamps_[f];
      continue;
    }
    set_part(f, 0, part_bound(f, 0));
    for (std::size_t i = 0; i < 3 && delaunay(); ++i) {
      const std::uint32_t g = mesh().face(f).across[i];
      if (changed_now(g) && g < f) {
        parts_[1 + i].key[f] = kInfinity;
        continue;
      }
      set_part(f, 1 + i, part_bound(f, 1 + i));
      if (!changed_now(g)) parts_[1 + mesh().face(g).place_of_face(f)].key[g] = kInfinity;
    }
    queue(f);
  }
  // An edge that failed may have got another triangle on its other side, which keeps it now: then the first one is as it was.
  for (const std::uint32_t f : failed_) {
    if (!mesh().face(f).alive() || changed_now(f)) continue;
    for (std::size_t p = 0; p < 4; ++p) {
      if (parts_[p].key[f] <= odometer_) set_part(f, p, part_bound(f, p));
    }
    queue(f);
  }
}

scene::DepthMesh Walk::mesh_in_places() const {
  scene::DepthMesh out;
  out.samples = mesh().samples();
  for (const Face& f : mesh().faces()) out.triangles.push_back(f.corner);
  return out;
}

std::vector<double> Walk::bounds_left() const {
  std::vector<double> left;
  const auto left_of = [&](double key) {
    return key == kInfinity ? key : std::max(0.0, std::nextafter(key - odometer_, -kInfinity));
  };
  for (std::uint32_t f = 0; f < mesh().faces().size(); ++f) {
    const Face& face = mesh().face(f);
    if (!face.alive()) continue;
    if (f >= parts_[0].key.size()) {
      left.push_back(0);
      continue;
    }
    double key = parts_[0].key[f];
    for (std::size_t i = 0; i < 3 && delaunay(); ++i) {
      const std::uint32_t g = face.across[i];
      key = std::min({key, parts_[1 + i].key[f], parts_[1 + mesh().face(g).place_of_face(f)].key[g]});
    }
    left.push_back(left_of(key));
  }
  return left;
}

// ---- what is looked at

void Walk::examine_due(FrameReport& report) {
  due_.clear();
  if (calendar_) calendar_->take_due(odometer_, due_);
  for (const auto& entry : due_) {
    const std::uint32_t f = entry.item;
    if (entry.stamp != stamps_[f]) continue;
    ++report.examined;
    bool tested = false, failed = false;
    for (std::size_t p = 0; p < (delaunay() ? 4U : 1U); ++p) {
      Part& part = parts_[p];
      if (part.key[f] > odometer_) continue;
      const double way = distance_up(at_, part.origin(f));
      // Where little of the bound is left it would be due again at once.
      if (way < 0.75 * part.bound[f]) {
        part.key[f] = sum_down(odometer_, std::nextafter(part.bound[f] - way, 0.0));
        if (part.key[f] > odometer_) continue;
      }
      tested = true;
      const double bound = part_bound(f, p);
      if (bound > 0 || part_holds(f, p)) {
        set_part(f, p, bound);
        continue;
      }
      failed = true;
      (p == 0 ? failing_ : not_delaunay_).push_back(f);
    }
    report.tested += tested ? 1 : 0;
    if (failed) {
      failed_.push_back(f);
    } else {
      queue(f);
    }
  }
}

void Walk::examine_all(FrameReport& report) {
  for (std::uint32_t f = 0; f < mesh().faces().size(); ++f) {
    const Face& face = mesh().face(f);
    if (!face.alive()) continue;
    ++report.examined;
    ++report.tested;
    if (!triangulation_->face_holds(f)) failing_.push_back(f);
    for (std::size_t i = 0; i < 3 && delaunay(); ++i) {
      if (f < face.across[i] && triangulation_->delaunay(f, i) < 0) not_delaunay_.push_back(f);
    }
  }
}

FrameReport Walk::move_to(const MotionPoint& at) {
  require_viewpoint(at);
  FrameReport report;
  report.at = at;
  const std::uint64_t rays = sampler_.rays, exact_before = triangulation_->constraints().counts.exact;
  const double step = distance_up(at, at_);
  if (step > 0) odometer_ = sum_up(odometer_, step);
  ++frame_;
  changed_.clear();
  touched_.clear();
  failing_.clear();
  failed_.clear();
  not_delaunay_.clear();
  old_view_->look_from(at_);
  triangulation_->view().look_from(at);
  at_ = at;
  triangulation_->flips = 0;
  const bool with_bounds =
      options_.bounds == WalkOptions::Bounds::sound || options_.bounds == WalkOptions::Bounds::sketch_unsound;
  if (!calendar_ && with_bounds && step > 0) {
    calendar_.emplace((options_.step > 0 ? options_.step : step) / 4);
    for (std::uint32_t f = 0; f < mesh().faces().size(); ++f) {
      if (mesh().face(f).alive()) queue(f);
    }
  }
  bool again = options_.bounds == WalkOptions::Bounds::rebuild;
  if (!again) {
    with_bounds ? examine_due(report) : examine_all(report);
    again = !repair_at_old_viewpoint(report);
  }
  if (!again) {
    again = !settle(report);
    if (!again) put_back(report);
    if (!again) refill(report);
    again = again || !settle(report);
    report.flipped = triangulation_->flips;
    report.exact = triangulation_->constraints().counts.exact - exact_before;
  }
  if (again) {
    ++frame_;
    report.rebuilt = true;
    report.removed = report.flipped = report.reinserted = 0;
    rebuild();
    report.inserted = mesh().vertex_count() - kBaseVertices;
    report.exact = triangulation_->constraints().counts.exact;
  }
  bounds_of_changed();
  report.odometer = odometer_;
  report.triangles = mesh().face_count();
  report.samples = mesh().vertex_count() - kBaseVertices;
  std::uint64_t changed = 0;
  for (const std::uint32_t f : changed_) changed += mesh().face(f).alive() ? 1 : 0;
  report.reused = report.triangles - changed;
  report.rays = sampler_.rays - rays;
  return report;
}

}  // namespace clues::fastpath::motion
