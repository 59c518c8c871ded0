#include "scene/stream/stream_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/stream/packets.h"

namespace clues::scene {
namespace {

using StreamJson = nlohmann::json;

constexpr const char* stream_format = "clues-stream/1";
constexpr std::uint64_t most_slots = std::uint64_t{1} << 32;
constexpr std::uint64_t most_triangles = std::uint64_t{1} << 32;  // ids have 32 bits

// One line of the file.
class StreamLine {
 public:
  StreamLine(std::string_view text, std::string where) : where_(std::move(where)), json_(parse_json(text, where_)) {
    if (!json_.is_object()) fail("a line of a stream is a JSON object");
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::malformed, where_ + ": " + what); }

  bool has(const char* key) const { return json_.contains(key); }
  std::size_t size() const { return json_.size(); }
  std::string text(const char* key) const {
    if (!has(key) || !json_[key].is_string()) fail(fmt::format("\"{}\" must be a text", key));
    return json_[key].get<std::string>();
  }
  std::uint64_t number(const StreamJson& value, std::uint64_t from, std::uint64_t below, const char* what) const {
    if (!value.is_number_unsigned()) fail(fmt::format("{} must be a number from {} up", what, from));
    const auto i = value.get<std::uint64_t>();
    if (below == 0)
      throw Error(ErrorCode::index_out_of_range, fmt::format("{}: {} {}: there is none", where_, what, i));
    if (i < from || i >= below)
      throw Error(ErrorCode::index_out_of_range,
                  fmt::format("{}: {} {} is not {} to {}", where_, what, i, from, below - 1));
    return i;
  }
  // Of those that have 32 bits: `below` is no more than 2^32.
  std::uint32_t number32(const StreamJson& value, std::uint64_t from, std::uint64_t below, const char* what) const {
    return static_cast<std::uint32_t>(number(value, from, below, what));
  }
  std::uint64_t count(const char* key) const {
    if (!has(key) || !json_[key].is_number_unsigned()) fail(fmt::format("\"{}\" must be a number from 0 up", key));
    return json_[key].get<std::uint64_t>();
  }
  const StreamJson& list(const char* key) const {
    if (!has(key) || !json_[key].is_array()) fail(fmt::format("\"{}\" must be a list", key));
    return json_[key];
  }
  const StreamJson& at(const char* key) const { return json_[key]; }
  double coordinate(const StreamJson& value) const {
    if (!value.is_number()) fail("a coordinate must be a number");
    // The reader takes -0 for the integer 0, which has no sign; only what has one is read as a signed integer.
    const bool minus_zero = value.is_number_integer() && !value.is_number_unsigned() && value.get<std::int64_t>() == 0;
    return minus_zero ? -0.0 : value.get<double>();
  }

