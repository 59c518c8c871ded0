// Triangles are cut in four until each is near enough; then the rules that make edges meet, which may cut more; then those with one finer neighbour
// are cut in two. Should a half be too far off, its triangle is cut in four after all, and the rules are gone through again.
#include "reference/multires/remesh.h"

#include <fmt/format.h>

#include <deque>
#include <exception>
#include <map>
#include <optional>
#include <set>

#include "reference/multires/room.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using scene::CarrierPoint;

constexpr double kWorthARound = 0.9;  // of the error, or of the number of crowded base triangles, of the round before

struct ByPlace {
  bool operator()(const CarrierPoint& a, const CarrierPoint& b) const {
    return a.corner != b.corner ? a.corner < b.corner : a.weight < b.weight;
  }
  bool operator()(const scene::OverlayVertex& a, const scene::OverlayVertex& b) const {
    return a.source == b.source ? (*this)(a.image, b.image) : (*this)(a.source, b.source);
  }
};

class Remesher {
 public:
  Remesher(const scene::Hierarchy& hierarchy, const RemeshOptions& options) : h_(hierarchy), options_(options) {}

  // Throws Error unsupported where the grids do not let it cut what has to be cut.
  Remesh run() {
    for (Patch& patch : base_patches(h_)) refine(std::move(patch));
    if (not_cut_) std::rethrow_exception(not_cut_);
    while (close()) {
    }
    write();
    return std::move(out_);
  }

  // The base triangles in which the grids, or `most`, did not let a patch be cut; and whether one was in the way of the level.
  const std::set<std::uint32_t>& crowded() const { return crowded_; }
  bool misses_level() const { return not_cut_ != nullptr; }

 private:
  scene::Point position(const CarrierPoint& source) const { return remesh_position(source, h_.input, options_.single); }
  scene::Point position(const Patch& patch, const CarrierPoint& corner) const {
    return position(source_at(patch, corner));
  }
  bool too_far(const Patch& patch) const {
    if (options_.error == std::numeric_limits<double>::infinity()) return false;
    const auto& c = patch.corners;
    return error_bound(patch, {position(patch, c[0]), position(patch, c[1]), position(patch, c[2])}, h_.input, nullptr,
                       options_.error)
               .worst() > options_.error;
  }

  template <typename Cut>
  std::vector<Patch> noted(const Patch& patch, const Cut& cut) {
    try {
      return cut();
    } catch (const scene::Error& error) {
      if (error.code() == scene::ErrorCode::unsupported) crowded_.insert(patch.base);
      throw;
    }
  }
  std::vector<Patch> in_four(const Patch& patch) {
    return noted(patch, [&] { return cut_in_four(patch, h_); });
  }
  std::vector<Patch> in_two(const Patch& patch, std::size_t edge) {
    return noted(patch, [&] { return cut_in_two(patch, edge, h_); });
  }

