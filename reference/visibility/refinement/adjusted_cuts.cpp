// T4 as a recursion. A part of V has its first-order map; each cut of it, by the adjusted plane of one of its segments, gives another upper bound of what it sees:
// what its two halves see together. All of them hold at once (D21), so what the part sees is in their intersection, and the bound of the halves shrinks in the same way.
//
// Cuts cost two maps each, and a part may have many segments. What an adjusted wedge can take away lies between two planes (deviation.h); where little of
// what is in doubt lies there, nothing is cut.
#include <algorithm>
#include <utility>

#include "exact/complex/cell_cut.h"
#include "reference/visibility/refinement/backprojection.h"
#include "reference/visibility/refinement/deviation.h"
#include "reference/visibility/refinement/retraction.h"

namespace clues::reference {

using exact::ConvexCell;
using exact::Plane3;
using exact::Point3;

namespace {

// A cut of V is made if it may take away more than this share of the excess, a cut of a half if more than four times as much, and so on: another depth of cuts of V gains more for
// the same work, until what is left is in doubt in one of the halves alone. Figures are in docs/precision.md.
constexpr double share_of_v = 1.0 / 64, more_for_halves = 4;

struct Part {
  ConvexCell cell;
  SideSets seen;                         // upper bound: its first-order map, less what its cuts took away
  std::vector<bool> open;                // sides of which it may see more than is known to be seen
  std::vector<ContourSegment> segments;  // to be adjusted at the next depth
  double least_share = share_of_v;
  std::size_t whole = 0, other = 0;  // what was cut, and the other half; 0, 0: V
};

class AdjustedCuts {
 public:
  AdjustedCuts(Bounds& bounds, const RefineOptions& options) : bounds_(bounds), options_(options) {}

  std::vector<DepthFigures> run(const DepthReport& report) {
    std::vector<DepthFigures> depths;
    const auto note = [&](int depth) {
      depths.push_back({depth, cells_, bounds_.maps(), bounds_.viewpoints(), bounds_.area(), backprojections_});
      if (report) report(depths.back());
    };
    bounds_.look_around(0);
    note(0);
    open_ = bounds_.open_sides();
    parts_.push_back(
        {bounds_.first_order().cell, bounds_.upper(), open_, inexact_segments(bounds_.first_order(), open_)});
    for (int depth = 1; depth <= options_.max_depth; ++depth) {
      if (std::none_of(open_.begin(), open_.end(), [](bool o) { return o; })) break;
      const double excess = depths.back().area.excess();
      if (excess <= bounds_.range().area_moved_in(options_.tolerance_area)) break;
      excess_ = excess;
      const std::size_t parts = parts_.size();  // the halves made now wait for the next depth
      for (std::size_t i = 0; i < parts; ++i) {
        if (adjust(i)) bounds_.restrict_to(parts_[0].seen, open_);
      }
      bounds_.look_around(depth);
      note(depth);
      open_ = bounds_.open_sides();
    }
    return depths;
  }

 private:
  // Whether the part was cut.
  bool adjust(std::size_t i) {
    const std::vector<ContourSegment> segments = std::exchange(parts_[i].segments, {});
    if (segments.empty()) return false;
    const ConvexCell cell = parts_[i].cell;
    for (std::size_t k = 0; k < open_.size(); ++k) parts_[i].open[k] = parts_[i].open[k] && open_[k];
    const DoubtfulArea doubtful(bounds_, seen_alone(i), parts_[i].open);
    const double least_gain = parts_[i].least_share * excess_;
    const std::size_t parts = parts_.size();
    for (const ContourSegment& s : segments) {
      if (!(doubtful.between(s.plane, separating_plane(s, cell)) > least_gain)) continue;
      const auto plane = plane_of(s, cell);
      if (!plane) continue;
      if (doubtful.between(s.plane, *plane) > least_gain) cut(i, *plane);
      if (options_.retract) {
        const auto nearer = retracted(s, *plane, cell);
        if (nearer && doubtful.between(nearer->first_order, nearer->adjusted) > least_gain) cut(i, nearer->adjusted);
      }
      const Point3 middle = exact::collapsed(CGAL::midpoint(s.lo, s.hi));
      parts_[i].segments.push_back({s.edge, s.lo, middle, s.plane, s.center});
      parts_[i].segments.push_back({s.edge, middle, s.hi, s.plane, s.center});
    }
    if (parts_.size() == parts) return false;
    narrow_wholes_of(i);
    return true;
  }

