#include "reference/visibility/map/side_faces.h"

#include <algorithm>
#include <iterator>

namespace clues::reference {

void SideFaces::sort() {
  std::sort(regions.begin(), regions.end(),
            [](const Region& x, const Region& y) { return CGAL::lexicographically_xyz_smaller(x.sample, y.sample); });
  std::sort(segments.begin(), segments.end(), [](const DmSegment& x, const DmSegment& y) {
    return x.a != y.a ? CGAL::lexicographically_xyz_smaller(x.a, y.a) : CGAL::lexicographically_xyz_smaller(x.b, y.b);
  });
}

void SideFaces::move_to(VisibilityMap& map) {
  for (const Region& r : regions) ++(r.visible ? map.statistics.regions_visible : map.statistics.regions_hidden);
  std::move(regions.begin(), regions.end(), std::back_inserter(map.regions));
  std::move(segments.begin(), segments.end(), std::back_inserter(map.segments));
}

}  // namespace clues::reference
