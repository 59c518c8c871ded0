// D14: the label of a point by walking towards it from the cell. All points of a walk are points of free space: where the walk goes on from a
// surface, it does so from a point beside it from which neither surface nor wedge piece divides the one before, and which so has its label.
//
// A walk does not depend on the wedge pieces but for that; it is made once and looked at again when new pieces appear (D17a).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "exact/dials.h"
#include "fastpath/visibility/labels/corner.h"
#include "fastpath/visibility/labels/left_out.h"
#include "fastpath/visibility/wedges/piece_set.h"

namespace clues::fastpath {

struct Leg {
  const ExactPoint* m = nullptr;  // the last crossing before p, on a piece
  const ExactPoint* p = nullptr;
  const ExactPoint* next = nullptr;  // beside m: the p of the next leg; none for the last
  std::uint32_t piece = 0;
  int side = 1;              // of the piece, that p is on: 1 front, -1 back
  bool from_edge = false;    // m is on an edge of the piece, the bottom of a groove in which all is hidden
  bool from_corner = false;  // m is a corner of the piece, and all next to it is hidden (corner.h)

  bool is_sight_line() const { return !from_edge && !from_corner; }
  // From where to p the walk goes beside a sight line, or along none (one_label.h, 1); null: nowhere.
  const ExactPoint* aside_from() const { return next ? next : is_sight_line() ? nullptr : m; }
};

struct Walk {
  // crossed: by a piece that was there when the walk was made; the walk is not complete then.
  enum class End : std::uint8_t { cell, surface, unresolved, crossed };
  End end = End::surface;
  std::vector<Leg> legs;      // from p towards the cell
  bool from_nowhere = false;  // unresolved, for want of a sight line that may be the first

  // It comes to a place beside a surface, and what it comes to after that may count.
  bool has_places() const { return legs.size() > (end == End::surface ? 1 : 0); }
  // Its last leg comes out of a groove or a corner.
  bool ends_in_the_dark() const { return !legs.empty() && !legs.back().is_sight_line(); }

  // Whether test(from, to) holds of the ends of all its ways that are beside a sight line or follow none.
  template <class Test>
  bool all_ways_aside(const Test& test) const {
    return std::all_of(legs.begin(), legs.end(), [&](const Leg& leg) {
      const ExactPoint* from = leg.aside_from();
      return !from || test(from->approximate(), leg.p->approximate());
    });
  }
};

// Whether a walk surely keeps out of what was left out, of number `i` of that, where it follows no sight line. Needs RoundedUp in scope.
bool keeps_out(const Walk& walk, const LeftOut& left_out);
bool keeps_out(const Walk& walk, const LeftOut& left_out, std::size_t i);

class Walker {
 public:
  // `longest`: legs after which a walk is given up (Dials).
  Walker(const LocalScene& scene, const PieceSet& pieces, std::int64_t longest = exact::Dials::kOwn);

  enum class Label : std::uint8_t { hidden, visible, unresolved };

  struct Manner {
    std::uint64_t seed = 0;  // another seed, other sight lines
    int near = 0;            // level of nearness from which on points beside surfaces are looked for
    std::size_t least = 0;   // legs along sight lines before the walk may end with one that comes out of the dark
  };
  // Which blocked sight lines to p may be the first, by where they come from; all, if empty.
  using MayCome = std::function<bool(const ExactPoint& v)>;
  // Points of the walk are kept in `pool`. Deterministic.
  Walk walk(const ExactPoint* p, Pool& pool, const Manner& manner, const MayCome& may_come = {}) const;
  // Whether the pieces from number `first` on cross a leg from H+ to H-; touch: some coincidence.
  Crossing leg_crossed(const Leg& leg, std::size_t first) const;
  // Whether the start of a walk is visible by the pieces from number `first` on, as far as sight lines tell; touch: make another walk. Where a piece divides a point of the walk from the
  // one before, what the walk comes to after that says nothing.
  Crossing visible(const Walk& walk, std::size_t first) const;
  // The same by a last leg that comes out of the dark. A sight line that comes into a beam stays in it, as V is on H+ of every wedge; this leg may leave it again.
  // Then a piece is crossed from H- to H+, and it is in doubt whether the start is visible.
  Crossing visible_by_last_leg(const Walk& walk, std::size_t first) const;
  // Whether the pieces from number `first` on cross a leg from H+ to H-, or divide a place of the walk from the point before, or may. If not, neither of the above says anything but no by them.
  bool is_met(const Walk& walk, std::size_t first) const;
  // Whether one is, or may be; the pieces are complete.
  bool last_leg_is_in_doubt(const Walk& walk) const;
  // Walks until a walk is in general position, and keeps out of what was left out where it follows no sight line. Needs RoundedUp in scope.
  Label label(const ExactPoint* p, const LeftOut& left_out, Pool& pool, std::uint64_t seed) const;

