// One function per object of the schema.
#include "validate/vectors/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/files/folder_update.h"
#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "validate/certificates/words.h"
#include "validate/vectors/field.h"

namespace clues::validate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

std::vector<std::uint32_t> read_ids(const Field& field, std::uint64_t triangles) {
  std::vector<std::uint32_t> ids;
  for (const auto& item : field.array(0)) {
    ids.push_back(item.index(triangles, "triangles"));
    if (ids.size() > 1 && ids[ids.size() - 2] >= ids.back()) item.fail("the list must ascend");
  }
  return ids;
}

// D22: the ids that lack a flag; a list that is there is not empty.
std::vector<std::uint32_t> read_flag(const Field& scene, const char* name, std::uint64_t triangles) {
  if (!scene.has(name)) return {};
  auto ids = read_ids(scene[name], triangles);
  if (ids.empty()) scene[name].fail("is empty: leave it out");
  return ids;
}

VectorScene read_scene(const Field& field) {
  field.object({"vertices", "triangles"}, {"see_through", "not_counted"});
  VectorScene scene;
  for (const auto& vertex : field["vertices"].array(1)) scene.vertices.push_back(vertex.point());
  for (const auto& triangle : field["triangles"].array(1)) {
    const auto corners = triangle.array(3, 3);
    scene::Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = corners[i].index(scene.vertices.size(), "vertices");
    scene.triangles.push_back(t);
  }
  scene.see_through = read_flag(field, "see_through", scene.triangles.size());
  scene.not_counted = read_flag(field, "not_counted", scene.triangles.size());
  for (const auto t : scene.see_through) {
    if (std::binary_search(scene.not_counted.begin(), scene.not_counted.end(), t))
      field.fail(fmt::format("triangle {} neither blocks nor counts: leave it out of the scene", t));
  }
  return scene;
}

// The flags of n triangles; none when all have it.
std::vector<std::uint8_t> flags_without(const std::vector<std::uint32_t>& ids, std::size_t n) {
  std::vector<std::uint8_t> flags(ids.empty() ? 0 : n, 1);
  for (const auto t : ids) flags[t] = 0;
  return flags;
}

MustBeVisible read_visible(const Field& field, std::uint64_t triangles) {
  MustBeVisible visible;
  visible.meets_cell = field.object({"triangle"}, {"meets_cell", "front", "v", "p"}).has("meets_cell");
  if (visible.meets_cell) {
    field.object({"triangle", "meets_cell"});
    if (!field["meets_cell"].flag()) field["meets_cell"].fail("is true or not there");
  } else {
    field.object({"triangle", "front", "v", "p"});
    visible.front = field["front"].flag();
    visible.v = field["v"].rational_point();
    visible.p = field["p"].rational_point();
  }
  visible.triangle = field["triangle"].index(triangles, "triangles");
  return visible;
}

// `counts` as in VectorCase.
Expectation read_expectation(const Field& field, std::uint64_t triangles, const std::vector<std::uint8_t>& counts) {
  field.object({"must_be_visible", "umbra", "no_surface", "first_order_visible"});
  Expectation expect;
  std::vector<int> said(triangles, 0);
  for (const auto& item : field["must_be_visible"].array(0)) {
    const auto visible = read_visible(item, triangles);
    if (!expect.must_be_visible.empty() && expect.must_be_visible.back().triangle >= visible.triangle)
      item.fail("the list must ascend");
    expect.must_be_visible.push_back(visible);
    ++said[visible.triangle];
  }
  for (const auto& item : field["umbra"].array(0)) {
    item.object({"triangle", "proof"});
    const Umbra umbra{item["triangle"].index(triangles, "triangles"),
                      item["proof"].one_of({"first_order_map", "exhaustive"}) == 0 ? UmbraProof::first_order_map
                                                                                   : UmbraProof::exhaustive};
    if (!expect.umbra.empty() && expect.umbra.back().triangle >= umbra.triangle) item.fail("the list must ascend");
    expect.umbra.push_back(umbra);
    ++said[umbra.triangle];
  }
  expect.no_surface = read_ids(field["no_surface"], triangles);
  for (const std::uint32_t t : expect.no_surface) ++said[t];
  for (std::size_t t = 0; t < said.size(); ++t) {
    if (!counts.empty() && counts[t] == 0) {
      if (said[t] != 0) field.fail(fmt::format("triangle {} does not count, and nothing is said about it", t));
    } else if (said[t] != 1) {
      field.fail(
          fmt::format("triangle {} must be in exactly one of must_be_visible, umbra and no_surface, and is in {}", t,
                      said[t] == 0 ? "none" : "several"));
    }
  }
  expect.first_order_visible = read_ids(field["first_order_visible"], triangles);
  for (const auto t : expect.first_order_visible) {
    if (!counts.empty() && counts[t] == 0)
      field["first_order_visible"].fail(fmt::format("triangle {} does not count", t));
  }
  return expect;
}

