// D16: cutting the scene into a conforming complex.
//
// 1. Equal corners become one point, triangles without area are set aside, identical triangles become one.
// 2. Box tests propose pairs; a pair that meets in more than its common corners or edge is cut.
// 3. Triangles that overlap in a plane are cut together (a cluster), every other triangle alone: a constrained
//    triangulation of all edges and contact segments in that plane, in exact arithmetic. A face of it belongs to
//    every triangle of the cluster that contains it.
#include "exact/complex/complex.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/box_intersection_d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "exact/complex/complex_internal.h"
#include "exact/complex/cut_memory.h"
#include "exact/kernel.h"
#include "scene/messages/error.h"

namespace clues::exact {
namespace {

using Corners = std::array<std::uint32_t, 3>;

// Points by value: equal coordinates (also +0 and -0) are one point.
class PointPool {
 public:
  std::uint32_t id_of(const Point3& p) {
    const auto [it, fresh] = ids_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (fresh) points_.push_back(p);
    return it->second;
  }
  const Point3& operator[](std::uint32_t id) const { return points_[id]; }
  std::vector<Point3> take() { return std::move(points_); }

 private:
  std::map<Point3, std::uint32_t, Kernel::Less_xyz_3> ids_;
  std::vector<Point3> points_;
};

// An input triangle with area; identical ones share it. Without origins: a part of the cell's border, which cuts and is dropped.
struct Sheet {
  Corners corners;
  std::vector<Origin> origins;
  CutMemory::Name name = 0;
  std::vector<Contact> contacts;       // that need a cut,
  std::vector<CutMemory::Name> meets;  // and with which sheets
};

bool is_even_permutation(const Corners& a, const Corners& b) {
  for (int i = 0; i < 3; ++i) {
    if (b[static_cast<std::size_t>(i)] == a[0]) return b[static_cast<std::size_t>((i + 1) % 3)] == a[1];
  }
  return false;
}

bool has_corner(const Corners& a, std::uint32_t c) { return std::find(a.begin(), a.end(), c) != a.end(); }

int common_corners(const Corners& a, const Corners& b) {
  return static_cast<int>(std::count_if(a.begin(), a.end(), [&](auto c) { return has_corner(b, c); }));
}

// For points in a's plane: whether all that are not among the ends of one edge of a lie strictly on the other side of that edge's line.
bool beyond_an_edge(const PointPool& pool, const Corners& a, const std::vector<std::uint32_t>& points) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t p = a[i], q = a[(i + 1) % 3], r = a[(i + 2) % 3];
    if (std::all_of(points.begin(), points.end(), [&](std::uint32_t c) {
          return c == p || c == q || CGAL::coplanar_orientation(pool[p], pool[q], pool[r], pool[c]) == CGAL::NEGATIVE;
        }))
      return true;
  }
  return false;
}

// Whether a plane or a line shows that a and b meet in common corners, or a common edge, only: b is on one side of a's plane, so that they meet where b has
// corners in that plane; and of those all that a lacks, if any, lie beyond an edge of a. Half of the answer: ask with a and b exchanged too.
bool strictly_beside(const PointPool& pool, const Corners& a, const Corners& b) {
  bool above = false, below = false, upon = false;
  std::vector<std::uint32_t> in_plane;
  for (const std::uint32_t c : b) {
    if (has_corner(a, c)) {
      in_plane.push_back(c);
      continue;
    }
    const CGAL::Orientation o = CGAL::orientation(pool[a[0]], pool[a[1]], pool[a[2]], pool[c]);
    (o == CGAL::POSITIVE ? above : o == CGAL::NEGATIVE ? below : upon) = true;
    if (o == CGAL::COPLANAR) in_plane.push_back(c);
  }
  if (above && below) return false;
  return !upon || beyond_an_edge(pool, a, in_plane);
}

