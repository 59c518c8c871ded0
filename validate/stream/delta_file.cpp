#include "validate/stream/delta_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "reference/delta/sewn_mesh.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "validate/certificates/words.h"

namespace clues::validate {
namespace {

using nlohmann::json;
using reference::SeenFrom;
using scene::Error;
using scene::ErrorCode;

constexpr const char* delta_format = "clues-delta/1";
constexpr std::array<const char*, 4> seen_names{"neither", "from", "to", "both"};

json exact_texts(const RVector& p) { return {p[0].get_str(), p[1].get_str(), p[2].get_str()}; }

json json_of(const DeltaEnd& end) { return {{"cell", {{"vertices", end.cell}}}, {"visible", end.visible}}; }

// Fields of one file, with its name in every message.
class Fields {
 public:
  Fields(const std::filesystem::path& path, std::uint64_t triangles)
      : file_(path.string()), triangles_(triangles), json_(scene::read_json_file(path)) {
    if (!json_.is_object()) fail("is no JSON object");
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::malformed, file_ + ": " + what); }
  [[noreturn]] void refuse(const std::string& what) const { throw Error(ErrorCode::unsupported, file_ + ": " + what); }

  const json& root() const { return json_; }

  const json& at(const json& object, const char* key) const {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end()) fail(fmt::format("no field \"{}\"", key));
    return *found;
  }
  const json& list(const json& object, const char* key) const {
    const json& value = at(object, key);
    if (!value.is_array()) fail(fmt::format("\"{}\" must be a list", key));
    return value;
  }
  std::string text(const json& object, const char* key) const {
    const json& value = at(object, key);
    if (!value.is_string()) fail(fmt::format("\"{}\" must be a text", key));
    return value.get<std::string>();
  }
  std::uint64_t number(const json& value, std::uint64_t below, const std::string& where) const {
    if (!value.is_number_unsigned()) fail(where + ": must be a number from 0 up");
    const auto i = value.get<std::uint64_t>();
    if (i >= below)
      throw Error(ErrorCode::index_out_of_range, fmt::format("{}: {}: {} is not below {}", file_, where, i, below));
    return i;
  }
  std::uint32_t triangle(const json& value, const std::string& where) const {
    return static_cast<std::uint32_t>(number(value, triangles_, where));
  }
  bool front(const json& object) const {
    const std::string side = text(object, "side");
    if (side != "front" && side != "back") fail("\"side\" must be \"front\" or \"back\"");
    return side == "front";
  }
  // Sorted, each once.
  std::vector<std::uint32_t> ids(const json& object, const char* key) const {
    std::vector<std::uint32_t> out;
    for (const json& value : list(object, key)) out.push_back(triangle(value, key));
    if (std::adjacent_find(out.begin(), out.end(), std::greater_equal<>()) != out.end())
      fail(fmt::format("\"{}\" must ascend, without doubles", key));
    return out;
  }
  RVector point(const json& value, const std::string& where) const {
    if (!value.is_array() || value.size() != 3) fail(where + ": must be three exact numbers");
    RVector p;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string* word = value[i].get_ptr<const std::string*>();
      if (word == nullptr || !is_rational(*word)) fail(where + ": must hold exact numbers, \"p/q\" or \"p\"");
      p[i] = Rational(*word);
      p[i].canonicalize();
    }
    return p;
  }
  std::vector<scene::Point> doubles(const json& object, const std::string& what) const {
    std::vector<scene::Point> out;
    for (const json& value : list(object, "vertices")) {
      if (!value.is_array() || value.size() != 3 ||
          !std::all_of(value.begin(), value.end(), [](const json& x) { return x.is_number(); }))
        fail(what + ": \"vertices\" must be lists of three numbers");
      out.push_back(value.get<scene::Point>());
    }
    return out;
  }
  std::vector<scene::Point> cell(const json& object) const { return doubles(at(object, "cell"), "\"cell\""); }
  // {"file", "sha256", "triangles"}; returns the hash.
  std::string scene_hash() const {
    const json& scene = at(json_, "scene");
    const json& count = at(scene, "triangles");
    if (!count.is_number_unsigned() || count != triangles_) {
      fail(fmt::format("is of a scene of {} triangles, but this one has {}; give the matching scene",
                       scene::json_excerpt(count), triangles_));
    }
    return text(scene, "sha256");
  }

 private:
  std::string file_;
  std::uint64_t triangles_;
  json json_;
};

SeenFrom seen_of(const Fields& fields, const json& object) {
  const std::string word = fields.text(object, "seen");
  const auto at = std::find(seen_names.begin(), seen_names.end(), word);
  if (at == seen_names.end()) fields.fail("\"seen\" must be \"neither\", \"from\", \"to\" or \"both\"");
  return static_cast<SeenFrom>(at - seen_names.begin());
}

}  // namespace

const char* name_of(SeenFrom seen) { return seen_names[static_cast<std::size_t>(seen)]; }

DeltaRecord record_of(const reference::Delta& delta, bool with_fragments) {
  DeltaRecord record;
  record.scene_triangles = delta.input_triangles;
  record.from.visible = delta.visible_from;
  record.to.visible = delta.visible_to;
  record.plus = delta.packets.plus;
  record.minus = delta.packets.minus;
  record.has_fragments = with_fragments;
  if (!with_fragments) return record;
  std::vector<reference::Rings3> rings;
  for (const reference::UnifiedRegion& r : delta.regions) rings.push_back(r.rings);
  const reference::SewnMesh mesh = reference::sew(rings);
  std::vector<RVector> points;
  for (const exact::Point3& p : mesh.points) points.push_back(validate::read(p));
  for (const auto& t : mesh.triangles) {
    const reference::UnifiedRegion& r = delta.regions[t.region];
    record.fragments.push_back(
        {{points[t.corners[0]], points[t.corners[1]], points[t.corners[2]]}, r.side.triangle, r.side.front, r.seen});
  }
  return record;
}

