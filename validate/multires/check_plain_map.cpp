// Why a map is proved (the argument of T11 with the input's own triangles as pieces): if each lies in one triangle of the base and turns
// counter-clockwise there, then across an inner edge of the input the two lie on either side, or in the two triangles of the base along
// one of its edges. So where no edge of the input's boundary runs through the inside of the base, every place within a component of the
// base is covered equally often; and that is once if the areas in each triangle sum to 1 of it.
#include "validate/multires/check_plain_map.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "scene/formats/number.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy.h"
#include "validate/multires/level_topology.h"

namespace clues::validate {
namespace {

// Corners of the base with positive weights, ascending.
using ExactCarrier = std::vector<std::pair<std::uint32_t, mpq_class>>;

// What is longer, or has a larger exponent, is refused: its fraction would be too large to compute with.
constexpr std::size_t longest_number = 10'000;
constexpr std::int64_t largest_exponent = 5'000;

// p/q.
std::optional<mpq_class> fraction(const std::string& text) {
  const bool digits =
      std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || c == '/' || c == '-'; });
  mpq_class out;
  if (!digits || out.set_str(text, 10) != 0 || out.get_den() == 0) return std::nullopt;
  out.canonicalize();
  return out;
}

// The texts that parse_number() takes, without its rounding.
std::optional<mpq_class> unrounded(std::string_view text) {
  if (scene::parse_number(text).kind != scene::NumberKind::finite) return std::nullopt;
  const bool negative = text.front() == '-';
  if (negative || text.front() == '+') text.remove_prefix(1);
  const bool hex = text.size() > 1 && (text[1] == 'x' || text[1] == 'X');
  if (hex) text.remove_prefix(2);
  std::int64_t exponent = 0;
  const auto mark = text.find_first_of(hex ? "pP" : "eE");
  if (mark != std::string_view::npos) {
    const auto read = scene::parse_integer(text.substr(mark + 1));
    if (!read || *read > largest_exponent || *read < -largest_exponent) return std::nullopt;
    exponent = *read;
  }
  std::string digits(text.substr(0, mark));
  if (const auto point = digits.find('.'); point != std::string::npos) {
    digits.erase(point, 1);
    exponent -= static_cast<std::int64_t>(digits.size() - point) * (hex ? 4 : 1);
  }
  mpq_class out(mpz_class(digits, hex ? 16 : 10));
  mpz_class scale;
  mpz_ui_pow_ui(scale.get_mpz_t(), hex ? 2 : 10, static_cast<unsigned long>(std::abs(exponent)));
  if (exponent < 0) {
    out /= scale;
  } else {
    out *= scale;
  }
  return negative ? mpq_class(-out) : out;
}

// How large a number is, for a message.
std::string size_text(const mpq_class& x) {
  const double size = std::abs(x.get_d());
  return size > 0 ? fmt::format("{:.3g}", size) : "less than 1e-300";
}

// The edges of one triangle only, and their ends.
struct Boundary {
  std::set<scene::Edge> edges;
  std::set<std::uint32_t> vertices;

  explicit Boundary(const std::vector<scene::Triangle>& triangles) {
    std::map<scene::Edge, int> uses;
    for (const auto& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++uses[scene::edge_of(t[k], t[(k + 1) % 3])];
    }
    for (const auto& [edge, count] : uses) {
      if (count != 1) continue;
      edges.insert(edge);
      vertices.insert(edge.begin(), edge.end());
    }
  }
  // A simplex, by its corners, ascending.
  bool holds(const std::vector<std::uint32_t>& corners) const {
    return corners.size() == 1 ? vertices.count(corners[0]) != 0
                               : corners.size() == 2 && edges.count({corners[0], corners[1]}) != 0;
  }
};

class PlainJudge {
 public:
  PlainJudge(const scene::TriangleMesh& input, const scene::TriangleMesh& base,
             const std::vector<scene::PlainMapLine>& lines, const std::string& file)
      : input_(input),
        base_(base),
        lines_(lines),
        file_(file),
        boundary_(input.triangles),
        base_boundary_(base.triangles) {}

  PlainMapReport run() {
    if (lines_.size() != input_.points.size()) {
      throw scene::Error(scene::ErrorCode::malformed,
                         fmt::format("{}: {} lines, but the input has {} vertices; there must be one for each", file_,
                                     lines_.size(), input_.points.size()));
    }
    report_.vertices = input_.points.size();
    report_.triangles = input_.triangles.size();
    report_.base_triangles = base_.triangles.size();
    check_surfaces();
    for (std::uint32_t v = 0; v < lines_.size(); ++v) images_.push_back(image_of(v));
    check_places();
    check_boundary();
    check_triangles();
    check_areas();
    if (!report_.counts.empty()) {
      report_.verdict = PlainVerdict::refuted;
    } else {
      report_.verdict = report_.spread == 0 ? PlainVerdict::proved : PlainVerdict::undecided;
    }
    return std::move(report_);
  }

