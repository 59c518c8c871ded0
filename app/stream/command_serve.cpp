// clues serve: a server of streams (D25), on standard input and output or at a local socket.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>

#include "app/commands.h"
#include "app/common.h"
#include "app/stream/served_cells.h"
#include "app/stream/socket_server.h"
#include "reference/streams/stream_session.h"
#include "scene/messages/error.h"
#include "scene/stream/stream_file.h"

namespace clues::app {
namespace {

struct ServeRequest {
  CellsChoice choice;
  std::string socket;
  bool binary = false;
  SendChoice send;
  MethodOptions method;
};

void say(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

void answer_lines(const reference::StreamStore& store, const scene::StreamHeader& header) {
  reference::StreamServer server(store);
  say(scene::to_line(header));
  std::string line;
  for (std::uint64_t number = 1; std::getline(std::cin, line); ++number) {
    const auto asked = scene::parse_stream_request(line, fmt::format("standard input:{}", number), header.cell_count);
    std::string answer;
    for (const auto& message : asked.resumes ? server.resume(asked.route, asked.have) : server.enter(asked.cell))
      answer += scene::to_line(message);
    say(answer + scene::stream_end_line(server.messages()));
  }
}

// What is no request ends it: the client is told why, and so is who started the program.
void answer_packets(const reference::StreamStore& store, const scene::StreamHeader& header) {
  reference::StreamSession session(store, header);
  say(session.greeting());
  std::array<char, 65536> buffer;
  while (!session.is_over()) {
    const auto got = read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw scene::Error(scene::ErrorCode::file_unreadable,
                         "cannot read standard input: " + std::generic_category().message(errno));
    if (got == 0) {
      say(session.finish());
      break;
    }
    session.feed({buffer.data(), static_cast<std::size_t>(got)});
    for (std::string answer = session.answer_next(); !answer.empty(); answer = session.answer_next()) say(answer);
  }
  if (session.is_over()) throw scene::Error(scene::ErrorCode::malformed, session.why_over());
}

int run_serve(const ServeRequest& request) {
  const auto options = request.method.to_reference();
  require_writable_parent(request.socket);
  auto served = served_cells(request.choice);
  const auto store = store_of(served, lists_of(served, options, request.send, "clues serve").lists, request.send);
  const auto header = header_of(served, request.method, store);
  if (!request.socket.empty()) {
    serve_at(request.socket, store, header);
    return fine;
  }
  if (request.binary) {
    answer_packets(store, header);
  } else {
    answer_lines(store, header);
  }
  return fine;
}

}  // namespace

void add_serve_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("serve", "Send clients what becomes visible, cell by cell");
  auto request = std::make_shared<ServeRequest>();
  request->choice.add_to(*command);
  auto* socket = command->add_option("--socket", request->socket, "Make a local socket there, for several clients")
                     ->type_name("PATH");
  command->add_flag("--binary", request->binary, "On standard input and output: packets in place of lines")
      ->excludes(socket);
  request->send.add_to(*command);
  request->method.add_to(*command);
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Prints a header, and answers each request, to enter a cell or to take up a route, with the messages "
          "of that step\n"
          "  (docs/delta.md). What is seen from the cell comes first; what is seen from cells within the "
          "horizon comes\n"
          "  after the viewer has entered. At a socket (always in packets) it serves until it is interrupted.\n"
          "  `clues conform --stream-server` puts routes to such programs; `clues walk --connect` is a "
          "client.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues conform --stream-server 'clues serve town.obj --cells grid:2x2x1:box:0,0,1,4,4,2' --scene town.obj "
      "--cells grid:2x2x1:box:0,0,1,4,4,2\n"
      "  clues serve level.bsp --bake level.bake --horizon 1 --socket level.sock\n"
      "  clues serve level.bsp --bake level.bake --hierarchy 3 --contours --socket level.sock\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input, or what is no request   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_serve(*request); });
}

}  // namespace clues::app
