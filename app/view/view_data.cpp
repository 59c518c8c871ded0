#include "app/view/view_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "app/view/page_data.h"
#include "app/view/page_json.h"
#include "app/view/page_stores.h"
#include "fuzz/findings/json_fields.h"
#include "fuzz/report/html_report.h"
#include "fuzz/shrinking/finding_folder.h"
#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy_file.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "validate/certificates/umbra_file.h"
#include "validate/stream/delta_file.h"
#include "validate/vectors/reader.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

struct KnownScene {
  std::string name, sha256;
  std::uint64_t triangles = 0;
};

// What a file says about its scene; the hash may be missing.
struct Named {
  std::string file, sha256;
};

std::string text_of(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

enum class Content : std::uint8_t { scene, finding, bake, walk, maps, document };

// By how the file begins. What is no regular file is for the readers of scenes to refuse: nobody waits for a pipe.
Content content_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return Content::scene;
  constexpr std::size_t enough = 200;
  std::string begin(enough, '\0');
  std::ifstream input(file, std::ios::binary);
  input.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (input.bad()) throw Error(ErrorCode::file_unreadable, file.string() + ": cannot be read; check the file");
  begin.resize(static_cast<std::size_t>(input.gcount()));
  if (begin.starts_with("SQLite format 3")) return Content::bake;
  if (scene::is_hierarchy_text(begin)) return Content::maps;
  if (begin.substr(0, begin.find('\n')).find("\"clues-motion-walk/") != std::string::npos) return Content::walk;
  const auto first = begin.find_first_not_of(" \t\r\n");
  const bool is_object = first != std::string::npos && begin[first] == '{' && file.extension() != ".gltf";
  return is_object || file.extension() == ".json" ? Content::document : Content::scene;
}

// The folder itself, or those of a campaign, by name.
std::vector<fs::path> findings_in(const fs::path& folder) {
  if (fuzz::holds_a_finding(folder)) return {folder};
  std::vector<fs::path> findings;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && fuzz::holds_a_finding(entry.path())) findings.push_back(entry.path());
  if (findings.empty())
    throw Error(ErrorCode::unsupported, folder.string() + ": is a folder without findings; name the files in it");
  std::sort(findings.begin(), findings.end());
  return findings;
}

}  // namespace

struct ViewData::Parts {
  fs::path root;
  std::vector<KnownScene> scenes;
  std::set<fs::path> read;  // scenes, by canonical path
  PageData page;

  std::string name_of(const fs::path& file) const {
    return root.empty() ? file.filename().string() : file.lexically_relative(root).string();
  }
  std::size_t read_scene(const fs::path& file) {
    read.insert(fs::weakly_canonical(file));
    const scene::FlaggedMesh mesh = scene::read_scene(file);
    const std::string name = file.filename().string(), sha256 = scene::sha256_of_scene(file);
    page.put({{"path", name}, {"sha256", sha256}, {"mesh", mesh_for_page(mesh)}});
    scenes.push_back({name, sha256, mesh.mesh.triangles.size()});
    return scenes.size() - 1;
  }
  // Of a scene that is named without its hash: that of the file, where all files are looked for.
  std::string hash_of(const std::string& file) const {
    std::error_code error;
    return !root.empty() && fs::is_regular_file(file, error) ? scene::sha256_of_scene(file) : "";
  }
  // One that was given, by its hash or else its name; or the file itself, where it is named or beside.
  const KnownScene& scene_of(const Named& named, const fs::path& about) {
    const std::string name = fs::path(named.file).filename().string();
    if (name.empty())
      throw Error(ErrorCode::malformed, about.string() + ": does not say which scene it is about; write it again");
    for (const KnownScene& s : scenes)
      if (!named.sha256.empty() && s.sha256 == named.sha256) return s;
    for (const KnownScene& s : scenes) {
      if (s.name != name) continue;
      if (!root.empty()) continue;  // many files about many scenes: a name says nothing
      if (named.sha256.empty()) return s;
      throw Error(ErrorCode::malformed,
                  about.string() + ": is about another version of " + name + " (the SHA-256 of the file differs)");
    }
    for (const fs::path& place : {about.parent_path() / name, fs::path(named.file)}) {
      std::error_code error;
      if (!fs::is_regular_file(place, error)) continue;
      if (!named.sha256.empty() && scene::sha256_of_scene(place) != named.sha256) continue;
      return scenes[read_scene(place)];
    }
    throw Error(ErrorCode::file_not_found,
                fmt::format("{}: is about the scene {}, which is not beside it{}; name that file too", about.string(),
                            name, named.sha256.empty() ? "" : " in the same version"));
  }
  void put(const fs::path& file, json value) { page.put({{"path", name_of(file)}, {"json", std::move(value)}}); }

