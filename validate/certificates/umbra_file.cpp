#include "validate/certificates/umbra_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "scene/json_reader.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/ply_text.h"
#include "validate/certificates/words.h"

namespace clues::validate {
namespace {

using nlohmann::json;
using reference::UmbraFacetKind;
using scene::Error;
using scene::ErrorCode;

constexpr const char* format_name = "clues-umbra/1";
constexpr std::array<const char*, 3> kind_names{"surface", "wedge", "bound"};

// The distinct corners in order, and for each facet their numbers.
struct Indexed {
  std::vector<RVector> points;
  std::vector<std::array<std::uint32_t, 3>> corners;
};

Indexed indexed(const UmbraCertificate& facets) {
  std::map<RVector, std::uint32_t> number;
  for (const CertificateFacet& f : facets) {
    for (const RVector& p : f.corners) number.emplace(p, 0);
  }
  Indexed out;
  for (auto& [p, i] : number) {
    i = static_cast<std::uint32_t>(out.points.size());
    out.points.push_back(p);
  }
  for (const CertificateFacet& f : facets) {
    out.corners.push_back({number.at(f.corners[0]), number.at(f.corners[1]), number.at(f.corners[2])});
  }
  return out;
}

json exact_json(const RVector& p) { return {p[0].get_str(), p[1].get_str(), p[2].get_str()}; }

scene::Point rounded(const RVector& p) { return exact::to_double_estimate(to_point(p)); }

class Reader {
 public:
  Reader(const std::filesystem::path& path, std::uint64_t triangles)
      : file_(path.string()), triangles_(triangles), json_(scene::read_json_file(path)) {}

  UmbraRecord read() const {
    if (!json_.is_object() || !json_.contains("format") || !json_["format"].is_string())
      fail("no \"format\"; an umbra has \"format\": \"clues-umbra/1\"");
    if (json_["format"] != format_name) {
      throw Error(ErrorCode::unsupported, file_ + ": the format " + scene::json_excerpt(json_["format"]) +
                                              " is not clues-umbra/1; give the file of `clues map --umbra`");
    }
    const auto scene = json_.find("scene");
    if (scene != json_.end() && scene->is_object() && scene->contains("triangles") &&
        (!(*scene)["triangles"].is_number_unsigned() || (*scene)["triangles"] != triangles_)) {
      fail(fmt::format("the umbra is of a scene of {} triangles, but this one has {}; give the matching scene",
                       scene::json_excerpt((*scene)["triangles"]), triangles_));
    }
    UmbraRecord record;
    record.scene_triangles = triangles_;
    std::vector<RVector> points;
    const json& vertices = list("vertices_exact");
    for (std::size_t i = 0; i < vertices.size(); ++i)
      points.push_back(point(vertices[i], fmt::format("vertices_exact[{}]", i)));
    const json& bounds = list("bounds_exact");
    if (bounds.size() != 2) fail("bounds_exact: must be two points");
    for (std::size_t i = 0; i < 2; ++i) record.bounds[i] = point(bounds[i], "bounds_exact");
    const json& facets = list("facets");
    for (std::size_t i = 0; i < facets.size(); ++i) add_facet(record, facets[i], points, fmt::format("facets[{}]", i));
    return record;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::malformed, file_ + ": " + what); }

  const json& list(const char* key) const {
    const auto at = json_.find(key);
    if (at == json_.end() || !at->is_array()) fail(fmt::format("no list \"{}\"", key));
    return *at;
  }

