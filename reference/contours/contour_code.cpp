#include "reference/contours/contour_code.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "reference/contours/varints.h"

namespace clues::reference {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point2;
using exact::Point3;

// What a line or an end is named by: an edge of the triangle, a corner, in full, a border of what is known, or a label.
enum : std::uint64_t { first_edge = 0, first_corner = 3, in_full = 6, on_known = 7, first_label = 8 };
enum class SeedForm : std::uint8_t { floats, doubles, in_full };

void write_point(const Point2& p, VarintWriter& out) {
  out.text(exact::to_string_exact(p.x()));
  out.text(exact::to_string_exact(p.y()));
}

FT read_fraction(VarintReader& in) {
  const std::string text = in.text();
  mpq_class value;
  if (text.empty() || value.set_str(text, 10) != 0 || sgn(value.get_den()) == 0) VarintReader::fail();
  value.canonicalize();
  return FT(FT::Exact_type(value.get_mpq_t()));
}

Point2 read_point(VarintReader& in) {
  const FT x = read_fraction(in);
  return {x, read_fraction(in)};
}

// A side of a triangle, with what is known of it and the planes that may cut it.
class CutTriangle {
 public:
  CutTriangle(const scene::TriangleMesh& mesh, std::uint32_t triangle, const FlatSet& known)
      : frame_(frame_of(mesh, triangle)),
        plane_(frame_.corners()[0], frame_.corners()[1], frame_.corners()[2]),
        known_(known.faces()) {}

  Point2 flat(const Point3& p) const { return frame_.frame()(p); }
  Point3 lift(const Point2& q) const { return frame_.lift(q); }
  Point2 corner(std::size_t k) const { return flat(frame_.corners()[k % 3]); }
  bool on_edge(std::size_t k, const Point2& p) const { return CGAL::collinear(corner(k), corner(k + 1), p); }

  // Where the line of `line` on the triangle meets that of `end`; none where they do not cross in a point.
  std::optional<Point2> crossing(std::uint64_t line, std::uint64_t end, const std::vector<Plane3>& planes) const {
    if (end >= first_corner && end < in_full) return corner(end - first_corner);
    if (line >= first_label && end >= first_label) {
      const auto met = CGAL::intersection(plane_, planes[line - first_label], planes[end - first_label]);
      const auto* p = met ? boost::get<Point3>(&*met) : nullptr;
      return p == nullptr ? std::nullopt : std::optional(flat(*p));
    }
    if (line < first_label && end < first_label) return std::nullopt;  // corners are named as such
    const std::size_t k = std::min(line, end);
    const Plane3& plane = planes[std::max(line, end) - first_label];
    const Point3 &a = frame_.corners()[k], &b = frame_.corners()[(k + 1) % 3];
    const FT at_a = exact::value_at(plane, a), at_b = exact::value_at(plane, b);
    if (at_a == at_b) return std::nullopt;
    return flat(a + (b - a) * (at_a / (at_a - at_b)));
  }

  // Where the line meets borders of what is known, in lexicographic order.
  std::vector<Point2> known_on(std::uint64_t line, const std::vector<Plane3>& planes) const {
    std::vector<Point2> out;
    for (const Face2& face : known_) {
      for (const Ring2& ring : face) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
          const FT at_p = height(line, p, planes), at_q = height(line, q, planes);
          if (CGAL::is_zero(at_p)) out.push_back(p);
          if (CGAL::sign(at_p) * CGAL::sign(at_q) < 0) out.push_back(p + (q - p) * (at_p / (at_p - at_q)));
        }
      }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

 private:
  // Zero on the line, and linear.
  FT height(std::uint64_t line, const Point2& p, const std::vector<Plane3>& planes) const {
    if (line >= first_label) return exact::value_at(planes[line - first_label], lift(p));
    return CGAL::determinant(corner(line + 1) - corner(line), p - corner(line));
  }

  TriangleFrame frame_;
  Plane3 plane_;
  std::vector<Face2> known_;
};

// The labels that are used, as they get their numbers in the code.
class UsedLabels {
 public:
  explicit UsedLabels(const PlaneTable& all) : all_(all) {}

