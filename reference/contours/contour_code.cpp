#include "reference/contours/contour_code.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point2;
using exact::Point3;
using scene::ContourCell;
using scene::ContourPoint;
using scene::ContourSeed;
using scene::ContourSide;

std::uint32_t number_of(const InputSide& side) { return 2 * side.triangle + (side.front ? 0U : 1U); }

// The labels that are used, as they get their numbers in the code.
class UsedLabels {
 public:
  explicit UsedLabels(const PlaneTable& all) : all_(all) {}

  std::uint32_t number(std::size_t label) {
    if (const auto at = numbers_.find(label); at != numbers_.end()) return at->second;
    PlaneLabel copy = all_.labels()[label];
    if (copy.kind == PlaneLabel::Kind::crossing) copy.crossed = number(copy.crossed);
    used_.push_back(copy);
    order_.push_back(label);
    return numbers_[label] = static_cast<std::uint32_t>(used_.size() - 1);
  }
  // All planes through the point, those in use first.
  std::vector<std::size_t> through(const Point3& p) const {
    std::vector<std::size_t> out;
    for (const std::size_t label : order_) {
      if (all_.plane(label).has_on(p)) out.push_back(label);
    }
    for (std::size_t label = 0; label < all_.labels().size(); ++label) {
      if (!numbers_.contains(label) && all_.plane(label).has_on(p)) out.push_back(label);
    }
    return out;
  }
  const Plane3& plane(std::size_t label) const { return all_.plane(label); }
  std::vector<PlaneLabel> labels() && { return std::move(used_); }

 private:
  const PlaneTable& all_;
  std::map<std::size_t, std::uint32_t> numbers_;
  std::vector<std::size_t> order_;
  std::vector<PlaneLabel> used_;
};

// Along contours: a segment behind one that ends where it begins.
std::vector<FlatSegment> chained(std::vector<FlatSegment> segments) {
  for (std::size_t i = 1; i < segments.size(); ++i) {
    for (std::size_t j = i; j < segments.size(); ++j) {
      if (segments[j].b == segments[i - 1].b) std::swap(segments[j].a, segments[j].b);
      if (segments[j].a != segments[i - 1].b) continue;
      std::swap(segments[i], segments[j]);
      break;
    }
  }
  return segments;
}

// What a cell draws on one side.
class SideCoder {
 public:
  SideCoder(std::uint32_t side, Drawings& drawings, UsedLabels& used, ContourCounts& counts)
      : drawings_(drawings),
        drawn_(drawings.on(side)),
        known_segments_(drawn_.segments().size()),
        used_(used),
        counts_(counts) {
    out_.side = side;
  }

  void add_segments(const std::vector<FlatSegment>& segments) {
    for (const FlatSegment& s : chained(segments)) {
      const std::uint32_t a = point(s.a), b = point(s.b);
      out_.segments.push_back({a, b});
    }
  }
  void add_block(std::size_t edge, const FlatSegment& s) {
    const auto k = static_cast<std::uint32_t>(edge);
    const std::uint32_t a = point(s.a), b = point(s.b);
    // All of an edge is named as it runs.
    const bool is_turned = drawn_.is_corner(a) && drawn_.is_corner(b) && a != k;
    out_.blocks.push_back({k, is_turned ? scene::PointPair{b, a} : scene::PointPair{a, b}});
  }
  ContourSide done() {
    for (const scene::PointPair& segment : out_.segments) drawn_.add_segment(segment);
    out_.bridges = drawn_.bridges();
    counts_.bridges += out_.bridges.size();
    return std::move(out_);
  }

