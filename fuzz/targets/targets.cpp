// All readers of files and of the protocol. Whatever they accept is written and read again, and must be the same.
#include "fuzz/targets/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fuzz/findings/store.h"
#include "fuzz/report/html_report.h"
#include "fuzz/shrinking/finding_folder.h"
#include "fuzz/targets/promises.h"
#include "scene/bakes/bake_store.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/files/temporary_folder.h"
#include "scene/formats/readers.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/json_reader.h"
#include "scene/levels/bsp_scene.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/result.h"
#include "scene/sealed_result.h"
#include "scene/stream/packets.h"
#include "validate/conform/protocol.h"
#include "validate/vectors/reader.h"
#include "validate/vectors/writer.h"

namespace clues::fuzz {
namespace {

bool same_bits(const std::vector<scene::Point>& a, const std::vector<scene::Point>& b) {
  const auto equal = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const scene::Point& p, const scene::Point& q) {
    return equal(p[0], q[0]) && equal(p[1], q[1]) && equal(p[2], q[2]);
  });
}

void check_mesh(const scene::TriangleMesh& mesh) {
  require(mesh.face_of.size() == mesh.triangles.size(), "every triangle has a face");
  require(std::is_sorted(mesh.face_of.begin(), mesh.face_of.end()), "triangles are in the order of the faces");
  for (const auto& t : mesh.triangles) {
    for (const auto corner : t) require(corner < mesh.points.size(), "every corner is a point");
  }
  for (const auto& p : mesh.points) {
    for (const double x : p) require(std::isfinite(x), "coordinates are finite");
  }
}

using Reader = scene::TriangleMesh (*)(std::string_view, const std::string&);

template <Reader read>
bool mesh_file(std::string_view bytes) {
  return accepted([&] {
    const auto mesh = read(bytes, "file");
    check_mesh(mesh);
    if (mesh.points.empty()) return;
    const auto again = scene::read_off(scene::to_off_text(mesh), "again");
    require(same_bits(mesh.points, again.points) && mesh.triangles == again.triangles,
            "a scene survives being written as OFF");
  });
}

void check_flagged(const scene::FlaggedMesh& mesh) {
  check_mesh(mesh.mesh);
  const auto total = mesh.mesh.triangles.size();
  for (const auto* flags : {&mesh.blocks, &mesh.counts})
    require(flags->empty() || flags->size() == total, "every triangle has its flags, or none has");
  for (std::uint32_t t = 0; t < total; ++t)
    require(mesh.blocking(t) || mesh.counting(t), "who is there does something");
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const auto first = mesh.parts[i].first_triangle;
    require(first < total && (i == 0 ? first == 0 : mesh.parts[i - 1].first_triangle < first), "parts ascend");
  }
}

bool gltf(std::string_view bytes) {
  return accepted([&] {
    const auto no_files = [](const std::string& path) -> std::string {
      throw scene::Error(scene::ErrorCode::file_not_found, path + ": there is none");
    };
    check_flagged(scene::read_gltf(bytes, "file", no_files));
  });
}

// A level, its cells, and what it was shipped with. Large ones take time and show no more.
bool bsp(std::string_view bytes) {
  return accepted([&] {
    const auto level = scene::parse_bsp(bytes, "file");
    if (level.nodes.size() > 64 || level.sides.size() > 256 || level.points.size() + level.corners.size() > 4096)
      return;
    const auto scene = scene::scene_of_level(level);
    check_flagged(scene.scene);
    for (std::uint32_t c = 0; c < std::min(level.visibility.clusters, 4U); ++c) {
      const auto ids = scene::shipped_set(level, scene, c);
      require(std::is_sorted(ids.begin(), ids.end()), "a shipped list ascends");
      for (const auto id : ids) require(scene.scene.counting(id), "a shipped list holds what is drawn");
    }
    for (const auto& cell : scene::cells_of_level(level)) {
      require(cell.inner.empty() || !cell.outer.empty(), "who has an inner cell has an outer one");
      require(cell.cluster < std::max(level.visibility.clusters, 1U), "a cell has a cluster");
    }
  });
}

