// clues walk: what a server sends to a viewer on a route through cells (D25), and a client that goes it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/stream/number_between.h"
#include "app/stream/routes.h"
#include "app/stream/served_cells.h"
#include "reference/link/link_simulator.h"
#include "reference/streams/stream_server.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/stream/caller.h"
#include "scene/stream/local_socket.h"
#include "scene/stream/stream_file.h"
#include "validate/stream/judge_stream.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct WalkRequest {
  CellsChoice choice;
  RouteChoice route;
  std::string connect, link, out;
  std::uint64_t routes = 1;
  bool binary = false, in_time = false, regulate = false;
  SendChoice send;
  double pace = 1, ahead = 0;  // seconds
  MethodOptions method;
};

// RATE:LATENCY[:LOSSES:OUTAGE]
reference::Link parse_link(const std::string& text, std::uint64_t seed) {
  std::vector<std::uint64_t> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    std::uint64_t number = 0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, number);
    if (error != std::errc() || stop != text.data() + end || number > 1000000000000)
      throw Error(ErrorCode::bad_argument, "--link " + text + ": give RATE:LATENCY[:LOSSES:OUTAGE], whole numbers");
    numbers.push_back(number);
    at = end + 1;
  }
  if ((numbers.size() != 2 && numbers.size() != 4) || numbers[0] == 0)
    throw Error(ErrorCode::bad_argument, "--link " + text + ": give RATE:LATENCY[:LOSSES:OUTAGE], the rate above 0");
  constexpr std::uint64_t ms = 1000;
  reference::Link link{numbers[0], ms * numbers[1], 0, 0, seed};
  if (numbers.size() == 2) return link;
  if (numbers[2] > 900000)
    throw Error(ErrorCode::bad_argument, "--link " + text + ": of a million packets at most 900000 are lost");
  link.losses_per_million = static_cast<std::uint32_t>(numbers[2]);
  link.outage_us = ms * numbers[3];
  return link;
}

struct WalkFigures {
  std::uint64_t entered = 0, packets = 0, sent = 0, taken = 0, bytes = 0;
  std::uint64_t whole_lists = 0, whole_bytes = 0;  // had each cell's list been sent as a whole
  // With contours, after each step:
  std::uint64_t contours = 0, contour_bytes = 0, held = 0, drawn = 0;
};

// Goes the route at the other end of a socket. When the connection is lost it waits for another server to come.
class WalkingClient {
 public:
  explicit WalkingClient(std::string path) : path_(std::move(path)) {}

  const scene::StreamHeader& header() {
    while (!caller_.header()) pump();
    return *caller_.header();
  }
  std::vector<scene::StreamMessage> enter(std::uint32_t cell) {
    const std::size_t before = caller_.messages().size();
    heard_ = std::chrono::steady_clock::now();
    to_send_ += caller_.enter(cell);
    while (caller_.waits()) pump();
    return {caller_.messages().begin() + static_cast<std::ptrdiff_t>(before), caller_.messages().end()};
  }
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::chrono::seconds longest_silence{60};  // of a server that owes an answer: then it is lost

  void reconnect() {
    constexpr std::chrono::milliseconds patience{10000}, pause{50};
    // From the first connection that was lost on: who takes every call and says nothing is no server either.
    if (!lost_since_) lost_since_ = std::chrono::steady_clock::now();
    const auto deadline = *lost_since_ + (met_ ? patience : pause);
    do {
      if (std::chrono::steady_clock::now() >= deadline)
        throw Error(ErrorCode::bad_argument, path_ + ": no server answers there; start `clues serve --socket`");
      if (tried_++ > 0) std::this_thread::sleep_for(pause);
      socket_ = scene::connect_to(path_);
    } while (!socket_.is_open());
    met_ = true;
    heard_ = std::chrono::steady_clock::now();
    to_send_ = caller_.connect();
  }
  void pump() {
    if (!socket_.is_open()) reconnect();
    auto io = to_send_.empty() ? scene::SocketIo::ok : scene::send_some(socket_, to_send_);
    if (io == scene::SocketIo::ok && to_send_.empty()) {
      std::string bytes;
      io = scene::receive_some(socket_, bytes);
      caller_.receive(bytes);
      if (!bytes.empty()) {
        lost_since_.reset();
        tried_ = 0;
        heard_ = std::chrono::steady_clock::now();
      }
    }
    if (io == scene::SocketIo::later) {
      scene::wait_for(socket_, !to_send_.empty(), std::chrono::seconds(1));
      if (std::chrono::steady_clock::now() - heard_ > longest_silence) io = scene::SocketIo::lost;
    }
    if (io == scene::SocketIo::lost) {
      socket_ = {};
      ++lost_;
    }
  }

