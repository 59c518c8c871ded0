// The solids of a scene, found by segments, and the planes in which they are fused (section.h).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "fastpath/solids/openings.h"
#include "fastpath/solids/section.h"
#include "fastpath/solids/solid.h"

namespace clues::fastpath::solids {

// A solid on the way from one point to another, entered and left at shares of the way.
struct Pierced {
  double in = 0, out = 0;
  std::uint32_t solid = 0;
  std::int32_t side_in = -1, side_out = -1;  // numbers of its sides; -1: an end of the segment is in it
};

// Serves many threads at once.
class Solids {
 public:
  // `about`: of all that will be asked about. Solids that reach a thousand times as far are left out, as their roundings would be too large; all are where it is beyond 2^200 or within 2^-200. So are those with a side that is too thin for doubles. O(n log n).
  Solids(std::vector<Solid> solids, const Bounds& about);
  Solids(const Solids&) = delete;
  Solids& operator=(const Solids&) = delete;

  const std::vector<Solid>& all() const { return solids_; }
  const Scale& scale() const { return scale_; }

  // Solids that the segment goes through, in the order in which it enters them: in doubles, for guesses only.
  void find_pierced(const Point& from, const Point& to, std::vector<Pierced>& out) const;
  // Whether there is one. `likely` is tried first, and is then the one that was found.
  bool pierces_any(const Point& from, const Point& to, std::uint32_t& likely) const;

  // Numbers of solids whose box touches the one given, ascending.
  std::vector<std::uint32_t> touching(const Bounds& box) const;

  // The plane a little behind a side of a solid. Solids whose sides lie in one plane share it.
  std::uint32_t plane_behind(std::uint32_t solid, std::uint32_t side) const { return planes_of_[solid][side]; }
  // Made when it is first asked for; always the same.
  const Section& section(std::uint32_t plane) const;
  const FilledPlane& filled(const FacetPlane& plane) const;

 private:
  struct Node {
    Bounds bounds;
    std::uint32_t first = 0, count = 0;  // of order_, of a leaf
    std::uint32_t left = 0, right = 0;   // else; nodes
  };
  struct LazySection {
    std::once_flag made;
    std::unique_ptr<const Section> section;
  };
  struct LazyFilled {
    std::once_flag made;
    std::unique_ptr<const FilledPlane> filled;
  };
  void build();
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  void number_planes();
  void find_planes();
  bool pierce(std::uint32_t solid, const Point& from, const Point& to, Pierced& hit) const;
  template <typename Visit>
  void walk(const Point& from, const Point& to, const Visit& visit) const;

  std::vector<Solid> solids_;
  std::vector<HalfSpace> estimates_;           // of all sides, solid by solid,
  std::vector<std::uint32_t> first_estimate_;  // which begin here; one more at the end
  Scale scale_;
  std::vector<Node> nodes_;  // node 0 is the root; none without solids
  std::vector<std::uint32_t> order_;
  std::vector<SectionPlane> planes_;
  std::vector<std::vector<std::uint32_t>> planes_of_;
  std::unique_ptr<LazySection[]> sections_;
  mutable std::mutex filled_mutex_;
  mutable std::map<std::array<double, 3>, LazyFilled> filled_;
};

}  // namespace clues::fastpath::solids