 private:
  std::uint32_t point(const Point2& flat) {
    const auto& points = drawn_.points();
    const auto known = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.flat == flat; });
    if (known != points.end()) return static_cast<std::uint32_t>(known - points.begin());
    const Point3 at = drawn_.frame().lift(flat);
    ContourPoint named = name_of(at, flat);
    ++(named.kind == ContourPoint::Kind::in_full ? counts_.in_full : counts_.by_labels);
    if (const auto edge = scene::edge_that_gets(named)) drawings_.on_scene_edge(out_.side / 2, *edge).push_back(at);
    out_.points.push_back(named);
    return drawn_.add_point(at, scene::lies_on(named));
  }

  ContourPoint name_of(const Point3& at, const Point2& flat) {
    ContourPoint name;
    std::uint32_t on = 0;
    for (std::uint32_t k = 0; k < 3 && on == 0; ++k) {
      if (!drawn_.on_edge(k, flat)) continue;
      on = 1 + k;
      const auto& there = drawings_.on_scene_edge(out_.side / 2, k);
      if (const auto same = std::find(there.begin(), there.end(), at); same != there.end()) {
        name.kind = ContourPoint::Kind::again;
        name.first = k;
        name.second = static_cast<std::uint32_t>(same - there.begin());
        return name;
      }
      if (const auto plane = across(at, drawn_.points()[k].at)) {
        name.kind = ContourPoint::Kind::on_edge;
        name.first = k;
        name.second = *plane;
        return name;
      }
    }
    for (std::uint32_t s = 0; s < known_segments_ && on == 0; ++s) {
      const auto& [a, b] = drawn_.segments()[s];
      if (!exact::Kernel::Segment_2(drawn_.points()[a].flat, drawn_.points()[b].flat).has_on(flat)) continue;
      on = 4 + s;
      if (const auto plane = across(at, drawn_.points()[a].at)) {
        name.kind = ContourPoint::Kind::on_segment;
        name.first = s;
        name.second = *plane;
        return name;
      }
    }
    if (on == 0) {
      if (const auto planes = crossing_at(at)) {
        name.kind = ContourPoint::Kind::crossing;
        name.first = (*planes)[0];
        name.second = (*planes)[1];
        return name;
      }
    }
    name.kind = ContourPoint::Kind::in_full;
    name.first = on;
    for (int i = 0; i < 3; ++i) name.at[static_cast<std::size_t>(i)] = exact::to_string_exact(at[i]);
    return name;
  }
  // A plane through the point and not through another one of its line.
  std::optional<std::uint32_t> across(const Point3& at, const Point3& other) {
    for (const std::size_t label : used_.through(at)) {
      if (!used_.plane(label).has_on(other)) return used_.number(label);
    }
    return std::nullopt;
  }
  // Two that cross the triangle there and nowhere else.
  std::optional<std::array<std::uint32_t, 2>> crossing_at(const Point3& at) {
    const auto labels = used_.through(at);
    for (std::size_t j = 1; j < labels.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const auto normal = [&](std::size_t label) { return used_.plane(label).orthogonal_vector(); };
        if (CGAL::is_zero(CGAL::determinant(drawn_.plane().orthogonal_vector(), normal(labels[i]), normal(labels[j]))))
          continue;
        const std::uint32_t one = used_.number(labels[i]);
        return std::array{one, used_.number(labels[j])};
      }
    }
    return std::nullopt;
  }

  Drawings& drawings_;
  DrawnSide& drawn_;
  std::size_t known_segments_;
  UsedLabels& used_;
  ContourCounts& counts_;
  ContourSide out_;
};

// The same component, with few bits where they do.
ContourSeed coded_seed(std::uint32_t side, const Point2& at, const DrawnSide& drawn) {
  ContourSeed seed;
  seed.side = side;
  const auto& flat = drawn.frame().flat();
  const auto u = flat[1] - flat[0], v = flat[2] - flat[0], w = at - flat[0];
  const FT twice = CGAL::determinant(u, v);
  const std::array<FT, 2> weights{CGAL::determinant(w, v) / twice, CGAL::determinant(u, w) / twice};
  Point2 place = at;
  for (std::uint32_t bits = 2; bits <= 52 && seed.bits == 0; ++bits) {
    const double scale = std::ldexp(1.0, static_cast<int>(bits));
    ContourSeed tried = seed;
    tried.bits = bits;
    for (std::size_t i = 0; i < 2; ++i)
      tried.at[i] = static_cast<std::uint64_t>(std::max(1.0, std::nearbyint(CGAL::to_double(weights[i]) * scale)));
    if (tried.at[0] + tried.at[1] >= static_cast<std::uint64_t>(scale)) continue;
    const Point2 there = place_of(tried, drawn.frame());
    if (there != at && !drawn.is_clear(at, there)) continue;
    seed = tried;
    place = there;
  }
  if (seed.bits == 0) {
    for (std::size_t i = 0; i < 2; ++i) seed.fractions[i] = exact::to_string_exact(weights[i]);
  }
  std::vector<std::pair<double, std::uint32_t>> near;
  for (std::uint32_t p = 0; p < drawn.points().size(); ++p) {
    const auto d = drawn.points()[p].flat - place;
    near.emplace_back(std::hypot(CGAL::to_double(d.x()), CGAL::to_double(d.y())), p);
  }
  std::sort(near.begin(), near.end());
  const auto from = std::find_if(near.begin(), near.end(),
                                 [&](const auto& n) { return drawn.is_free(drawn.points()[n.second].flat, place); });
  if (from == near.end()) throw scene::Error(scene::ErrorCode::internal, "contours: a seed that sees no corner");
  seed.from = from->second;
  return seed;
}

}  // namespace

