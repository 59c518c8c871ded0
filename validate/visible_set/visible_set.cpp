// The search: points first, then every edge at which a set of free sight lines can end (docs/visible-set.md).
#include "validate/visible_set/visible_set.h"

#include <algorithm>
#include <utility>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "scene/messages/error.h"
#include "validate/windows/sight_scene.h"

namespace clues::validate {
namespace {

using exact::Point3;
using Proof = TriangleSight::Proof;

class Search {
 public:
  Search(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const VisibleSetOptions& options)
      : mesh_(mesh), cell_(cell), options_(options), scene_(mesh, cell, options.mode == reference::Mode::solid) {}

  VisibleSet run() {
    VisibleSet result;
    std::optional<std::vector<std::uint32_t>> in_omega;
    if (options_.trust_map) {
      reference::Options map_options;
      map_options.mode = options_.mode;
      in_omega = reference::first_order_visibility(mesh_, cell_, map_options).visible;
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!options_.only.empty() && !std::binary_search(options_.only.begin(), options_.only.end(), t)) {
        result.triangles.push_back({Sight::undecided, false, std::nullopt, Proof::none});
        continue;
      }
      const bool may_be_seen = !in_omega || std::binary_search(in_omega->begin(), in_omega->end(), t);
      result.triangles.push_back(decide(t, may_be_seen));
    }
    statistics_.edges = scene_.edge_count();
    result.statistics = statistics_;
    return result;
  }

 private:
  TriangleSight decide(std::uint32_t t, bool may_be_seen) {
    TriangleSight answer;
    if (!scene_.has_surface(t)) {
      answer.sight = Sight::no_surface;
      return answer;
    }
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto corner = [&](std::uint32_t i) { return exact::to_exact(mesh_.points[i]); };
    if (exact::meets_cell({corner(a), corner(b), corner(c)}, cell_)) {
      answer.sight = Sight::visible;
      answer.meets_cell = true;
      answer.proof = Proof::meets_cell;
      return answer;
    }
    windows_ = 0;
    undecided_ = false;
    std::vector<SightQuestion> questions;
    for (const bool front : {true, false}) {
      if (!front && options_.mode == reference::Mode::solid) continue;
      if (auto question = scene_.question(t, front)) questions.push_back(std::move(*question));
    }
    for (const auto& question : questions) {
      if (answer.witness || !may_be_seen || cell_.dimension() > 0) break;
      answer.witness = ask_viewpoint(question);
      statistics_.found_by_point += answer.witness ? 1 : 0;
    }
    for (const bool by_point : {options_.points_first, !options_.points_first}) {
      if (!may_be_seen) break;
      for (const auto& question : questions) {
        if (answer.witness) break;
        answer.witness = by_point ? ask(question, question.samples) : sweep_edges(question);
        auto& found = by_point ? statistics_.found_by_point : statistics_.found_by_edge;
        found += answer.witness ? 1 : 0;
      }
    }
    answer.sight = answer.witness ? Sight::visible : undecided_ ? Sight::undecided : Sight::hidden;
    if (answer.witness) {
      answer.proof = Proof::witness;
    } else if (!undecided_ && !may_be_seen) {
      answer.proof = Proof::first_order_map;
      ++statistics_.hidden_by_map;
    } else if (!undecided_) {
      answer.proof = Proof::exhaustive;
      ++statistics_.hidden_exhaustive;
    }
    return answer;
  }

  std::optional<Witness> confirmed(const SightQuestion& question, const Point3& v, const Point3& p) const {
    if (!exact::check_witness(mesh_, cell_, question.triangle, question.front, v, p).valid) return std::nullopt;
    return Witness{question.triangle, question.front, v, p};
  }

  std::optional<Witness> ask(const SightQuestion& question, const std::vector<Point3>& points) {
    for (const Point3& p : points) {
      ++statistics_.point_questions;
      const auto answer = exact::point_occlusion(p, question.plane, cell_, question.soup);
      if (answer.occluded) continue;
      if (auto found = confirmed(question, *answer.witness, p)) return found;
      throw scene::Error(scene::ErrorCode::internal, "visible_set: a free sight line from a point is refused");
    }
    return std::nullopt;
  }

  // A single point as cell: the same from there, the triangle being what is to be seen. All is decided by
  // that.
  std::optional<Witness> ask_viewpoint(const SightQuestion& question) {
    const Point3& v = cell_.center();
    const auto& triangle = question.target.triangle;
    const exact::ConvexCell seen({to_point(triangle[0]), to_point(triangle[1]), to_point(triangle[2])});
    ++statistics_.point_questions;
    const auto answer = exact::point_occlusion(v, std::nullopt, seen, question.soup);
    if (answer.occluded) return std::nullopt;
    if (auto found = confirmed(question, v, *answer.witness)) return found;
    throw scene::Error(scene::ErrorCode::internal, "visible_set: a free sight line to a viewpoint is refused");
  }

  std::optional<Witness> sweep_edges(const SightQuestion& question) {
    if (cell_.dimension() == 1) {
      const RVector &a = scene_.shape().vertices[0], &b = scene_.shape().vertices[1];
      return sweep(question, {a, minus(b, a), 0, 1, {}}, Passage::on_cell);
    }
    for (const SightEdge& edge : question.edges) {
      if (auto found = sweep(question, edge, Passage::edge)) return found;
    }
    return std::nullopt;
  }