  void add_bake(const fs::path& file);
  void add_walk(const fs::path& file);
  void add_maps(const fs::path& file);
  void add_json(const fs::path& file);
  void add_finding(const fs::path& folder);
  void add_conformance(const fs::path& file, json report);
};

// From what was compared with its hashes, and not from the files once more.
void ViewData::Parts::add_finding(const fs::path& folder) {
  const auto saved = fuzz::load_finding(folder);
  const fs::path known = root.empty() ? fs::weakly_canonical(folder).filename() : folder.lexically_relative(root);
  const std::string base = known == "." ? "" : known.string() + "/";
  const auto& about = saved.finding;
  page.put({{"path", base + "finding.json"},
            {"json",
             {{"format", "clues-finding/2"},
              {"oracle", about.oracle},
              {"verdict", about.verdict},
              {"explanation", about.explanation},
              {"subject", saved.subject},
              {"mode", about.where.solid ? "solid" : "sheet"}}}});
  for (const auto& [finding, place] :
       {std::pair{&saved.finding, std::string()}, {&saved.original, std::string("original/")}}) {
    scene::TriangleMesh cell;
    cell.points = finding->where.cell;
    json witness = json::object();
    if (finding->triangle) witness["triangle"] = *finding->triangle;
    if (finding->witness) {
      witness["side"] = finding->witness->front ? "front" : "back";
      witness["v"] = finding->witness->v;
      witness["p"] = finding->witness->p;
    }
    page.put({{"path", base + place + "scene.off"}, {"mesh", mesh_for_page(finding->where.mesh)}});
    page.put({{"path", base + place + "cell.obj"}, {"mesh", mesh_for_page(cell)}});
    page.put({{"path", base + place + "witness.json"}, {"json", std::move(witness)}});
  }
}

// The scenes of cases that miss something, as far as the suite can be read.
void ViewData::Parts::add_conformance(const fs::path& file, json report) {
  std::set<std::string> wanted;
  for (const json& c : report.at("cases"))
    if (c.contains("missed") && !c.at("missed").empty()) wanted.insert(c.at("id").get<std::string>());
  json shown = json::object();
  try {
    if (!wanted.empty()) {
      for (const auto& c : validate::read_suite(text_of(report, "suite"))) {
        if (!wanted.contains(c.id)) continue;
        shown[c.id] = mesh_for_page(c.mesh);
        shown[c.id]["cell"] = c.cell;
      }
    }
  } catch (const Error& problem) {
    if (problem.code() == ErrorCode::file_unreadable) throw;
    shown = json::object();  // then the page has the table alone, and says so
  }
  report["scenes"] = std::move(shown);
  put(file, std::move(report));
}

void ViewData::Parts::add_bake(const fs::path& file) {
  const scene::FinishedBake bake(file);
  const scene::BakePlan& plan = bake.plan();
  const KnownScene& scene = scene_of({plan.scene_file, plan.scene_sha256}, file);
  if (plan.triangles != scene.triangles) {
    throw Error(ErrorCode::malformed, fmt::format("{}: is about {} triangles, and {} has {}", file.string(),
                                                  plan.triangles, scene.name, scene.triangles));
  }
  put(file, bake_for_page(bake));
}

// Both are texts that the page reads as they are.
void ViewData::Parts::add_walk(const fs::path& file) {
  json bounds = walk_for_page(file);
  page.put({{"path", file.filename().string()}, {"text", scene::read_file_bytes(file)}, {"bounds", std::move(bounds)}});
}

