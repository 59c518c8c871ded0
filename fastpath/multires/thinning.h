// Points of the overlay that were introduced and are of no use any more, taken out again (D33): each is moved onto a neighbour, along the input edge
// that it lies on, where all pieces that are left keep both orientations; of several neighbours onto the one that leaves the largest smallest piece.
//
// Whether a point can be taken out depends on the pieces around it alone. The rule is to go through all candidates until a round takes none out;
// one around which nothing has changed since it was looked at need not be looked at again.
#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <vector>

#include "exact/multires/grid.h"

namespace clues::fastpath::multires {

// The points of a star as arrays.
struct StarPoints {
  std::vector<std::uint32_t> number;  // in the overlay; no_vertex: introduced here
  std::vector<std::uint8_t> of_input;
  std::vector<std::uint8_t> may_go;  // introduced, and inside of a new triangle
  std::vector<scene::CarrierPoint> source, image;

  std::size_t size() const { return number.size(); }
  void clear() {
    number.clear();
    of_input.clear();
    source.clear();
    image.clear();
  }
};

// A piece by points of the star.
struct StarPart {
  std::array<std::uint32_t, 3> corners{};
  std::uint32_t input = 0;
  bool cut = false;  // its source is new
};

class Thinning {
 public:
  // `parts`: all that lie in `triangle`.
  void thin(const scene::Triangle& triangle, const std::vector<scene::Triangle>& input, const StarPoints& points,
            std::vector<StarPart>& parts);

 private:
  bool take_out(std::uint32_t point);
  exact::Wide smallest_left(std::uint32_t point, std::uint32_t target, exact::Wide best) const;

  const std::vector<scene::Triangle>* input_ = nullptr;
  const StarPoints* points_ = nullptr;
  std::vector<StarPart>* parts_ = nullptr;
  std::vector<std::uint8_t> gone_, changed_;
  std::vector<std::array<std::int64_t, 2>> at_;                           // the image in the triangle
  std::vector<boost::container::small_vector<std::uint32_t, 8>> around_;  // by point: its parts
  std::vector<std::uint32_t> candidates_, left_, neighbours_;
};

}  // namespace clues::fastpath::multires