 private:
  void find(const std::string& check, const std::string& what) {
    if (++report_.counts[check] <= 20) report_.findings.push_back({check, what});
  }

  void check_surfaces() {
    const auto a = topology_of(input_.triangles, input_.points.size()),
               b = topology_of(base_.triangles, base_.points.size());
    if (!a.defect.empty()) find("E1", "the input: " + a.defect);
    if (!b.defect.empty()) find("E1", "the base: " + b.defect);
    // The map would take it to where a triangle is, or nothing to it.
    for (const std::uint32_t v : vertices_without_triangle(input_.triangles, input_.points.size()))
      find("E1", fmt::format("the input: vertex {} has no triangle", v));
    for (const std::uint32_t v : vertices_without_triangle(base_.triangles, base_.points.size()))
      find("E1", fmt::format("the base: vertex {} has no triangle", v));
    if (a.defect.empty() && b.defect.empty() && (a.euler() != b.euler() || a.boundaries != b.boundaries)) {
      find("E1",
           fmt::format(
               "the input has Euler number {} and {} boundaries, the base {} and {}: no map between them is one to one",
               a.euler(), a.boundaries, b.euler(), b.boundaries));
    }
  }

  mpq_class number(std::uint32_t v, const std::string& text) const {
    std::optional<mpq_class> out;
    if (text.size() <= longest_number) out = text.find('/') == std::string::npos ? unrounded(text) : fraction(text);
    if (!out) {
      throw scene::Error(scene::ErrorCode::malformed,
                         fmt::format("{}: vertex {}: {} is no number, or longer than {} characters, or has an exponent "
                                     "beyond {}",
                                     file_, v, scene::excerpt(text), longest_number, largest_exponent));
    }
    return *out;
  }

  ExactCarrier image_of(std::uint32_t v) {
    const auto& line = lines_[v];
    if (line.triangle >= base_.triangles.size()) {
      find("E4", fmt::format("vertex {}: base triangle {} does not exist; there are {}", v, line.triangle,
                             base_.triangles.size()));
      return {};
    }
    std::array<mpq_class, 3> w{number(v, line.weights[0]), number(v, line.weights[1]), 0};
    w[2] = line.weights[2].empty() ? mpq_class(1 - w[0] - w[1]) : number(v, line.weights[2]);
    const mpq_class sum = w[0] + w[1] + w[2];
    if (sum != 1) {
      find("E4", fmt::format("vertex {}: its coordinates sum to 1 {} {}, not to 1", v, sum > 1 ? "+" : "-",
                             size_text(sum - 1)));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (w[k] < 0) find("E4", fmt::format("vertex {}: coordinate {} is negative (-{})", v, k, size_text(w[k])));
    }
    ExactCarrier out;
    for (std::size_t k = 0; k < 3; ++k) {
      // With a sum that is off by a little, what is judged is the point that must have been meant.
      if (w[k] > 0 && sum > 0) out.emplace_back(base_.triangles[line.triangle][k], mpq_class(w[k] / sum));
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  void check_places() {
    std::map<ExactCarrier, std::uint32_t> places;
    for (std::uint32_t v = 0; v < images_.size(); ++v) {
      if (images_[v].empty()) continue;
      const auto [place, fresh] = places.emplace(images_[v], v);
      if (!fresh) find("E6", fmt::format("vertices {} and {} have the same image", place->second, v));
    }
  }

  // A one-to-one map takes the boundary to the boundary, and nothing else.
  void check_boundary() {
    for (std::uint32_t v = 0; v < images_.size(); ++v) {
      if (images_[v].empty()) continue;
      const bool on_input = boundary_.holds({v}), on_base = base_boundary_.holds(corners_of({v}));
      if (on_input && !on_base) find("E6", fmt::format("vertex {} of the boundary is mapped to the inside", v));
      if (!on_input && on_base) find("E6", fmt::format("the inner vertex {} is mapped to the boundary", v));
    }
  }

  void check_triangles() {
    std::map<scene::Triangle, std::optional<std::uint32_t>> base;
    for (std::uint32_t t = 0; t < base_.triangles.size(); ++t) {
      auto corners = base_.triangles[t];
      std::sort(corners.begin(), corners.end());
      const auto [place, fresh] = base.try_emplace(corners, t);
      if (!fresh) place->second.reset();  // on which of the two sides of a cushion something lies, corners do not tell
    }
    covered_.resize(base_.triangles.size());
    for (std::uint32_t i = 0; i < input_.triangles.size(); ++i) {
      const auto& t = input_.triangles[i];
      if (images_[t[0]].empty() || images_[t[1]].empty() || images_[t[2]].empty()) continue;
      const auto corners = corners_of({t[0], t[1], t[2]});
      if (corners.size() < 3) {
        find("E6", fmt::format("triangle {} is mapped to an edge or a vertex", i));
        continue;
      }
      const auto on = corners.size() == 3 ? base.find({corners[0], corners[1], corners[2]}) : base.end();
      if (on == base.end() || !on->second) {
        ++report_.spread;
        continue;
      }
      ++report_.judged;
      const mpq_class part = part_of(base_.triangles[*on->second], t);
      if (part <= 0) {
        ++report_.flipped;
        find("E6", fmt::format("triangle {} is flipped or flat on base triangle {}", i, *on->second));
      }
      covered_[*on->second] += part;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = scene::edge_of(t[k], t[(k + 1) % 3]);
        if (boundary_.holds({a, b}) && !base_boundary_.holds(corners_of({a, b}))) {
          find("E6", fmt::format("the boundary from vertex {} to vertex {} runs through the inside of base triangle {}",
                                 a, b, *on->second));
        }
      }
    }
  }

  void check_areas() {
    for (std::size_t t = 0; t < covered_.size(); ++t) {
      if (covered_[t] > 1 || (report_.spread == 0 && covered_[t] != 1)) {
        find("E6", fmt::format("base triangle {}: what lies in it has {:.17g} of its area", t, covered_[t].get_d()));
      }
    }
  }

  // Of the simplex of the base that carries the images.
  std::vector<std::uint32_t> corners_of(std::initializer_list<std::uint32_t> vertices) const {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t v : vertices) {
      for (const auto& [corner, weight] : images_[v]) out.push_back(corner);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  // The area of a triangle's image as a part of the base triangle in which it lies; below 0 if it is flipped.
  mpq_class part_of(const scene::Triangle& base, const scene::Triangle& input) const {
    std::array<mpq_class, 3> u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const auto& [corner, weight] : images_[input[k]]) {
        if (corner == base[1]) u[k] = weight;
        if (corner == base[2]) v[k] = weight;
      }
    }
    return (u[1] - u[0]) * (v[2] - v[0]) - (v[1] - v[0]) * (u[2] - u[0]);
  }

