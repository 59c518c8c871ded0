// D17: what has to be visible for a wedge to be there. A part of a contour edge between neighbouring cuts has wedges where the space beside it is visible (D13a), and a
// mesh vertex where the space beside it on the way to the cell is. Each source keeps a walk (D14) from one round to the next, and is asked again only about
// new wedge pieces.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "fastpath/visibility/labels/walker.h"
#include "fastpath/visibility/wedges/beside.h"
#include "fastpath/visibility/wedges/contacts.h"
#include "fastpath/visibility/wedges/contour.h"

namespace clues::fastpath {

class Sources {
 public:
  // A part of a contour edge, seen from one supporting plane, with a point beside it.
  struct OfEdge {
    std::size_t contour = 0;
    EdgePart part;
    const ExactPoint* beside = nullptr;
    int level = 0;  // of nearness of `beside`
    std::uint64_t seed = 0x51;
    Walk walk;
    bool lit = false;
    bool doubtful = false;  // lit by a last leg alone that is in doubt (walker.h), in the round that ended last
  };

  // A mesh vertex and a point beside it on the way to the cell. If that is visible the vertex is, as its sight lines go on
  // to it. If it is not, it speaks for the vertex only as long as no surface and no wedge piece is between the two; a piece
  // that comes between moves the point nearer.
  struct OfVertex {
    std::uint32_t point = 0;
    const ExactPoint* beside = nullptr;
    const ExactPoint* view = nullptr;  // of a part of V that no other source looks at: on the way there
    int level = 0;                     // of nearness of `beside`
    std::uint64_t seed = 0xa7;
    Walk walk;
    bool lit = false;
    bool separates = false;  // its wedges do nothing else (T10): in doubt it is lit, and nothing is lost by it
    bool doubtful = false;   // lit by a last leg alone that is in doubt (walker.h), in the round that ended last
  };

  // Keeps references, but for `is_vertex`: which points are vertices of the surface (surface_vertices.h). `pieces` must be empty until the
  // first round.
  Sources(const LocalScene& scene, const std::vector<bool>& is_vertex, const std::vector<ContourEdge>& contours,
          const PieceSet& pieces, const Walker& walker, Contacts& contacts, Workers& workers);

  // With the cuts of each edge, ascending from its first end. Nothing is lit; `pieces` must be empty.
  void start_round(const std::vector<std::vector<const ExactPoint*>>& cuts);

  const std::vector<OfEdge>& of_edges() const { return of_edges_; }
  const std::vector<OfVertex>& of_vertices() const { return of_vertices_; }
  // Those that become visible by the pieces from number `first` on, ascending; from here on they are lit. In doubt: also those that count as visible.
  struct Numbers {
    std::vector<std::size_t> of_edges, of_vertices;
  };
  Numbers newly_lit(std::size_t first, bool in_doubt);
  // When a round has all its pieces: what is lit by its last leg alone may be so for want of an answer.
  void note_doubt();

  std::uint64_t walks() const { return walks_; }
  std::uint64_t unresolved() const;  // sources that count as visible without a proof: is_in_doubt, or doubtful
  // A wedge that only separates (T10) makes nothing visible, also where it should not exist: no doubt comes of it.
  bool is_in_doubt(const OfEdge& s) const {
    return s.walk.end == Walk::End::unresolved && !contours_[s.contour].holds_cell;
  }
  static bool is_in_doubt(const OfVertex& s) { return s.walk.end == Walk::End::unresolved && !s.separates; }

 private:
  Walk walk(const ExactPoint* p, std::uint64_t seed, Pool& pool);
  void place(OfEdge& source, Pool& pool);
  std::vector<OfVertex> beside_vertex(std::uint32_t vertex, Pool& pool);
  OfVertex towards(std::uint32_t vertex, const ExactPoint& view, Pool& pool);
  void place(OfVertex& source, Pool& pool);
  bool piece_between(const ExactPoint& beside, const ExactPoint& x, std::size_t first) const;
  static OfVertex unresolved(std::uint32_t vertex, const ExactPoint& view, Pool& pool);
  bool newly_visible(OfEdge& source, std::size_t first, Pool& pool);
  bool newly_visible(OfVertex& source, std::size_t first, Pool& pool);
  bool newly_visible(const ExactPoint* p, Walk& w, std::uint64_t& seed, std::size_t first, Pool& pool);
  Crossing label_of(const Walk& walk, std::size_t first) const;

  const LocalScene& scene_;
  const std::vector<ContourEdge>& contours_;
  const PieceSet& pieces_;
  const Walker& walker_;
  Contacts& contacts_;
  Workers& workers_;
  std::vector<OfEdge> of_edges_;
  std::vector<OfVertex> of_vertices_;
  std::atomic<std::uint64_t> walks_{0};
};

}  // namespace clues::fastpath
