#include "validate/stream/conform_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "scene/messages/error.h"
#include "scene/stream/packets.h"
#include "validate/processes/child_process.h"

namespace clues::validate {
namespace {

constexpr std::uint64_t most_header_bytes = std::uint64_t{1} << 20;

// What came instead of an answer.
struct NoAnswer {
  std::string what;
};

// Of an answer to one step: all triangles with their corners, gone and come, and a contour for each cell, take less in
// either form.
std::uint64_t most_bytes_of_a_step(const scene::StreamHeader& header) {
  constexpr std::uint64_t to_spare = std::uint64_t{1} << 20, of_each = 512;
  constexpr std::uint64_t most_cells = std::uint64_t{1} << 32;
  return to_spare + of_each * (scene::most_messages_of_a_step(header) + std::min(header.cell_count, most_cells));
}

// Speaks lines or packets (packets.h), as the program begins.
class ServerPipe {
 public:
  ServerPipe(const std::vector<std::string>& command, std::chrono::milliseconds time)
      : program_(command, 0), time_(time) {}

  const scene::StreamHeader& header(std::chrono::milliseconds time) {
    const auto deadline = ChildProcess::Clock::now() + time;
    most_bytes_ = most_header_bytes;
    text_ = more(deadline);
    binary_ = text_.front() == scene::stream_magic.front();
    if (!binary_) {
      header_ = scene::parse_stream_header(line(deadline), "server");
    } else {
      packets_.feed(std::exchange(text_, {}));
      while (!packets_.take_magic()) packets_.feed(more(deadline));
      header_ = scene::parse_header(packet(deadline), "server");
    }
    return header_;
  }

  // The messages of the answer, at most so many, which is about so many steps.
  std::vector<scene::StreamMessage> ask(const scene::StreamRequest& request, std::uint64_t most, std::size_t steps) {
    require_silence();
    const std::uint64_t of_a_step = most_bytes_of_a_step(header_);
    most_bytes_ = of_a_step * std::min<std::uint64_t>(steps, std::numeric_limits<std::uint64_t>::max() / of_a_step);
    bytes_ = 0;
    const auto deadline = ChildProcess::Clock::now() + time_;
    if (program_.write_bytes(binary_ ? to_packet(request) : to_line(request), deadline) != ChildProcess::Io::ok)
      throw NoAnswer{"the program reads no more; " + program_.stderr_tail()};
    std::vector<scene::StreamMessage> out;
    while (true) {
      auto item =
          binary_ ? scene::parse_server_packet(packet(deadline), "server", header_) : of_line(line(deadline), header_);
      if (item.kind == scene::ServerPacket::Kind::refusal) throw NoAnswer{"the program refuses: " + item.why};
      if (item.kind == scene::ServerPacket::Kind::end) {
        ends_at_ = item.messages;
        return out;
      }
      if (out.size() == most) throw NoAnswer{fmt::format("an answer without end: more than {} messages", most)};
      out.push_back(std::move(item.message));
    }
  }
  // So many messages the program says there were in the session, by its last answer.
  std::uint64_t ends_at() const { return ends_at_; }

  // Nothing more to ask.
  void finish() {
    require_silence();
    const auto end = program_.finish(ChildProcess::Clock::now() + time_);
    require_silence();
    if (end.killed_here || end.killed_keeper || end.exit_code != 0)
      throw NoAnswer{"when there was nothing more to answer the program " + describe(end) + "; " +
                     program_.stderr_tail()};
  }

 private:
  using Deadline = ChildProcess::Clock::time_point;

  static scene::ServerPacket of_line(const std::string& line, const scene::StreamHeader& header) {
    scene::ServerPacket item;
    if (const auto end = scene::parse_stream_end(line)) {
      item.kind = scene::ServerPacket::Kind::end;
      item.messages = *end;
    } else {
      item.message = scene::parse_stream_message(line, "server", header);
    }
    return item;
  }

  // Before a question: what is there was not asked for.
  void require_silence() const {
    if (!text_.empty() || !packets_.empty() || program_.has_unread_output())
      throw NoAnswer{"the program says what was not asked for, behind the end of an answer"};
  }

  std::string more(Deadline deadline) {
    std::string bytes;
    const auto io = program_.read_bytes(bytes, deadline);
    if (io != ChildProcess::Io::ok)
      throw NoAnswer{io == ChildProcess::Io::late ? "no answer in time"
                                                  : "the program ended; " + program_.stderr_tail()};
    bytes_ += bytes.size();
    if (bytes_ > most_bytes_) throw NoAnswer{fmt::format("an answer without end: more than {} bytes", most_bytes_)};
    return bytes;
  }

  std::string line(Deadline deadline) {
    for (std::size_t from = 0; text_.find('\n', from) == std::string::npos;) {
      from = text_.size();
      text_ += more(deadline);
    }
    const auto end = text_.find('\n');
    std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

  scene::Packet packet(Deadline deadline) {
    while (true) {
      if (auto packet = packets_.next()) return std::move(*packet);
      packets_.feed(more(deadline));
    }
  }

  ChildProcess program_;
  std::chrono::milliseconds time_;
  bool binary_ = false;
  scene::StreamHeader header_;
  std::string text_;  // of lines, not taken yet
  scene::PacketReader packets_{scene::most_packet_bytes, "server"};
  std::uint64_t bytes_ = 0, most_bytes_ = 0;  // of this answer
  std::uint64_t ends_at_ = 0;
};

class ServerTrial {
 public:
  ServerTrial(const std::vector<std::string>& command, const std::vector<std::uint32_t>& route,
              std::chrono::milliseconds first, std::chrono::milliseconds time, ServerRun& run)
      : command_(command), route_(route), first_(first), time_(time), run_(run) {}

