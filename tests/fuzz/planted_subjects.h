// Answers that hide something visible, as campaigns meet them.
#pragma once

#include <numeric>

#include "exact/sight/scene_query.h"
#include "fuzz/subjects/subject.h"

namespace clues::fuzz {

class EverythingHidden : public Subject {
 public:
  Answer answer(const Case&) const override { return {}; }
  std::string name() const override { return "everything-hidden"; }
};

// All but one triangle, which one depends on the coordinates and not on the order.
class HidesOneTriangle : public Subject {
 public:
  Answer answer(const Case& scene) const override {
    const auto& mesh = scene.mesh;
    Answer out;
    std::uint32_t hidden = 0;
    double most = -1e300;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      double sum = 0;
      for (const auto c : mesh.triangles[t]) sum += mesh.points[c][1];
      if (sum > most) hidden = t;
      most = std::max(most, sum);
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (t != hidden) out.pvs.push_back(t);
    }
    return out;
  }
  std::string name() const override { return "hides-one-triangle"; }
};

// What the cell's centre sees of every triangle's centroid and three points near its corners.
class FromTheCentre : public Subject {
 public:
  Answer answer(const Case& scene) const override {
    const auto& mesh = scene.mesh;
    Answer out;
    const auto complex = exact::build_complex(mesh);
    const auto hull = exact::ConvexCell::from_doubles(scene.cell);
    const exact::SceneQuery query(complex, hull);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      std::array<exact::Point3, 3> c;
      for (std::size_t i = 0; i < 3; ++i) c[i] = exact::to_exact(mesh.points[mesh.triangles[t][i]]);
      const auto middle = CGAL::centroid(c[0], c[1], c[2]);
      bool seen = exact::meets_cell(c, hull) || query.is_free(hull.center(), middle);
      for (const auto& corner : c) seen = seen || query.is_free(hull.center(), corner + (middle - corner) / 8);
      if (seen) out.pvs.push_back(t);
    }
    return out;
  }
  std::string name() const override { return "from-the-centre"; }
};

// Claims to be exactly Omega, and loses the last triangle of a mesh of few: with vertices more it does not.
class LosesOneOfFew : public Subject {
 public:
  explicit LosesOneOfFew(std::size_t few) : few_(few) {}
  Answer answer(const Case& scene) const override {
    Answer out = make_subject("reference")->answer(scene);
    out.map.reset();
    out.in_doubt.emplace();
    if (!out.pvs.empty() && scene.mesh.triangles.size() <= few_) out.pvs.pop_back();
    return out;
  }
  std::string name() const override { return "loses-one-of-few"; }

 private:
  std::size_t few_;
};

// Claims to be exactly Omega, and is not: one triangle too few, or all of them.
class ClaimsOmega : public Subject {
 public:
  explicit ClaimsOmega(bool all) : all_(all) {}
  Answer answer(const Case& scene) const override {
    Answer out = make_subject("reference")->answer(scene);
    out.map.reset();
    out.in_doubt.emplace();
    if (all_) {
      out.pvs.resize(scene.mesh.triangles.size());
      std::iota(out.pvs.begin(), out.pvs.end(), 0U);
    } else if (!out.pvs.empty()) {
      out.pvs.pop_back();
    }
    return out;
  }
  std::string name() const override { return all_ ? "claims-all" : "claims-too-few"; }

 private:
  bool all_;
};

}  // namespace clues::fuzz
