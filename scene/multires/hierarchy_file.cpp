#include "scene/multires/hierarchy_file.h"

#include <fmt/format.h>

#include <iterator>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

constexpr std::string_view first_line = "clues-maps 1";
constexpr std::array<std::string_view, 3> kind_names{"interior", "boundary", "feature"};
constexpr std::array<std::string_view, 3> reason_names{"link", "flat", "numbers"};

using Out = fmt::memory_buffer;

void write(Out& out, const CarrierPoint& point) {
  fmt::format_to(std::back_inserter(out), "{}", point.size());
  for (std::size_t k = 0; k < point.size(); ++k) {
    fmt::format_to(std::back_inserter(out), " {} {}", point.corner[k], point.weight[k]);
  }
}

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

// A line after the other, each token asked for by what it is.
class Reader {
 public:
  Reader(const std::string& file, std::string_view text) : lines_(file, text, {}), limit_(text.size()) {}

  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::malformed) const {
    fail_at(lines_.place(), code, what);
  }
  void next_line(std::string_view wanted) {
    if (!lines_.next()) fail(fmt::format("the file ends where {} was expected", wanted));
    at_ = 0;
  }
  void end_line() {
    if (at_ != lines_.tokens().size()) fail(fmt::format("{} is one word too many", excerpt(lines_.tokens()[at_])));
  }
  void end_file() {
    if (lines_.next()) fail("nothing was expected after the end");
  }
  std::string_view word(std::string_view what) {
    if (at_ == lines_.tokens().size()) fail(fmt::format("{} is missing at the end of the line", what));
    return lines_.tokens()[at_++];
  }
  std::int64_t integer(std::string_view what) {
    const std::string_view token = word(what);
    const auto value = parse_integer(token);
    if (!value) fail(fmt::format("{} is no whole number ({})", excerpt(token), what));
    return *value;
  }
  std::uint32_t index(std::string_view what, std::size_t count) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) >= count) {
      fail(fmt::format("{} {} does not exist; there are {}", what, value, count), ErrorCode::index_out_of_range);
    }
    return static_cast<std::uint32_t>(value);
  }
  // Nothing in a file can be more than it has characters.
  std::size_t count(std::string_view what) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) > limit_) fail(fmt::format("{} {} is no count", what, value));
    return static_cast<std::size_t>(value);
  }
  std::size_t heading(std::string_view name) {
    next_line(name);
    if (const auto found = word(name); found != name)
      fail(fmt::format("{} stands where '{}' was expected", excerpt(found), name));
    return count(name);
  }
  double number(std::string_view what) { return number_at(word(what), what, lines_.place()); }
  std::size_t name(const std::array<std::string_view, 3>& names, std::string_view what) {
    const std::string_view token = word(what);
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] == token) return k;
    }
    fail(fmt::format("{} is no {}", excerpt(token), what));
  }
  Triangle triangle(std::size_t vertices) {
    Triangle t{};
    for (auto& v : t) v = index("vertex", vertices);
    return t;
  }
  CarrierPoint point(std::size_t vertices) {
    CarrierPoint out;
    const std::size_t size = count("corners");
    if (size < 1 || size > 3) fail("a point has 1 to 3 corners");
    for (std::size_t k = 0; k < size; ++k) {
      out.corner[k] = index("vertex", vertices);
      if (k > 0 && out.corner[k] <= out.corner[k - 1]) fail("the corners of a point have to ascend");
      out.weight[k] = integer("weight");
    }
    return out;
  }
  Removal removal(std::size_t vertices) {
    Removal r;
    r.vertex = index("vertex", vertices);
    r.kind = static_cast<StarKind>(name(kind_names, "kind of a star"));
    const std::size_t ring = count("ring");
    for (std::size_t k = 0; k < ring; ++k) r.ring.push_back(index("vertex", vertices));
    r.across = index("place in the ring", ring);
    for (std::size_t k = 0; k < ring; ++k) {
      const std::int64_t x = integer("coordinate"), y = integer("coordinate");
      for (const std::int64_t c : {x, y}) {
        if (c < -disk_unit || c > disk_unit) fail(fmt::format("the coordinate {} is not within 2^24", c));
      }
      r.flat.push_back({x, y});
    }
    const std::size_t triangles = count("triangles");
    for (std::size_t k = 0; k < triangles; ++k) r.triangles.push_back(triangle(vertices));
    return r;
  }

 private:
  LineReader lines_;
  std::size_t limit_;
  std::size_t at_ = 0;
};

}  // namespace

