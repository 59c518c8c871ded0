// D1: triangle i is the i-th triangle of the file; a face with more corners is a fan from its first one.
#include "scene/formats/mesh_builder.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "scene/messages/warning.h"

namespace clues::scene {
namespace {

constexpr std::size_t most_items = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void MeshBuilder::add_point(const Point& point, const Place& place) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(point[axis])) {
      fail_at(place, ErrorCode::non_finite,
              fmt::format("the {} coordinate is {}; every coordinate must be finite", "xyz"[axis], point[axis]));
    }
  }
  if (mesh_.points.size() == most_items) fail_at(place, ErrorCode::unsupported, "more than 2^32-1 vertices; split it");
  mesh_.points.push_back(point);
}

void MeshBuilder::add_face(std::span<const std::int64_t> corners, const Place& place) {
  if (corners.empty())
    fail_at(place, ErrorCode::malformed, "a face with 0 corners; give it three or more, or remove it");
  for (const auto corner : corners) {
    if (corner < 0 || corner >= static_cast<std::int64_t>(most_items)) fail_index(corner, place);
  }
  if (corners.size() > most_items - mesh_.triangles.size()) {
    fail_at(place, ErrorCode::unsupported, "more than 2^32-1 triangles; split the scene");
  }
  const auto face = static_cast<std::uint32_t>(face_numbers_.size());
  const auto corner_id = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    mesh_.triangles.push_back({corner_id(0), corner_id(i), corner_id(i + 1)});
    mesh_.face_of.push_back(face);
  }
  item_ = place.item;
  face_numbers_.push_back(place.number);
  if (corners.size() < 3 && left_out_++ == 0)
    first_left_out_ =
        fmt::format("{}: a face with {} corner{}", place.text(), corners.size(), corners.size() == 1 ? "" : "s");
}

TriangleMesh MeshBuilder::take() {
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    for (const auto corner : mesh_.triangles[i]) {
      if (corner >= mesh_.points.size()) fail_index(corner, {file_, item_, face_numbers_[mesh_.face_of[i]]});
    }
  }
  if (left_out_ > 0) {
    warn(first_left_out_ + (left_out_ == 1 ? " is no surface: left out"
                                           : fmt::format(" is no surface: left out, and {} more", left_out_ - 1)));
  }
  return std::move(mesh_);
}

void MeshBuilder::fail_index(std::int64_t corner, const Place& place) const {
  const auto last = static_cast<std::int64_t>(mesh_.points.size()) - 1 + index_base_;
  fail_at(place, ErrorCode::index_out_of_range,
          mesh_.points.empty()
              ? fmt::format("the face names vertex {}, but there is no vertex; add the vertices", corner + index_base_)
              : fmt::format("the face names vertex {}, but the vertices are {} to {}; correct the index",
                            corner + index_base_, index_base_, last));
}

}  // namespace clues::scene
