// Faces and neighbours.
#include "fastpath/motion/sphere_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "scene/messages/error.h"

namespace clues::fastpath::motion {
namespace {

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) { return (std::uint64_t{from} << 32U) | to; }

}  // namespace

SphereMesh::SphereMesh(const scene::DepthMesh& mesh) : samples_(mesh.samples) {
  face_of_.assign(samples_.size(), kNone);
  std::unordered_map<std::uint64_t, std::uint32_t> face_at;
  for (const auto& t : mesh.triangles) {
    const auto f = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back({t, {kNone, kNone, kNone}});
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] >= samples_.size()) {
        throw scene::Error(scene::ErrorCode::index_out_of_range,
                           fmt::format("depth mesh: triangle {} has no such corner", f));
      }
      face_of_[t[i]] = f;
      if (!face_at.emplace(edge_key(t[(i + 1) % 3], t[(i + 2) % 3]), f).second) {
        throw scene::Error(scene::ErrorCode::malformed,
                           fmt::format("depth mesh: triangle {} shares an edge and its direction with another", f));
      }
    }
  }
  for (Face& face : faces_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto beyond = face_at.find(edge_key(face.corner[(i + 2) % 3], face.corner[(i + 1) % 3]));
      if (beyond == face_at.end())
        throw scene::Error(scene::ErrorCode::malformed, "depth mesh: an edge has one triangle only");
      face.across[i] = beyond->second;
    }
  }
  for (std::uint32_t v = static_cast<std::uint32_t>(samples_.size()); v-- > 0;) {
    if (face_of_[v] == kNone) free_vertices_.push_back(v);
  }
}

std::uint32_t SphereMesh::add_vertex(const scene::DepthSample& sample) {
  if (free_vertices_.empty()) {
    samples_.push_back(sample);
    face_of_.push_back(kNone);
    return static_cast<std::uint32_t>(samples_.size() - 1);
  }
  const std::uint32_t v = free_vertices_.back();
  free_vertices_.pop_back();
  samples_[v] = sample;
  return v;
}

void SphereMesh::forget_vertex(std::uint32_t v) {
  face_of_[v] = kNone;
  if (!samples_[v].is_base) free_vertices_.push_back(v);
}

std::uint32_t SphereMesh::new_face() {
  if (free_faces_.empty()) {
    faces_.emplace_back();
    return static_cast<std::uint32_t>(faces_.size() - 1);
  }
  const std::uint32_t f = free_faces_.back();
  free_faces_.pop_back();
  return f;
}

void SphereMesh::set(std::uint32_t f, const std::array<std::uint32_t, 3>& corner,
                     const std::array<std::uint32_t, 3>& across) {
  faces_[f].corner = corner;
  faces_[f].across = across;
  for (const std::uint32_t v : corner) face_of_[v] = f;
  changed_.push_back(f);
}

void SphereMesh::join(std::uint32_t f, std::uint32_t instead_of, std::uint32_t g) {
  faces_[f].across[faces_[f].place_of_face(instead_of)] = g;
}

void SphereMesh::split_face(std::uint32_t f, std::uint32_t vertex) {
  const auto [a, b, c] = faces_[f].corner;
  const auto [na, nb, nc] = faces_[f].across;
  const std::uint32_t g = new_face(), h = new_face();
  set(f, {vertex, b, c}, {na, g, h});
  set(g, {vertex, c, a}, {nb, h, f});
  set(h, {vertex, a, b}, {nc, f, g});
  join(nb, f, g);
  join(nc, f, h);
}

void SphereMesh::split_edge(std::uint32_t f, std::size_t i, std::uint32_t vertex) {
  const Face here = faces_[f];
  const std::uint32_t a = here.corner[i], b = here.corner[(i + 1) % 3], c = here.corner[(i + 2) % 3];
  const std::uint32_t nb = here.across[(i + 1) % 3], nc = here.across[(i + 2) % 3];
  const std::uint32_t g = here.across[i];
  const std::size_t j = faces_[g].place_of_face(f);  // g: d, c, b
  const std::uint32_t d = faces_[g].corner[j], mc = faces_[g].across[(j + 1) % 3], mb = faces_[g].across[(j + 2) % 3];
  const std::uint32_t h = new_face(), k = new_face();  // beyond ca: nb; beyond ab: nc; beyond bd: mc; beyond dc: mb
  set(f, {vertex, a, b}, {nc, g, h});
  set(h, {vertex, c, a}, {nb, f, k});
  set(g, {vertex, b, d}, {mc, k, f});
  set(k, {vertex, d, c}, {mb, h, g});
  join(nb, f, h);
  join(mb, g, k);
}

