// Half-edge collapses, each proved by the signs of what is left: the pieces around the point fill the same polygon before and after, on both
// surfaces, and fill it once if they all turn counter-clockwise.
#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "reference/multires/stars/star_pieces.h"

namespace clues::reference {
namespace {

using exact::Wide;
using scene::CarrierPoint;

// Whether v may move to w on a surface: inside of the triangle anywhere, on an edge along it.
bool may_slide(const CarrierPoint& v, const CarrierPoint& w) {
  if (v.size() == 3) return true;
  if (v.size() != 2) return false;
  return std::all_of(w.corner.begin(), w.corner.begin() + static_cast<std::ptrdiff_t>(w.size()),
                     [&](std::uint32_t c) { return v.weight_of(c) > 0; });
}

class Simplifier {
 public:
  // Piece k lies in triangles[part[k]].
  Simplifier(const std::vector<scene::Triangle>& triangles, const std::vector<std::size_t>& part,
             const std::vector<scene::Triangle>& input, const StarPieces& star, std::vector<StarPiece>& pieces)
      : triangles_(triangles),
        part_(part),
        input_(input),
        star_(star),
        pieces_(pieces),
        alive_(pieces.size(), true),
        around_(star.points.size()) {
    for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
      for (const std::uint32_t v : pieces_[k].corners) around_[v].push_back(k);
    }
  }

  // `hub`: points on the edges from it are looked at too.
  void run(std::uint32_t hub) {
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t v = 0; v < around_.size(); ++v) {
      if (around_[v].empty()) continue;
      const CarrierPoint& image = star_.points[v].at.image;
      if (!star_.points[v].of_input && (image.size() == 3 || (image.size() == 2 && image.weight_of(hub) > 0)))
        candidates.push_back(v);
    }
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::uint32_t> left;
      for (const std::uint32_t v : candidates) {
        if (take_out(v)) {
          changed = true;
        } else {
          left.push_back(v);
        }
      }
      candidates = std::move(left);
    }
  }
  bool is_left(std::size_t piece) const { return alive_[piece]; }

 private:
  // The smallest image that would be left with v at w; 0 where that is not allowed.
  Wide smallest_left(std::uint32_t v, std::uint32_t w) const {
    Wide smallest = 0;
    std::size_t shared = 0;
    for (const std::uint32_t k : around_[v]) {
      auto corners = pieces_[k].corners;
      if (std::find(corners.begin(), corners.end(), w) != corners.end()) {
        ++shared;
        continue;
      }
      std::replace(corners.begin(), corners.end(), v, w);
      const auto& at = star_.points;
      const Wide area = exact::area_in(triangles_[part_[k]], at[corners[0]].at.image, at[corners[1]].at.image,
                                       at[corners[2]].at.image);
      if (area <= 0 || exact::orientation_in(input_[pieces_[k].input], at[corners[0]].at.source,
                                             at[corners[1]].at.source, at[corners[2]].at.source) <= 0) {
        return 0;
      }
      if (smallest == 0 || area < smallest) smallest = area;
    }
    return shared == 2 ? smallest : 0;
  }

  bool take_out(std::uint32_t v) {
    neighbours_.clear();
    for (const std::uint32_t k : around_[v]) {
      for (const std::uint32_t w : pieces_[k].corners) {
        if (w != v) neighbours_.push_back(w);
      }
    }
    std::sort(neighbours_.begin(), neighbours_.end());
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    Wide best = 0;
    std::uint32_t target = v;
    for (const std::uint32_t w : neighbours_) {
      const auto &from = star_.points[v].at, &to = star_.points[w].at;
      if (!may_slide(from.source, to.source) || !may_slide(from.image, to.image)) continue;
      const Wide area = smallest_left(v, w);
      if (area > best) {
        best = area;
        target = w;
      }
    }
    if (target == v) return false;
    for (const std::uint32_t k : around_[v]) {
      auto& corners = pieces_[k].corners;
      if (std::find(corners.begin(), corners.end(), target) != corners.end()) {
        alive_[k] = false;
        for (const std::uint32_t w : corners) {
          if (w == v) continue;
          auto& left = around_[w];
          left.erase(std::remove(left.begin(), left.end(), k), left.end());
        }
      } else {
        std::replace(corners.begin(), corners.end(), v, target);
        around_[target].push_back(k);
      }
    }
    around_[v].clear();
    return true;
  }

  const std::vector<scene::Triangle>& triangles_;
  const std::vector<std::size_t>& part_;
  const std::vector<scene::Triangle>& input_;
  const StarPieces& star_;
  std::vector<StarPiece>& pieces_;
  std::vector<bool> alive_;
  std::vector<boost::container::small_vector<std::uint32_t, 8>> around_;  // by point: its pieces
  std::vector<std::uint32_t> neighbours_;                                 // of the point that is looked at
};

}  // namespace

void simplify(const scene::Triangle& triangle, const std::vector<scene::Triangle>& input, const StarPieces& star,
              std::vector<StarPiece>& pieces) {
  const std::vector<scene::Triangle> triangles{triangle};
  const std::vector<std::size_t> part(pieces.size(), 0);
  Simplifier simplifier(triangles, part, input, star, pieces);
  simplifier.run(scene::no_vertex);
  std::vector<StarPiece> kept;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (simplifier.is_left(k)) kept.push_back(pieces[k]);
  }
  pieces = std::move(kept);
}

void simplify_star(const std::vector<scene::Triangle>& triangles, std::uint32_t hub,
                   const std::vector<scene::Triangle>& input, const StarPieces& star,
                   std::vector<std::vector<StarPiece>>& pieces) {
  std::vector<StarPiece> all;
  std::vector<std::size_t> part;
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    all.insert(all.end(), pieces[t].begin(), pieces[t].end());
    part.insert(part.end(), pieces[t].size(), t);
    pieces[t].clear();
  }
  Simplifier simplifier(triangles, part, input, star, all);
  simplifier.run(hub);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (simplifier.is_left(k)) pieces[part[k]].push_back(all[k]);
  }
}

}  // namespace clues::reference
