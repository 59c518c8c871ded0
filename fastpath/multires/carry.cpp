#include "fastpath/multires/carry.h"

#include <algorithm>

#include "exact/dials.h"
#include "fastpath/multires/crossing.h"

namespace clues::fastpath::multires {
namespace {

using exact::DiskPoint;
using exact::FlatPoint;
using scene::CarrierPoint;
constexpr std::uint32_t none = scene::no_vertex;
constexpr std::size_t number_of_middle = 15;

bool lies_in(const scene::Triangle& triangle, const CarrierPoint& p) {
  return std::all_of(p.corner.begin(), p.corner.end(), [&](std::uint32_t v) {
    return v == none || v == triangle[0] || v == triangle[1] || v == triangle[2];
  });
}

}  // namespace

std::size_t Carrier::number_of(std::uint32_t vertex) const {
  if (vertex == star_->vertex) return number_of_middle;
  std::size_t k = 0;
  while (star_->ring_[k] != vertex) ++k;
  return k;
}

DiskPoint Carrier::place_of(std::uint32_t vertex) const {
  const std::size_t k = number_of(vertex);
  return k == number_of_middle ? DiskPoint{0, 0} : layout_->ring_[k];
}

void Carrier::add_point(std::uint32_t number, bool of_input, const CarrierPoint& source, const CarrierPoint& image) {
  points_.number.push_back(number);
  points_.of_input.push_back(of_input ? 1 : 0);
  points_.source.push_back(source);
  points_.image.push_back(image);
  FlatPoint flat;
  DiskDouble about;
  unsigned mask = 0;
  for (std::size_t k = 0; k < 3 && image.corner[k] != none; ++k) {
    const std::size_t place = number_of(image.corner[k]);
    mask |= 1U << place;
    if (place == number_of_middle) continue;
    const DiskPoint& corner = layout_->ring_[place];
    flat.x += Wide{corner[0]} * image.weight[k];
    flat.y += Wide{corner[1]} * image.weight[k];
    const DiskDouble c = in_doubles(corner);
    const double weight = static_cast<double>(image.weight[k]) * 0x1p-60;
    about.x += c.x * weight;
    about.y += c.y * weight;
  }
  flat_.push_back(flat);
  about_.push_back(about);
  mask_.push_back(static_cast<std::uint16_t>(mask));
}

void Carrier::gather() {
  points_.clear();
  flat_.clear();
  about_.clear();
  mask_.clear();
  parts_.clear();
  place_.resize(std::max(place_.size(), pieces_.point_count()), none);
  for (const std::uint32_t triangle : star_->triangles()) {
    for (const auto& piece : pieces_.of(triangle)) {
      StarPart part{{}, piece.input, false};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = piece.corners[k];
        if (place_[p] == none) {
          place_[p] = static_cast<std::uint32_t>(points_.size());
          add_point(p, pieces_.is_vertex(p), pieces_.source(p), pieces_.image(p));
        }
        part.corners[k] = place_[p];
      }
      parts_.push_back(part);
    }
  }
  for (const std::uint32_t p : points_.number) place_[p] = none;
}