void SphereMesh::flip(std::uint32_t f, std::size_t i) {
  const Face here = faces_[f];
  const std::uint32_t a = here.corner[i], b = here.corner[(i + 1) % 3], c = here.corner[(i + 2) % 3];
  const std::uint32_t nb = here.across[(i + 1) % 3], nc = here.across[(i + 2) % 3];
  const std::uint32_t g = here.across[i];
  const std::size_t j = faces_[g].place_of_face(f);
  const std::uint32_t d = faces_[g].corner[j], mc = faces_[g].across[(j + 1) % 3], mb = faces_[g].across[(j + 2) % 3];
  set(f, {a, b, d}, {mc, g, nc});
  set(g, {a, d, c}, {mb, nb, f});
  join(nb, f, g);
  join(mc, g, f);
}

void SphereMesh::star_of(std::uint32_t v, Star& star) const {
  star.faces.clear();
  star.ring.clear();
  const std::uint32_t first = face_of_[v];
  for (std::uint32_t f = first;;) {
    const Face& face = faces_[f];
    const std::size_t i = face.place_of(v);
    star.faces.push_back(f);
    star.ring.push_back(face.corner[(i + 1) % 3]);
    f = face.across[(i + 1) % 3];  // beyond the edge from corner i + 2 to v
    if (f == first) return;
  }
}

void SphereMesh::replace_star(std::uint32_t v, const Star& star,
                              std::span<const std::array<std::uint32_t, 3>> triangles) {
  const std::size_t n = star.ring.size();
  // What lies beyond each edge of the polygon; and the faces that wait for the other side of a diagonal.
  struct Side {
    std::uint32_t from, to, face;
  };
  std::vector<Side> open;
  for (std::size_t k = 0; k < n; ++k) {
    const Face& face = faces_[star.faces[k]];
    open.push_back(
        {static_cast<std::uint32_t>(k), static_cast<std::uint32_t>((k + 1) % n), face.across[face.place_of(v)]});
  }
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const std::uint32_t f = star.faces[k];
    std::array<std::uint32_t, 3> corner{}, across{kNone, kNone, kNone};
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = star.ring[triangles[k][i]];
      const std::uint32_t from = triangles[k][(i + 1) % 3], to = triangles[k][(i + 2) % 3];
      const auto match =
          std::find_if(open.begin(), open.end(), [&](const Side& s) { return s.from == from && s.to == to; });
      if (match == open.end()) {
        open.push_back({to, from, f});
        continue;
      }
      across[i] = match->face;
      Face& beyond = faces_[match->face];
      for (std::size_t j = 0; j < 3; ++j) {
        if (beyond.corner[(j + 1) % 3] == star.ring[to] && beyond.corner[(j + 2) % 3] == star.ring[from])
          beyond.across[j] = f;
      }
      open.erase(match);
    }
    set(f, corner, across);
  }
  for (std::size_t k = star.faces.size(); k-- > triangles.size();) {
    faces_[star.faces[k]] = Face{};
    free_faces_.push_back(star.faces[k]);
    changed_.push_back(star.faces[k]);
  }
  forget_vertex(v);
}

scene::DepthMesh SphereMesh::to_depth_mesh(std::vector<std::uint32_t>* numbers) const {
  scene::DepthMesh mesh;
  std::vector<std::uint32_t> number(samples_.size(), kNone);
  if (numbers != nullptr) numbers->clear();
  for (std::uint32_t v = 0; v < samples_.size(); ++v) {
    if (!is_vertex(v)) continue;
    number[v] = static_cast<std::uint32_t>(mesh.samples.size());
    mesh.samples.push_back(samples_[v]);
    if (numbers != nullptr) numbers->push_back(v);
  }
  for (const Face& f : faces_) {
    if (f.alive()) mesh.triangles.push_back({number[f.corner[0]], number[f.corner[1]], number[f.corner[2]]});
  }
  return mesh;
}

}  // namespace clues::fastpath::motion