  std::string path_, to_send_;
  scene::Descriptor socket_;
  scene::StreamCaller caller_;
  std::uint64_t lost_ = 0;
  std::optional<std::chrono::steady_clock::time_point> lost_since_;  // and nothing was heard
  std::chrono::steady_clock::time_point heard_;                      // the last byte, or what was asked since
  int tried_ = 0;                                                    // to connect, since then
  bool met_ = false;
};

class Walk {
 public:
  Walk(const WalkRequest& request, const ServedCells& served)
      : request_(request),
        served_(served),
        sent_(request.connect.empty() ? lists_of(served, request.method.to_reference(), request.send, "clues walk")
                                      : SentLists{served.lists, {}}),
        store_(store_of(served, sent_.lists, request.send)),
        header_(request.connect.empty() ? header_of(served, request.method, store_) : served.header) {}

  void go(const std::vector<std::uint32_t>& route) {
    reference::StreamServer server(store_);
    validate::StreamClient client(served_.scene.mesh);
    for (const std::uint32_t cell : route) {
      const auto messages = server.enter(cell);
      add(cell, messages);
      if (!request_.send.contours) continue;
      for (const auto& message : messages) client.apply(message);
      const auto drawn = client.drawn_in(cell);
      figures_.held += client.size();
      figures_.drawn += drawn ? drawn->size() : client.size();
    }
  }
  std::uint64_t go_connected(const std::vector<std::uint32_t>& route) {
    WalkingClient client(request_.connect);
    if (const auto other = difference(served_.header, client.header()); !other.empty())
      throw Error(ErrorCode::bad_argument, request_.connect + ": serves " + other);
    header_ = client.header();
    for (const std::uint32_t cell : route) add(cell, client.enter(cell));
    return client.lost();
  }
  // The same over a link, in simulated time.
  reference::LinkReport go_over(const std::vector<std::uint32_t>& route) const {
    constexpr double second = 1e6;
    const auto stays = static_cast<std::uint64_t>(second * request_.pace);
    std::vector<reference::TimedStep> steps;
    for (const std::uint32_t cell : route)
      steps.push_back(
          {static_cast<std::uint64_t>(second * request_.pace * static_cast<double>(steps.size() + 1)), cell, stays});
    return reference::walk_over(store_, steps, parse_link(request_.link, request_.route.seed),
                                static_cast<std::uint64_t>(second * request_.ahead),
                                request_.in_time ? reference::NodeChoice::in_time : reference::NodeChoice::coarsest,
                                request_.regulate ? reference::Pace::regulated : reference::Pace::steady);
  }
  const WalkFigures& figures() const { return figures_; }
  const std::string& dropped() const { return sent_.dropped; }
  std::string text() const { return (request_.binary ? to_packet(header_) : to_line(header_)) + text_; }

 private:
  std::string written(const scene::StreamMessage& message) const {
    return request_.binary ? scene::to_packet(message) : scene::to_line(message);
  }
  void add(std::uint32_t cell, const std::vector<scene::StreamMessage>& messages) {
    ++figures_.entered;
    for (const auto& message : messages) {
      const std::string bytes = written(message);
      ++figures_.packets;
      figures_.sent += message.plus.size();
      figures_.taken += message.minus.size();
      figures_.bytes += bytes.size();
      if (message.kind == scene::StreamMessage::Kind::contours) {
        figures_.contours += message.contours.size();
        figures_.contour_bytes += bytes.size();
      }
      if (!request_.out.empty()) text_ += bytes;
    }
    if (sent_.lists.empty()) return;  // the server knows them
    const auto& list = sent_.lists[cell];
    auto [at, is_new] = whole_.try_emplace(cell, 0);
    if (is_new) at->second = written(reference::DisplayList(served_.scene.mesh).plus(list)).size();
    figures_.whole_lists += list.size();
    figures_.whole_bytes += at->second;
  }