std::string to_json_text(const DeltaRecord& record) {
  json out = {
      {"format", delta_format},
      {"scene", {{"file", record.scene_file}, {"sha256", record.scene_sha256}, {"triangles", record.scene_triangles}}},
      {"mode", record.mode},
      {"from", json_of(record.from)},
      {"to", json_of(record.to)},
      {"packets", {{"plus", record.plus}, {"minus", record.minus}}}};
  if (record.has_fragments) {
    std::map<RVector, std::uint64_t> number;
    for (const DeltaFragment& f : record.fragments) {
      for (const RVector& p : f.corners) number.emplace(p, 0);
    }
    json exact = json::array(), vertices = json::array(), triangles = json::array();
    for (auto& [p, i] : number) {
      i = exact.size();
      exact.push_back(exact_texts(p));
      vertices.push_back(exact::to_double_estimate(to_point(p)));
    }
    for (const DeltaFragment& f : record.fragments) {
      triangles.push_back({{"corners", {number.at(f.corners[0]), number.at(f.corners[1]), number.at(f.corners[2])}},
                           {"triangle", f.triangle},
                           {"side", f.front ? "front" : "back"},
                           {"seen", name_of(f.seen)}});
    }
    out["fragments"] = {
        {"vertices_exact", std::move(exact)}, {"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
  }
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

DeltaRecord read_delta(const std::filesystem::path& path, std::uint64_t triangles) {
  const Fields fields(path, triangles);
  const json& root = fields.root();
  if (root.value("format", json()) != delta_format)
    fields.refuse("is no transition, which has \"format\": \"clues-delta/1\"; give the file of `clues delta`");
  DeltaRecord record;
  record.scene_sha256 = fields.scene_hash();
  record.scene_triangles = triangles;
  record.mode = fields.text(root, "mode");
  for (const auto& [key, end] : {std::pair("from", &record.from), std::pair("to", &record.to)}) {
    end->cell = fields.cell(fields.at(root, key));
    end->visible = fields.ids(fields.at(root, key), "visible");
  }
  record.plus = fields.ids(fields.at(root, "packets"), "plus");
  record.minus = fields.ids(fields.at(root, "packets"), "minus");
  record.has_fragments = root.contains("fragments");
  if (!record.has_fragments) return record;
  for (const json& value : fields.list(root["fragments"], "vertices_exact"))
    record.vertices.push_back({fields.point(value, fmt::format("vertices_exact[{}]", record.vertices.size())), {}});
  const auto rounded = fields.doubles(root["fragments"], "\"fragments\"");
  if (rounded.size() != record.vertices.size()) {
    fields.fail(
        fmt::format("\"vertices\" has {} points, and \"vertices_exact\" {}", rounded.size(), record.vertices.size()));
  }
  for (std::size_t i = 0; i < rounded.size(); ++i) record.vertices[i].rounded = rounded[i];
  for (const json& value : fields.list(root["fragments"], "triangles")) {
    const std::string where = fmt::format("fragments: triangles[{}]", record.fragments.size());
    DeltaFragment fragment;
    const json& corners = fields.list(value, "corners");
    if (corners.size() != 3) fields.fail(where + ": corners must be three numbers of vertices");
    for (std::size_t i = 0; i < 3; ++i)
      fragment.corners[i] = record.vertices[fields.number(corners[i], record.vertices.size(), where)].exact;
    fragment.triangle = fields.triangle(fields.at(value, "triangle"), where);
    fragment.front = fields.front(value);
    fragment.seen = seen_of(fields, value);
    record.fragments.push_back(std::move(fragment));
  }
  return record;
}

MapFile read_map_file(const std::filesystem::path& path, std::uint64_t triangles) {
  const Fields fields(path, triangles);
  const json& root = fields.root();
  if (root.value("format", json()) != "clues-result/1" || !root.contains("regions"))
    fields.refuse("is no map; give a file of `clues map --map`");
  MapFile map;
  map.scene_sha256 = fields.scene_hash();
  map.mode = fields.text(root, "mode");
  map.cell = fields.cell(root);
  map.visible = fields.ids(root, "visible");
  for (const json& value : fields.list(root, "regions")) {
    const json& visible = fields.at(value, "visible");
    if (!visible.is_boolean()) fields.fail("\"visible\" of a region must be true or false");
    if (!visible.get<bool>()) continue;
    if (!value.contains("rings_exact"))
      fields.refuse("the map has no exact regions; give one of `clues map --map --kernel exact`");
    MapFileRegion region;
    region.triangle = fields.triangle(fields.at(value, "triangle"), "regions");
    region.front = fields.front(value);
    for (const json& ring : fields.list(value, "rings_exact")) {
      if (!ring.is_array()) fields.fail("\"rings_exact\" must hold lists of points");
      region.rings.emplace_back();
      for (const json& p : ring) region.rings.back().push_back(fields.point(p, "rings_exact"));
    }
    map.regions.push_back(std::move(region));
  }
  return map;
}

}  // namespace clues::validate