  std::uint64_t number(std::size_t label) {
    if (const auto at = numbers_.find(label); at != numbers_.end()) return at->second;
    PlaneLabel copy = all_.labels()[label];
    if (copy.kind == PlaneLabel::Kind::crossing) copy.crossed = number(copy.crossed);
    used_.push_back(copy);
    planes_.push_back(all_.plane(label));
    return numbers_[label] = used_.size() - 1;
  }
  const std::vector<PlaneLabel>& labels() const { return used_; }
  const std::vector<Plane3>& planes() const { return planes_; }
  // A plane in use that crosses the line there.
  std::optional<std::uint64_t> in_use_through(const CutTriangle& on, std::uint64_t line, const Point2& at) const {
    const Point3 p = on.lift(at);
    for (std::uint64_t i = 0; i < used_.size(); ++i) {
      if (planes_[i].has_on(p) && on.crossing(line, first_label + i, planes_) == at) return i;
    }
    return std::nullopt;
  }
  // Any, which is in use then.
  std::optional<std::uint64_t> through(const CutTriangle& on, std::uint64_t line, const Point2& at) {
    const Point3 p = on.lift(at);
    for (std::size_t i = 0; i < all_.labels().size(); ++i) {
      if (numbers_.contains(i) || !all_.plane(i).has_on(p)) continue;
      std::vector<Plane3> planes = planes_;
      planes.push_back(all_.plane(i));
      if (on.crossing(line, first_label + planes.size() - 1, planes) == at) return number(i);
    }
    return std::nullopt;
  }

 private:
  const PlaneTable& all_;
  std::map<std::size_t, std::uint64_t> numbers_;
  std::vector<PlaneLabel> used_;
  std::vector<Plane3> planes_;
};

std::uint64_t line_of(const CutTriangle& on, const FlatSegment& s, const PlaneTable& planes, UsedLabels& used) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (on.on_edge(k, s.a) && on.on_edge(k, s.b)) return first_edge + k;
  }
  const std::size_t label = planes.holding(on.lift(s.a), on.lift(s.b));
  return label == PlaneTable::npos ? in_full : first_label + used.number(label);
}

// Writes how the end of a segment on the line is named, and says whether in full.
bool write_end(const CutTriangle& on, std::uint64_t line, const Point2& at, UsedLabels& used, VarintWriter& out) {
  const auto named = [&out](std::uint64_t name) {
    out.number(name);
    return false;
  };
  for (std::size_t k = 0; k < 3 && line != in_full; ++k) {
    if (at == on.corner(k)) return named(first_corner + k);
    if (line >= first_label && on.crossing(line, first_edge + k, used.planes()) == at) return named(first_edge + k);
  }
  if (line != in_full) {
    if (const auto label = used.in_use_through(on, line, at)) return named(first_label + *label);
    const auto known = on.known_on(line, used.planes());
    if (const auto place = std::find(known.begin(), known.end(), at); place != known.end()) {
      out.number(on_known);
      out.number(static_cast<std::uint64_t>(place - known.begin()));
      return false;
    }
    if (const auto label = used.through(on, line, at)) return named(first_label + *label);
    out.number(in_full);
  }
  write_point(at, out);
  return true;
}

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

void write_seed(const Seed& seed, VarintWriter& out) {
  const double x = CGAL::to_double(seed.at.x()), y = CGAL::to_double(seed.at.y());
  constexpr double most = std::numeric_limits<float>::max();
  const bool fits = std::abs(x) <= most && std::abs(y) <= most;  // what is infinite does not, and is no coordinate
  if (fits && Point2(static_cast<float>(x), static_cast<float>(y)) == seed.at) {
    out.number(static_cast<std::uint64_t>(SeedForm::floats));
    for (const double d : {x, y}) out.raw(std::bit_cast<std::uint32_t>(static_cast<float>(d)), 4);
  } else if (std::isfinite(x) && std::isfinite(y) && Point2(x, y) == seed.at) {
    out.number(static_cast<std::uint64_t>(SeedForm::doubles));
    for (const double d : {x, y}) out.raw(std::bit_cast<std::uint64_t>(d), 8);
  } else {
    out.number(static_cast<std::uint64_t>(SeedForm::in_full));
    write_point(seed.at, out);
  }
}

Point2 read_seed(VarintReader& in) {
  const auto form = static_cast<SeedForm>(in.number(3));
  if (form == SeedForm::in_full) return read_point(in);
  std::array<double, 2> at{};
  for (double& x : at) {
    x = form == SeedForm::floats ? std::bit_cast<float>(static_cast<std::uint32_t>(in.raw(4)))
                                 : std::bit_cast<double>(in.raw(8));
    if (!std::isfinite(x)) VarintReader::fail();
  }
  return {at[0], at[1]};
}

}  // namespace

