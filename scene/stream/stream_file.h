// D25: what a server says to a client, as JSON lines ("clues-stream/1", docs/delta.md). The first line says of which
// scene and cells; every other is a message. `+` brings triangles with the slots that they get in the client's display
// list, and the vertices that are new to it; `-` takes triangles out, and says which slots of vertices become free;
// `cell` says where the viewer is from here on. Slot 0 is nothing (FIG. 43). `contours` says, for some cells, which part of
// the display list has to be drawn there (FIG. 54).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

struct StreamTriangle {
  std::uint32_t triangle = 0;              // id (D1)
  std::uint32_t slot = 0;                  // of the display list, from 1
  std::array<std::uint32_t, 3> corners{};  // slots of vertices, from 1

  friend bool operator==(const StreamTriangle&, const StreamTriangle&) = default;
};

struct StreamVertex {
  std::uint32_t slot = 0;
  Point at{};

  friend bool operator==(const StreamVertex&, const StreamVertex&) = default;
};

// D26, FIG. 54: what of the display list is drawn in a cell: all that a flood over triangles of the list reaches from the
// seeds, through edges that they have in common (corners with the same coordinates) and that are not of the boundary. In
// a cell without a contour everything is drawn.
struct CellContour {
  std::uint32_t cell = 0;
  std::vector<std::uint32_t> seeds;     // ids, ascending
  std::vector<std::uint64_t> boundary;  // 3 * id + k: the edge from corner k of that triangle to the next, ascending

  friend bool operator==(const CellContour&, const CellContour&) = default;
};

struct StreamMessage {
  enum class Kind : std::uint8_t { plus, minus, cell, contours };
  Kind kind = Kind::cell;
  std::uint32_t cell = 0;              // cell: its number
  std::vector<StreamTriangle> plus;    // plus
  std::vector<StreamVertex> vertices;  // plus
  std::vector<std::uint32_t> minus;    // minus: ids
  std::vector<std::uint32_t> unused;   // minus: slots of vertices that become free
  std::vector<CellContour> contours;   // contours: by cell; they replace all that came before
};

struct StreamHeader {
  std::string scene_sha256, cells;  // cells: as --cells has it
  std::uint64_t scene_triangles = 0, cell_count = 0;
  std::string mode = "sheet";     // or "solid": of the maps; of a bake it means nothing
  std::string lists_sha256 = {};  // of what else the messages follow from; empty: nothing is said of it
};

// What is other about `there`, for a message: "another scene", "other cells"; empty: it is of the same things.
std::string difference(const StreamHeader& here, const StreamHeader& there);
// Also what decides the messages, as far as both say it: then one goes on where the other stopped.
std::string difference_of_messages(const StreamHeader& here, const StreamHeader& there);

struct Stream {
  StreamHeader header;
  std::vector<StreamMessage> messages;
};

// With its newline.
std::string to_line(const StreamHeader& header);
std::string to_line(const StreamMessage& message);

// One line, without its end; `where` is for messages. Throws Error malformed, index_out_of_range.
StreamHeader parse_stream_header(std::string_view line, const std::string& where);
StreamMessage parse_stream_message(std::string_view line, const std::string& where, const StreamHeader& header);

// What a client asks a server: to enter a cell, or, after a lost connection, for what it does not have of the messages
// of a route.
struct StreamRequest {
  bool resumes = false;
  std::uint32_t cell = 0;            // to enter
  std::vector<std::uint32_t> route;  // resumes: the cells that were asked for before
  std::uint64_t have = 0;            // resumes: so many messages have come
};
// The most messages of the answer to one step: each triangle comes and goes once, and five are empty, the cell, or contours.
std::uint64_t most_messages_of_a_step(const StreamHeader& header);
// Numbers of edges are below.
std::uint64_t edges_of(const StreamHeader& header);

std::string to_line(const StreamRequest& request);
StreamRequest parse_stream_request(std::string_view line, const std::string& where, std::uint64_t cells);

// The end of an answer: how many messages the session has had. None where the line is something else.
std::string stream_end_line(std::uint64_t messages);
std::optional<std::uint64_t> parse_stream_end(std::string_view line);

// As lines, or in binary (packets.h). Throws Error: file errors; malformed, index_out_of_range, non_finite with file and
// line. Ids and cells are below what the header says.
Stream read_stream(const std::filesystem::path& path);

// Numbers of cells with blanks or ends of lines between them, '#' comments. Throws Error as read_stream; index_out_of_range
// where one is not below `cells`; malformed where there is none.
std::vector<std::uint32_t> read_route(const std::filesystem::path& path, std::uint64_t cells);

}  // namespace clues::scene