  RVector point(const json& value, const std::string& where) const {
    if (!value.is_array() || value.size() != 3) fail(where + ": must be three exact numbers");
    RVector p;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!value[i].is_string() || !is_rational(value[i].get_ref<const std::string&>()))
        fail(where + ": must hold exact numbers, \"p/q\" or \"p\"");
      p[i] = Rational(value[i].get_ref<const std::string&>());
      p[i].canonicalize();
    }
    return p;
  }

  std::uint32_t index(const json& value, std::uint64_t below, const std::string& where) const {
    if (!value.is_number_unsigned()) fail(where + ": must be a number from 0 up");
    const auto i = value.get<std::uint64_t>();
    if (i >= below)
      throw Error(ErrorCode::index_out_of_range, fmt::format("{}: {}: {} is not below {}", file_, where, i, below));
    return static_cast<std::uint32_t>(i);
  }

  void add_facet(UmbraRecord& record, const json& value, const std::vector<RVector>& points,
                 const std::string& where) const {
    if (!value.is_object() || !value.contains("kind") || !value.contains("corners"))
      fail(where + ": must have \"kind\" and \"corners\"");
    const json& word = value["kind"];
    const auto kind =
        std::find(kind_names.begin(), kind_names.end(), word.is_string() ? word.get<std::string>() : std::string());
    if (kind == kind_names.end()) fail(where + ": the kind must be \"surface\", \"wedge\" or \"bound\"");
    const json& corners = value["corners"];
    if (!corners.is_array() || corners.size() != 3) fail(where + ": corners must be three numbers of vertices");
    CertificateFacet facet;
    for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = points[index(corners[i], points.size(), where)];
    record.kinds.push_back(static_cast<UmbraFacetKind>(kind - kind_names.begin()));
    if (record.kinds.back() == UmbraFacetKind::surface) {
      if (!value.contains("triangle")) fail(where + ": a surface must name its \"triangle\"");
      facet.triangle = index(value["triangle"], triangles_, where);
    }
    record.facets.push_back(std::move(facet));
  }

  std::string file_;
  std::uint64_t triangles_;
  json json_;
};

}  // namespace

UmbraRecord record_of(const reference::Umbra& umbra) {
  UmbraRecord record;
  record.bounds = {validate::read(umbra.bounds.lo), validate::read(umbra.bounds.hi)};
  for (const reference::UmbraFacet& f : umbra.facets) {
    CertificateFacet facet;
    if (f.kind == UmbraFacetKind::surface) facet.triangle = f.triangle;
    for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = validate::read(f.corners[i]);
    record.facets.push_back(std::move(facet));
    record.kinds.push_back(f.kind);
  }
  return record;
}

Rational enclosed_volume(const UmbraCertificate& facets) {
  Rational six = 0;
  for (const CertificateFacet& f : facets) six += dot(f.corners[0], cross(f.corners[1], f.corners[2]));
  return six / 6;
}

std::string to_json_text(const UmbraRecord& record) {
  const Indexed all = indexed(record.facets);
  json vertices = json::array(), exact = json::array(), facets = json::array();
  for (const RVector& p : all.points) {
    vertices.push_back(rounded(p));
    exact.push_back(exact_json(p));
  }
  for (std::size_t i = 0; i < all.corners.size(); ++i) {
    json facet = {{"kind", kind_names[static_cast<std::size_t>(record.kinds[i])]}, {"corners", all.corners[i]}};
    if (record.facets[i].triangle) facet["triangle"] = *record.facets[i].triangle;
    facets.push_back(std::move(facet));
  }
  const json out = {
      {"format", format_name},
      {"scene", {{"file", record.scene_file}, {"sha256", record.scene_sha256}, {"triangles", record.scene_triangles}}},
      {"cell", {{"vertices", record.cell}}},
      {"bounds_exact", {exact_json(record.bounds[0]), exact_json(record.bounds[1])}},
      {"volume_exact", enclosed_volume(record.facets).get_str()},
      {"vertices", vertices},
      {"vertices_exact", exact},
      {"facets", facets}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

UmbraRecord read_umbra(const std::filesystem::path& path, std::uint64_t triangles) {
  return Reader(path, triangles).read();
}

std::string to_off_text(const UmbraRecord& record) {
  const Indexed all = indexed(record.facets);
  scene::TriangleMesh mesh;
  for (const RVector& p : all.points) mesh.points.push_back(rounded(p));
  mesh.triangles = all.corners;
  return scene::to_off_text(mesh);
}

std::string to_ply_text(const UmbraRecord& record) {
  constexpr std::array<std::array<std::uint32_t, 3>, 3> colours{{{150, 150, 150}, {230, 140, 40}, {90, 140, 210}}};
  const Indexed all = indexed(record.facets);
  scene::PlyText text(all.points.size(), all.corners.size(),
                      {.comment = "grey: surface; orange: wedge; blue: enclosing box", .of_face = scene::ply_colour});
  for (const RVector& p : all.points) text.vertex(rounded(p));
  for (std::size_t i = 0; i < all.corners.size(); ++i) {
    const auto& [red, green, blue] = colours[static_cast<std::size_t>(record.kinds[i])];
    text.face({all.corners[i][0], all.corners[i][1], all.corners[i][2]}, {red, green, blue});
  }
  return text.take();
}

}  // namespace clues::validate
