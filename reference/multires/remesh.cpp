// Triangles are cut in four until each is near enough; then the rules that make edges meet, which may cut more; then those with one finer neighbour
// are cut in two. Should a half be too far off, its triangle is cut in four after all, and the rules are gone through again.
#include "reference/multires/remesh.h"

#include <fmt/format.h>

#include <deque>
#include <map>
#include <set>

#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using scene::CarrierPoint;

struct ByPlace {
  bool operator()(const CarrierPoint& a, const CarrierPoint& b) const {
    return a.corner != b.corner ? a.corner < b.corner : a.weight < b.weight;
  }
};

class Remesher {
 public:
  Remesher(const scene::Hierarchy& hierarchy, const RemeshOptions& options)
      : h_(with_coarse_parameters(hierarchy)), options_(options) {}

  Remesh run() {
    for (Patch& patch : base_patches(h_)) refine(std::move(patch));
    while (close()) {
    }
    write();
    return std::move(out_);
  }

 private:
  scene::Point position(const Patch& patch, const CarrierPoint& corner) const {
    return position_estimate(source_at(patch, corner), h_.input);
  }
  PatchError error_of(const Patch& patch) const {
    return error_bound(
        patch,
        {position(patch, patch.corners[0]), position(patch, patch.corners[1]), position(patch, patch.corners[2])},
        h_.input);
  }
  bool too_far(const Patch& patch) const {
    return options_.error < std::numeric_limits<double>::infinity() && error_of(patch).worst() > options_.error;
  }

  void refine(Patch patch) {
    std::vector<Patch> parts;
    if (patch.level < options_.level) {
      parts = cut_in_four(patch, h_);
    } else if (patch.level < options_.most && too_far(patch)) {
      // What the grids do not let us cut stays, and the bound says so.
      try {
        parts = cut_in_four(patch, h_);
      } catch (const scene::Error& error) {
        if (error.code() != scene::ErrorCode::unsupported) throw;
      }
    }
    for (Patch& part : parts) refine(std::move(part));
    if (parts.empty()) keep(std::move(patch));
  }
  void keep(Patch patch) {
    for (const CarrierPoint& corner : patch.corners) used_.insert(corner);
    leaves_.push_back(std::move(patch));
    if (options_.progress) options_.progress(leaves_.back().base + 1, h_.base.size());
  }

  // Which edges have a vertex in the middle, and whether one has vertices beyond that.
  struct Finer {
    std::vector<std::size_t> edges;
    bool twice = false;
  };
  Finer finer_neighbours(const Patch& patch) const {
    Finer out;
    if (patch.level >= most_levels - 2) return out;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &a = patch.corners[k], &b = patch.corners[(k + 1) % 3];
      const CarrierPoint middle = middle_of(a, b);
      if (used_.count(middle) == 0) continue;
      out.edges.push_back(k);
      out.twice = out.twice || used_.count(middle_of(a, middle)) != 0 || used_.count(middle_of(middle, b)) != 0;
    }
    return out;
  }

  // One round of the rules; true when something was cut in four.
  bool close() {
    bool changed = false;
    std::deque<Patch> waiting;
    waiting.swap(leaves_);
    for (Patch& patch : waiting) {
      const Finer finer = finer_neighbours(patch);
      bool cut = finer.twice || finer.edges.size() > 1;
      if (!cut && finer.edges.size() == 1 && patch.level < options_.most) {
        for (const Patch& half : cut_in_two(patch, finer.edges[0], h_)) cut = cut || too_far(half);
      }
      if (!cut) {
        leaves_.push_back(std::move(patch));
        continue;
      }
      changed = true;
      for (Patch& part : cut_in_four(patch, h_)) keep(std::move(part));
    }
    return changed;
  }

  std::uint32_t vertex(const Patch& patch, const CarrierPoint& corner) {
    const auto [place, fresh] = numbers_.try_emplace(corner, static_cast<std::uint32_t>(out_.mesh.points.size()));
    if (fresh) {
      out_.parameters.push_back(corner);
      out_.sources.push_back(source_at(patch, corner));
      out_.mesh.points.push_back(position_estimate(out_.sources.back(), h_.input));
    }
    return place->second;
  }

  void write_triangle(const Patch& patch) {
    scene::Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = vertex(patch, patch.corners[k]);
    out_.mesh.face_of.push_back(static_cast<std::uint32_t>(out_.mesh.triangles.size()));
    out_.mesh.triangles.push_back(t);
    out_.base.push_back(patch.base);
    const PatchError error =
        error_bound(patch, {out_.mesh.points[t[0]], out_.mesh.points[t[1]], out_.mesh.points[t[2]]}, h_.input);
    out_.error.to_remesh = std::max(out_.error.to_remesh, error.to_remesh);
    out_.error.to_input = std::max(out_.error.to_input, error.to_input);
  }

  void write() {
    std::map<std::uint32_t, std::vector<const Patch*>> by_base;
    for (const Patch& patch : leaves_) by_base[patch.base].push_back(&patch);
    for (const auto& [base, patches] : by_base) {
      for (const Patch* patch : patches) {
        const Finer finer = finer_neighbours(*patch);
        if (finer.edges.empty()) {
          write_triangle(*patch);
        } else {
          for (const Patch& half : cut_in_two(*patch, finer.edges[0], h_)) write_triangle(half);
        }
      }
    }
    out_.reached = !(out_.error.worst() > options_.error);
  }

  const scene::Hierarchy h_;
  const RemeshOptions& options_;
  std::deque<Patch> leaves_;
  std::set<CarrierPoint, ByPlace> used_;
  std::map<CarrierPoint, std::uint32_t, ByPlace> numbers_;
  Remesh out_;
};

}  // namespace

Remesh remeshed(const scene::Hierarchy& hierarchy, const RemeshOptions& options) {
  if (options.level < 0 || options.level > options.most || options.most > most_levels - 2) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("remesh: a level is from 0 to {}", std::min(options.most, most_levels - 2)));
  }
  return Remesher(hierarchy, options).run();
}

}  // namespace clues::reference