ContourCode encoded_contours(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                             const std::vector<FlatSet>& known, const ContourLabel& label, const PlaneTable& planes) {
  ContourCode code;
  UsedLabels used(planes);
  std::map<std::size_t, std::vector<FlatSegment>> by_side;
  for (const SideSegment& s : label.segments) by_side[s.side].push_back(s.at);
  VarintWriter body;
  body.number(label.seeds.size());
  std::size_t before = 0;
  for (const Seed& seed : label.seeds) {  // by side
    body.number(seed.side - before);
    before = seed.side;
    write_seed(seed, body);
  }
  body.number(by_side.size());
  before = 0;
  for (auto& [side, segments] : by_side) {
    const CutTriangle on(mesh, sides[side].triangle, known[side]);
    body.number(side - before);
    before = side;
    body.number(segments.size());
    std::optional<Point2> last;
    for (const FlatSegment& s : chained(segments)) {
      const bool continues = last && *last == s.a;
      const std::uint64_t line = line_of(on, s, planes, used);
      body.number(2 * line + (continues ? 1 : 0));
      for (const Point2* end : {&s.a, &s.b}) {
        if (end == &s.a && continues) continue;
        ++(write_end(on, line, *end, used, body) ? code.ends_in_full : code.ends_by_labels);
      }
      code.segments_in_full += line == in_full;
      last = s.b;
    }
  }
  VarintWriter out;
  out.number(used.labels().size());
  for (const PlaneLabel& l : used.labels()) {
    out.number(static_cast<std::uint64_t>(l.kind));
    const bool vertex = l.kind == PlaneLabel::Kind::vertex, triangle = l.kind == PlaneLabel::Kind::triangle;
    for (std::size_t i = 0; i < (vertex ? 1U : triangle ? 3U : 2U); ++i) out.number(l.points[i]);
    for (std::size_t i = 0; i < (triangle ? 0U : l.kind == PlaneLabel::Kind::edge ? 1U : 2U); ++i)
      out.number(l.cell[i]);
    if (l.kind == PlaneLabel::Kind::crossing) out.number(l.crossed);
  }
  code.bytes = out.bytes + body.bytes;
  return code;
}

ContourLabel decoded_contours(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                              const std::vector<FlatSet>& known, const exact::ConvexCell& cell,
                              std::string_view bytes) {
  VarintReader in(bytes);
  PlaneTable table(mesh, cell);
  std::vector<Plane3> planes;
  constexpr std::uint64_t most = std::uint64_t{1} << 32;
  for (std::uint64_t n = in.number(most); n > 0; --n) {
    PlaneLabel l;
    l.kind = static_cast<PlaneLabel::Kind>(in.number(4));
    const bool vertex = l.kind == PlaneLabel::Kind::vertex, triangle = l.kind == PlaneLabel::Kind::triangle;
    for (std::size_t i = 0; i < (vertex ? 1U : triangle ? 3U : 2U); ++i)
      l.points[i] = static_cast<std::uint32_t>(in.number(mesh.points.size()));
    for (std::size_t i = 0; i < (triangle ? 0U : l.kind == PlaneLabel::Kind::edge ? 1U : 2U); ++i)
      l.cell[i] = static_cast<std::uint32_t>(in.number(cell.vertices().size()));
    if (l.kind == PlaneLabel::Kind::crossing) l.crossed = in.number(planes.size());
    planes.push_back(table.plane(table.add(l)));
  }
  ContourLabel label;
  std::size_t side = 0;
  const auto next_side = [&] {
    side += in.number(most);
    if (side >= sides.size()) VarintReader::fail();
    return side;
  };
  for (std::uint64_t n = in.number(most); n > 0; --n) {
    const std::size_t on = next_side();
    label.seeds.push_back({on, read_seed(in)});
  }
  side = 0;
  for (std::uint64_t n = in.number(most); n > 0; --n) {
    next_side();
    const CutTriangle on(mesh, sides[side].triangle, known[side]);
    std::optional<Point2> last;
    for (std::uint64_t k = in.number(most); k > 0; --k) {
      const std::uint64_t named = in.number(2 * (first_label + planes.size())), line = named / 2;
      if (line >= first_corner && line < first_label && line != in_full) VarintReader::fail();
      const auto end = [&]() -> Point2 {
        const std::uint64_t name = line == in_full ? std::uint64_t{in_full} : in.number(first_label + planes.size());
        if (name == in_full) return read_point(in);
        if (name == on_known) {
          const auto points = on.known_on(line, planes);
          return points[in.number(points.size())];
        }
        const auto at = on.crossing(line, name, planes);
        if (!at) VarintReader::fail();
        return *at;
      };
      if (named % 2 == 1 && !last) VarintReader::fail();
      const Point2 a = named % 2 == 1 ? *last : end();
      last = end();
      label.segments.push_back({side, {a, *last}});
    }
  }
  if (!in.done()) VarintReader::fail();
  return label;
}

}  // namespace clues::reference
