#include "validate/multires/check_remesh.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "validate/multires/common_triangulation.h"
#include "validate/multires/level_topology.h"
#include "validate/multires/triangle_distance.h"

namespace clues::validate {
namespace {

using scene::TriangleMesh;

class RemeshJudge {
 public:
  RemeshJudge(const scene::Hierarchy& h, const TriangleMesh& remesh, const scene::RemeshProof& proof,
              HierarchyReport& report)
      : h_(h), remesh_(remesh), proof_(proof), report_(report) {}

  // Points and pieces whose weights cannot be used for distances: those are left alone then.
  void check_maps() {
    const auto before = report_.counts;
    check_topology();
    // The remesh over the base domain: its triangles are the pieces.
    std::vector<scene::OverlayVertex> vertices;
    for (std::uint32_t v = 0; v < proof_.parameters.size(); ++v)
      vertices.push_back({scene::at_vertex(v), proof_.parameters[v]});
    std::vector<scene::OverlayTriangle> parts;
    for (std::uint32_t t = 0; t < remesh_.triangles.size(); ++t) parts.push_back({remesh_.triangles[t], t});
    check_common_triangulation(
        {remesh_.triangles, h_.base, vertices, parts, "the remesh", "the base domain", "E7", "E7"}, report_);
    remesh_triangles_ = check_common_triangulation(
        {h_.input.triangles, remesh_.triangles, proof_.points, proof_.pieces, "the input", "the remesh", "E7", "E7"},
        report_);
    sound_ = before == report_.counts;
  }

  void check_positions(bool single) {
    std::vector<bool> seen(remesh_.points.size(), false);
    for (const auto& point : proof_.points) {
      if (point.image.size() != 1) continue;
      const std::uint32_t v = point.image.corner[0];
      seen[v] = true;
      for (const double x : remesh_.points[v]) {
        if (single && x != static_cast<float>(x))
          wrong(fmt::format("vertex {} of the remesh is at no float: {}", v, x));
      }
      if (!is_rounded_from({point.source, h_.input}, remesh_.points[v], single)) {
        wrong(fmt::format("vertex {} of the remesh is not where the input is at its point", v));
      }
    }
    for (std::uint32_t v = 0; v < seen.size(); ++v) {
      if (!seen[v]) wrong(fmt::format("vertex {} of the remesh is no point of the pieces", v));
    }
  }

  void check_distances() {
    if (!sound_) return wrong("distances were not looked at, for what is wrong with the pieces");
    for (std::uint32_t i = 0; i < proof_.pieces.size(); ++i) {
      const auto& piece = proof_.pieces[i];
      const auto on = corners_of(remesh_, remesh_triangles_[i]), near = corners_of(h_.input, proof_.near[i]);
      for (const std::uint32_t p : piece.corners) {
        const auto& point = proof_.points[p];
        if (std::isfinite(proof_.to_remesh) && !is_within({point.source, h_.input}, on, proof_.to_remesh))
          wrong(fmt::format("piece {}: point {} of the input is farther from the remesh than the bound {}", i, p,
                            proof_.to_remesh));
        if (std::isfinite(proof_.to_input) && !is_within({point.image, remesh_}, near, proof_.to_input))
          wrong(
              fmt::format("piece {}: point {} of the remesh is farther from triangle {} of the input than the bound {}",
                          i, p, proof_.near[i], proof_.to_input));
      }
    }
  }

 private:
  void wrong(const std::string& what) { report_.find("E7", what); }

  void check_topology() {
    const auto topology = topology_of(remesh_.triangles, remesh_.points.size()),
               input = topology_of(h_.input.triangles, h_.input.points.size());
    if (!topology.defect.empty()) wrong("the remesh is no surface: " + topology.defect);
    if (topology.euler() != input.euler() || topology.boundaries != input.boundaries) {
      wrong(fmt::format("the remesh has Euler number {} and {} boundaries, the input {} and {}", topology.euler(),
                        topology.boundaries, input.euler(), input.boundaries));
    }
  }

  const scene::Hierarchy& h_;
  const TriangleMesh& remesh_;
  const scene::RemeshProof& proof_;
  HierarchyReport& report_;
  std::vector<std::uint32_t> remesh_triangles_;  // of each piece
  bool sound_ = false;
};

// The mesh over the vertices of the proof. Each may be several in its file, but none there several of the proof: the file would be joined where the
// proof is not.
TriangleMesh with_vertices_of(const scene::RemeshProof& proof, const TriangleMesh& remesh, HierarchyReport& report) {
  TriangleMesh out;
  out.triangles = proof.triangles;
  out.points.resize(proof.parameters.size());
  std::vector<bool> placed(proof.parameters.size(), false);
  std::vector<std::uint32_t> stands_for(remesh.points.size(), scene::no_vertex);
  for (std::size_t t = 0; t < proof.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = proof.triangles[t][k];
      const std::uint32_t in_file = remesh.triangles[t][k];
      const auto& at = remesh.points[in_file];
      if (stands_for[in_file] != scene::no_vertex && stands_for[in_file] != v)
        report.find("E7", fmt::format("vertex {} of the file is vertices {} and {} of the remesh (triangle {})",
                                      in_file, stands_for[in_file], v, t));
      stands_for[in_file] = v;
      if (placed[v] && out.points[v] != at)
        report.find("E7", fmt::format("vertex {} of the remesh is in two places (triangle {})", v, t));
      out.points[v] = at;
      placed[v] = true;
    }
  }
  return out;
}

}  // namespace

void check_remesh(const scene::Hierarchy& hierarchy, const TriangleMesh& remesh, const scene::RemeshProof& proof,
                  bool single, HierarchyReport& report) {
  report.remesh =
      RemeshRow{proof.parameters.size(), proof.triangles.size(), proof.pieces.size(), proof.to_remesh, proof.to_input};
  if (remesh.triangles.size() != proof.triangles.size()) {
    report.find("E7", fmt::format("the remesh has {} triangles, its proof is about {}", remesh.triangles.size(),
                                  proof.triangles.size()));
    return;
  }
  const TriangleMesh mesh = with_vertices_of(proof, remesh, report);
  RemeshJudge judge(hierarchy, mesh, proof, report);
  judge.check_maps();
  judge.check_positions(single);
  judge.check_distances();
}

}  // namespace clues::validate
