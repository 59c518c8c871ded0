#include "fuzz/shrinking/finding_folder.h"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "fuzz/findings/files.h"
#include "fuzz/findings/json_fields.h"
#include "fuzz/subjects/subject.h"
#include "scene/files/folder_update.h"
#include "scene/formats/file_bytes.h"
#include "scene/formats/readers.h"
#include "scene/json_reader.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/messages/shell_word.h"
#include "scene/result.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

constexpr const char* format = "clues-finding/2";
constexpr const char* about_file = "finding.json";
// All that we ever write there; finding.json, without which there is no finding, first.
constexpr const char* all_files[] = {
    about_file,    "scene.off",          "cell.obj",          "witness.json",          "picture.svg",
    "command.txt", "original/scene.off", "original/cell.obj", "original/witness.json", "original/picture.svg"};

json witness_json(const Finding& f) {
  json out = json::object();
  if (f.triangle) out["triangle"] = *f.triangle;
  if (f.witness) {
    out["side"] = f.witness->front ? "front" : "back";
    out["v"] = f.witness->v;
    out["p"] = f.witness->p;
  }
  return out;
}

std::string text_of(const json& about) { return dumped(about, 2) + "\n"; }

// finding.json vouches for itself too: "checksum" is the SHA-256 of its text without that line. It tells what was changed, not who wrote it.
std::string sealed(json about) {
  about["checksum"] = scene::sha256_of(text_of(about));
  return text_of(about);
}

void put_case(scene::FolderUpdate& update, const Finding& f, const std::string& folder, json& sums) {
  const auto put = [&](const char* name, const std::string& bytes) {
    update.put(folder + name, bytes);
    sums[name] = scene::sha256_of(bytes);
  };
  put("scene.off", scene::to_off_text(f.where.mesh));
  put("cell.obj", points_as_obj(f.where.cell));
  put("witness.json", witness_json(f).dump(2) + "\n");
  update.put(folder + "picture.svg", picture_of(f));
}

json parsed(const std::string& bytes, const fs::path& file) {
  try {
    json value = scene::parse_json_text(bytes);
    if (value.is_object()) return value;
  } catch (const scene::JsonError&) {
  }
  throw Error(ErrorCode::malformed, file.string() + ": this is not JSON; the finding was changed after it was saved");
}

json about_of(const std::string& bytes, const fs::path& file) {
  json about = parsed(bytes, file);
  const auto version = about.find("format");
  if (version == about.end() || *version != format)
    throw Error(ErrorCode::unsupported,
                file.string() + ": not of the format " + format + "; have the campaign make it anew");
  return about;
}

void require_sealed(json about, const fs::path& file) {
  const auto checksum = about.find("checksum");
  const json said = checksum == about.end() ? json() : *checksum;
  about.erase("checksum");
  if (said != scene::sha256_of(text_of(about)))
    throw Error(ErrorCode::malformed, file.string() + ": was changed after the finding was saved");
}

// Each file is read once: what is used is what was compared.
CaseTexts read_case(const fs::path& folder, const json& sums) {
  const auto read = [&](const char* name) {
    std::string bytes = scene::read_file_bytes(folder / name);
    if (scene::sha256_of(bytes) != sums.at(name).get<std::string>())
      throw Error(ErrorCode::malformed, (folder / name).string() + ": was changed after the finding was saved");
    return bytes;
  };
  return {read("scene.off"), read("cell.obj"), read("witness.json")};
}

void parse_case(Finding& f, const CaseTexts& texts, const fs::path& folder) {
  f.where.mesh = scene::read_off(texts.scene_off, (folder / "scene.off").string());
  f.where.cell = scene::read_obj(texts.cell_obj, (folder / "cell.obj").string()).points;
  const std::string place = (folder / "witness.json").string();
  const json w = parsed(texts.witness_json, place);
  if (w.contains("triangle")) f.triangle = whole_number<std::uint32_t>(w, "triangle");
  if (w.contains("v") || w.contains("p") || w.contains("side")) {
    const std::string side = w.at("side").get<std::string>();
    if (side != "front" && side != "back")
      throw Error(ErrorCode::malformed, place + ": the side is neither \"front\" nor \"back\"; it was changed");
    f.witness = WitnessText{whole_number<std::uint32_t>(w, "triangle"), side == "front", three_texts(w.at("v")),
                            three_texts(w.at("p"))};
  }
  require_whole(f, place);
}