VectorCase read_case(const Field& field, Where& where, const VectorFile& file, bool drafts) {
  if (drafts && !field.has("expect")) {
    field.object({"id", "comment", "flags", "level", "scene", "mode", "cell"});
  } else {
    field.object({"id", "comment", "flags", "level", "scene", "mode", "cell", "expect"});
  }
  VectorCase c;
  c.id = field["id"].text(is_slug, "a slug: lower-case words joined by '-'");
  where.case_id = c.id;
  c.topic = file.topic;
  c.comment = field["comment"].text();
  for (const auto& flag : field["flags"].array(1)) {
    c.flags.push_back(flag.text());
    if (!file.notes.contains(c.flags.back()))
      flag.fail(fmt::format("\"{}\" is not explained in notes", c.flags.back()));
    if (std::count(c.flags.begin(), c.flags.end(), c.flags.back()) > 1) flag.fail("is there twice");
  }
  c.level = field["level"].one_of({"core", "full"}) == 0 ? CaseLevel::core : CaseLevel::full;
  c.scene = field["scene"].text();
  const auto scene = file.scenes.find(c.scene);
  if (scene == file.scenes.end()) field["scene"].fail(fmt::format("there is no scene \"{}\"", c.scene));
  c.mesh.points = scene->second.vertices;
  c.mesh.triangles = scene->second.triangles;
  for (std::uint32_t t = 0; t < c.mesh.triangles.size(); ++t) c.mesh.face_of.push_back(t);
  c.blocks = flags_without(scene->second.see_through, c.mesh.triangles.size());
  c.counts = flags_without(scene->second.not_counted, c.mesh.triangles.size());
  c.mode = field["mode"].one_of({"sheet", "solid"}) == 0 ? CaseMode::sheet : CaseMode::solid;
  if (c.mode == CaseMode::solid && !c.is_plain())
    field["mode"].fail("in solid mode every triangle blocks and counts; take another scene");
  for (const auto& corner : field["cell"].array(1)) c.cell.push_back(corner.point());
  if (field.has("expect")) c.expect = read_expectation(field["expect"], c.mesh.triangles.size(), c.counts);
  where.case_id.clear();
  return c;
}

VectorNote read_note(const Field& field) {
  field.object({"bug_type", "description", "effect", "hazards"});
  VectorNote note;
  field["bug_type"].one_of({"EDGE_CASE", "PRECISION", "METHOD", "INPUT", "MODE"});
  note.bug_type = field["bug_type"].text();
  note.description = field["description"].text();
  note.effect = field["effect"].text();
  for (const auto& hazard : field["hazards"].array(0))
    note.hazards.push_back(hazard.text(is_hazard, "a hazard like A-3 or B-7"));
  return note;
}

void require_all_used(const VectorFile& file, const Field& root) {
  for (const auto& [flag, unused] : file.notes) {
    if (std::none_of(file.cases.begin(), file.cases.end(), [&flag = flag](const VectorCase& c) {
          return std::find(c.flags.begin(), c.flags.end(), flag) != c.flags.end();
        })) {
      root["notes"][flag.c_str()].fail("no case has this flag");
    }
  }
  for (const auto& [name, unused] : file.scenes) {
    if (std::none_of(file.cases.begin(), file.cases.end(),
                     [&name = name](const VectorCase& c) { return c.scene == name; })) {
      root["scenes"][name.c_str()].fail("no case uses this scene");
    }
  }
}

}  // namespace

VectorFile parse_vector_file(std::string_view text, const std::string& name, bool drafts) {
  const json value = scene::parse_json(text, name);
  Where where{name, ""};
  const Field root(value, where, "");
  root.object({"format", "topic", "definition", "source", "notes", "scenes", "cases"});
  root["format"].one_of({"clues-vectors/1"});
  VectorFile file;
  file.name = fs::path(name).filename().string();
  file.topic = root["topic"].text(is_slug, "a slug: lower-case words joined by '-'");
  if (file.topic + ".json" != file.name)
    root["topic"].fail("the file must be named after its topic: " + file.topic + ".json");
  file.definition = root["definition"].text(is_definition, "a list of statements like \"D5, D6\"");
  const Field source = root["source"].object({"name", "version", "seed", "confirmed_by"});
  file.source.name = source["name"].text();
  file.source.version = source["version"].text(is_month, "a year and month like 2026-11");
  if (!source["seed"].is_null()) file.source.seed = source["seed"].number();
  file.source.confirmed_by = source["confirmed_by"].text();
  for (const auto& [flag, field] : root["notes"].object({}).members()) {
    if (!is_flag(flag)) field.fail("a flag is CamelCase");
    file.notes.emplace(flag, read_note(field));
  }
  for (const auto& [scene_name, field] : root["scenes"].object({}).members()) {
    if (!is_slug(scene_name)) field.fail("the name of a scene is a slug: lower-case words joined by '-'");
    file.scenes.emplace(scene_name, read_scene(field));
  }
  for (const auto& field : root["cases"].array(1)) {
    field.object({"id"}, {"comment", "flags", "level", "scene", "mode", "cell", "expect"});
    auto c = read_case(field, where, file, drafts);
    if (std::any_of(file.cases.begin(), file.cases.end(), [&](const VectorCase& other) { return other.id == c.id; })) {
      field["id"].fail(fmt::format("\"{}\" is there twice", c.id));
    }
    file.cases.push_back(std::move(c));
  }
  require_all_used(file, root);
  return file;
}

