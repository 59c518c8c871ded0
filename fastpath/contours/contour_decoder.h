// The map of a cell from a file of contours (D26), in doubles: the boundary segments made again from their labels, and
// floods from the seeds, from the outermost cell inwards.
//
// Guarantee. Let R be what the exact decoder (reference/contours/contour_code.h) finds on a side of a triangle.
//   1. R lies in a region Q whose border runs along segments of the drawing, between their exact ends. Floods go over
//      faces of the drawing. Sides of edges that bound one face are always joined (side_graph.h), and a stretch of an edge
//      of the scene is passed unless it is known to be blocked; so what is reached holds what is reached exactly. By
//      induction that holds for all cells on the way inwards: in the exact flood a face counts where the cell around sees
//      it, and here where it is reached there.
//   2. LitRegion has the border of Q with each end moved, by a known `radius` at most, to doubles. Then Q lies in the
//      points that the moved border goes around, together with all points that are no farther than its radius from one of
//      its edges. For let all ends move evenly from where they are to where they were moved: no point of an edge is ever
//      farther than the radius from where it ends. So the border never runs over a point p that is farther than that from
//      the moved one, and goes around p as often in the end as in the beginning: not at all only where p is not in Q.
//      Faces between points that cannot be told apart may have no edge left: they lie in the box around these points.
// So what is called hidden is hidden from the cell, as far as the file is right: the topology of a drawing (which points
// are one, what hangs together, where a seed is) is the file's word. clues delta decode --check compares with the exact
// decoder.
//
// Whole triangles: a triangle is listed where a face of one of its sides is reached, so the list holds the exact one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fastpath/contours/interval_drawing.h"
#include "scene/mesh/mesh.h"
#include "scene/stream/contour_file.h"

namespace clues::fastpath {

// Of one side of a triangle: what may be seen of it.
struct LitRegion {
  using Flat = std::array<double, 2>;
  // The border's edges, each with the region on the same hand; and points near which is all that is known of a part.
  struct Border {
    std::array<Flat, 2> ends{};
    scene::PointPair points{};  // the ends in the drawing; of points that cannot be told apart one
    double radius = 0;          // how far an exact end may be off in a coordinate
  };
  std::uint32_t side = 0;
  bool whole = true;          // all of the triangle; then there is no border
  std::array<int, 2> axes{};  // two of three coordinates, flat
  std::vector<Border> border;

  // Whether a point of the side's plane may be in it: goes around, or near the border. Of a point that is not in the
  // triangle nothing is asked.
  bool may_hold(const scene::Point& p) const;
};

struct ContourDecoding {
  std::vector<std::uint32_t> list;  // triangles, ascending
  std::vector<LitRegion> regions;   // by side; sides of which nothing is seen have none
  std::uint64_t points = 0;         // of drawings
  std::uint64_t unbounded = 0;      // of which doubles say nothing but that they are on their edge or triangle
  std::uint64_t wild = 0;           // at which they do not tell the order
};

class ContourDecoder {
 public:
  explicit ContourDecoder(const scene::TriangleMesh& mesh);  // O(n log n)

  // O(n log n) in the triangles of the scene and the points of drawings. Throws scene::Error malformed where the file is not
  // of this scene's size, or a point is beside its triangle.
  ContourDecoding decode(const scene::ContourFile& file, std::uint32_t cell) const;

 private:
  const scene::TriangleMesh& mesh_;
  SceneEdges edges_;
};

}  // namespace clues::fastpath
