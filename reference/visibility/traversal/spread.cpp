#include "reference/visibility/traversal/spread.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;

Spread::Spread(const exact::SceneQuery& scene, Statistics& statistics, std::int64_t sight_rays)
    : scene_(scene),
      statistics_(statistics),
      sight_rays_(sight_rays),
      visited_(scene.complex().in_cell),
      seen_(visited_.size(), false),
      tried_(visited_.size(), false) {
  // The centre, and a point beside each vertex of V.
  const std::size_t n = scene.cell().vertices().size();
  eyes_.push_back(scene.cell().center());
  for (std::size_t i = 0; n > 1 && i < n; ++i) {
    std::vector<int> weights;
    for (std::size_t j = 0; j < n; ++j) weights.push_back(i == j ? 67 : 1 + static_cast<int>((3 * i + 5 * j) % 4));
    eyes_.push_back(exact::collapsed(scene.cell().interior_point(weights)));
  }
}

void Spread::see(std::uint32_t piece) {
  visited_[piece] = true;
  if (seen_[piece]) return;
  seen_[piece] = tried_[piece] = true;
  ++seen_count_;
  queue_.push_back(piece);
}

void Spread::sight(const Point3& v, const Point3& p, const std::uint32_t* target) {
  if (sight_rays_ != exact::Dials::kOwn && statistics_.sight_lines >= static_cast<std::uint64_t>(sight_rays_)) return;
  ++statistics_.sight_lines;
  const exact::SegmentAnswer answer = scene_.crossings(v, p);
  if (answer.degenerate) return;
  if (!answer.hits.empty()) {
    see(answer.hits.front().piece);
  } else if (target && scene_.complex().planes[*target].oriented_side(v) != CGAL::ON_ORIENTED_BOUNDARY) {
    see(*target);
  }
}

void Spread::try_to_see(std::uint32_t piece) {
  const exact::Complex& complex = scene_.complex();
  const auto& c = complex.pieces[piece].corners;
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    std::array<int, 3> w{2, 3, 3};  // near the middle for the centre, else near one corner or another
    if (i > 0) {
      w = {1, 1, 1};
      w[i % 3] = 14;
    }
    const Point3 p = exact::collapsed(CGAL::barycenter(complex.points[c[0]], FT(w[0]), complex.points[c[1]], FT(w[1]),
                                                       complex.points[c[2]], FT(w[2])));
    sight(eyes_[i], p, &piece);
    if (seen_[piece]) return;
  }
}

void Spread::flood() {
  const exact::Complex& complex = scene_.complex();
  while (!queue_.empty()) {
    const std::uint32_t t = queue_.back();
    queue_.pop_back();
    for (const std::uint32_t corner : complex.pieces[t].corners) {
      for (const std::uint32_t u : complex.point_pieces[corner]) {
        visited_[u] = true;
        if (tried_[u]) continue;
        tried_[u] = true;
        try_to_see(u);
      }
    }
  }
}

void Spread::look_around() {
  const CGAL::Bbox_3& box = scene_.bounds();
  const double reach = (box.xmax() - box.xmin()) + (box.ymax() - box.ymin()) + (box.zmax() - box.zmin());
  const Point3& eye = eyes_.front();
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        // A little off the axes and diagonals, where the coincidences are.
        sight(eye, eye + FT(reach) * exact::Vector3(x + 0.0625, y + 0.03125, z - 0.046875), nullptr);
      }
    }
  }
  flood();
}

void Spread::visit_with_neighbours(std::uint32_t piece) {
  for (const std::uint32_t corner : scene_.complex().pieces[piece].corners) {
    for (const std::uint32_t u : scene_.complex().point_pieces[corner]) visit(u);
  }
}

void Spread::look_at(const std::vector<std::uint32_t>& pieces) {
  for (const std::uint32_t t : pieces) {
    if (seen_[t]) continue;
    tried_[t] = true;
    try_to_see(t);
    flood();
  }
}

}  // namespace clues::reference