ContourCell encoded_contours(const std::vector<InputSide>& sides, const ContourLabel& label, Drawings drawings,
                             const PlaneTable& planes, ContourCounts& counts) {
  ContourCell cell;
  UsedLabels used(planes);
  std::map<std::size_t, std::vector<FlatSegment>> by_side;
  for (const SideSegment& s : label.segments) by_side[s.side].push_back(s.at);
  for (const auto& [s, segments] : by_side) {
    const std::uint32_t side = number_of(sides[s]);
    const DrawnSide& drawn = drawings.on(side);
    std::vector<FlatSegment> inside;
    std::vector<std::pair<std::size_t, FlatSegment>> blocks;
    for (const FlatSegment& at : segments) {
      std::size_t k = 0;
      while (k < 3 && !(drawn.on_edge(k, at.a) && drawn.on_edge(k, at.b))) ++k;
      if (k < 3) {
        blocks.emplace_back(k, at);
      } else {
        inside.push_back(at);
      }
    }
    SideCoder coder(side, drawings, used, counts);
    coder.add_segments(inside);
    for (const auto& [k, at] : blocks) coder.add_block(k, at);
    cell.sides.push_back(coder.done());
  }
  for (const Seed& seed : label.seeds) {
    const std::uint32_t side = number_of(sides[seed.side]);
    cell.seeds.push_back(coded_seed(side, seed.at, drawings.on(side)));
  }
  cell.planes = std::move(used).labels();
  return cell;
}

ContourLabel decoded_contours(const std::vector<InputSide>& sides, const ContourCell& cell, Drawings& drawings) {
  std::map<std::uint32_t, std::size_t> places;
  for (std::size_t s = 0; s < sides.size(); ++s) places[number_of(sides[s])] = s;
  drawings.add(cell);
  ContourLabel label;
  for (const ContourSide& side : cell.sides) {
    const auto& points = drawings.on(side.side).points();
    const auto add = [&](const scene::PointPair& ends) {
      if (points[ends[0]].flat == points[ends[1]].flat)
        throw scene::Error(scene::ErrorCode::malformed, "contours: a segment whose ends are one point");
      label.segments.push_back({places.at(side.side), {points[ends[0]].flat, points[ends[1]].flat}});
    };
    for (const scene::PointPair& segment : side.segments) add(segment);
    for (const auto& block : side.blocks) add(block.ends);
  }
  for (const ContourSeed& seed : cell.seeds)
    label.seeds.push_back({places.at(seed.side), place_of(seed, drawings.on(seed.side).frame())});
  return label;
}

std::vector<FlatSet> decoded_map(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                 const scene::ContourFile& file, std::uint32_t cell, ContourMaps* keep) {
  Drawings drawings(mesh);
  std::vector<FlatSet> known = whole_sides(sides, mesh);
  for (const std::uint32_t c : scene::chain_of(file.cells, cell)) {
    const ContourLabel label = decoded_contours(sides, file.cells[c], drawings);
    if (keep != nullptr) {
      if (const auto at = keep->find(c); at != keep->end()) {
        known = at->second;
        continue;
      }
    }
    known = flooded(sides, mesh, known, label);
    if (keep != nullptr) (*keep)[c] = known;
  }
  return known;
}

std::vector<FlatSet> whole_sides(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh) {
  std::vector<FlatSet> sets;
  for (const InputSide& side : sides) {
    const TriangleFrame frame = frame_of(mesh, side.triangle);
    sets.emplace_back(frame.twice_area(), std::vector<Face2>{{frame.outline()}});
  }
  return sets;
}

std::vector<std::uint32_t> list_of(const std::vector<InputSide>& sides, const std::vector<FlatSet>& sets,
                                   const std::vector<std::uint32_t>& besides) {
  std::vector<std::uint32_t> list = besides;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!sets[s].empty()) list.push_back(sides[s].triangle);
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace clues::reference