  const WalkRequest& request_;
  const ServedCells& served_;
  SentLists sent_;
  reference::StreamStore store_;
  scene::StreamHeader header_;                    // that of the server, where it is another program
  std::map<std::uint32_t, std::uint64_t> whole_;  // bytes of a cell's list
  WalkFigures figures_;
  std::string text_;
};

int run_walk(const WalkRequest& request) {
  if (request.route.at_random() == (request.route.steps == 0))
    throw Error(ErrorCode::bad_argument, "give one of --route, --camera and --steps (see `clues walk --help`)");
  if (request.routes != 1 && (!request.route.at_random() || !request.out.empty() || !request.connect.empty()))
    throw Error(ErrorCode::bad_argument, "--routes is for --steps, and for figures alone");
  if (request.ahead > request.pace * static_cast<double>(request.send.horizon))
    throw Error(ErrorCode::bad_argument,
                "--ahead: at most --pace times --horizon; from farther behind, what he still sees would go");
  if (request.in_time && request.send.levels == 0)
    throw Error(ErrorCode::bad_argument, "--in-time needs a --hierarchy of 1 or more: it chooses among its nodes");
  if (request.regulate && request.ahead == 0)
    throw Error(ErrorCode::bad_argument, "--regulate needs --ahead: at the face there is no way left to go slower on");
  if (!request.connect.empty() && (!request.link.empty() || !request.send.is_default()))
    throw Error(ErrorCode::bad_argument,
                "--connect: the link is a real one, and the server decides what it sends; leave out --link, --horizon, "
                "--hierarchy, --contours, --drop and --drop-area");
  if (!request.link.empty()) parse_link(request.link, 1);
  require_writable_parent(request.out);
  require_apart({&request.out}, {&request.choice.scene, &request.route.route, &request.route.camera,
                                 &request.choice.cells, &request.choice.bake, &request.choice.lists});
  const ServedCells served = served_cells(request.choice);
  RouteChoice choice = request.route;
  auto route = choice.take(served);
  Walk walk(request, served);
  std::uint64_t lost = 0;
  if (!request.connect.empty()) {
    lost = walk.go_connected(route);
  } else {
    walk.go(route);
  }
  for (std::uint64_t i = 1; i < request.routes; ++i) {
    ++choice.seed;
    choice.first = static_cast<std::uint32_t>(i % served.cells.size());
    walk.go(choice.take(served));
  }
  if (!request.out.empty()) scene::write_file_atomically(request.out, walk.text());
  const WalkFigures& f = walk.figures();
  const bool lists_known = f.whole_bytes > 0;  // not to a client of somebody else's server
  print(
      fmt::format("cells entered  messages  triangles sent  taken away      bytes{}\n"
                  "{:>13}  {:>8}  {:>14}  {:>10}  {:>9}{}\n",
                  lists_known ? "  whole lists: triangles      bytes" : "", f.entered, f.packets, f.sent, f.taken,
                  f.bytes, lists_known ? fmt::format("  {:>22}  {:>9}", f.whole_lists, f.whole_bytes) : ""));
  if (request.send.contours) {
    const auto mean = [&f](std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(f.entered); };
    print(
        fmt::format("contours: {}, {} bytes; after a step {:.1f} triangles are held, {:.1f} are drawn, the cell lists "
                    "{:.1f}\n",
                    f.contours, f.contour_bytes, mean(f.held), mean(f.drawn), mean(f.whole_lists)));
  }
  if (!walk.dropped().empty()) print(walk.dropped());
  if (!request.link.empty()) {
    const auto over = walk.go_over(choice.take(served));
    constexpr double second = 1e6;
    print(fmt::format("over the link: {} packets, {} bytes, {} losses; {} stalls, {:.3f} s in all, {:.3f} s at most\n",
                      over.packets, over.bytes, over.losses, over.stalls, static_cast<double>(over.stalled_us) / second,
                      static_cast<double>(over.longest_us) / second));
    if (request.regulate)
      print(fmt::format("regulated: {} steps slower, at {:.3f} of his speed at the least, {:.3f} s longer in all\n",
                        over.slowed, CGAL::to_double(over.least_speed), static_cast<double>(over.slowed_us) / second));
    if (over.slowest < 1)
      print(fmt::format("at {:.3f} of his speed from where he asks on he would not stand still behind the first cell\n",
                        CGAL::to_double(over.slowest)));
    const auto steps = std::accumulate(over.steps_on_level.begin(), over.steps_on_level.end(), std::uint64_t{0});
    print(fmt::format("held after a step: {:.1f} triangles, of which the cell lists {:.1f}\n",
                      static_cast<double>(over.held) / static_cast<double>(steps),
                      static_cast<double>(over.seen) / static_cast<double>(steps)));
    if (request.in_time)
      print("steps by level of the hierarchy: " + fmt::format("{}\n", fmt::join(over.steps_on_level, " ")));
  }
  if (lost > 0) print(fmt::format("the connection was lost {} times, and taken up again\n", lost));
  return fine;
}

}  // namespace