// The reader of JSON that all the others use: what it accepts is what the library reads, and its refusals can be shown to anybody.
bool json_text(std::string_view bytes) {
  try {
    const auto value = scene::parse_json_text(bytes);
    require(nlohmann::json::accept(bytes), "what is accepted is JSON");
    require(value == nlohmann::json::parse(bytes), "the value is that of the library");
    require(scene::parse_json_text(value.dump()) == value, "a value survives being written");
    const auto shown = scene::json_excerpt(value);
    require(scene::printable(shown) == shown && shown.size() < 400, "an excerpt is short and printable");
    return true;
  } catch (const scene::JsonError& error) {
    const std::string text = error.what();
    require(scene::printable(text) == text && text.size() < 400, "a refusal is short and printable");
    require(error.line() <= 1 + static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\n')),
            "the line is one of the text");
    return false;
  }
}

// A cell as it is given on the command line. Grids of more than 9 x 9 x 9 cells are a matter of memory and not of reading.
bool cell(std::string_view bytes) {
  const std::string text(bytes);
  const bool box = text.starts_with("box:");
  if (!box && !(text.starts_with("grid:") && text.find(':', 5) <= 10)) return false;
  return accepted([&] {
    for (const auto& spec : scene::parse_cells(text)) {
      require(!spec.points.empty() && spec.points.size() <= 8, "a box has 1 to 8 corners");
      for (const auto& p : spec.points) {
        for (const double x : p) require(std::isfinite(x), "coordinates are finite");
      }
    }
  });
}

// First byte: how many triangles the scene has, and whether the rest is a result or a list.
bool pvs(std::string_view bytes) {
  if (bytes.empty()) return false;
  const auto head = static_cast<unsigned char>(bytes[0]);
  const std::uint64_t triangles = head >> 1;
  return accepted([&] {
    const auto ids = (head & 1) != 0 ? scene::parse_result_pvs(bytes.substr(1), "file", {triangles, {}, {}, {}})
                                     : scene::parse_pvs_list(bytes.substr(1), "file", triangles);
    require(std::is_sorted(ids.begin(), ids.end()) && std::adjacent_find(ids.begin(), ids.end()) == ids.end(),
            "ids ascend and none is there twice");
    require(ids.empty() || ids.back() < triangles, "every id is a triangle");
    require(scene::parse_pvs_list(scene::to_pvs_text(ids), "again", triangles) == ids, "a PVS survives being written");
  });
}

bool vectors(std::string_view bytes) {
  const bool is_index = accepted([&] {
    const auto index = validate::parse_vector_index(bytes, "index.json");
    const auto text = validate::to_json_text(index);
    require(validate::to_json_text(validate::parse_vector_index(text, "again")) == text, "the index has one text");
  });
  if (is_index) return true;
  return accepted([&] {
    const auto file = validate::parse_vector_file(bytes, "file.json", true);
    for (const auto& c : file.cases) check_mesh(c.mesh);
    const auto text = validate::to_json_text(file);
    require(validate::to_json_text(validate::parse_vector_file(text, "file.json", true)) == text,
            "a vector file has one text");
  });
}

// Each line, taken for what an implementation may be told and for what it may answer.
bool protocol(std::string_view bytes) {
  using namespace validate;
  bool any = false;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const auto end = std::min(bytes.find('\n', begin), bytes.size());
    const auto line = bytes.substr(begin, end - begin);
    begin = end + 1;
    try {
      const Request request = parse_request(line);
      any = true;
      check_mesh(request.mesh);
      if (request.kind == Request::Kind::run) {
        VectorCase c;
        c.mesh = request.mesh;
        c.cell = request.cell;
        c.mode = request.mode;
        c.blocks = request.blocks;
        c.counts = request.counts;
        const Request again = parse_request(run_request(request.seq, c));
        require(same_bits(again.mesh.points, request.mesh.points) && again.mesh.triangles == request.mesh.triangles &&
                    same_bits(again.cell, request.cell) && again.mode == request.mode && again.seq == request.seq &&
                    again.blocks == request.blocks && again.counts == request.counts,
                "a request survives being written");
      }
    } catch (const ProtocolError&) {
    }
    try {
      const Implementation about = parse_start_reply(line);
      any = true;
      require(parse_start_reply(start_reply(about)).name == about.name, "an implementation keeps its name");
    } catch (const ProtocolError&) {
    }
    constexpr std::size_t triangles = 12;
    const validate::Answer answer = parse_reply(line, 1, triangles);
    require(answer.visible.empty() || answer.visible.back() < triangles, "every id is a triangle");
    if (answer.kind == AnswerKind::visible) {
      any = true;
      require(parse_reply(run_reply(1, answer), 1, triangles).visible == answer.visible, "a reply survives");
    }
  }
  return any;
}

