#include "scene/multires/hierarchy_file.h"

#include <fmt/format.h>

#include <iterator>

#include "scene/formats/file_bytes.h"
#include "scene/multires/list_reader.h"

namespace clues::scene {
namespace {

constexpr std::string_view first_line = "clues-maps 1";
constexpr std::array<std::string_view, 3> kind_names{"interior", "boundary", "feature"};
constexpr std::array<std::string_view, 3> reason_names{"link", "flat", "numbers"};

using Out = fmt::memory_buffer;

void write(Out& out, const Removal& r) {
  auto to = std::back_inserter(out);
  fmt::format_to(to, "remove {} {} {}", r.vertex, kind_names[static_cast<std::size_t>(r.kind)], r.ring.size());
  for (const std::uint32_t v : r.ring) fmt::format_to(to, " {}", v);
  fmt::format_to(to, " {}", r.across);
  for (const auto& p : r.flat) fmt::format_to(to, " {} {}", p[0], p[1]);
  fmt::format_to(to, " {}", r.triangles.size());
  for (const auto& t : r.triangles) fmt::format_to(to, " {} {} {}", t[0], t[1], t[2]);
  fmt::format_to(to, "\n");
}

Removal removal_of(ListReader& in, std::size_t vertices) {
  Removal r;
  r.vertex = in.index("vertex", vertices);
  r.kind = static_cast<StarKind>(in.name(kind_names, "kind of a star"));
  const std::size_t ring = in.count("ring");
  for (std::size_t k = 0; k < ring; ++k) r.ring.push_back(in.index("vertex", vertices));
  r.across = in.index("place in the ring", ring);
  for (std::size_t k = 0; k < ring; ++k) {
    const std::int64_t x = in.integer("coordinate"), y = in.integer("coordinate");
    for (const std::int64_t c : {x, y}) {
      if (c < -disk_unit || c > disk_unit) in.fail(fmt::format("the coordinate {} is not within 2^24", c));
    }
    r.flat.push_back({x, y});
  }
  const std::size_t triangles = in.count("triangles");
  for (std::size_t k = 0; k < triangles; ++k) r.triangles.push_back(in.triangle(vertices));
  return r;
}

}  // namespace

std::string to_text(const Hierarchy& h) {
  Out out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{}\nvertices {}\n", first_line, h.input.points.size());
  for (const auto& p : h.input.points) fmt::format_to(to, "{} {} {}\n", p[0], p[1], p[2]);
  write_triangles(out, "triangles", h.input.triangles);
  fmt::format_to(to, "features {}\n", h.features.size());
  for (const auto& e : h.features) fmt::format_to(to, "{} {}\n", e[0], e[1]);
  fmt::format_to(to, "fixed {}\n", h.fixed.size());
  for (const auto v : h.fixed) fmt::format_to(to, "{}\n", v);
  fmt::format_to(to, "levels {}\n", h.levels.size());
  for (const auto& level : h.levels) {
    fmt::format_to(to, "removals {}\n", level.removals.size());
    for (const auto& r : level.removals) write(out, r);
    fmt::format_to(to, "kept {}\n", level.kept.size());
    for (const auto& k : level.kept) {
      fmt::format_to(to, "{} {}\n", k.vertex, reason_names[static_cast<std::size_t>(k.reason)]);
    }
  }
  write_triangles(out, "base", h.base);
  write_points(out, h.points);
  fmt::format_to(to, "pieces {}\n", h.pieces.size());
  for (const auto& p : h.pieces) fmt::format_to(to, "{} {} {} {}\n", p.corners[0], p.corners[1], p.corners[2], p.input);
  return fmt::to_string(out);
}

bool is_hierarchy_text(std::string_view text) { return text.substr(0, 10) == first_line.substr(0, 10); }

Hierarchy parse_hierarchy(std::string_view text, const std::string& file) {
  ListReader in(file, text);
  in.next_line("clues-maps 1");
  if (in.word("the format") != "clues-maps")
    in.fail("this is no hierarchy of clues maps; its first line is 'clues-maps 1'");
  if (in.word("version") != "1") in.fail("this version of clues reads 'clues-maps 1' only");
  in.end_line();
  Hierarchy h;
  in.list("vertices", [&] {
    Point p{};
    for (double& x : p) x = in.number("coordinate");
    h.input.points.push_back(p);
  });
  const std::size_t vertices = h.input.points.size();
  in.list("triangles", [&] {
    h.input.face_of.push_back(static_cast<std::uint32_t>(h.input.triangles.size()));
    h.input.triangles.push_back(in.triangle(vertices));
  });
  in.list("features", [&] {
    const std::uint32_t a = in.index("vertex", vertices), b = in.index("vertex", vertices);
    h.features.push_back(edge_of(a, b));
  });
  in.list("fixed", [&] { h.fixed.push_back(in.index("vertex", vertices)); });
  const std::size_t levels = in.heading("levels");
  in.end_line();
  for (std::size_t l = 0; l < levels; ++l) {
    HierarchyLevel level;
    in.list("removals", [&] {
      if (in.word("remove") != "remove") in.fail("a line of a removal begins with 'remove'");
      level.removals.push_back(removal_of(in, vertices));
    });
    in.list("kept", [&] {
      const std::uint32_t vertex = in.index("vertex", vertices);
      level.kept.push_back({vertex, static_cast<KeptFor>(in.name(reason_names, "reason"))});
    });
    h.levels.push_back(std::move(level));
  }
  in.list("base", [&] { h.base.push_back(in.triangle(vertices)); });
  in.list("points", [&] {
    OverlayVertex p;
    p.source = in.point(vertices);
    p.image = in.point(vertices);
    h.points.push_back(p);
  });
  if (h.points.size() < vertices)
    in.fail("there are fewer points than vertices; the vertices of the input are the first points");
  in.list("pieces", [&] {
    OverlayTriangle t;
    for (auto& c : t.corners) c = in.index("point", h.points.size());
    t.input = in.index("triangle", h.input.triangles.size());
    h.pieces.push_back(t);
  });
  in.end_file();
  return h;
}

Hierarchy read_hierarchy(const std::filesystem::path& path) {
  return parse_hierarchy(read_file_bytes(path), path.string());
}

std::vector<PlainMapLine> read_plain_map(const std::filesystem::path& path) {
  const std::string text = read_file_bytes(path);
  const std::string file = path.string();
  LineReader lines(file, text, {});
  std::vector<PlainMapLine> out;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    const auto triangle = parse_integer(tokens[0]);
    if (!triangle || *triangle < 0 || *triangle >= no_vertex || tokens.size() < 3 || tokens.size() > 4) {
      fail_at(lines.place(), ErrorCode::malformed,
              "expected the number of a base triangle and two or three coordinates");
    }
    PlainMapLine line;
    line.triangle = static_cast<std::uint32_t>(*triangle);
    for (std::size_t k = 1; k < tokens.size(); ++k) line.weights[k - 1] = tokens[k];
    out.push_back(std::move(line));
  }
  return out;
}

}  // namespace clues::scene
