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

}  // namespace

Complex build_complex(const scene::TriangleMesh& mesh, const ConvexCell* cell) {
  std::vector<Point3> points(mesh.points.size());
  std::transform(mesh.points.begin(), mesh.points.end(), points.begin(), to_exact);
  return build_complex(points, mesh.triangles, cell);
}

Complex build_complex(const std::vector<Point3>& points, const std::vector<Corners>& input, const ConvexCell* cell) {
  Complex complex;
  complex.input_triangles = input.size();

  PointPool pool;
  std::vector<std::uint32_t> point_of(points.size());
  std::vector<bool> used(points.size(), false);
  for (const auto& t : input) {
    for (const std::uint32_t c : t) used[c] = true;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) point_of[i] = pool.id_of(points[i]);
  }

  std::vector<Sheet> sheets;
  std::map<Corners, std::size_t> sheet_of;
  for (std::uint32_t t = 0; t < input.size(); ++t) {
    const auto& in = input[t];
    const Corners corners{point_of[in[0]], point_of[in[1]], point_of[in[2]]};
    if (CGAL::collinear(pool[corners[0]], pool[corners[1]], pool[corners[2]])) {
      complex.degenerate.push_back(t);
      continue;
    }
    Corners key = corners;
    std::sort(key.begin(), key.end());
    const auto [it, fresh] = sheet_of.try_emplace(key, sheets.size());
    if (fresh) sheets.push_back({corners, {}});
    Sheet& sheet = sheets[it->second];
    sheet.origins.push_back({t, is_even_permutation(sheet.corners, corners)});
  }

  if (cell && cell->dimension() == 3) {
    const auto corner = [&](int i) { return pool.id_of(cell->vertices()[static_cast<std::size_t>(i)]); };
    for (const CellFacet& f : cell->facets()) {
      for (std::size_t i = 2; i < f.corners.size(); ++i) {
        const Corners corners{corner(f.corners[0]), corner(f.corners[i - 1]), corner(f.corners[i])};
        Corners key = corners;
        std::sort(key.begin(), key.end());
        if (sheet_of.try_emplace(key, sheets.size()).second) sheets.push_back({corners, {}});
      }
    }
  }

  // Contacts that need a cut.
  std::vector<std::vector<Contact>> contacts(sheets.size());
  std::vector<std::size_t> cluster(sheets.size());
  std::iota(cluster.begin(), cluster.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (cluster[i] != i) i = cluster[i] = cluster[cluster[i]];
    return i;
  };
  using Box = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_EXPLICIT>;
  struct SheetBox : Box {
    std::size_t sheet;
    SheetBox(const CGAL::Bbox_3& b, std::size_t s) : Box(b), sheet(s) {}
  };
  std::vector<SheetBox> boxes;
  boxes.reserve(sheets.size());
  const auto triangle3 = [&](const Sheet& s) {
    return Kernel::Triangle_3(pool[s.corners[0]], pool[s.corners[1]], pool[s.corners[2]]);
  };
  for (std::size_t i = 0; i < sheets.size(); ++i) boxes.emplace_back(triangle3(sheets[i]).bbox(), i);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const SheetBox& a, const SheetBox& b) {
    pairs.push_back(std::minmax(a.sheet, b.sheet));
  });
  std::sort(pairs.begin(), pairs.end());
  std::vector<Contact> met(pairs.size());
  // Isolated: who calls this from a task of his own must not be given another one while he waits here.
  const CGAL::Protect_FPU_rounding<true> as_usual(
      CGAL_FE_TONEAREST);  // TBB gives its threads that of who calls it first
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
      const Sheet &a = sheets[pairs[k].first], &b = sheets[pairs[k].second];
      if (strictly_beside(pool, a.corners, b.corners) || strictly_beside(pool, b.corners, a.corners)) return;
      Contact contact = meet(triangle3(a), triangle3(b));
      if (!contact.overlap) {
        // One common corner, or one whole common edge, needs no cut.
        if (static_cast<int>(contact.points.size()) <= common_corners(a.corners, b.corners)) return;
        for (Point3& p : contact.points) p = collapsed(p);
      }
      met[k] = std::move(contact);
    });
  });
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const Contact& contact = met[k];
    if (contact.points.empty()) continue;
    if (contact.overlap) {
      cluster[root(i)] = root(j);
      continue;
    }
    contacts[i].push_back(contact);
    contacts[j].push_back(contact);
  }

  // Cut each cluster; clusters in order of their first sheet, so that the result does not depend on union order.
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < sheets.size(); ++i) members[root(i)].push_back(i);
  std::vector<std::vector<std::size_t>> work;
  for (auto& [r, m] : members) {
    if (std::any_of(m.begin(), m.end(), [&](std::size_t s) { return !sheets[s].origins.empty(); })) work.push_back(m);
  }
  std::sort(work.begin(), work.end());
  for (const auto& sheet_ids : work) {
    const Sheet& first = sheets[sheet_ids.front()];
    if (sheet_ids.size() == 1 && contacts[sheet_ids.front()].empty()) {
      complex.pieces.push_back({first.corners, first.origins});
      continue;
    }
    std::vector<std::array<Point3, 3>> triangles;
    std::vector<Contact> cuts;
    for (const std::size_t s : sheet_ids) {
      const Corners& c = sheets[s].corners;
      triangles.push_back({pool[c[0]], pool[c[1]], pool[c[2]]});
      cuts.insert(cuts.end(), contacts[s].begin(), contacts[s].end());
      complex.refined_triangles += sheets[s].origins.size();
    }
    for (const CutFace& face : cut_in_plane(triangles, cuts)) {
      Piece piece;
      for (std::size_t k = 0; k < 3; ++k) piece.corners[k] = pool.id_of(face.corners[k]);
      for (const auto& [member, same_side] : face.owners) {
        for (const Origin& o : sheets[sheet_ids[member]].origins)
          piece.origins.push_back({o.triangle, o.same_side == same_side});
      }
      if (piece.origins.empty()) continue;
      std::sort(piece.origins.begin(), piece.origins.end(),
                [](const Origin& x, const Origin& y) { return x.triangle < y.triangle; });
      complex.pieces.push_back(std::move(piece));
    }
  }

  complex.points = pool.take();
  compact(complex);
  complex.unit = unit_of(complex.points);
  for (const Piece& p : complex.pieces) {
    const Point3 &a = complex.points[p.corners[0]], &b = complex.points[p.corners[1]],
                 &c = complex.points[p.corners[2]];
    complex.planes.emplace_back(a, b, c);
    complex.in_cell.push_back(cell && cell->dimension() == 3 && cell->interior_contains(CGAL::centroid(a, b, c)));
  }
  find_edges(complex);
  return complex;
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
