#include "reference/streams/client_contours.h"

#include <algorithm>

namespace clues::reference {

scene::CellContour client_contour(const EdgeUsers& edges, ListFloods& floods, std::uint32_t cell,
                                  const std::vector<std::uint32_t>& known, const std::vector<std::uint32_t>& wanted) {
  const ListContour contour = floods.contour(known, wanted);
  scene::CellContour out{cell, contour.seeds, {}};
  for (const std::uint32_t e : contour.boundary) {
    // Named by the first wanted triangle at it, which the client holds.
    const auto& users = edges.at(e);
    const std::uint32_t t = *std::find_if(users.begin(), users.end(), [&](std::uint32_t user) {
      return std::binary_search(wanted.begin(), wanted.end(), user);
    });
    std::size_t k = 0;
    while (edges.edge(t, k) != e) ++k;
    out.boundary.push_back(3 * std::uint64_t{t} + k);
  }
  std::sort(out.boundary.begin(), out.boundary.end());
  return out;
}

}  // namespace clues::reference
