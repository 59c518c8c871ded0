#include "same_map.h"

#include <algorithm>

namespace clues::test {

using exact::Point3;

namespace {

std::string text(const Point3& p) {
  return exact::to_string_exact(p.x()) + "," + exact::to_string_exact(p.y()) + "," + exact::to_string_exact(p.z()) +
         " ";
}

// The ring from its least point on.
std::string text(const std::vector<Point3>& ring) {
  const auto least = std::min_element(ring.begin(), ring.end(), [](const Point3& a, const Point3& b) {
    return CGAL::lexicographically_xyz_smaller(a, b);
  });
  std::string out;
  for (auto p = least; p != ring.end(); ++p) out += text(*p);
  for (auto p = ring.begin(); p != least; ++p) out += text(*p);
  return out;
}

// A side of a piece: its corners in the order in which they turn counter-clockwise on that side.
std::string side_text(const reference::VisibilityMap& map, std::uint32_t piece, bool front) {
  const auto& c = map.complex.pieces[piece].corners;
  std::vector<Point3> ring{map.complex.points[c[0]], map.complex.points[c[1]], map.complex.points[c[2]]};
  if (!front) std::swap(ring[1], ring[2]);
  return text(ring);
}

}  // namespace

std::multiset<std::string> region_lines(const reference::VisibilityMap& map) {
  std::multiset<std::string> lines;
  for (const reference::Region& r : map.regions) {
    std::vector<std::string> rings;
    for (const auto& ring : r.rings) rings.push_back(text(ring));
    std::sort(rings.begin() + 1, rings.end());
    std::string line = side_text(map, r.piece, r.front) + (r.visible ? "visible" : "hidden");
    for (const std::string& ring : rings) line += " | " + ring;
    lines.insert(line);
  }
  return lines;
}

std::multiset<std::string> segment_lines(const reference::VisibilityMap& map) {
  std::multiset<std::string> lines;
  for (const reference::DmSegment& s : map.segments) {
    lines.insert(side_text(map, s.piece, s.front) + (s.boundary ? "boundary " : "inner ") + text(s.a) + text(s.b));
  }
  return lines;
}

std::multiset<std::string> wedge_lines(const std::vector<reference::Wedge>& wedges) {
  std::multiset<std::string> lines;
  for (const reference::Wedge& w : wedges) {
    std::string line = text(w.center) + text(w.near0) + text(w.near1);
    line += w.unbounded ? "unbounded" : text(w.far0) + text(w.far1);
    lines.insert(line);
  }
  return lines;
}

}  // namespace clues::test
