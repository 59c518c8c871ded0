// D17: what has to be visible for a wedge to be there. A part of a contour edge between neighbouring cuts has wedges where the space beside it is visible (D13a), and a
// mesh vertex where the space beside it on the way to the cell is. Each source keeps a walk (D14) from one round to the next, and is asked again only about
// new wedge pieces.
//
// A source is asked at a place beside it, and its walk goes on from places beside surfaces, with nothing between that was known then. What is lit is not asked again in its round. But a piece that comes later
// may divide a place from what it stands for; then another label is known, and the source may be dark. So when a round has all its pieces what is lit is looked at once more, and what a piece
// divides is asked nearer in another round (ask_nearer).
//
// The last leg of a walk that ends in a groove or a corner is no part of a sight line, and light that it comes into it may leave again (walker.h). So it lights no source: the walk is made
// anew, with more legs before it may end like that. They come ever nearer to where it is dark, so the light begins on one of them; if none says so the source is in doubt.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "fastpath/visibility/labels/left_out.h"
#include "fastpath/visibility/labels/walker.h"
#include "fastpath/visibility/wedges/beside.h"
#include "fastpath/visibility/wedges/contacts.h"
#include "fastpath/visibility/wedges/contour.h"

namespace clues::fastpath {

class Sources {
 public:
  // What is asked whether light is there.
  struct Place {
    const ExactPoint* beside = nullptr;  // where it is asked
    int level = 0;                       // of nearness of `beside`
    Walker::Manner manner;               // of the walk from there
    Walk walk;
    bool lit = false;
    bool stale = false;  // the walk has to be made anew
    bool known = false;  // see start_known()
    bool alone = false;  // the walk was made when there was no piece
    bool unmet = false;  // no piece of the round before met the walk, or came between a place and what it stands for
    bool confirmed = false;  // it was lit when the round before had all its pieces
  };

  // A part of a contour edge, seen from one supporting plane, with a point beside it.
  struct OfEdge : Place {
    std::size_t contour = 0;
    EdgePart part;
    bool is_clear = false;  // no piece that there was at the end of the round before divides the place from the part

    OfEdge() { manner.seed = 0x51; }
  };

  // A mesh vertex and a point beside it on the way to the cell. If that is visible the vertex is, as its sight lines go on
  // to it. If it is not, it speaks for the vertex only as long as no surface and no wedge piece is between the two; a piece
  // that comes between moves the point nearer.
  struct OfVertex : Place {
    std::uint32_t point = 0;
    const ExactPoint* view = nullptr;  // of a part of V that no other source looks at: on the way there
    bool separates = false;  // its wedges do nothing else (T10): in doubt it is lit, and nothing is lost by it

    OfVertex() { manner.seed = 0xa7; }
  };

  // Keeps references, but for `is_vertex`: which points are vertices of the surface (surface_vertices.h). `pieces` must be empty until the
  // first round.
  Sources(const LocalScene& scene, const std::vector<bool>& is_vertex, const std::vector<ContourEdge>& contours,
          const PieceSet& pieces, const Walker& walker, Contacts& contacts, Workers& workers);

  // None is left. With all threads.
  void clear();
  // With the cuts of each edge, ascending from its first end. Nothing is lit; `pieces` must be empty.
  void start_round(const std::vector<std::vector<const ExactPoint*>>& cuts);

  const std::vector<OfEdge>& of_edges() const { return of_edges_; }
  const std::vector<OfVertex>& of_vertices() const { return of_vertices_; }
  // Those that become visible by the pieces from number `first` on, ascending; from here on they are lit. What no piece of the round before met is asked about the newest of the round's
  // fresh pieces alone.
  enum class Light : std::uint8_t {
    sure,      // what is visible
    in_doubt,  // and what counts as visible
    known      // what is visible whatever is in doubt: see start_known()
  };
  struct Numbers {
    std::vector<std::size_t> of_edges, of_vertices;
  };
  // Those that are no part of a piece that there was at the end of the round before, as a walker sees them; the newest are those from number `first` on.
  struct Fresh {
    const Walker& walker;
    std::size_t first = 0;
  };
  Numbers newly_lit(std::size_t first, const Fresh& fresh, Light light);
  // All pieces of the round have been asked about: what is not lit is met by none.
  void end_light();
  // When a round has all its pieces: what is lit though a piece divides one of its places from what that stands for is asked nearer in the next round. Whether there is any. Then the round had
  // light that is not there, and what it left undecided is asked again, too; the first few times. `fresh`: all of them; `all_still_there`: what there was at the end of the round before.
  bool ask_nearer(const Walker& fresh, bool all_still_there);

  // When the rounds are over and all pieces there (D17b): nothing is lit. From here on only that can be which was, which keeps out of all that was left out, with its place and where its walk goes
  // beside a sight line, which no piece divides, and which sight lines show. Needs RoundedUp in scope. O(sources * what is left out near them).
  void start_known(const LeftOut& left_out);

  std::uint64_t walks() const { return walks_; }
  std::uint64_t unresolved() const;  // sources that count as visible without a proof: is_in_doubt
  // A wedge that only separates (T10) makes nothing visible, also where it should not exist: no doubt comes of it.
  bool is_in_doubt(const OfEdge& s) const {
    return s.walk.end == Walk::End::unresolved && !contours_[s.contour].holds_cell;
  }
  static bool is_in_doubt(const OfVertex& s) { return s.walk.end == Walk::End::unresolved && !s.separates; }

 private:
  void set_walk(Place& source, Walk made);  // what was known of another walk is forgotten
  // Of an edge: from a nearer place where no sight line to this one comes next to the edge.
  void walk_from_place(OfEdge& source, Pool& pool);
  void walk_from_place(OfVertex& source, Pool& pool);
  // From its level of nearness on; the walk from there is left to make. Without a place the source counts as visible.
  void find_place(OfEdge& source, Pool& pool);
  std::vector<OfVertex> beside_vertex(std::uint32_t vertex, Pool& pool);
  OfVertex towards(std::uint32_t vertex, const ExactPoint& view, Pool& pool);
  void place(OfVertex& source, Pool& pool);
  bool piece_between(const ExactPoint& beside, const ExactPoint& x, const PieceSet& by, std::size_t first) const;
  static OfVertex unresolved(std::uint32_t vertex, const ExactPoint& view, Pool& pool);
  bool is_met(const OfEdge& source, const Fresh& by) const;
  bool is_met(const OfVertex& source, const Fresh& by) const;
  bool newly_visible(OfEdge& source, std::size_t first, Pool& pool);
  bool newly_visible(OfVertex& source, std::size_t first, Pool& pool);
  template <class Source>
  bool newly_visible_by_walk(Source& source, std::size_t first, Pool& pool);
  Place& place_of(std::size_t i);  // of edges, then of vertices
  bool is_cut_off(const OfEdge& source, const PieceSet& by, std::size_t first) const;

  const LocalScene& scene_;
  const std::vector<ContourEdge>& contours_;
  const PieceSet& pieces_;
  const Walker& walker_;
  Contacts& contacts_;
  Workers& workers_;
  int times_nearer_ = 0;
  std::vector<OfEdge> of_edges_;
  std::vector<OfVertex> of_vertices_;
  std::atomic<std::uint64_t> walks_{0};
};

}  // namespace clues::fastpath