std::string to_text(const Hierarchy& h) {
  Out out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{}\nvertices {}\n", first_line, h.input.points.size());
  for (const auto& p : h.input.points) fmt::format_to(to, "{} {} {}\n", p[0], p[1], p[2]);
  fmt::format_to(to, "triangles {}\n", h.input.triangles.size());
  for (const auto& t : h.input.triangles) fmt::format_to(to, "{} {} {}\n", t[0], t[1], t[2]);
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
  fmt::format_to(to, "base {}\n", h.base.size());
  for (const auto& t : h.base) fmt::format_to(to, "{} {} {}\n", t[0], t[1], t[2]);
  fmt::format_to(to, "points {}\n", h.points.size());
  for (const auto& p : h.points) {
    write(out, p.source);
    out.push_back(' ');
    write(out, p.image);
    out.push_back('\n');
  }
  fmt::format_to(to, "pieces {}\n", h.pieces.size());
  for (const auto& p : h.pieces) fmt::format_to(to, "{} {} {} {}\n", p.corners[0], p.corners[1], p.corners[2], p.input);
  return fmt::to_string(out);
}

bool is_hierarchy_text(std::string_view text) { return text.substr(0, 10) == first_line.substr(0, 10); }

Hierarchy parse_hierarchy(std::string_view text, const std::string& file) {
  Reader in(file, text);
  in.next_line("clues-maps 1");
  if (in.word("the format") != "clues-maps")
    in.fail("this is no hierarchy of clues maps; its first line is 'clues-maps 1'");
  if (in.word("version") != "1") in.fail("this version of clues reads 'clues-maps 1' only");
  in.end_line();
  Hierarchy h;
  const auto list = [&in](std::string_view heading, const auto& read) {
    const std::size_t count = in.heading(heading);
    in.end_line();
    for (std::size_t k = 0; k < count; ++k) {
      in.next_line(heading);
      read();
      in.end_line();
    }
  };
  list("vertices", [&] {
    Point p{};
    for (double& x : p) x = in.number("coordinate");
    h.input.points.push_back(p);
  });
  const std::size_t vertices = h.input.points.size();
  list("triangles", [&] {
    h.input.face_of.push_back(static_cast<std::uint32_t>(h.input.triangles.size()));
    h.input.triangles.push_back(in.triangle(vertices));
  });
  list("features", [&] {
    const std::uint32_t a = in.index("vertex", vertices), b = in.index("vertex", vertices);
    h.features.push_back(edge_of(a, b));
  });
  list("fixed", [&] { h.fixed.push_back(in.index("vertex", vertices)); });
  const std::size_t levels = in.heading("levels");
  in.end_line();
  for (std::size_t l = 0; l < levels; ++l) {
    HierarchyLevel level;
    list("removals", [&] {
      if (in.word("remove") != "remove") in.fail("a line of a removal begins with 'remove'");
      level.removals.push_back(in.removal(vertices));
    });
    list("kept", [&] {
      const std::uint32_t vertex = in.index("vertex", vertices);
      level.kept.push_back({vertex, static_cast<KeptFor>(in.name(reason_names, "reason"))});
    });
    h.levels.push_back(std::move(level));
  }
  list("base", [&] { h.base.push_back(in.triangle(vertices)); });
  list("points", [&] {
    OverlayVertex p;
    p.source = in.point(vertices);
    p.image = in.point(vertices);
    h.points.push_back(p);
  });
  if (h.points.size() < vertices)
    in.fail("there are fewer points than vertices; the vertices of the input are the first points");
  list("pieces", [&] {
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