SavedFinding finding_of(const json& about, const CaseTexts& now, const CaseTexts& original, const fs::path& folder) {
  SavedFinding saved;
  const std::string mode = about.at("mode").get<std::string>();
  if (mode != "sheet" && mode != "solid")
    throw Error(ErrorCode::malformed, (folder / about_file).string() + ": the mode is neither sheet nor solid");
  for (Finding* f : {&saved.finding, &saved.original}) {
    about.at("oracle").get_to(f->oracle);
    about.at("verdict").get_to(f->verdict);
    about.at("explanation").get_to(f->explanation);
    about.at("generator").get_to(f->where.generator);
    f->where.seed = whole_number<std::uint64_t>(about, "seed");
    f->where.index = whole_number<std::uint64_t>(about, "index");
    f->where.solid = mode == "solid";
  }
  saved.finding.where.dials = numbers_by_name(about, "dials");
  saved.original.where.dials = numbers_by_name(about, "dials_original");
  if (about.contains("flags")) take_flags(about.at("flags"), saved.finding.where);
  if (about.contains("flags_original")) take_flags(about.at("flags_original"), saved.original.where);
  about.at("subject").get_to(saved.subject);
  about.at("scenes").get_to(saved.scenes);
  saved.steps = whole_number<std::uint64_t>(about, "shrink_steps");
  parse_case(saved.finding, now, folder);
  parse_case(saved.original, original, folder / "original");
  return saved;
}

// Runs `read`; what JSON says of a field becomes an error that names the folder.
template <class Read>
SavedFinding with_place(const fs::path& folder, const Read& read) {
  return reading_fields(read, [&](const std::string& what) {
    return Error(ErrorCode::malformed, folder.string() + ": not the folder of a finding, or changed: " + what);
  });
}

// A name as an argument that is no option.
std::string argument(const std::string& name) { return scene::shell_word(name.starts_with('-') ? "./" + name : name); }

std::string commands(const SavedFinding& saved, const fs::path& folder) {
  const Case& where = saved.finding.where;
  std::string scenes;
  for (const auto& path : saved.scenes) scenes += " --scenes " + argument(path);
  return fmt::format(
      "# verify this finding:\nclues replay {}{}\n# make the original again:\n"
      "clues fuzz --subject {} --seed {} --generator {} --first {} --cases 1{}{}{} --out again\n",
      argument(folder.filename().string()), is_program(saved.subject) ? " --run-subject" : "",
      scene::shell_word(saved.subject), where.seed, scene::shell_word(where.generator), where.index,
      saved.finding.oracle == "subject" ? "" : " --oracle " + scene::shell_word(saved.finding.oracle),
      saved.original.where.dials.empty() ? " --no-dials" : "", scenes);
}

}  // namespace

std::string folder_name(const Finding& finding) {
  std::string name = finding.signature();
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '-';
  }
  return name;
}

bool holds_a_finding(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder, ignored) &&
         (fs::is_regular_file(fs::symlink_status(folder / about_file, ignored)) ||
          fs::is_regular_file(fs::symlink_status(folder / ".clues-pending" / "commit", ignored)));
}

bool is_free_for_a_finding(const fs::path& folder) {
  std::error_code error;
  const auto status = fs::symlink_status(folder, error);
  if (status.type() == fs::file_type::not_found) return true;
  if (!fs::is_directory(status)) return false;
  if (holds_a_finding(folder)) return true;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().starts_with(".clues-")) return false;
  }
  return !error;
}

