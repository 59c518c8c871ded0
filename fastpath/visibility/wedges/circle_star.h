// A star that the great circle of a plane through x cuts (T13): arcs are cut where it crosses them, it is cut where they meet it, and what they do not cover
// of it is free.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "fastpath/visibility/wedges/star.h"

namespace clues::fastpath {

// In whole numbers: the circle meets arcs in points that intervals do not know to be on both.
class CircleStar : public Star<Integer> {
 public:
  using Face = std::vector<int>;

  CircleStar(const Star<Integer>& star, const V& normal) : Star<Integer>(star) {
    std::vector<int> rim;
    const std::vector<Arc> covering = cut_arcs(normal, rim);
    first_free_ = arcs_.size();
    add_free_parts(normal, rim, covering);
    find_faces();
  }

  // For each free part of the circle: the faces on the side away from its normal, and on the other.
  std::vector<std::pair<Face, Face>> across() const {
    const bool connected =
        std::all_of(component_.begin(), component_.end(), [&](int c) { return c == component_.front(); });
    const V nothing{Integer(0), Integer(0), Integer(0)};
    std::vector<std::pair<Face, Face>> sides;
    for (std::size_t i = first_free_; i < arcs_.size(); ++i) {
      if (connected) {
        sides.push_back({{face_[2 * i + 1]}, {face_[2 * i]}});
        continue;
      }
      const V &n = arcs_[i].normal, middle = nodes_[idx(arcs_[i].a)] + nodes_[idx(arcs_[i].b)];
      sides.emplace_back(face_of(moved({middle, -n, nothing, {}})), face_of(moved({middle, n, nothing, {}})));
    }
    return sides;
  }

 private:
  // Arcs that the circle crosses, in two. Tells the nodes on it, and gives the arcs that lie in it.
  std::vector<Arc> cut_arcs(const V& n, std::vector<int>& rim) {
    const std::vector<int> side = sides_of(n);
    for (int i = 0; i < static_cast<int>(side.size()); ++i) {
      if (side[idx(i)] == 0) rim.push_back(i);
    }
    std::vector<Arc> whole, covering;
    whole.swap(arcs_);
    for (const Arc& arc : whole) {
      const int sa = side[idx(arc.a)], sb = side[idx(arc.b)];
      if (sa == 0 && sb == 0) covering.push_back(arc);
      if (sa * sb >= 0) {
        arcs_.push_back(arc);
        continue;
      }
      const V a = nodes_[idx(arc.a)], b = nodes_[idx(arc.b)];
      const int c = static_cast<int>(nodes_.size());
      nodes_.push_back(abs(dot(n, b)) * a + abs(dot(n, a)) * b);
      rim.push_back(c);
      arcs_.push_back({arc.a, c, arc.piece, arc.normal});
      arcs_.push_back({c, arc.b, arc.piece, arc.normal});
    }
    return covering;
  }

  // In parts of at most a quarter turn.
  void add_free_parts(const V& n, std::vector<int> rim, const std::vector<Arc>& covering) {
    const Integer zero(0);
    const V e = n.x.sign() != 0 || n.y.sign() != 0 ? V{-n.y, n.x, zero} : V{n.z, zero, zero}, f = cross(n, e);
    for (const V& d : {e, f, V(-e), V(-f)}) {
      if (std::any_of(rim.begin(), rim.end(), [&](int i) { return same_direction(nodes_[idx(i)], d); })) continue;
      rim.push_back(static_cast<int>(nodes_.size()));
      nodes_.push_back(d);
    }
    std::sort(rim.begin(), rim.end(), [&](int i, int k) {
      if (i == k) return false;
      const V &di = nodes_[idx(i)], &dk = nodes_[idx(k)];
      const int hi = half_turn(n, e, di), hk = half_turn(n, e, dk);
      return hi != hk ? hi < hk : det_sign(n, di, dk) > 0;
    });
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const int a = rim[i], b = rim[(i + 1) % rim.size()];
      const V middle = nodes_[idx(a)] + nodes_[idx(b)];
      if (std::any_of(covering.begin(), covering.end(), [&](const Arc& arc) {
            return in_arc(nodes_[idx(arc.a)], nodes_[idx(arc.b)], arc.normal, middle);
          }))
        continue;
      arcs_.push_back({a, b, kNoPiece, n});
    }
  }

  std::size_t first_free_ = 0;  // the first arc of the circle, which are the last ones
};

}  // namespace clues::fastpath