 private:
  std::string where_;
  StreamJson json_;
};

StreamHeader header_of(const StreamLine& line) {
  if (!line.has("format") || line.text("format") != stream_format)
    line.fail("is no stream, which begins with {\"format\": \"clues-stream/1\", ...}");
  StreamHeader header{line.text("scene_sha256"), line.text("cells"), line.count("scene_triangles"),
                      line.count("cell_count")};
  if (line.has("mode")) header.mode = line.text("mode");
  if (header.mode != "sheet" && header.mode != "solid") line.fail("\"mode\" must be \"sheet\" or \"solid\"");
  if (line.has("lists_sha256")) header.lists_sha256 = line.text("lists_sha256");
  return header;
}

template <class Number>
std::vector<Number> ascending(const StreamLine& line, const StreamJson& items, std::uint64_t below, const char* what) {
  std::vector<Number> numbers;
  std::uint64_t least = 0;
  for (const auto& item : items) {
    numbers.push_back(static_cast<Number>(line.number(item, least, below, what)));
    least = numbers.back() + std::uint64_t{1};
  }
  return numbers;
}

// Of a cell from `from` on.
CellContour contour_of(const StreamLine& line, const StreamJson& item, std::uint64_t from, const StreamHeader& header) {
  if (!item.is_array() || item.size() != 3 || !item[1].is_array() || !item[2].is_array())
    line.fail(json_excerpt(item) + " is no contour [CELL, [ID, ...], [EDGE, ...]]");
  return {line.number32(item[0], from, header.cell_count, "the cell of a contour"),
          ascending<std::uint32_t>(line, item[1], header.scene_triangles, "the seed of a contour"),
          ascending<std::uint64_t>(line, item[2], edges_of(header), "the edge of a contour")};
}

StreamMessage message_of(const StreamLine& line, const StreamHeader& header) {
  StreamMessage message;
  if (line.has("cell") && line.size() == 1) {
    message.cell = line.number32(line.at("cell"), 0, header.cell_count, "the cell");
    return message;
  }
  if (line.has("plus") && line.has("vertices") && line.size() == 2) {
    message.kind = StreamMessage::Kind::plus;
    for (const auto& item : line.list("plus")) {
      if (!item.is_array() || item.size() != 5) line.fail(json_excerpt(item) + " is no triangle [ID, SLOT, a, b, c]");
      StreamTriangle t{line.number32(item[0], 0, header.scene_triangles, "the triangle"),
                       line.number32(item[1], 1, most_slots, "the slot"),
                       {}};
      for (std::size_t i = 0; i < 3; ++i)
        t.corners[i] = line.number32(item[2 + i], 1, most_slots, "the slot of a vertex");
      message.plus.push_back(t);
    }
    for (const auto& item : line.list("vertices")) {
      if (!item.is_array() || item.size() != 4) line.fail(json_excerpt(item) + " is no vertex [SLOT, x, y, z]");
      message.vertices.push_back({line.number32(item[0], 1, most_slots, "the slot of a vertex"),
                                  {line.coordinate(item[1]), line.coordinate(item[2]), line.coordinate(item[3])}});
    }
    return message;
  }
  if (line.has("minus") && line.has("unused") && line.size() == 2) {
    message.kind = StreamMessage::Kind::minus;
    for (const auto& item : line.list("minus"))
      message.minus.push_back(line.number32(item, 0, header.scene_triangles, "the triangle"));
    for (const auto& item : line.list("unused"))
      message.unused.push_back(line.number32(item, 1, most_slots, "the slot of a vertex"));
    return message;
  }
  if (line.has("contours") && line.size() == 1) {
    message.kind = StreamMessage::Kind::contours;
    for (const auto& item : line.list("contours")) {
      const std::uint64_t from = message.contours.empty() ? 0 : message.contours.back().cell + std::uint64_t{1};
      message.contours.push_back(contour_of(line, item, from, header));
    }
    return message;
  }
  line.fail(
      R"(a message is {"cell": N}, {"plus": [...], "vertices": [...]}, {"minus": [...], "unused": [...]} or {"contours": [...]})");
}

}  // namespace

std::string difference(const StreamHeader& here, const StreamHeader& there) {
  if (here.scene_sha256 != there.scene_sha256 || here.scene_triangles != there.scene_triangles) return "another scene";
  return here.cells != there.cells || here.cell_count != there.cell_count ? "other cells" : "";
}

std::string difference_of_messages(const StreamHeader& here, const StreamHeader& there) {
  if (const auto other = difference(here, there); !other.empty()) return other;
  if (here.mode != there.mode) return "another mode";
  const bool known = !here.lists_sha256.empty() && !there.lists_sha256.empty();
  return known && here.lists_sha256 != there.lists_sha256 ? "other lists, or another horizon" : "";
}

std::uint64_t most_messages_of_a_step(const StreamHeader& header) {
  return 5 + 2 * std::min(header.scene_triangles, most_triangles);
}

std::uint64_t edges_of(const StreamHeader& header) { return 3 * std::min(header.scene_triangles, most_triangles); }

std::string to_line(const StreamHeader& header) {
  StreamJson json{{"format", stream_format},
                  {"scene_sha256", header.scene_sha256},
                  {"scene_triangles", header.scene_triangles},
                  {"cells", header.cells},
                  {"cell_count", header.cell_count}};
  if (header.mode != "sheet") json["mode"] = header.mode;
  if (!header.lists_sha256.empty()) json["lists_sha256"] = header.lists_sha256;
  return json.dump(-1, ' ', false, StreamJson::error_handler_t::replace) + "\n";
}