void find_edges(Complex& complex) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> by_ends;
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    if (complex.in_cell[t]) continue;
    const Corners& c = complex.pieces[t].corners;
    for (std::size_t i = 0; i < 3; ++i) by_ends[std::minmax(c[i], c[(i + 1) % 3])].push_back(t);
  }
  complex.piece_edges.resize(complex.pieces.size());
  complex.point_pieces.resize(complex.points.size());
  complex.point_edges.resize(complex.points.size());
  for (const auto& [ends, pieces] : by_ends) {
    const auto id = static_cast<std::uint32_t>(complex.edges.size());
    complex.edges.push_back({ends.first, ends.second, pieces});
    complex.point_edges[ends.first].push_back(id);
    complex.point_edges[ends.second].push_back(id);
    for (const std::uint32_t t : pieces) {
      const Corners& c = complex.pieces[t].corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair<std::uint32_t, std::uint32_t> side = std::minmax(c[i], c[(i + 1) % 3]);
        if (side == ends) complex.piece_edges[t][i] = id;
      }
    }
  }
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    if (complex.in_cell[t]) continue;
    for (const std::uint32_t c : complex.pieces[t].corners) complex.point_pieces[c].push_back(t);
  }
}

// Drops points that no piece uses; the others keep their order.
void compact(Complex& complex) {
  std::vector<bool> used(complex.points.size(), false);
  for (const Piece& p : complex.pieces) {
    for (const std::uint32_t c : p.corners) used[c] = true;
  }
  std::vector<std::uint32_t> now(complex.points.size(), 0);
  std::vector<Point3> kept;
  for (std::size_t i = 0; i < used.size(); ++i) {
    now[i] = static_cast<std::uint32_t>(kept.size());
    if (used[i]) kept.push_back(complex.points[i]);
  }
  complex.points = std::move(kept);
  for (Piece& p : complex.pieces) {
    for (std::uint32_t& c : p.corners) c = now[c];
  }
}

std::vector<Point3> exact_points(const scene::TriangleMesh& mesh) {
  std::vector<Point3> points(mesh.points.size());
  std::transform(mesh.points.begin(), mesh.points.end(), points.begin(), to_exact);
  return points;
}

// In parallel, and isolated: who calls this from a task of his own must not be given another one while he waits here.
void for_each_isolated(std::size_t n, const auto& work) {
  const CGAL::Protect_FPU_rounding<true> as_usual(
      CGAL_FE_TONEAREST);  // TBB gives its threads that of who calls it first
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, n, work); });
}

class Builder {
 public:
  Builder(const ConvexCell* cell, std::span<const std::uint32_t> names, CutMemory* memory)
      : cell_(cell && cell->dimension() == 3 ? cell : nullptr), names_(names), memory_(memory) {}

  Complex build(const std::vector<Point3>& points, const std::vector<Corners>& input) {
    complex_.input_triangles = input.size();
    take_in(points, input);
    if (cell_) add_border();
    find_contacts();
    cut();
    finish();
    return std::move(complex_);
  }

 private:
  using Sheets = std::vector<std::size_t>;

  // 1.
  void take_in(const std::vector<Point3>& points, const std::vector<Corners>& input) {
    std::vector<bool> used(points.size(), false);
    for (const auto& t : input) {
      for (const std::uint32_t c : t) used[c] = true;
    }
    std::vector<std::uint32_t> point_of(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (used[i]) point_of[i] = pool_.id_of(points[i]);
    }
    for (std::uint32_t t = 0; t < input.size(); ++t) {
      const auto& in = input[t];
      const Corners corners{point_of[in[0]], point_of[in[1]], point_of[in[2]]};
      if (CGAL::collinear(pool_[corners[0]], pool_[corners[1]], pool_[corners[2]])) {
        complex_.degenerate.push_back(t);
        continue;
      }
      Sheet& sheet = sheets_[sheet_with(corners, names_.empty() ? 0 : names_[t])];
      sheet.origins.push_back({t, is_even_permutation(sheet.corners, corners)});
    }
  }

  void add_border() {
    CutMemory::Name name = CutMemory::kBorder;
    const auto corner = [&](int i) { return pool_.id_of(cell_->vertices()[static_cast<std::size_t>(i)]); };
    for (const CellFacet& f : cell_->facets()) {
      for (std::size_t i = 2; i < f.corners.size(); ++i)
        sheet_with({corner(f.corners[0]), corner(f.corners[i - 1]), corner(f.corners[i])}, name++);
    }
  }

  // The sheet with these corners, in whatever order; a new one gets this name.
  std::size_t sheet_with(const Corners& corners, CutMemory::Name name) {
    Corners key = corners;
    std::sort(key.begin(), key.end());
    const auto [it, fresh] = sheet_of_.try_emplace(key, sheets_.size());
    if (fresh) sheets_.push_back({corners, {}, name, {}, {}});
    return it->second;
  }

  Kernel::Triangle_3 triangle(const Sheet& s) const {
    return {pool_[s.corners[0]], pool_[s.corners[1]], pool_[s.corners[2]]};
  }