Expectation parse_expectation(std::string_view text, const VectorCase& about) {
  const json value = scene::parse_json(text, "expect");
  const Where where{"expect", ""};
  return read_expectation(Field(value, where, ""), about.mesh.triangles.size(), about.counts);
}

VectorFile read_vector_file(const fs::path& path, bool drafts) {
  return parse_vector_file(scene::read_file_bytes(path), path.string(), drafts);
}

std::vector<fs::path> vector_files(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error(ErrorCode::file_not_found, folder.string() + ": no such folder; name the folder of a suite");
  }
  scene::finish_update(folder, suite_files);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto& path = entry.path();
    if (path.extension() == ".json" && path.filename() != "index.json" && path.filename() != "schema.json")
      files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

VectorIndex read_vector_index(const fs::path& folder) {
  const auto path = folder / "index.json";
  scene::finish_update(folder, suite_files);
  return parse_vector_index(scene::read_file_bytes(path), path.string());
}

VectorIndex parse_vector_index(std::string_view text, const std::string& name) {
  const json value = scene::parse_json(text, name);
  const Where where{name, ""};
  const Field root(value, where, "");
  root.object({"format", "active", "withdrawn", "topics", "cases"});
  root["format"].one_of({"clues-vectors-index/1"});
  VectorIndex index;
  index.active = root["active"].number();
  index.withdrawn = root["withdrawn"].number();
  for (const auto& [topic, count] : root["topics"].object({}).members()) index.topics[topic] = count.number();
  for (const auto& [id, field] : root["cases"].object({}).members()) {
    if (!is_slug(id)) field.fail("an id is a slug: lower-case words joined by '-'");
    field.object({"topic", "status"}, {"reason"});
    IndexEntry entry{field["topic"].text(), field["status"].one_of({"active", "withdrawn"}) == 1, ""};
    if (entry.withdrawn != field.has("reason")) field.fail("a withdrawn case, and no other, has a \"reason\"");
    if (entry.withdrawn) entry.reason = field["reason"].text();
    index.cases.emplace(id, entry);
  }
  return index;
}

std::vector<VectorCase> read_suite(const fs::path& folder) {
  const auto files = vector_files(folder);
  const auto index = read_vector_index(folder);
  std::vector<VectorCase> cases;
  std::set<std::string> ids;
  for (const auto& path : files) {
    for (auto& c : read_vector_file(path).cases) {
      const auto complain = [&](const std::string& what) {
        throw Error(ErrorCode::malformed, fmt::format("{}: case {}: id: {}", path.string(), c.id, what));
      };
      if (!ids.insert(c.id).second) complain("another file has this id too");
      const auto entry = index.cases.find(c.id);
      if (entry == index.cases.end() || entry->second.withdrawn) complain("is not an active case of index.json");
      cases.push_back(std::move(c));
    }
  }
  for (const auto& [id, entry] : index.cases) {
    if (!entry.withdrawn && !ids.contains(id)) {
      throw Error(ErrorCode::malformed,
                  fmt::format("{}: case {}: is active, but no file has it", (folder / "index.json").string(), id));
    }
  }
  return cases;
}

bool matches_glob(std::string_view text, std::string_view glob) {
  constexpr std::size_t kNone = std::string_view::npos;
  std::size_t t = 0, g = 0, star = kNone,
              resume = 0;  // the last star, and where the text after what it stands for begins
  while (t < text.size()) {
    if (g < glob.size() && glob[g] == '*') {
      star = g++;
      resume = t;
    } else if (g < glob.size() && (glob[g] == '?' || glob[g] == text[t])) {
      ++g;
      ++t;
    } else if (star != kNone) {  // an earlier star need never stand for more: let the last one
      g = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return glob.find_first_not_of('*', g) == kNone;
}

}  // namespace clues::validate