void save_finding(const SavedFinding& saved, const fs::path& folder) {
  std::error_code error;
  const bool made = fs::create_directory(folder, error);
  const fs::path place = fs::canonical(folder, error);  // a link stays a link
  if (error) throw Error(ErrorCode::file_unwritable, folder.string() + ": cannot make this folder: " + error.message());
  const Finding& f = saved.finding;
  json about{{"format", format},
             {"oracle", f.oracle},
             {"verdict", f.verdict},
             {"explanation", f.explanation},
             {"generator", f.where.generator},
             {"seed", f.where.seed},
             {"index", f.where.index},
             {"mode", f.where.solid ? "solid" : "sheet"},
             {"subject", saved.subject},
             {"scenes", saved.scenes},
             {"shrink_steps", saved.steps},
             {"triangles", f.where.mesh.triangles.size()},
             {"triangles_original", saved.original.where.mesh.triangles.size()}};
  const CaseDials& of_original = saved.original.where.dials;  // shrinking turns some of them back
  if (!f.where.dials.empty()) about["dials"] = f.where.dials;
  if (!of_original.empty()) about["dials_original"] = of_original;
  if (const json flags = flags_json(f.where); !flags.empty()) about["flags"] = flags;
  if (const json flags = flags_json(saved.original.where); !flags.empty()) about["flags_original"] = flags;
  try {
    scene::FolderUpdate update(place, all_files);
    put_case(update, f, "", about["sha256"]);
    put_case(update, saved.original, "original/", about["sha256_original"]);
    update.put("command.txt", commands(saved, place));
    update.put(about_file, sealed(about));
    update.commit();
  } catch (...) {
    if (made) fs::remove(place, error);  // only where it is empty
    throw;
  }
}

SavedFinding load_finding(const fs::path& given) {
  std::error_code error;
  const fs::path folder = fs::canonical(given, error);
  if (error)
    throw Error(ErrorCode::file_not_found,
                given.string() + ": there is no such folder (" + error.message() + "); give the folder of a finding");
  scene::finish_update(folder, all_files);
  const fs::path file = folder / about_file;
  if (!fs::exists(file, error))
    throw Error(ErrorCode::file_not_found, file.string() + ": there is no such file; is this the folder of a finding?");
  const json about = about_of(scene::read_file_bytes(file), file);
  require_sealed(about, file);
  return with_place(folder, [&] {
    const CaseTexts now = read_case(folder, about.at("sha256"));
    return finding_of(about, now, read_case(folder / "original", about.at("sha256_original")), folder);
  });
}

SavedFinding finding_of_texts(const std::string& finding_json, const CaseTexts& now, const CaseTexts& original,
                              const fs::path& place) {
  return with_place(place,
                    [&] { return finding_of(about_of(finding_json, place / about_file), now, original, place); });
}

std::string picture_of(const Finding& finding) {
  const Case& scene = finding.where;
  scene::Point low = scene.cell.front(), high = low;
  for (const auto* points : {&scene.cell, &scene.mesh.points}) {
    for (const scene::Point& p : *points) {
      for (std::size_t i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
  }
  constexpr double size = 640, margin = 20;
  const double extent = std::max(high[0] - low[0], high[1] - low[1]);
  const double scale = extent > 0 ? size / extent : 1;
  const auto at = [&](double x, double y) {
    return fmt::format("{:.2f},{:.2f}", margin + (x - low[0]) * scale, margin + (high[1] - y) * scale);
  };
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      size + 2 * margin);
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const bool meant = finding.triangle == t;
    text += "<polygon points=\"";
    for (const auto c : scene.mesh.triangles[t]) text += at(scene.mesh.points[c][0], scene.mesh.points[c][1]) + " ";
    text += fmt::format("\" fill=\"{}\" fill-opacity=\"0.35\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                        meant ? "#d02020" : "#909090", meant ? "#a00000" : "#404040", meant ? 2.5 : 1);
  }
  for (std::size_t i = 0; i < scene.cell.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      text += fmt::format("<polyline points=\"{} {}\" stroke=\"#1f4fd8\" stroke-width=\"0.7\"/>\n",
                          at(scene.cell[i][0], scene.cell[i][1]), at(scene.cell[j][0], scene.cell[j][1]));
    text +=
        fmt::format("<polyline points=\"{0} {0}\" stroke=\"#1f4fd8\" stroke-width=\"6\" stroke-linecap=\"round\"/>\n",
                    at(scene.cell[i][0], scene.cell[i][1]));
  }
  if (finding.witness) {
    const auto estimate = [](const std::string& fraction) {
      const auto slash = fraction.find('/');
      const double top = std::strtod(fraction.c_str(), nullptr);
      return slash == fraction.npos ? top : top / std::strtod(fraction.c_str() + slash + 1, nullptr);
    };
    const auto &v = finding.witness->v, &p = finding.witness->p;
    text += fmt::format("<polyline points=\"{} {}\" stroke=\"#108030\" stroke-width=\"2\"/>\n",
                        at(estimate(v[0]), estimate(v[1])), at(estimate(p[0]), estimate(p[1])));
  }
  return text + "</svg>\n";
}

}  // namespace clues::fuzz