  // 2.
  void find_contacts() {
    const std::vector<std::pair<std::size_t, std::size_t>> pairs = overlapping_boxes();
    std::vector<Contact> met(pairs.size());
    for_each_isolated(pairs.size(),
                      [&](std::size_t k) { met[k] = contact(sheets_[pairs[k].first], sheets_[pairs[k].second]); });
    cluster_.resize(sheets_.size());
    std::iota(cluster_.begin(), cluster_.end(), std::size_t{0});
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [i, j] = pairs[k];
      if (memory_) memory_->keep(sheets_[i].name, sheets_[j].name, met[k]);
      if (met[k].overlap) {
        cluster_[root(i)] = root(j);
      } else if (!met[k].points.empty()) {
        sheets_[i].contacts.push_back(met[k]);
        sheets_[j].contacts.push_back(met[k]);
        sheets_[i].meets.push_back(sheets_[j].name);
        sheets_[j].meets.push_back(sheets_[i].name);
      }
    }
  }

  std::vector<std::pair<std::size_t, std::size_t>> overlapping_boxes() const {
    using Box = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_EXPLICIT>;
    struct SheetBox : Box {
      std::size_t sheet;
      SheetBox(const CGAL::Bbox_3& b, std::size_t s) : Box(b), sheet(s) {}
    };
    std::vector<SheetBox> boxes;
    boxes.reserve(sheets_.size());
    for (std::size_t i = 0; i < sheets_.size(); ++i) boxes.emplace_back(triangle(sheets_[i]).bbox(), i);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const SheetBox& a, const SheetBox& b) {
      pairs.push_back(std::minmax(a.sheet, b.sheet));
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  // Without points where no cut is needed.
  Contact contact(const Sheet& a, const Sheet& b) const {
    if (const Contact* known = memory_ ? memory_->contact(a.name, b.name) : nullptr) return *known;
    if (strictly_beside(pool_, a.corners, b.corners) || strictly_beside(pool_, b.corners, a.corners)) return {};
    Contact contact = meet(triangle(a), triangle(b));
    if (contact.overlap) return {{}, true};  // where does not matter: the plane is cut along all edges
    // One common corner, or one whole common edge, needs no cut.
    if (static_cast<int>(contact.points.size()) <= common_corners(a.corners, b.corners)) return {};
    for (Point3& p : contact.points) p = collapsed(p);
    return contact;
  }

  std::size_t root(std::size_t i) {
    while (cluster_[i] != i) i = cluster_[i] = cluster_[cluster_[i]];
    return i;
  }

  // 3. Clusters in order of their first sheet, so that the result does not depend on union order.
  void cut() {
    std::map<std::size_t, Sheets> members;
    for (std::size_t i = 0; i < sheets_.size(); ++i) members[root(i)].push_back(i);
    std::vector<Sheets> work;
    for (auto& [r, m] : members) {
      if (std::any_of(m.begin(), m.end(), [&](std::size_t s) { return !sheets_[s].origins.empty(); }))
        work.push_back(std::move(m));
    }
    std::sort(work.begin(), work.end());
    const auto is_whole = [&](const Sheets& ids) { return ids.size() == 1 && sheets_[ids[0]].contacts.empty(); };
    std::vector<std::vector<CutFace>> faces(work.size());
    for_each_isolated(work.size(), [&](std::size_t w) {
      if (!is_whole(work[w])) faces[w] = cut_faces(work[w]);
    });
    for (std::size_t w = 0; w < work.size(); ++w) {
      if (is_whole(work[w])) {
        const Sheet& whole = sheets_[work[w][0]];
        complex_.pieces.push_back({whole.corners, whole.origins});
        continue;
      }
      if (memory_) memory_->keep(situation(work[w]), faces[w]);
      for (const std::size_t s : work[w]) complex_.refined_triangles += sheets_[s].origins.size();
      add_pieces(work[w], faces[w]);
    }
  }

  CutMemory::Situation situation(const Sheets& ids) const {
    CutMemory::Situation situation;
    for (const std::size_t s : ids) {
      situation.push_back({sheets_[s].name});
      situation.back().insert(situation.back().end(), sheets_[s].meets.begin(), sheets_[s].meets.end());
    }
    return situation;
  }

  std::vector<CutFace> cut_faces(const Sheets& ids) const {
    if (const std::vector<CutFace>* known = memory_ ? memory_->cut(situation(ids)) : nullptr) return *known;
    std::vector<std::array<Point3, 3>> triangles;
    std::vector<Contact> contacts;
    for (const std::size_t s : ids) {
      const Corners& c = sheets_[s].corners;
      triangles.push_back({pool_[c[0]], pool_[c[1]], pool_[c[2]]});
      contacts.insert(contacts.end(), sheets_[s].contacts.begin(), sheets_[s].contacts.end());
    }
    return cut_in_plane(triangles, contacts);
  }

  void add_pieces(const Sheets& ids, const std::vector<CutFace>& faces) {
    for (const CutFace& face : faces) {
      Piece piece;
      for (std::size_t k = 0; k < 3; ++k) piece.corners[k] = pool_.id_of(face.corners[k]);
      for (const auto& [member, same_side] : face.owners) {
        for (const Origin& o : sheets_[ids[member]].origins)
          piece.origins.push_back({o.triangle, o.same_side == same_side});
      }
      if (piece.origins.empty()) continue;
      std::sort(piece.origins.begin(), piece.origins.end(),
                [](const Origin& x, const Origin& y) { return x.triangle < y.triangle; });
      complex_.pieces.push_back(std::move(piece));
    }
  }

  void finish() {
    complex_.points = pool_.take();
    compact(complex_);
    complex_.unit = unit_of(complex_.points);
    for (const Piece& p : complex_.pieces) {
      const Point3 &a = complex_.points[p.corners[0]], &b = complex_.points[p.corners[1]],
                   &c = complex_.points[p.corners[2]];
      complex_.planes.emplace_back(a, b, c);
      complex_.in_cell.push_back(cell_ && cell_->interior_contains(CGAL::centroid(a, b, c)));
    }
    find_edges(complex_);
  }

  const ConvexCell* cell_;  // null unless it is solid
  std::span<const std::uint32_t> names_;
  CutMemory* memory_;
  Complex complex_;
  PointPool pool_;
  std::vector<Sheet> sheets_;
  std::map<Corners, std::size_t> sheet_of_;
  std::vector<std::size_t> cluster_;  // union-find
};

}  // namespace

