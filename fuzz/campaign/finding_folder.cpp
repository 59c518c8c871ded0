#include "fuzz/campaign/finding_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "fuzz/campaign/files.h"
#include "scene/atomic_file.h"
#include "scene/cell_spec.h"
#include "scene/error.h"
#include "scene/json_reader.h"
#include "scene/mesh_io.h"
#include "scene/result.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

constexpr const char* format = "clues-finding/1";
constexpr const char* proof_files[] = {"scene.off", "cell.obj", "witness.json"};

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

// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

void write_case(const Finding& f, const fs::path& folder, json& sums) {
  fs::create_directory(folder);
  scene::write_file_atomically(folder / "scene.off", scene::to_off_text(f.where.mesh));
  scene::write_file_atomically(folder / "cell.obj", points_as_obj(f.where.cell));
  scene::write_file_atomically(folder / "witness.json", witness_json(f).dump(2) + "\n");
  scene::write_file_atomically(folder / "picture.svg", picture_of(f));
  for (const char* name : proof_files) sums[name] = scene::sha256_of_file(folder / name);
}

void read_case(Finding& f, const fs::path& folder, const json& sums) {
  for (const char* name : proof_files) {
    if (scene::sha256_of_file(folder / name) != sums.at(name).get<std::string>()) {
      throw Error(ErrorCode::malformed, (folder / name).string() + ": was changed after the finding was saved");
    }
  }
  f.where.mesh = scene::read_mesh(folder / "scene.off");
  f.where.cell = scene::parse_cell((folder / "cell.obj").string()).points;
  const json w = scene::read_json_file(folder / "witness.json");
  if (w.contains("triangle")) f.triangle = w.at("triangle").get<std::uint32_t>();
  if (w.contains("v")) {
    f.witness = WitnessText{f.triangle.value(), w.at("side") == "front", w.at("v").get<std::array<std::string, 3>>(),
                            w.at("p").get<std::array<std::string, 3>>()};
  }
}

}  // namespace

std::string folder_name(const Finding& finding) {
  std::string name = finding.signature();
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '-';
  }
  return name;
}

void save_finding(const SavedFinding& saved, const fs::path& folder) {
  const fs::path part = folder.string() + ".part";
  std::error_code error;
  fs::remove_all(part, error);
  fs::create_directories(part, error);
  if (error) throw Error(ErrorCode::file_unwritable, part.string() + ": cannot make this folder: " + error.message());
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
  write_case(f, part, about["sha256"]);
  write_case(saved.original, part / "original", about["sha256_original"]);
  scene::write_file_atomically(part / "finding.json", about.dump(2) + "\n");
  std::string scenes;
  for (const auto& path : saved.scenes) scenes += " --scenes " + quoted(path);
  scene::write_file_atomically(
      part / "command.txt",
      fmt::format("# verify this finding:\nclues replay {}\n# make the original again:\n"
                  "clues fuzz --subject {} --seed {} --generator {} --first {} --cases 1{}{}{} --out again\n",
                  folder.filename().string(), quoted(saved.subject), f.where.seed, f.where.generator, f.where.index,
                  f.oracle == "subject" ? "" : " --oracle " + f.oracle, of_original.empty() ? " --no-dials" : "",
                  scenes));
  fs::remove_all(folder, error);
  fs::rename(part, folder, error);
  if (error) throw Error(ErrorCode::file_unwritable, folder.string() + ": cannot be made: " + error.message());
}

SavedFinding load_finding(const fs::path& folder) {
  const json about = scene::read_json_file(folder / "finding.json");
  SavedFinding saved;
  try {
    if (about.at("format") != format)
      throw Error(ErrorCode::unsupported, (folder / "finding.json").string() + ": not of the format " + format);
    for (Finding* f : {&saved.finding, &saved.original}) {
      about.at("oracle").get_to(f->oracle);
      about.at("verdict").get_to(f->verdict);
      about.at("explanation").get_to(f->explanation);
      about.at("generator").get_to(f->where.generator);
      about.at("seed").get_to(f->where.seed);
      about.at("index").get_to(f->where.index);
      f->where.solid = about.at("mode") == "solid";
    }
    saved.finding.where.dials = about.value("dials", CaseDials{});
    saved.original.where.dials = about.value("dials_original", CaseDials{});
    about.at("subject").get_to(saved.subject);
    about.at("scenes").get_to(saved.scenes);
    about.at("shrink_steps").get_to(saved.steps);
    read_case(saved.finding, folder, about.at("sha256"));
    read_case(saved.original, folder / "original", about.at("sha256_original"));
  } catch (const json::exception& error) {
    throw Error(ErrorCode::malformed, folder.string() + ": not the folder of a finding, or changed: " + error.what());
  }
  return saved;
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
