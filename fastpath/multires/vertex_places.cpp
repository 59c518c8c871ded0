#include "fastpath/multires/vertex_places.h"

#include <algorithm>

#include "exact/dials.h"
#include "fastpath/multires/crossing.h"
#include "fastpath/multires/grid_signs.h"

namespace clues::fastpath::multires {
namespace {

using scene::no_vertex;

struct CoverCorners {
  std::array<DiskPoint, 3> at;
  std::array<DiskDouble, 3> about;
};

bool is_over(const scene::Triangle& triangle, const scene::CarrierPoint& image) {
  return std::all_of(image.corner.begin(), image.corner.end(), [&](std::uint32_t v) {
    return v == no_vertex || v == triangle[0] || v == triangle[1] || v == triangle[2];
  });
}

}  // namespace

VertexPlaces::VertexPlaces(const scene::TriangleMesh& input)
    : first_(input.triangles.size(), no_vertex), next_(input.points.size(), no_vertex) {
  for (std::uint32_t v = 0; v < input.points.size(); ++v) images_.push_back(scene::at_vertex(v));
}

void VertexPlaces::carry(const SurfaceStar& star, const DiskLayout& layout, const HoleCover& cover,
                         Carried& out) const {
  out = Carried{};
  const bool sure = !exact::process_dials::is_on(exact::process_dials::unsure_doubles);
  const auto place_of = [&](std::uint32_t v) {
    const auto ring = star.ring();
    const auto place = std::find(ring.begin(), ring.end(), v) - ring.begin();
    return v == star.vertex ? DiskPoint{0, 0} : layout.ring_[static_cast<std::size_t>(place)];
  };
  std::array<CoverCorners, most_neighbours> corners;
  for (std::size_t t = 0; t < cover.size; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[t].at[k] = place_of(cover.triangles_[t][k]);
      corners[t].about[k] = in_doubles(corners[t].at[k]);
    }
  }
  const auto move = [&](std::uint32_t v) {
    const auto& image = images_[v];
    if (image.weight_of(star.vertex) == 0) return true;
    exact::FlatPoint flat;
    DiskDouble about;
    for (std::size_t k = 0; k < image.size(); ++k) {
      const DiskPoint corner = place_of(image.corner[k]);
      flat.x += Wide{corner[0]} * image.weight[k];
      flat.y += Wide{corner[1]} * image.weight[k];
      const double weight = static_cast<double>(image.weight[k]) * 0x1p-60;
      about.x += in_doubles(corner).x * weight;
      about.y += in_doubles(corner).y * weight;
    }
    const auto holds = [&](const CoverCorners& c) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        int sign = sure ? side_filtered(c.about[k], c.about[next], about) : unsure;
        if (sign == unsure) sign = exact::sign_of(exact::orientation(c.at[k], c.at[next], flat));
        if (sign < 0) return false;
      }
      return true;
    };
    std::size_t t = 0;
    while (t < cover.size && !holds(corners[t])) ++t;
    if (t == cover.size) return false;
    const auto moved = weights_in(cover.triangles_[t], corners[t].at, flat);
    if (moved) out.moved.push_back({v, *moved});
    return moved.has_value();
  };
  bool all = move(star.vertex);
  for (const std::uint32_t t : star.triangles()) {
    for (std::uint32_t v = first_[t]; v != no_vertex && all; v = next_[v]) all = move(v);
  }
  out.done = all;
}

void VertexPlaces::put(const SurfaceStar& star, const HoleCover& cover, const Carried& carried) {
  for (const auto& moved : carried.moved) images_[moved.point] = moved.image;
  const std::size_t first = first_.size();
  first_.resize(first + cover.size, no_vertex);
  const auto lay = [&](std::uint32_t v) {
    std::size_t t = 0;
    while (!is_over(cover.triangles_[t], images_[v])) ++t;
    next_[v] = first_[first + t];
    first_[first + t] = v;
  };
  lay(star.vertex);
  for (const std::uint32_t t : star.triangles()) {
    for (std::uint32_t v = first_[t]; v != no_vertex;) {
      const std::uint32_t after = next_[v];
      lay(v);
      v = after;
    }
    first_[t] = no_vertex;
  }
}

void VertexPlaces::write_to(scene::Hierarchy& hierarchy) const {
  for (std::uint32_t v = 0; v < images_.size(); ++v) hierarchy.points.push_back({scene::at_vertex(v), images_[v]});
}

}  // namespace clues::fastpath::multires
