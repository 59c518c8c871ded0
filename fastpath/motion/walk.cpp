// A frame: what is due, the repair, the flips, new samples, new bounds.
#include "fastpath/motion/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "fastpath/motion/base_mesh.h"
#include "fastpath/motion/bounds/sketch_bound.h"
#include "scene/messages/error.h"

namespace clues::fastpath::motion {
namespace {

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

void Walk::TriangleBounds::resize(std::size_t n) {
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
  for (auto* of_the_old_mesh : {&failing_, &not_delaunay_}) of_the_old_mesh->clear();
  calendar_.reset();
  edges_.reset();
  bounds_ = {};
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

double Walk::bound_of(std::uint32_t f) const {
  const auto [a, b, c] = mesh().face(f).corner;
  const View& view = triangulation_->view();
  view.row(a), view.row(b), view.row(c);
  return options_.bounds == WalkOptions::Bounds::sketch_unsound
             ? sketch_bound_unsound(view.row(a), view.row(b), view.row(c), limits_)
             : triangle_bound(view.row(a), view.row(b), view.row(c), limits_);
}

void Walk::set_bound(std::uint32_t f, double bound) {
  bounds_.bound[f] = bound;
  bounds_.key[f] = sum_down(odometer_, bound);
  bounds_.x[f] = at_[0];
  bounds_.y[f] = at_[1];
  bounds_.z[f] = at_[2];
}

void Walk::queue(std::uint32_t f) {
  ++stamps_[f];
  if (calendar_) calendar_->put({bounds_.key[f], f, stamps_[f]});
}

std::array<const Row*, 4> Walk::rows_of_edge(std::uint32_t f, std::size_t i) const {
  const Face& face = mesh().face(f);
  const Face& other = mesh().face(face.across[i]);
  const std::array<std::uint32_t, 4> vertices{face.corner[i], face.corner[(i + 1) % 3], face.corner[(i + 2) % 3],
                                              other.corner[other.place_of_face(f)]};
  const View& view = triangulation_->view();
  for (const std::uint32_t v : vertices) view.row(v);  // the first use of a vertex may move the others
  return {&view.row(vertices[0]), &view.row(vertices[1]), &view.row(vertices[2]), &view.row(vertices[3])};
}

double Walk::ball_of_edge(std::uint32_t f, std::size_t i) const {
  const auto [a, b, c, d] = rows_of_edge(f, i);
  return delaunay_bound(*a, *b, *c, *d);
}

bool Walk::set_edge(std::uint32_t f, std::size_t i) {
  const auto [a, b, c, d] = rows_of_edge(f, i);
  return edges_->set(slot_of(f, i), delaunay_model(*a, *b, *c, *d), at_);
}

// At the viewpoint before the first step, where all bounds are known. What the width of a bin should be is not known earlier.
void Walk::begin_bounds(double step) {
  const double width = (options_.step > 0 ? options_.step : step) / 4;
  calendar_.emplace(width);
  if (delaunay()) {
    edges_.emplace(width);
    edges_->resize(3 * mesh().faces().size());
  }
  for (std::uint32_t f = 0; f < mesh().faces().size(); ++f) {
    if (!mesh().face(f).alive()) continue;
    queue(f);
    for (std::size_t i = 0; i < 3 && delaunay(); ++i) {
      if (f < mesh().face(f).across[i]) edges_->set_ball(slot_of(f, i), first_balls_[slot_of(f, i)], at_);
    }
  }
  first_balls_.clear();
}

// Each edge is kept by one of its triangles: a changed one, and of two such the one with the lesser number. All changed triangles hold.
void Walk::bounds_of_changed() {
  if (options_.bounds != WalkOptions::Bounds::sound && options_.bounds != WalkOptions::Bounds::sketch_unsound) return;
  const std::size_t n = mesh().faces().size();
  bounds_.resize(n);
  stamps_.resize(n, 0);
  if (edges_) edges_->resize(3 * n);
  if (delaunay() && !edges_) first_balls_.resize(3 * n);
  for (const std::uint32_t f : changed_) {
    const Face& face = mesh().face(f);
    if (!face.alive()) {
      ++stamps_[f];
      for (std::size_t i = 0; i < 3 && edges_; ++i) edges_->drop(slot_of(f, i));
      continue;
    }
    set_bound(f, bound_of(f));
    queue(f);
    for (std::size_t i = 0; i < 3 && delaunay(); ++i) {
      const std::uint32_t g = face.across[i];
      if (changed_now(g) && g < f) {
        if (edges_) edges_->drop(slot_of(f, i));
        continue;
      }
      if (!edges_) {
        first_balls_[f < g ? slot_of(f, i) : slot_of(g, mesh().face(g).place_of_face(f))] = ball_of_edge(f, i);
        continue;
      }
      set_edge(f, i);
      if (!changed_now(g)) edges_->drop(slot_of(g, mesh().face(g).place_of_face(f)));
    }
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
    if (f >= bounds_.key.size()) {
      left.push_back(0);
      continue;
    }
    double at_least = left_of(bounds_.key[f]);
    for (std::size_t i = 0; i < 3 && delaunay(); ++i) at_least = std::min(at_least, ball_of_edge(f, i));
    left.push_back(at_least);
  }
  return left;
}

// ---- what is looked at

void Walk::examine_due(FrameReport& report) {
  due_.clear();
  due_edges_.clear();
  if (calendar_) calendar_->take_due(odometer_, due_);
  if (edges_) edges_->take_due(due_edges_);
  examined_in_.resize(mesh().faces().size(), 0);
  computed_in_.resize(mesh().faces().size(), 0);
  const auto count = [&](std::vector<std::uint32_t>& frames, std::uint32_t f, std::uint64_t& of) {
    if (std::exchange(frames[f], frame_) != frame_) ++of;
  };
  for (const auto& entry : due_) {
    const std::uint32_t f = entry.item;
    if (entry.stamp != stamps_[f]) continue;
    count(examined_in_, f, report.examined);
    const double way = distance_up(at_, bounds_.origin(f));
    // Where little of the bound is left it would be due again at once.
    if (way < 0.75 * bounds_.bound[f]) {
      bounds_.key[f] = sum_down(odometer_, std::nextafter(bounds_.bound[f] - way, 0.0));
      if (bounds_.key[f] > odometer_) {
        queue(f);
        continue;
      }
    }
    count(computed_in_, f, report.tested);
    const double bound = bound_of(f);
    if (bound > 0 || triangulation_->face_holds(f)) {
      set_bound(f, bound);
      queue(f);
    } else {
      failing_.push_back(f);
    }
  }
  for (const std::uint32_t s : due_edges_) {
    const std::uint32_t f = s / 3;
    count(examined_in_, f, report.examined);
    if (edges_->has_some_left(s, at_)) continue;
    count(computed_in_, f, report.tested);
    if (set_edge(f, s % 3) || triangulation_->delaunay(f, s % 3) >= 0) continue;
    not_delaunay_.push_back(f);
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
  const bool with_bounds =
      options_.bounds == WalkOptions::Bounds::sound || options_.bounds == WalkOptions::Bounds::sketch_unsound;
  if (with_bounds && step > 0 && !calendar_) begin_bounds(step);
  if (edges_) edges_->move(at_, at);
  if (step > 0) odometer_ = sum_up(odometer_, step);
  ++frame_;
  changed_.clear();
  touched_.clear();
  failing_.clear();
  not_delaunay_.clear();
  old_view_->look_from(at_);
  triangulation_->view().look_from(at);
  at_ = at;
  triangulation_->flips = 0;
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