// A result file as the answer to a question that says all it can. What is kept of it is whole, and no other text is.
bool result(std::string_view bytes) {
  const scene::Asked asked{12, std::string(64, 'a'), "sheet", {{0, 0, 0}, {1, 0, 0}}};
  if (bytes.size() >= 2) {
    const std::string sealed = scene::sealed_result(bytes, "question");
    require(scene::flaw_of_sealed(sealed, "question").empty(), "what is kept is whole");
    require(!scene::flaw_of_sealed(sealed, "another").empty(), "it answers one question");
    require(!scene::flaw_of_sealed(sealed.substr(0, sealed.size() - 1), "question").empty(), "a cut is seen");
  }
  require(!scene::flaw_of_sealed(bytes, "question").empty(), "bytes of strangers carry no hash");
  return accepted([&] {
    const auto ids = scene::parse_result_pvs(bytes, "file", asked);
    require(ids.empty() || ids.back() < 12, "every id is a triangle");
    require(scene::parse_result_pvs(bytes, "file", {12, {}, {}, {}}) == ids, "who asks less gets the same");
  });
}

// The files of a finding, after one another with a zero byte between: finding.json, scene.off, cell.obj, witness.json. Or one finding as the store keeps it.
bool finding(std::string_view bytes) {
  std::vector<std::string> texts(1);
  for (const char c : bytes) {
    if (c == '\0') {
      texts.emplace_back();
    } else {
      texts.back() += c;
    }
  }
  return accepted([&] {
    if (texts.size() != 4) {
      const Finding f = finding_from_json_text(std::string(bytes));
      check_mesh(f.where.mesh);
      require(to_json_text(finding_from_json_text(to_json_text(f))) == to_json_text(f), "a finding survives");
      return;
    }
    const CaseTexts texts_of_case{texts[1], texts[2], texts[3]};
    const SavedFinding saved = finding_of_texts(texts[0], texts_of_case, texts_of_case, "folder");
    check_mesh(saved.finding.where.mesh);
    require(!saved.finding.where.cell.empty(), "there is a cell");
    require(!saved.finding.triangle || *saved.finding.triangle < saved.finding.where.mesh.triangles.size(),
            "the triangle is one of the scene");
    require(picture_of(saved.finding).ends_with("</svg>\n"), "it can be drawn");
    require(folder_name(saved.finding).find_first_of("/.") == std::string::npos, "its folder is below the campaign's");
  });
}

// The database of a campaign, opened as `clues fuzz` does.
bool store(std::string_view bytes) {
  const scene::TemporaryFolder folder;
  scene::write_file_atomically(folder.file("findings.sqlite"), bytes);
  return accepted([&] {
    Store opened(folder.file("findings.sqlite"), "plan");
    const std::uint64_t done = opened.cases_done();
    opened.counters();
    opened.contradictions();
    for (const StoredFinding& f : opened.findings()) check_mesh(f.finding.where.mesh);
    opened.commit({{done, Outcome{}}}, done + 1);
    require(opened.cases_done() == done + 1, "a case that is done is counted");
  });
}

// What `clues check --bake` reads.
bool bake(std::string_view bytes) {
  const scene::TemporaryFolder folder;
  scene::write_file_atomically(folder.file("of.bake"), bytes);
  return accepted([&] {
    const scene::FinishedBake opened(folder.file("of.bake"));
    for (std::uint32_t c = 0; c < opened.plan().cells.size(); ++c) {
      const auto list = opened.cell(c).list;
      require(std::is_sorted(list.begin(), list.end()), "a list ascends");
      require(list.empty() || list.back() < opened.plan().triangles, "triangles are those of the scene");
      require(!opened.plan().cells[c].points.empty(), "a cell has points");
    }
  });
}