void add_walk_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("walk", "What a server sends to a viewer who goes from cell to cell");
  auto request = std::make_shared<WalkRequest>();
  request->choice.add_to(*command);
  request->route.add_to(*command, "So many steps at random, from cell 0 on");
  command
      ->add_option("--routes", request->routes,
                   "Figures of so many random routes, with seeds from --seed on, from each cell in turn")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  request->send.add_to(*command);
  command->add_option("--connect", request->connect, "Go the route as a client of `clues serve --socket PATH`")
      ->type_name("PATH");
  auto* link = command
                   ->add_option("--link", request->link,
                                "Simulate a link: bytes a second, latency in ms, packets lost of a million with their "
                                "connection, ms until there is another")
                   ->type_name("RATE:LATENCY[:LOSSES:OUTAGE]");
  command->add_option("--pace", request->pace, "Seconds in each cell, for --link (default: 1)")
      ->type_name("S")
      ->needs(link)
      ->check(number_between(0, 1e6));
  command->add_option("--ahead", request->ahead, "Ask for a cell so many seconds before, for --link (default: 0)")
      ->type_name("S")
      ->needs(link)
      ->check(number_between(0, 1e6));
  command
      ->add_flag("--in-time", request->in_time,
                 "With --hierarchy and --link: of the nodes of a cell the coarsest that is sent in time")
      ->needs(link);
  command
      ->add_flag("--regulate", request->regulate,
                 "With --link and --ahead: the viewer goes slower where data would be late, so that he need not stand")
      ->needs(link);
  command->add_flag("--binary", request->binary, "Packets in place of lines, in the file and in the figures");
  request->method.add_to(*command);
  command->add_option("-o,--out", request->out, "The messages (docs/delta.md)")->type_name("FILE");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Writes down the messages of a server: what becomes visible is sent before the viewer enters a cell, what "
          "is not\n"
          "  visible any more is taken away afterwards. `clues conform --stream` judges such files, whoever made "
          "them.\n"
          "  With --connect, another program is the server. When it is lost, the route is taken up with the next one "
          "that\n"
          "  listens there, within ten seconds; nothing is sent twice. A server that says nothing for a minute is "
          "lost.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues walk town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 --steps 10 -o walk.stream.jsonl\n"
      "  clues walk town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 --camera walk:0.5,0.5,1.5:3.5,3.5,1.5 --binary -o "
      "walk.stream\n"
      "  clues walk town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 --steps 10 --horizon 1 --link 100000:50:10000:500 "
      "--ahead 0.2\n"
      "  clues walk town.obj --cells grid:4x4x1:box:0,0,1,4,4,2 --steps 10 --hierarchy 2 --link 20000:50 --in-time\n"
      "  clues walk town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 --steps 10 --horizon 1 --link 2000:50 --ahead 0.2 "
      "--regulate\n"
      "  clues walk town.obj --cells grid:4x4x1:box:0,0,1,4,4,2 --steps 10 --hierarchy 2 --contours -o "
      "drawn.stream.jsonl\n"
      "  clues conform --stream walk.stream.jsonl --scene town.obj --cells grid:2x2x1:box:0,0,1,4,4,2\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input, or no server   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_walk(*request); });
}

}  // namespace clues::app