  const scene::TriangleMesh &input_, &base_;
  const std::vector<scene::PlainMapLine>& lines_;
  const std::string& file_;
  const Boundary boundary_, base_boundary_;
  std::vector<ExactCarrier> images_;
  std::vector<mpq_class> covered_;  // by base triangle, as a part of it
  PlainMapReport report_;
};

constexpr std::array<const char*, 3> verdicts{"proved", "refuted", "undecided"};

}  // namespace

PlainMapReport check_plain_map(const scene::TriangleMesh& input, const scene::TriangleMesh& base,
                               const std::vector<scene::PlainMapLine>& lines, const std::string& file) {
  return PlainJudge(input, base, lines, file).run();
}

std::string to_text(const PlainMapReport& r) {
  std::string out = fmt::format("{} vertices and {} triangles on {}\n", r.vertices, r.triangles, r.base_triangles);
  out += fmt::format("in one base triangle: {} triangles, {} of them flipped; over several: {}\n", r.judged, r.flipped,
                     r.spread);
  for (const auto& f : r.findings) out += fmt::format("{} {}\n", f.check, f.what);
  for (const auto& [check, count] : r.counts) {
    if (count > 20) out += fmt::format("{}: {} findings, 20 are listed\n", check, count);
  }
  switch (r.verdict) {
    case PlainVerdict::proved:
      return out + "proved: one to one, linear on every triangle\n";
    case PlainVerdict::refuted:
      return out + "refuted: no bijection, or not as it is written\n";
    case PlainVerdict::undecided:
      break;
  }
  return out +
         "undecided: nothing is wrong, and how the triangles over several base triangles run is not in the file\n";
}

std::string to_json_text(const PlainMapReport& r) {
  nlohmann::json findings = nlohmann::json::array();
  for (const auto& f : r.findings) findings.push_back({{"check", f.check}, {"what", f.what}});
  const nlohmann::json out{{"format", "clues-plain-map-verdict/1"},
                           {"verdict", verdicts[static_cast<std::size_t>(r.verdict)]},
                           {"counts", r.counts},
                           {"findings", findings},
                           {"vertices", r.vertices},
                           {"triangles", r.triangles},
                           {"base_triangles", r.base_triangles},
                           {"judged", r.judged},
                           {"flipped", r.flipped},
                           {"spread", r.spread}};
  return out.dump(1) + "\n";
}

}  // namespace clues::validate
