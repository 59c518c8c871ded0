// What a frame does to triangles that fail, and to the holes that this leaves.
#include <algorithm>
#include <cmath>
#include <utility>

#include "fastpath/motion/base_mesh.h"
#include "fastpath/motion/walk.h"

namespace clues::fastpath::motion {

// What is hidden by something nearer has to go: the sample that is furthest away, a direction before all points; the greater number of two as far.
std::uint32_t Walk::furthest_sample(std::uint32_t f) const {
  std::uint32_t best = kNone;
  double furthest = 0;
  for (const std::uint32_t v : mesh().face(f).corner) {
    const scene::DepthSample& sample = mesh().samples()[v];
    if (sample.is_base) continue;
    const double length = sample.is_direction ? HUGE_VAL : triangulation_->view().row(v).length;
    if (best != kNone && (length < furthest || (length == furthest && v < best))) continue;
    best = v;
    furthest = length;
  }
  return best;
}

// Where it is seen still, the nearest one has gone past it, and further with each step: that one is put back where it is now.
std::uint32_t Walk::sample_that_moves(std::uint32_t f) {
  const std::uint32_t furthest = furthest_sample(f);
  if (furthest == kNone || !sampler_.sees(at_, mesh().samples()[furthest])) return furthest;
  std::uint32_t nearest = furthest;
  for (const std::uint32_t v : mesh().face(f).corner) {
    const scene::DepthSample& sample = mesh().samples()[v];
    if (sample.is_base || sample.is_direction) continue;
    const View& view = triangulation_->view();
    if (mesh().samples()[nearest].is_direction || view.row(v).length < view.row(nearest).length) nearest = v;
  }
  return nearest;
}

bool Walk::remove_sample(std::uint32_t v, std::uint32_t f, const View& view, FrameReport& report) {
  if (v == kNone) return false;
  const scene::DepthSample sample = mesh().samples()[v];
  const std::uint32_t beside = mesh().face(f).corner[mesh().face(f).corner[0] == v ? 1 : 0];
  if (!triangulation_->remove(v, view, triangulation_->view())) return false;
  ++report.removed;
  out_.push_back({sample, kNone, beside, frame_});
  note_changes();
  return true;
}

// A base vertex is where it is from everywhere, and goes through all that is near; what is in its way would have to go, one layer of samples after the other.
bool Walk::lift_base_vertex_of(std::uint32_t f) {
  const auto corner = mesh().face(f).corner;
  if (triangulation_->facing(triangulation_->view(), corner[0], corner[1], corner[2]) > 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t v = corner[i];
    const scene::DepthSample sample = mesh().samples()[v];
    if (!sample.is_base || !triangulation_->remove(v, *old_view_, triangulation_->view())) continue;
    out_.push_back({sample, v, corner[(i + 1) % 3], frame_});
    note_changes();
    return true;
  }
  return false;
}

bool Walk::covers(const std::uint32_t* corners, std::size_t count, std::uint32_t base) const {
  constexpr double kCosine = 0.995;  // of 0.1
  const View& view = triangulation_->view();
  return std::all_of(corners, corners + count, [&](std::uint32_t v) {
    view.row(base), view.row(v);
    const Row &b = view.row(base), &r = view.row(v);
    return dot(b.x, r.x) > kCosine * (b.length * r.length);
  });
}

void Walk::lift_covered_base_vertices() {
  SphereMesh::Star star;
  for (std::uint32_t v = 0; v < kBaseVertices; ++v) {
    if (!mesh().is_vertex(v)) continue;
    mesh().star_of(v, star);
    if (!covers(star.ring.data(), star.ring.size(), v)) continue;
    const scene::DepthSample sample = mesh().samples()[v];
    if (triangulation_->remove(v, triangulation_->view(), triangulation_->view()))
      out_.push_back({sample, v, star.ring[0], frame_});
    note_changes();
  }
}

// Base vertices, and samples that are seen still, the last one that was taken out first. What does not fit waits; of base vertices that have waited before one in four is looked at in a frame.
void Walk::put_back(FrameReport& report) {
  std::vector<Out> waiting;
  for (; !out_.empty(); out_.pop_back()) {
    Out& out = out_.back();
    const bool is_base = out.base != kNone;
    if (is_base && out.frame != frame_ && (out.base + frame_) % 4 != 0) {
      waiting.push_back(out);
      continue;
    }
    if (is_base || sampler_.sees(at_, out.sample)) {
      std::uint32_t from =
          mesh().is_vertex(out.beside) ? mesh().face_of(out.beside) : triangulation_->face_towards(out.sample);
      if (is_base) {
        from = triangulation_->face_holding(out.base, from);
        if (from != kNone) {
          const auto& corner = mesh().face(from).corner;
          out.beside = corner[0];
          if (covers(corner.data(), 3, out.base)) {
            waiting.push_back(out);
            continue;
          }
        }
      }
      const bool back = triangulation_->insert(out.sample, from, out.base) != kNone;
      note_changes();
      if (back && !is_base) {
        ++report.inserted;
        ++report.reinserted;
      }
      if (back) continue;
    }
    if (is_base) {
      waiting.push_back(out);
    } else {
      removed_.push_back(out.sample);
      if (removed_.size() > options_.samples) removed_.pop_front();
    }
  }
  out_ = std::move(waiting);
}

// False: so much fails, as after a jump, that a new mesh is less work; or a star did not fit in a half sphere.
bool Walk::repair_at_old_viewpoint(FrameReport& report) {
  stack_ = failing_;
  if (4 * failing_.size() > mesh().face_count()) return false;
  const std::uint64_t most = mesh().vertex_count() / 4;
  while (!stack_.empty()) {
    const std::uint32_t f = stack_.back();
    stack_.pop_back();
    if (!mesh().face(f).alive() || triangulation_->face_holds(f)) continue;
    const std::size_t before = touched_.size();
    if (!lift_base_vertex_of(f) &&
        (report.removed > most || !remove_sample(sample_that_moves(f), f, *old_view_, report)))
      return false;
    stack_.insert(stack_.end(), touched_.begin() + static_cast<std::ptrdiff_t>(before), touched_.end());
  }
  return true;
}

// Flips, and removes what flips brought too near. With the Delaunay condition every edge may be flipped; without it, only those
// between two triangles that are new anyway. Ends, as each round but the last removes a sample. False where a star did not fit in a half sphere.
bool Walk::settle(FrameReport& report) {
  const auto allowed = [this](std::uint32_t f, std::uint32_t g) {
    return delaunay() || (changed_now(f) && changed_now(g));
  };
  for (bool again = true; again;) {
    again = false;
    stack_ = touched_;
    stack_.insert(stack_.end(), not_delaunay_.begin(), not_delaunay_.end());
    not_delaunay_.clear();
    triangulation_->legalise(stack_, allowed);
    note_changes();
    std::vector<std::uint32_t> to_test;
    to_test.swap(touched_);
    ++tested_now_;
    tested_in_.resize(mesh().faces().size(), 0);
    std::erase_if(to_test, [&](std::uint32_t f) { return std::exchange(tested_in_[f], tested_now_) == tested_now_; });
    std::sort(to_test.begin(), to_test.end());
    for (const std::uint32_t f : to_test) {
      if (!mesh().face(f).alive() || triangulation_->face_holds(f)) continue;
      if (!remove_sample(furthest_sample(f), f, triangulation_->view(), report)) return false;
      again = true;
    }
  }
  return true;
}

bool Walk::is_thin(std::uint32_t f) {
  const auto& corner = mesh().face(f).corner;
  const View& view = triangulation_->view();
  for (std::size_t i = 0; i < 3; ++i) {
    view.row(corner[i]);
    const Row &a = view.row(corner[(i + 1) % 3]), &b = view.row(corner[(i + 2) % 3]);
    if (dot(a.x, b.x) < thin_cosine_ * (a.length * b.length)) return true;
  }
  return false;
}

// As long as samples are missing: one into each long triangle of those that are new, and then those that were removed, the oldest first, where
// they are seen again.
void Walk::refill(FrameReport& report) {
  const auto missing = [&] { return mesh().vertex_count() < options_.samples + std::uint64_t{kBaseVertices}; };
  std::vector<std::uint32_t> thin = changed_;
  for (std::size_t k = 0; k < thin.size() && missing(); ++k) {
    const std::uint32_t f = thin[k];
    if (!mesh().face(f).alive() || !is_thin(f)) continue;
    Vec middle;
    for (const std::uint32_t v : mesh().face(f).corner) {
      const Row& r = triangulation_->view().row(v);
      middle = middle + (1 / r.length) * r.x;
    }
    const auto sample = sampler_.sample(at_, {middle.x, middle.y, middle.z});
    const std::size_t before = touched_.size();
    const bool inserted = sample && triangulation_->insert(*sample, f) != kNone;
    note_changes();
    if (!inserted) continue;
    ++report.inserted;
    thin.insert(thin.end(), touched_.begin() + static_cast<std::ptrdiff_t>(before), touched_.end());
  }
  for (std::size_t tries = std::min<std::size_t>(removed_.size(), 2 + report.removed); tries > 0 && missing();
       --tries) {
    const scene::DepthSample sample = removed_.front();
    removed_.pop_front();
    if (sampler_.sees(at_, sample) && triangulation_->insert(sample, triangulation_->face_towards(sample)) != kNone) {
      ++report.inserted;
      ++report.reinserted;
    } else {
      removed_.push_back(sample);
    }
    note_changes();
  }
}

}  // namespace clues::fastpath::motion