// In ascending order of their ends, as the pieces are cut along one after the other.
void Carrier::find_diagonals(const HoleCover& cover) {
  boost::container::small_vector<scene::Edge, 3 * most_neighbours> edges;
  for (const auto& t : cover.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(scene::edge_of(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  diagonals_.clear();
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    if (edges[k] != edges[k + 1]) continue;
    diagonals_.push_back({edges[k][0], edges[k][1], place_of(edges[k][0]), place_of(edges[k][1])});
  }
}

// The point where an edge, whose ends lie strictly on either side of its line, crosses the diagonal: made, if it lies between the ends of the diagonal. False: it
// does, and the grids have no place for it.
bool Carrier::cross(const Diagonal& d, std::uint32_t x, std::uint32_t y, bool& within) {
  const Wide one = exact::orientation(d.at_a, d.at_b, flat_[x]), two = exact::orientation(d.at_a, d.at_b, flat_[y]);
  const Parts parts{two > 0 ? two : -two, one > 0 ? one : -one};  // of x and of y: what is opposite
  const auto weight_b = place_on_diagonal(d.at_a, d.at_b, flat_[x], flat_[y], parts);
  within = weight_b.has_value();
  if (!within) return true;
  if (*weight_b == 0) return false;
  const auto source = mean_of(points_.source[x], points_.source[y], parts);
  if (!source) return false;
  const std::int64_t weight_a = scene::whole_weight - *weight_b;
  add_point(none, false, *source,
            d.a < d.b ? CarrierPoint{{d.a, d.b, none}, {weight_a, *weight_b, 0}}
                      : CarrierPoint{{d.b, d.a, none}, {*weight_b, weight_a, 0}});
  return true;
}

std::uint32_t Carrier::crossing_at(const Diagonal& diagonal, std::uint32_t x, std::uint32_t y, bool& possible) {
  const std::uint32_t low = std::min(x, y), high = std::max(x, y);
  for (std::uint32_t k = first_crossing_[low]; k != none; k = crossings_[k].next) {
    if (crossings_[k].other == high) return crossings_[k].point;
  }
  bool within = false;
  const bool made = cross(diagonal, low, high, within);
  possible = possible && made;
  const auto point = made && within ? static_cast<std::uint32_t>(points_.size() - 1) : none;
  crossings_.push_back({high, point, first_crossing_[low]});
  first_crossing_[low] = static_cast<std::uint32_t>(crossings_.size() - 1);
  return point;
}

bool Carrier::cut_along(const Diagonal& diagonal) {
  const std::size_t count = points_.size();
  const DiskDouble a = in_doubles(diagonal.at_a), b = in_doubles(diagonal.at_b);
  side_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    int sign = sure_ ? side_filtered(a, b, about_[k]) : unsure;
    if (sign == unsure) sign = exact::sign_of(exact::orientation(diagonal.at_a, diagonal.at_b, flat_[k]));
    side_[k] = static_cast<signed char>(sign);
  }
  first_crossing_.assign(count, none);
  crossings_.clear();
  bool possible = true;
  const std::size_t before = parts_.size();
  for (std::size_t i = 0; i < before && possible; ++i) {
    const StarPart part = parts_[i];
    const std::array<int, 3> side{side_[part.corners[0]], side_[part.corners[1]], side_[part.corners[2]]};
    if (side[0] >= 0 && side[1] >= 0 && side[2] >= 0) continue;
    if (side[0] <= 0 && side[1] <= 0 && side[2] <= 0) continue;
    // Turned so that the first corner is alone on its side, or, where the line goes through a corner, is that corner.
    std::size_t turn = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int next = side[(k + 1) % 3], last = side[(k + 2) % 3];
      if (side[k] == 0 || (side[k] * next < 0 && side[k] * last < 0)) turn = k;
    }
    const std::uint32_t x = part.corners[turn], y = part.corners[(turn + 1) % 3], z = part.corners[(turn + 2) % 3];
    const auto add = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      parts_.push_back({{p, q, r}, part.input, true});
    };
    if (side[turn] == 0) {
      const std::uint32_t p = crossing_at(diagonal, y, z, possible);
      if (p == none) continue;
      parts_[i] = {{x, y, p}, part.input, true};
      add(x, p, z);
      continue;
    }
    const std::uint32_t p = crossing_at(diagonal, x, y, possible), q = crossing_at(diagonal, x, z, possible);
    if (p == none || q == none) {
      if (p != q) possible = false;  // the diagonal would end inside of a piece, where no vertex of the overlay is
      continue;
    }
    parts_[i] = {{x, p, q}, part.input, true};
    if (y < z) {
      add(p, y, q);
      add(y, z, q);
    } else {
      add(p, y, z);
      add(p, z, q);
    }
  }
  return possible;
}

bool Carrier::holds(std::size_t triangle, std::uint32_t point) const {
  const Sides& about = about_corners_[triangle];
  const auto& corners = corners_[triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    int sign = sure_ ? side_filtered(about[k], about[next], about_[point]) : unsure;
    if (sign == unsure) sign = exact::sign_of(exact::orientation(corners[k], corners[next], flat_[point]));
    if (sign < 0) return false;
  }
  return true;
}

bool Carrier::holds_middle(std::size_t triangle, const std::array<std::uint32_t, 3>& p) const {
  const Sides& about = about_corners_[triangle];
  const auto& corners = corners_[triangle];
  const DiskDouble sum{about_[p[0]].x + about_[p[1]].x + about_[p[2]].x,
                       about_[p[0]].y + about_[p[1]].y + about_[p[2]].y};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    int sign = sure_ ? middle_filtered(about[k], about[next], sum) : unsure;
    if (sign == unsure) {
      const DiskPoint &a = corners[k], &b = corners[next];
      const Wide dx = flat_[p[0]].x + flat_[p[1]].x + flat_[p[2]].x - Wide{3} * a[0] * scene::whole_weight,
                 dy = flat_[p[0]].y + flat_[p[1]].y + flat_[p[2]].y - Wide{3} * a[1] * scene::whole_weight;
      sign = exact::sign_of((b[0] - a[0]) * dy - (b[1] - a[1]) * dx);
    }
    if (sign < 0) return false;
  }
  return true;
}

// New images for the points that are not on the border; those that a diagonal introduced lie on an edge already.
bool Carrier::locate(const HoleCover& cover) {
  for (std::uint32_t k = 0; k < points_.size(); ++k) {
    if ((mask_[k] >> number_of_middle) == 0) continue;
    std::size_t t = 0;
    while (t < cover.size && !holds(t, k)) ++t;
    if (t == cover.size) return false;
    const auto image = weights_in(cover.triangles_[t], corners_[t], flat_[k]);
    if (!image) return false;
    points_.image[k] = *image;
    unsigned mask = 0;
    for (const std::uint32_t v : cover.triangles_[t]) {
      if (image->weight_of(v) > 0) mask |= 1U << number_of(v);
    }
    mask_[k] = static_cast<std::uint16_t>(mask);
  }
  return true;
}