  std::optional<Plane3> plane_of(const ContourSegment& s, const ConvexCell& cell) {
    ++backprojections_;
    return adjusted_plane(s, seen_by_segment(bounds_.first_order().complex, s, cell, bounds_.options()), cell);
  }

  // The planes of the first edge on the way to the cell whose adjusted plane does not run into its surface; none if the segment's own does not.
  struct Planes {
    Plane3 first_order, adjusted;
  };
  std::optional<Planes> retracted(const ContourSegment& s, const Plane3& own, const ConvexCell& cell) {
    const exact::Complex& complex = bounds_.first_order().complex;
    ContourSegment source = s;
    std::optional<Plane3> plane = own;
    while (runs_into_surface(complex, source.edge, *plane)) {
      const auto nearer = nearer_edge(complex, source, cell);
      if (!nearer) return std::nullopt;
      source = *nearer;
      plane = plane_of(source, cell);
      if (!plane) return std::nullopt;
    }
    if (source.edge == s.edge) return std::nullopt;
    return Planes{source.plane, *plane};
  }

  void cut(std::size_t i, const Plane3& plane) {
    const auto plus = exact::part_beside(parts_[i].cell, plane, exact::Side::negative);
    const auto minus = exact::part_beside(parts_[i].cell, plane, exact::Side::positive);
    if (!plus || !minus) return;
    cells_ += 2;
    const std::size_t first = parts_.size();
    for (const ConvexCell* half : {&*plus, &*minus}) {
      const std::vector<bool> wanted = parts_[i].open;
      const VisibilityMap map = bounds_.map_of(*half, wanted);
      Part part{*half,
                bounds_.sets_of(map),
                wanted,
                {},
                more_for_halves * parts_[i].least_share,
                i,
                half == &*plus ? first + 1 : first};
      for (std::size_t k = 0; k < wanted.size(); ++k)
        part.open[k] = wanted[k] && !subtract(part.seen[k], bounds_.lower()[k]).empty();
      part.segments = inexact_segments(map, part.open);
      parts_.push_back(std::move(part));
    }
    narrow(i, first);
  }

  // What a part sees, its halves see together.
  void narrow(std::size_t whole, std::size_t half) {
    const SideSets &by_one = parts_[half].seen, &by_other = parts_[parts_[half].other].seen;
    Part& part = parts_[whole];
    for (std::size_t k = 0; k < part.seen.size(); ++k) {
      if (part.open[k]) part.seen[k] = intersect(part.seen[k], unite(by_one[k], by_other[k]));
    }
  }

  void narrow_wholes_of(std::size_t i) {
    for (; i != 0; i = parts_[i].whole) narrow(parts_[i].whole, i);
  }

  // T4 asks of V- what is hidden from V+: a place that both halves may see is not decided by looking closer at one of them.
  SideSets seen_alone(std::size_t i) const {
    SideSets seen = parts_[i].seen;
    for (std::size_t half = i; half != 0; half = parts_[half].whole) {
      const SideSets& by_other = parts_[parts_[half].other].seen;
      for (std::size_t k = 0; k < seen.size(); ++k) {
        if (parts_[i].open[k]) seen[k] = subtract(seen[k], by_other[k]);
      }
    }
    return seen;
  }

  Bounds& bounds_;
  RefineOptions options_;
  std::vector<bool> open_;
  std::vector<Part> parts_;
  double excess_ = 0;  // before this depth
  std::uint64_t cells_ = 1, backprojections_ = 0;
};

}  // namespace

std::vector<DepthFigures> refine_by_backprojection(Bounds& bounds, const RefineOptions& options,
                                                   const DepthReport& report) {
  return AdjustedCuts(bounds, options).run(report);
}

}  // namespace clues::reference
