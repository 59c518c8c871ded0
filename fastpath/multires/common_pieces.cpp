#include "fastpath/multires/common_pieces.h"

namespace clues::fastpath::multires {

CommonPieces::CommonPieces(const scene::TriangleMesh& input)
    : vertices_(input.points.size()), used_(input.triangles.size()) {
  for (std::uint32_t v = 0; v < input.points.size(); ++v) images_.push_back(scene::at_vertex(v));
  sources_ = images_;
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t) {
    stretches_.push_back({t, 1});
    pool_.push_back({input.triangles[t], t});
  }
}

void CommonPieces::put(std::span<const std::uint32_t> star, const Carried& carried) {
  const auto first = static_cast<std::uint32_t>(images_.size());
  for (const auto& moved : carried.moved) images_[moved.point] = moved.image;
  for (const auto& added : carried.added) {
    images_.push_back(added.image);
    sources_.push_back(added.source);
  }
  for (const std::uint32_t t : star) {
    used_ -= stretches_[t].size;
    stretches_[t].size = 0;
  }
  std::size_t begin = pool_.size();
  for (scene::OverlayTriangle piece : carried.pieces) {
    for (std::uint32_t& p : piece.corners) {
      if (p >= Carried::first_new) p = first + (p - Carried::first_new);
    }
    pool_.push_back(piece);
  }
  for (const std::uint32_t size : carried.sizes) {
    stretches_.push_back({begin, size});
    begin += size;
    used_ += size;
  }
}

void CommonPieces::end_level() {
  if (pool_.size() < 2 * used_) return;
  std::vector<scene::OverlayTriangle> pool;
  pool.reserve(2 * used_);
  for (Stretch& s : stretches_) {
    const auto begin = pool_.begin() + static_cast<std::ptrdiff_t>(s.begin);
    s.begin = pool.size();
    pool.insert(pool.end(), begin, begin + s.size);
  }
  pool_ = std::move(pool);
}

void CommonPieces::write_to(std::span<const std::uint32_t> triangles, scene::Hierarchy& hierarchy) const {
  std::vector<std::uint32_t> number(images_.size(), scene::no_vertex);
  hierarchy.points.clear();
  hierarchy.pieces.clear();
  const auto add = [&](std::uint32_t p) {
    number[p] = static_cast<std::uint32_t>(hierarchy.points.size());
    hierarchy.points.push_back({sources_[p], images_[p]});
  };
  for (std::uint32_t v = 0; v < vertices_; ++v) add(v);
  for (const std::uint32_t t : triangles) {
    for (scene::OverlayTriangle piece : of(t)) {
      for (std::uint32_t& p : piece.corners) {
        if (number[p] == scene::no_vertex) add(p);
        p = number[p];
      }
      hierarchy.pieces.push_back(piece);
    }
  }
}

}  // namespace clues::fastpath::multires