  // Windows along one line until every open range between critical places is decided.
  std::optional<Witness> sweep(const SightQuestion& question, const SightEdge& edge, Passage passage) {
    ++statistics_.edges_swept;
    SightWindow window(scene_.shape(), question.target, edge, passage);
    for (const int wedge : {1, -1}) {
      if (wedge < 0 && passage != Passage::edge) break;
      std::vector<OpenRange> todo;
      Rational from = edge.low;
      if (passage == Passage::on_cell) {
        for (const Rational& stop : scene_.stops()) {
          todo.push_back({to_root(from), to_root(stop)});
          from = stop;
        }
      }
      todo.push_back({to_root(from), to_root(edge.high)});
      while (!todo.empty()) {
        const OpenRange range = std::move(todo.back());
        todo.pop_back();
        if (options_.window_limit > 0 && windows_ >= options_.window_limit) {
          undecided_ = true;
          return std::nullopt;
        }
        ++windows_;
        ++statistics_.windows;
        const Rational s = between(range.low, range.high);
        OpenRange done{to_root(s), to_root(s)};
        switch (window.decide(s, wedge)) {
          case SightWindow::Answer::open:
            return witness_from(question, window.opening(), passage);
          case SightWindow::Answer::covered:
            done = window.planes().valid_range(range);
            break;
          case SightWindow::Answer::on_event:
            break;  // a single place decides nothing: go on beside it
        }
        if (range.low < done.low) todo.push_back({range.low, done.low});
        if (done.high < range.high) todo.push_back({done.high, range.high});
        statistics_.events += (range.low < done.low ? 1 : 0) + (done.high < range.high ? 1 : 0);
      }
    }
    return std::nullopt;
  }

  // Free lines are an open set, so a small enough nudge off the edge leaves one; it is found by halving.
  // Where its ends are touched, which spoils them for a witness (D6), another direction beside is taken, in
  // another place each time.
  std::optional<Witness> witness_from(const SightQuestion& question, const Opening& opening, Passage passage) const {
    const RVector d{opening.d[0], opening.d[1], opening.d[2]};
    Rational size(1, 16);
    const auto longest = [](const RVector& x) {
      Rational most = 0;
      for (const Rational& c : x) most = std::max(most, Rational(abs(c)));
      return most;
    };
    const RVector nudge =
        is_zero(opening.nudge) ? opening.nudge : times(opening.nudge, Rational(1 / longest(opening.nudge)));
    constexpr int most_halvings = 4000;  // far beyond any distance between doubles
    for (int i = 0; i < most_halvings; ++i, size /= 2) {
      const RVector y = sum(opening.y, times(nudge, size));
      const RVector aside{Rational(i % 7 - 3), Rational(i % 11 - 5), Rational(i % 13 - 6)};
      for (const RVector& direction : {d, sum(d, times(aside, Rational(size * longest(d))))}) {
        const auto line = line_through(question, y, direction, passage);
        if (!line) continue;
        if (auto found = confirmed(question, to_point(line->first), to_point(line->second))) return found;
      }
    }
    throw scene::Error(scene::ErrorCode::internal, "visible_set: an open window leads to no free sight line");
  }

  // v and p on the line through y.
  std::optional<std::pair<RVector, RVector>> line_through(const SightQuestion& question, const RVector& y,
                                                          const RVector& d, Passage passage) const {
    if (sgn(dot(question.target.up, d)) == 0) return std::nullopt;
    const auto reach = [&](const RVector& normal, const RVector& at) {
      return Rational(dot(normal, minus(at, y)) / dot(normal, d));
    };
    const auto point = [&](const Rational& s) { return sum(y, times(d, s)); };
    const RVector p = point(reach(question.target.up, question.target.triangle[0]));
    if (passage == Passage::on_cell) return std::pair(y, p);
    const auto& facets = scene_.shape().facets;
    if (cell_.dimension() == 2 && sgn(dot(facets[0].normal, d)) == 0) return std::nullopt;
    if (cell_.dimension() == 2) return std::pair(point(reach(facets[0].normal, facets[0].corners[0])), p);
    std::optional<Rational> enter, leave;
    for (const auto& facet : facets) {
      const int slope = sgn(dot(facet.normal, d));
      if (slope == 0) continue;
      const Rational s = reach(facet.normal, facet.corners[0]);
      if (slope < 0 && (!enter || *enter < s)) enter = s;
      if (slope > 0 && (!leave || s < *leave)) leave = s;
    }
    if (!enter || !leave || !(*enter < *leave)) return std::nullopt;
    return std::pair(point(Rational((*enter + *leave) / 2)), p);
  }

  const scene::TriangleMesh& mesh_;
  const exact::ConvexCell& cell_;
  const VisibleSetOptions& options_;
  SightScene scene_;
  VisibleSetStatistics statistics_;
  std::uint64_t windows_ = 0;
  bool undecided_ = false;
};

}  // namespace

VisibleSet exact_visible_set(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                             const VisibleSetOptions& options) {
  return Search(mesh, cell, options).run();
}

}  // namespace clues::validate