void ViewData::Parts::add_maps(const fs::path& file) {
  std::string text = scene::read_file_bytes(file);
  scene::parse_hierarchy(text, file.string());
  page.put({{"path", file.filename().string()}, {"text", std::move(text)}});
}

void ViewData::Parts::add_json(const fs::path& file) {
  const std::string bytes = scene::read_file_bytes(file);
  json value = scene::parse_json(bytes, file.string());
  const std::string format = text_of(value, "format");
  const auto add = [&] {
    if (format == "clues-result/1") {
      const json about = value.value("scene", json::object());
      const auto& scene = scene_of({text_of(about, "file"), text_of(about, "sha256")}, file);
      scene::parse_result_pvs(bytes, file.string(), {scene.triangles, scene.sha256, "", {}});
      put(file, result_for_page(value, scene.triangles, file.string()));
    } else if (format == "clues-umbra/1") {
      const json about = value.value("scene", json::object());
      const auto& scene = scene_of({text_of(about, "file"), text_of(about, "sha256")}, file);
      validate::read_umbra(file, scene.triangles);
      value.erase("vertices");
      put(file, std::move(value));
    } else if (format == "clues-delta/1") {
      const json about = value.value("scene", json::object());
      const auto& scene = scene_of({text_of(about, "file"), text_of(about, "sha256")}, file);
      validate::read_delta(file, scene.triangles);
      if (value.contains("fragments")) value["fragments"].erase("vertices_exact");
      put(file, std::move(value));
    } else if (format == "clues-judgement/1") {
      fuzz::section_of(bytes, file, false);
      const std::string named = text_of(value, "scene");
      const auto& scene = scene_of({named, hash_of(named)}, file);
      if (value.at("triangles").size() != scene.triangles) {
        throw Error(ErrorCode::malformed, fmt::format("{}: is about {} triangles, and {} has {}", file.string(),
                                                      value.at("triangles").size(), scene.name, scene.triangles));
      }
      value["scene_sha256"] = scene.sha256;
      put(file, std::move(value));
    } else if (format == "clues-conformance/1") {
      fuzz::section_of(bytes, file, false);
      add_conformance(file, std::move(value));
    } else if (format.starts_with("clues-finding/")) {
      add_finding(file.has_parent_path() ? file.parent_path() : fs::path("."));
    } else {
      throw Error(ErrorCode::unsupported,
                  file.string() +
                      ": is none of the files that can be viewed: results, bakes, deltas, walks, "
                      "hierarchies, judgements, umbrae, conformance reports, findings and "
                      "scenes");
    }
  };
  fuzz::reading_fields(add, [&](const std::string& what) {
    return Error(ErrorCode::malformed, file.string() + ": is not complete (" + what + "); make it anew");
  });
}

ViewData::ViewData(fs::path root) : parts_(std::make_unique<Parts>()) { parts_->root = std::move(root); }
ViewData::~ViewData() = default;
ViewData::ViewData(ViewData&&) noexcept = default;
ViewData& ViewData::operator=(ViewData&&) noexcept = default;

void ViewData::add_files(const std::vector<fs::path>& files) {
  struct Other {
    fs::path file;
    Content content;
  };
  std::vector<Other> others;
  for (const fs::path& file : files) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
      for (const fs::path& finding : findings_in(file)) others.push_back({finding, Content::finding});
    } else if (const Content content = content_of(file); content != Content::scene) {
      others.push_back({file, content});
    } else if (!parts_->read.contains(fs::weakly_canonical(file))) {
      parts_->read_scene(file);
    }
  }
  for (const auto& [file, content] : others) {
    if (content == Content::finding) parts_->add_finding(file);
    if (content == Content::bake) parts_->add_bake(file);
    if (content == Content::walk) parts_->add_walk(file);
    if (content == Content::maps) parts_->add_maps(file);
    if (content == Content::document) parts_->add_json(file);
  }
}

std::size_t ViewData::count() const { return parts_->page.count(); }

std::string ViewData::text() const { return parts_->page.text(); }

}  // namespace clues::app