Complex build_complex(const scene::TriangleMesh& mesh, const ConvexCell* cell) {
  return Builder(cell, {}, nullptr).build(exact_points(mesh), mesh.triangles);
}

Complex build_complex(const std::vector<Point3>& points, const std::vector<Corners>& input, const ConvexCell* cell) {
  return Builder(cell, {}, nullptr).build(points, input);
}

Complex build_complex(const scene::TriangleMesh& part, const ConvexCell* cell, std::span<const std::uint32_t> names,
                      CutMemory& memory) {
  return Builder(cell, names, &memory).build(exact_points(part), part.triangles);
}

std::vector<std::uint32_t> triangles_not_solid(const Complex& complex) {
  // Edges over all pieces, those in the cell too, which Complex::edges leaves out.
  struct Sides {
    std::int64_t balance = 0;
    std::vector<std::uint32_t> pieces;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Sides> edges;
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    const Piece& p = complex.pieces[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = p.corners[k], b = p.corners[(k + 1) % 3];
      Sides& edge = edges[std::minmax(a, b)];
      for (const Origin& o : p.origins) edge.balance += (a < b) == o.same_side ? 1 : -1;
      edge.pieces.push_back(t);
    }
  }
  std::vector<std::uint32_t> bad;
  for (const auto& [ends, edge] : edges) {
    if (edge.balance == 0) continue;
    for (const std::uint32_t t : edge.pieces) {
      for (const Origin& o : complex.pieces[t].origins) bad.push_back(o.triangle);
    }
  }
  std::sort(bad.begin(), bad.end());
  bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
  return bad;
}

void require_solid(const Complex& complex) {
  const std::vector<std::uint32_t> bad = triangles_not_solid(complex);
  if (bad.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < bad.size() && i < 5; ++i) list += (i ? ", " : "") + std::to_string(bad[i]);
  throw scene::Error(scene::ErrorCode::not_solid,
                     "solid mode needs a closed, consistently oriented mesh, but triangle" +
                         std::string(bad.size() > 1 ? "s " : " ") + list + (bad.size() > 5 ? ", ..." : "") + " (" +
                         std::to_string(bad.size()) +
                         " in all) have an edge that is open or turned over; close the mesh, or use sheet mode");
}

}  // namespace clues::exact