// The first new triangle that holds the middle of a part, if it has its images, too; else the number of triangles. New triangles have no inside in
// common: one that has the middle inside, as doubles may tell, is the first. The one to look at is that over the corners that the images name.
std::size_t Carrier::triangle_of(const HoleCover& cover, const StarPart& part) const {
  const auto [p, q, r] = part.corners;
  const unsigned mask = static_cast<unsigned>(mask_[p]) | mask_[q] | mask_[r];
  std::size_t likely = 0;
  while (likely < cover.size && cover_mask_[likely] != mask) ++likely;
  if (likely < cover.size && sure_) {
    const Sides& about = about_corners_[likely];
    const DiskDouble sum{about_[p].x + about_[q].x + about_[r].x, about_[p].y + about_[q].y + about_[r].y};
    if (middle_filtered(about[0], about[1], sum) == 1 && middle_filtered(about[1], about[2], sum) == 1 &&
        middle_filtered(about[2], about[0], sum) == 1) {
      return likely;
    }
  }
  std::size_t t = 0;
  while (t < cover.size && !holds_middle(t, part.corners)) ++t;
  if (t == cover.size) return t;
  const auto& triangle = cover.triangles_[t];
  const bool fits =
      lies_in(triangle, points_.image[p]) && lies_in(triangle, points_.image[q]) && lies_in(triangle, points_.image[r]);
  return fits ? t : cover.size;
}

bool Carrier::share_out(const HoleCover& cover) {
  shares_.resize(std::max(shares_.size(), cover.size));
  for (std::size_t t = 0; t < cover.size; ++t) {
    shares_[t].clear();
    may_thin_[t] = false;
  }
  points_.may_go.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    points_.may_go[k] = points_.of_input[k] == 0 && points_.image[k].corner[2] != none ? 1 : 0;
  }
  for (const StarPart& part : parts_) {
    const std::size_t t = triangle_of(cover, part);
    if (t == cover.size) return false;
    const std::uint32_t p = part.corners[0], q = part.corners[1], r = part.corners[2];
    const auto turns = [&](const scene::Triangle& in, const std::vector<CarrierPoint>& of) {
      return area_of(place_in(in, of[p]), place_in(in, of[q]), place_in(in, of[r])) > 0;
    };
    if (!turns(cover.triangles_[t], points_.image)) return false;
    if (part.cut && !turns(input_[part.input], points_.source)) return false;
    shares_[t].push_back(part);
    may_thin_[t] = may_thin_[t] || (points_.may_go[p] | points_.may_go[q] | points_.may_go[r]) != 0;
  }
  return true;
}

void Carrier::carry(const SurfaceStar& star, const DiskLayout& layout, const HoleCover& cover, Carried& out) {
  star_ = &star;
  layout_ = &layout;
  sure_ = !exact::process_dials::is_on(exact::process_dials::unsure_doubles);
  out = Carried{};
  gather();
  const std::size_t before = points_.size();
  find_diagonals(cover);
  for (const Diagonal& diagonal : diagonals_) {
    if (!cut_along(diagonal)) return;
  }
  for (std::size_t t = 0; t < cover.size; ++t) {
    unsigned mask = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      mask |= 1U << number_of(cover.triangles_[t][k]);
      corners_[t][k] = place_of(cover.triangles_[t][k]);
      about_corners_[t][k] = in_doubles(corners_[t][k]);
    }
    cover_mask_[t] = static_cast<std::uint16_t>(mask);
  }
  moves_.resize(before);
  for (std::size_t k = 0; k < before; ++k) moves_[k] = static_cast<std::uint8_t>(mask_[k] >> number_of_middle);
  if (!locate(cover) || !share_out(cover)) return;
  for (std::size_t t = 0; t < cover.size; ++t) {
    if (may_thin_[t]) thinning_.thin(cover.triangles_[t], input_, points_, shares_[t]);
  }

  out.done = true;
  std::size_t count = 0;
  for (std::size_t t = 0; t < cover.size; ++t) count += shares_[t].size();
  out.pieces.reserve(count);
  for (std::size_t k = 0; k < before; ++k) {
    if (moves_[k] != 0) out.moved.push_back({points_.number[k], points_.image[k]});
  }
  for (std::size_t t = 0; t < cover.size; ++t) {
    out.sizes.push_back(static_cast<std::uint32_t>(shares_[t].size()));
    for (const StarPart& part : shares_[t]) {
      scene::OverlayTriangle piece{{}, part.input};
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& number = points_.number[part.corners[k]];
        if (number == none) {
          number = Carried::first_new + static_cast<std::uint32_t>(out.added.size());
          out.added.push_back({points_.source[part.corners[k]], points_.image[part.corners[k]]});
        }
        piece.corners[k] = number;
      }
      out.pieces.push_back(piece);
    }
  }
}

}  // namespace clues::fastpath::multires
