// Which constraint of which part of a triangle is meant, in answers and messages.
#pragma once

#include <cstdint>
#include <string>

namespace clues::scene {

enum class MotionConstraint : std::uint8_t { facing, edge_length, separation, delaunay };

// edge_length, delaunay: of the edge from corner `corner` to the next; separation: of that corner and the edge opposite; facing: 0.
struct ConstraintPlace {
  MotionConstraint constraint = MotionConstraint::facing;
  std::uint32_t triangle = 0;
  std::uint8_t corner = 0;

  bool operator==(const ConstraintPlace&) const = default;
};

inline const char* name_of(MotionConstraint constraint) {
  switch (constraint) {
    case MotionConstraint::facing:
      return "facing";
    case MotionConstraint::edge_length:
      return "edge-length";
    case MotionConstraint::separation:
      return "separation";
    case MotionConstraint::delaunay:
      return "delaunay";
  }
  return "";
}

// "separation of sample 7 from the edge 3-4": `a`, `b`, `c` are the samples at `corner` and after it.
inline std::string describe(MotionConstraint constraint, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto edge = std::to_string(a).append("-").append(std::to_string(b));
  switch (constraint) {
    case MotionConstraint::facing:
      return "facing";
    case MotionConstraint::edge_length:
      return std::string("length of the edge ").append(edge);
    case MotionConstraint::separation:
      return std::string("separation of sample ")
          .append(std::to_string(a))
          .append(" from the edge ")
          .append(std::to_string(b))
          .append("-")
          .append(std::to_string(c));
    case MotionConstraint::delaunay:
      return std::string("Delaunay property of the edge ").append(edge);
  }
  return "";
}

}  // namespace clues::scene