  void refine(Patch patch) {
    if (not_cut_ && crowded_.count(patch.base) != 0) return;
    const bool has_to = patch.level < options_.level;
    std::vector<Patch> parts;
    if (!has_to && patch.level >= options_.most) {
      if (too_far(patch))
        crowded_.insert(patch.base);  // a large part of the input is squeezed into a small one of the base domain
    } else if (has_to || too_far(patch)) {
      // What the grids do not let us cut stays. For an error the bound says so; for a level the others are looked at before that is the end.
      try {
        parts = in_four(patch);
      } catch (const scene::Error& error) {
        if (error.code() != scene::ErrorCode::unsupported) throw;
        if (has_to && !not_cut_) {
          not_cut_ = std::current_exception();
          leaves_.clear();
          used_.clear();
        }
      }
    }
    for (Patch& part : parts) refine(std::move(part));
    if (parts.empty()) keep(std::move(patch));
  }
  void keep(Patch patch) {
    if (not_cut_) return;
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
        for (const Patch& half : in_two(patch, finer.edges[0])) cut = cut || too_far(half);
      }
      if (!cut) {
        leaves_.push_back(std::move(patch));
        continue;
      }
      changed = true;
      for (Patch& part : in_four(patch)) refine(std::move(part));  // its parts may be farther off than it is
    }
    return changed;
  }

  std::uint32_t vertex(const Patch& patch, const CarrierPoint& corner) {
    const auto [place, fresh] = numbers_.try_emplace(corner, static_cast<std::uint32_t>(out_.mesh.points.size()));
    if (fresh) {
      out_.proof.parameters.push_back(corner);
      out_.sources.push_back(source_at(patch, corner));
      out_.mesh.points.push_back(position(out_.sources.back()));
    }
    return place->second;
  }

  // Of the triangles of a base triangle that is cut in four, the middle one does: then two of its corners are farthest to the first corner, else one
  // (a half of one that is cut in two has a corner in the middle, and goes with the corner that it keeps).
  static bool stands_on_its_head(const Patch& patch) {
    std::array<std::int64_t, 3> first{};
    for (std::size_t k = 0; k < 3; ++k) first[k] = patch.corners[k].weight_of(patch.triangle[0]);
    const auto most = *std::max_element(first.begin(), first.end());
    return std::count(first.begin(), first.end(), most) == 2;
  }

  // The point with its place on the remesh triangle: parts of the patch are multiples of 2^-60, for a patch is a base triangle made smaller by a power
  // of two, or half of that.
  std::uint32_t proof_point(const Patch& patch, const scene::Triangle& t, const StarPoint& point) {
    const auto& c = patch.corners;
    const exact::Wide whole = exact::area_in(patch.triangle, c[0], c[1], c[2]) >> scene::weight_bits;
    std::array<std::pair<std::uint32_t, std::int64_t>, 3> parts;
    for (std::size_t k = 0; k < 3; ++k) {
      const exact::Wide area = exact::area_in(patch.triangle, c[(k + 1) % 3], c[(k + 2) % 3], point.at.image);
      if (area % whole != 0)
        throw scene::Error(scene::ErrorCode::internal, "remesh: a point of a patch that is not on its grid");
      parts[k] = {t[k], static_cast<std::int64_t>(area / whole)};
    }
    std::sort(parts.begin(), parts.end());
    scene::OverlayVertex out{point.at.source, {}};
    std::size_t size = 0;
    for (const auto& [corner, weight] : parts) {
      if (weight == 0) continue;
      out.image.corner[size] = corner;
      out.image.weight[size++] = weight;
    }
    const auto [place, fresh] = proof_points_.try_emplace(out, static_cast<std::uint32_t>(out_.proof.points.size()));
    if (fresh) out_.proof.points.push_back(out);
    return place->second;
  }

  void write_triangle(const Patch& patch) {
    scene::Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = vertex(patch, patch.corners[k]);
    out_.mesh.face_of.push_back(static_cast<std::uint32_t>(out_.mesh.triangles.size()));
    out_.mesh.triangles.push_back(t);
    out_.proof.triangles.push_back(t);
    out_.base.push_back(patch.base);
    out_.first_piece.push_back(out_.proof.pieces.size());
    out_.turned.push_back(stands_on_its_head(patch));
    add_error(patch, out_.mesh, t, h_.input, out_.proof);
    std::vector<std::uint32_t> numbers;
    for (const StarPoint& point : patch.pieces.points) numbers.push_back(proof_point(patch, t, point));
    for (const StarPiece& piece : patch.pieces.pieces)
      out_.proof.pieces.push_back(
          {{numbers[piece.corners[0]], numbers[piece.corners[1]], numbers[piece.corners[2]]}, piece.input});
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
          for (const Patch& half : in_two(*patch, finer.edges[0])) write_triangle(half);
        }
      }
    }
    out_.first_piece.push_back(out_.proof.pieces.size());
    out_.reached = !(out_.error() > options_.error);
  }

  const scene::Hierarchy& h_;
  const RemeshOptions& options_;
  std::set<std::uint32_t> crowded_;
  std::exception_ptr not_cut_;
  std::deque<Patch> leaves_;
  std::set<CarrierPoint, ByPlace> used_;
  std::map<CarrierPoint, std::uint32_t, ByPlace> numbers_;
  std::map<scene::OverlayVertex, std::uint32_t, ByPlace> proof_points_;
  Remesh out_;
};

}  // namespace

scene::Point remesh_position(const CarrierPoint& source, const scene::TriangleMesh& input, bool single) {
  scene::Point at = position_estimate(source, input);
  if (single) {
    for (double& x : at) {
      // Through memory, because g++ 12 leaves out two conversions in a row where it makes vectors of them (-O2).
      const volatile float rounded = static_cast<float>(x);
      x = rounded;
    }
  }
  return at;
}

void add_error(const Patch& patch, const scene::TriangleMesh& mesh, const scene::Triangle& t,
               const scene::TriangleMesh& input, scene::RemeshProof& proof) {
  std::vector<std::uint32_t> near;
  const PatchError error = error_bound(patch, {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, input, &near);
  proof.to_remesh = std::max(proof.to_remesh, error.to_remesh);
  proof.to_input = std::max(proof.to_input, error.to_input);
  proof.near.insert(proof.near.end(), near.begin(), near.end());
}

Remesh remeshed(const scene::Hierarchy& hierarchy, const RemeshOptions& options) {
  if (options.level < 0 || options.level > options.most || options.most > most_levels - 2) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("remesh: a level is from 0 to {}", std::min(options.most, most_levels - 2)));
  }
  scene::Hierarchy h = with_coarse_parameters(hierarchy);
  RemeshOptions coarser = options;
  std::optional<Remesh> best;
  double crowded_before = std::numeric_limits<double>::infinity();
  while (true) {
    Remesher remesher(h, coarser);
    std::exception_ptr failed;
    bool better = false;
    try {
      Remesh out = remesher.run();
      if (out.reached) return out;
      better = !best || out.error() < kWorthARound * best->error();
      if (!best || out.error() < best->error()) best = std::move(out);
    } catch (const scene::Error& error) {
      if (error.code() != scene::ErrorCode::unsupported) throw;
      failed = std::current_exception();
      better = static_cast<double>(remesher.crowded().size()) < kWorthARound * crowded_before;
    }
    if (better && !remesher.crowded().empty()) {
      crowded_before = static_cast<double>(remesher.crowded().size());
      make_room(h, remesher.crowded());
      continue;
    }
    if (best) return std::move(*best);
    // Neighbours of fine triangles are cut too, and may lie where the grids do not let them: then all are to be coarser.
    if (coarser.most == coarser.level || remesher.misses_level()) std::rethrow_exception(failed);
    --coarser.most;
  }
}

}  // namespace clues::reference
