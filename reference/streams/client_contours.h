// FIG. 54: what a client that holds the list of a large cell has to draw in each of the small ones within, said by
// contours of whole triangles (list_contour.h) in place of lists. The client floods over what it holds; it needs no number
// but those that say which corners are the same, so doubles are exact.
//
// *What is guaranteed.* Let a contour be coded within `known`, and let the client hold H, which contains `wanted`, and any
// others. Then it draws all of `wanted`: in each connected part of `wanted` is a seed, and edges with `wanted` triangles
// on both sides stop no flood unless triangles of `known` that are not wanted are at them, where the part is cut when it
// is coded, too. If H lies in `known` it draws nothing else: from a wanted triangle a flood leaves through an edge with
// others of `known` only, and these edges are the boundary. So what is not drawn is not wanted, whatever was sent before or
// after; and nothing has to be taken back.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/contours/list_contour.h"
#include "scene/stream/stream_file.h"

namespace clues::reference {

// Lists ascending, `wanted` a part of `known`; `floods` is of these edges. O(known log n).
scene::CellContour client_contour(const EdgeUsers& edges, ListFloods& floods, std::uint32_t cell,
                                  const std::vector<std::uint32_t>& known, const std::vector<std::uint32_t>& wanted);

}  // namespace clues::reference