  void go(ServerPipe& server, const scene::StreamHeader& about) {
    run_.stream.header = server.header(first_);
    if (const auto other = difference(about, run_.stream.header); !other.empty())
      throw NoAnswer{"the program serves " + other};
    for (const std::uint32_t cell : route_) {
      for (auto& message : step(server, cell, all().size())) run_.stream.messages.push_back(std::move(message));
      ends_.push_back(all().size());
    }
    for (std::uint64_t have = 0; have <= all().size(); ++have) {
      resume(server, route_, have);
      ++run_.resumed;
    }
    server.finish();
    for (const std::uint64_t have : std::set<std::uint64_t>{1, (1 + all().size()) / 2, all().size()}) {
      go_on_anew(have);
      run_.anew.push_back(have);
    }
  }

 private:
  const std::vector<scene::StreamMessage>& all() const { return run_.stream.messages; }

  // `before`: messages of the session up to there.
  std::vector<scene::StreamMessage> step(ServerPipe& server, std::uint32_t cell, std::uint64_t before) const {
    scene::StreamRequest request;
    request.cell = cell;
    auto answer = server.ask(request, scene::most_messages_of_a_step(run_.stream.header), 1);
    std::uint64_t entered = 0, others = 0;
    for (const auto& m : answer) {
      if (m.kind == scene::StreamMessage::Kind::cell) ++(m.cell == cell ? entered : others);
    }
    if (entered != 1 || others != 0)
      throw NoAnswer{
          fmt::format("the program did not answer as asked: into cell {} there is one message \"cell\", and "
                      "it sends {}, and {} of other cells",
                      cell, entered, others)};
    if (server.ends_at() != before + answer.size())
      throw NoAnswer{fmt::format("after cell {} it says that there were {} messages, and there were {}", cell,
                                 server.ends_at(), before + answer.size())};
    return answer;
  }

  void require_same(const std::vector<scene::StreamMessage>& said, std::uint64_t from, std::uint64_t to,
                    const std::string& when) const {
    bool same = said.size() == to - from;
    for (std::size_t i = 0; same && i < said.size(); ++i)
      same = scene::to_line(said[i]) == scene::to_line(all()[from + i]);
    if (!same) throw NoAnswer{when + ": what comes then is not the rest"};
  }

  // Asks for the messages of the route behind the first `have`.
  void resume(ServerPipe& server, const std::vector<std::uint32_t>& route, std::uint64_t have) const {
    const std::uint64_t to = ends_[route.size() - 1];
    scene::StreamRequest request;
    request.resumes = true;
    request.route = route;
    request.have = have;
    const std::string when = fmt::format("asked to go on after message {}", have);
    const auto rest = server.ask(request, to - have, route.size());
    require_same(rest, have, to, when);
    if (server.ends_at() != to)
      throw NoAnswer{when +
                     fmt::format(": it says that there were {} messages, and there were {}", server.ends_at(), to)};
  }

  // A program that was not there before, and the client that has so many messages.
  void go_on_anew(std::uint64_t have) const {
    ServerPipe server(command_, time_);
    const std::string when = fmt::format("started anew after message {}", have);
    try {
      if (const auto other = difference_of_messages(run_.stream.header, server.header(first_)); !other.empty())
        throw NoAnswer{"the program serves " + other};
      const auto answered = std::lower_bound(ends_.begin(), ends_.end(), have);
      const auto asked = answered - ends_.begin() + 1;
      resume(server, {route_.begin(), route_.begin() + asked}, have);
      std::uint64_t to = *answered;
      for (auto cell = route_.begin() + asked; cell != route_.end(); ++cell) {
        const auto answer = step(server, *cell, to);
        require_same(answer, to, ends_[static_cast<std::size_t>(cell - route_.begin())], when);
        to += answer.size();
      }
      server.finish();
    } catch (const NoAnswer& none) {
      throw NoAnswer{when + ": " + none.what};
    }
  }

  const std::vector<std::string>& command_;
  const std::vector<std::uint32_t>& route_;
  std::chrono::milliseconds first_, time_;
  ServerRun& run_;
  std::vector<std::uint64_t> ends_;  // of the answers to the cells: messages up to there
};

}  // namespace

ServerRun run_stream_server(const std::vector<std::string>& command, const scene::StreamHeader& about,
                            const std::vector<std::uint32_t>& route, std::chrono::milliseconds first,
                            std::chrono::milliseconds time) {
  ServerRun run;
  ServerPipe server(command, time);
  try {
    ServerTrial(command, route, first, time, run).go(server, about);
  } catch (const NoAnswer& none) {
    run.failed = none.what;
  } catch (const scene::Error& e) {
    run.failed = e.what();
  }
  return run;
}

}  // namespace clues::validate
