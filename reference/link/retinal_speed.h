// FIG. 50A: detail chosen by how fast the image moves, with a proof that nobody sees the difference, as far as a curve
// (perception_curve.h) says what is seen.
//
// A viewer at the eye e moves with velocity w; a point at r from the eye moves over his retina at |w x r| / |r|^2
// radians a second. Over a triangle that is at least the distance of the origin from the triangle of the w x r, which
// is linear in r, by the largest |r|^2. A detail with the error E (no point of it is farther than that from the
// surface, nor the other way round) at a distance d is off by at most asin(E / d), and that is at most t where E <= d
// (t - t^3 / 6). So all is compared in squares, in fractions.
//
// The speed is that of an eye that looks ahead. One that follows what it sees has less of it on the retina: how much an
// eye does so is for the curve to say.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/kernel.h"
#include "scene/mesh/mesh.h"
#include "scene/stream/perception_curve.h"

namespace clues::reference {

// From the point to the triangle, which may be a segment or a point.
exact::FT squared_distance(const exact::Point3& from, const exact::Point3& a, const exact::Point3& b,
                           const exact::Point3& c);

struct MovingEye {
  exact::Point3 at;
  exact::Vector3 velocity;  // units of the scene in a second
};

// No point of the triangle moves slower than that over the retina, squared. 0 where one may stand still, and where the
// eye is in the triangle.
exact::FT squared_speed_bound(const MovingEye& eye, const scene::TriangleMesh& mesh, std::uint32_t triangle);

// `errors`: of the same triangles in several details, from the finest on, rising. The coarsest whose error goes unseen
// at this triangle; 0, the finest, where none does.
std::size_t detail_unseen(const std::vector<scene::PerceptionRow>& curve, const MovingEye& eye,
                          const scene::TriangleMesh& mesh, std::uint32_t triangle, const std::vector<double>& errors);

}  // namespace clues::reference