  const PieceSet& pieces() const { return *pieces_; }
  // A point of int V for candidate number i.
  const ExactPoint* viewpoint(std::uint64_t i) const { return viewpoints_[i % viewpoints_.size()]; }

 private:
  struct Surface {
    std::uint32_t piece;
    int side;
  };
  int height_sign(const Surface& s, const ExactPoint& x) const;
  // A point of int V strictly in front of the surface (and of `also`, if given and possible); none if V has none in front of the first, or it is not found
  // within 2^-3968 of a vertex. What is in front of a plane of doubles is: heights over it are multiples of 2^-3222, and below 2^400 in the standard range.
  const ExactPoint* in_front(const Surface& on, const Surface* also, std::uint64_t seed, Pool& pool) const;
  enum class Both : std::uint8_t { apart, touch, meet };  // V, or the closed V only, with the space in front of both
  using Chain = std::array<GrooveEnd, 2>;                 // of edges that are connected
  struct Ends {
    const Chain& of;
    std::array<bool, 2> closed{};  // nothing comes in there
  };

  // ---- what does not end (grooves.cpp)

  // Apart also if the closed V touches that space only upon this chain of common edges, or past its closed ends.
  Both in_front_of_both(const Surface& a, const Surface& b, const std::optional<Ends>& ends) const;
  // Whether the groove over this chain, which q is in, is dark, though the closed V touches the space in front of both.
  bool is_dark_over(const Chain& chain, const Surface& on, const Surface& before, const ExactPoint& q) const;
  // Whether the piece lies in the plane of a surface and in front of the other, at least in part.
  bool is_wall(std::uint32_t piece, const Surface& of, const Surface& other) const;
  // A wall of a groove is all of a flat surface, which others may cut into many pieces.
  struct Wall {
    std::vector<std::uint32_t> pieces;
    std::vector<std::uint32_t> edges;  // at which the other wall stands on it: on one line
  };
  Wall wall_of(const Surface& a, const Surface& b) const;
  // Whether the wall's pieces at a point of such an edge fill the angle from one edge to the next, in front of the other wall. Where they leave a notch, a viewer next to the line
  // sees along the groove through it, however near the edge.
  bool is_whole_at(std::uint32_t point, std::uint32_t from, std::uint32_t to, const Surface& wall,
                   const Surface& other) const;
  // Those of such edges that are connected with number `first`, with no notch between.
  Chain chain_of(std::size_t first, const std::vector<std::uint32_t>& edges, const Surface& a, const Surface& b) const;
  // A point of int V in front of `on`, close to where the closed V touches the groove, from which the sight line to p does not come in through the other wall; none, if none was found.
  const ExactPoint* along_groove(const ExactPoint& p, const Surface& on, const Surface& before, Pool& pool) const;
  // Where it touches: vertices, and points where an edge or a diagonal of V leaves the space in front of the first.
  std::vector<const ExactPoint*> ends_of_groove(const Surface& a, const Surface& b, Pool& pool) const;
  // Whether something stands between a place where walls meet and q, or may; without the pieces that `skip` says.
  template <class Skip>
  bool is_blocked(const ExactPoint& y, const ExactPoint& q, const Skip& skip) const;
  // Each adds the last leg of a walk that has none, if it can.
  bool corner_leg(Walk& walk, Pool& pool) const;
  bool leg_from_edge_at_corner(Walk& walk, Pool& pool) const;
  bool groove_leg(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const;
  bool leg_from_edge(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const;
  bool leg_in_slice(Walk& walk, const Surface& on, const Surface& before, Both how, Pool& pool) const;
  // A piece of the wall that holds y, a point of its plane, and what comes next in direction d.
  std::optional<std::uint32_t> piece_from(const ExactPoint& y, const Exact3& d, const Surface& wall,
                                          const Surface& other) const;

  const LocalScene* scene_;
  const PieceSet* pieces_;
  std::int64_t longest_;
  Pool own_;
  std::vector<const ExactPoint*> viewpoints_;
};

}  // namespace clues::fastpath