std::string to_line(const StreamMessage& message) {
  StreamJson json;
  if (message.kind == StreamMessage::Kind::cell) {
    json["cell"] = message.cell;
  } else if (message.kind == StreamMessage::Kind::plus) {
    json["plus"] = StreamJson::array();
    json["vertices"] = StreamJson::array();
    for (const auto& t : message.plus)
      json["plus"].push_back({t.triangle, t.slot, t.corners[0], t.corners[1], t.corners[2]});
    for (const auto& v : message.vertices) json["vertices"].push_back({v.slot, v.at[0], v.at[1], v.at[2]});
  } else if (message.kind == StreamMessage::Kind::contours) {
    json["contours"] = StreamJson::array();
    for (const auto& c : message.contours) json["contours"].push_back({c.cell, c.seeds, c.boundary});
  } else {
    json["minus"] = message.minus;
    json["unused"] = message.unused;
  }
  return json.dump() + "\n";
}

StreamHeader parse_stream_header(std::string_view line, const std::string& where) {
  return header_of(StreamLine(line, where));
}

StreamMessage parse_stream_message(std::string_view line, const std::string& where, const StreamHeader& header) {
  return message_of(StreamLine(line, where), header);
}

std::string to_line(const StreamRequest& request) {
  const StreamJson json = request.resumes ? StreamJson{{"resume", {{"route", request.route}, {"have", request.have}}}}
                                          : StreamJson{{"enter", request.cell}};
  return json.dump() + "\n";
}

StreamRequest parse_stream_request(std::string_view text, const std::string& where, std::uint64_t cells) {
  const StreamLine line(text, where);
  StreamRequest request;
  if (line.has("enter") && line.size() == 1) {
    request.cell = line.number32(line.at("enter"), 0, cells, "the cell");
    return request;
  }
  if (!line.has("resume") || line.size() != 1) line.fail(R"(a request is {"enter": N} or {"resume": {...}})");
  const StreamLine inner(line.at("resume").dump(), where);
  if (inner.size() != 2) inner.fail("\"resume\" has \"route\" and \"have\", and nothing else");
  request.resumes = true;
  request.have = inner.count("have");
  for (const auto& cell : inner.list("route")) request.route.push_back(inner.number32(cell, 0, cells, "the cell"));
  return request;
}

std::string stream_end_line(std::uint64_t messages) { return StreamJson{{"end", messages}}.dump() + "\n"; }

std::optional<std::uint64_t> parse_stream_end(std::string_view text) {
  const StreamLine line(text, "end");
  if (!line.has("end") || line.size() != 1) return std::nullopt;
  return line.count("end");
}

Stream read_stream(const std::filesystem::path& path) {
  const std::string bytes = read_file_bytes(path);
  if (bytes.starts_with(stream_magic)) return parse_packets(bytes, path.string());
  Stream stream;
  std::string_view rest = bytes;
  for (std::uint64_t number = 1; !rest.empty(); ++number) {
    const auto end = rest.find('\n');
    const StreamLine line(rest.substr(0, end), fmt::format("{}:{}", path.string(), number));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (number == 1) {
      stream.header = header_of(line);
    } else {
      stream.messages.push_back(message_of(line, stream.header));
    }
  }
  if (bytes.empty()) throw Error(ErrorCode::malformed, path.string() + ": is empty; give a stream of `clues walk`");
  return stream;
}

std::vector<std::uint32_t> read_route(const std::filesystem::path& path, std::uint64_t cells) {
  const std::string bytes = read_file_bytes(path), file = path.string();
  LineReader lines(file, bytes, {});
  std::vector<std::uint32_t> route;
  while (lines.next()) {
    for (const auto token : lines.tokens()) {
      std::uint64_t cell = 0;
      const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), cell);
      if (error != std::errc() || end != token.data() + token.size())
        fail_at(lines.place(), ErrorCode::malformed, excerpt(token) + " is no number of a cell");
      if (cell >= cells)
        fail_at(lines.place(), ErrorCode::index_out_of_range,
                fmt::format("there is no cell {}; the last is {}", cell, cells - 1));
      route.push_back(static_cast<std::uint32_t>(cell));
    }
  }
  if (route.empty()) throw Error(ErrorCode::malformed, path.string() + ": names no cell");
  return route;
}

}  // namespace clues::scene