// What a server of streams sends, or what clients send to one. However the bytes come in, the packets are the same.
bool stream(std::string_view bytes) {
  const bool to_client = bytes.starts_with(scene::stream_magic);
  return accepted([&] {
    if (to_client) {
      const auto read = scene::parse_packets(bytes, "stream");
      std::string again = scene::to_packet(read.header);
      for (const auto& message : read.messages) again += scene::to_packet(message);
      require(again == bytes, "a stream has one form");
      return;
    }
    scene::PacketReader whole(scene::most_request_bytes, "client"), bytewise(scene::most_request_bytes, "client");
    whole.feed(bytes);
    std::string again;
    std::size_t fed = 0;
    while (const auto packet = whole.next()) {
      const auto request = scene::parse_request(*packet, "client", 12);
      again += scene::to_packet(request);
      while (fed < again.size()) {
        require(!bytewise.next(), "a packet comes when all of it is there");
        bytewise.feed(bytes.substr(fed++, 1));
      }
      const auto same = bytewise.next();
      require(same && same->kind == packet->kind && same->body == packet->body, "packets come however they are cut");
    }
    require(bytes.starts_with(again), "a request has one form");
    if (again.empty()) throw scene::Error(scene::ErrorCode::malformed, "client: nothing is asked");
  });
}

// A file in the folder of `clues report`: whatever it says is text on the page.
bool report(std::string_view bytes) {
  bool is_result = false;
  return accepted([&] {
           const auto section = section_of(std::string(bytes), "file.json", false);
           is_result = section.has_value();
           if (!section) return;
           const std::string page = to_html({*section}, "");
           const std::string bare = to_html({}, "");
           const auto count = [](const std::string& text, const std::string& what) {
             std::size_t n = 0;
             for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
             return n;
           };
           for (const char* markup : {"<script", "<img", "<a ", "<iframe", "<style"})
             require(count(page, markup) == count(bare, markup), "what a result says is no markup");
           require(page.find('\x1b') == std::string::npos, "nor does it hold controls");
         }) &&
         is_result;
}

}  // namespace

const std::vector<Target>& all_targets() {
  static const std::vector<Target> all{
      {"obj", "the reader of OBJ files", mesh_file<scene::read_obj>},
      {"off", "the reader of OFF files", mesh_file<scene::read_off>},
      {"ply", "the reader of PLY files, text and binary", mesh_file<scene::read_ply>},
      {"stl", "the reader of STL files, text and binary", mesh_file<scene::read_stl>},
      {"gltf", "the reader of glTF files, .gltf and .glb", gltf},
      {"bsp", "the reader of levels, their cells and shipped lists", bsp},
      {"json", "the reader of JSON", json_text},
      {"cell_and_pvs", "cells of the command line, lists of triangle ids and result files",
       [](std::string_view bytes) {
         return bytes.starts_with("box:") || bytes.starts_with("grid:") ? cell(bytes) : pvs(bytes);
       }},
      {"vectors", "the reader of the conformance suite and of its index", vectors},
      {"protocol", "the JSON lines between clues conform and an implementation", protocol},
      {"result", "a result file as an answer to a question", result},
      {"finding", "the files of a finding, and findings as the store keeps them", finding},
      {"store", "the database of a campaign", store},
      {"bake", "a store of clues bake", bake},
      {"motion", "depth meshes, motion bounds, walks and ways of viewpoints", motion_files},
      {"maps", "hierarchies of surfaces, judged, proofs of remeshes, features and maps of other programs", map_files},
      {"contours", "files of contours, decoded exactly and in doubles", contour_files},
      {"lists", "files of lists, decoded", list_files},
      {"stream", "streams in binary, and what clients ask", stream},
      {"report", "what clues report finds in a folder", report},
      {"scene_to_verdict", "a small scene, mapped by the reference and judged by oracles of the fuzzer",
       scene_to_verdict}};
  return all;
}

const Target& target_named(const std::string& name) {
  for (const Target& t : all_targets()) {
    if (t.name == name) return t;
  }
  throw scene::Error(scene::ErrorCode::bad_argument, "no target of the name " + name);
}

}  // namespace clues::fuzz
