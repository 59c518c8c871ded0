#include "validate/stream/conform_server.h"

#include <fmt/format.h>

#include "scene/messages/error.h"
#include "scene/stream/packets.h"
#include "validate/processes/child_process.h"

namespace clues::validate {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 28;  // bytes

// What came instead of an answer.
struct NoAnswer {
  std::string what;
};

// Speaks lines or packets (packets.h), as the program begins.
class ServerPipe {
 public:
  ServerPipe(const std::vector<std::string>& command, std::chrono::milliseconds time)
      : program_(command, 0), time_(time) {}

  scene::StreamHeader header(std::chrono::milliseconds time) {
    const auto deadline = ChildProcess::Clock::now() + time;
    read_more(deadline);
    binary_ = text_.front() == scene::stream_magic.front();
    if (!binary_) return scene::parse_stream_header(line(deadline), "server");
    packets_.feed(text_);
    while (!packets_.take_magic()) packets_.feed(more(deadline));
    return scene::parse_header(packet(deadline), "server");
  }

  // The messages of the answer, and how many there were in the session.
  std::uint64_t ask(const scene::StreamRequest& request, const scene::StreamHeader& header,
                    std::vector<scene::StreamMessage>& out) {
    const auto deadline = ChildProcess::Clock::now() + time_;
    if (program_.write_bytes(binary_ ? to_packet(request) : to_line(request), deadline) != ChildProcess::Io::ok)
      throw NoAnswer{"the program reads no more; " + program_.stderr_tail()};
    while (true) {
      auto item =
          binary_ ? scene::parse_server_packet(packet(deadline), "server", header) : of_line(line(deadline), header);
      if (item.kind == scene::ServerPacket::Kind::end) return item.messages;
      if (item.kind == scene::ServerPacket::Kind::refusal) throw NoAnswer{"the program refuses: " + item.why};
      out.push_back(std::move(item.message));
    }
  }

  void finish() { program_.finish(ChildProcess::Clock::now() + time_); }

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

  std::string more(Deadline deadline) {
    std::string bytes;
    const auto io = program_.read_bytes(bytes, deadline);
    if (io == ChildProcess::Io::ok) return bytes;
    throw NoAnswer{io == ChildProcess::Io::late ? "no answer in time" : "the program ended; " + program_.stderr_tail()};
  }
  void read_more(Deadline deadline) { text_ += more(deadline); }

  std::string line(Deadline deadline) {
    for (std::size_t from = 0; text_.find('\n', from) == std::string::npos;) {
      if (text_.size() > longest_line) throw NoAnswer{"an answer without end"};
      from = text_.size();
      read_more(deadline);
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
  std::string text_;  // of lines, not taken yet
  scene::PacketReader packets_{scene::most_packet_bytes, "server"};
};

// From every message on, the same messages as before.
void cut_everywhere(ServerPipe& server, const std::vector<std::uint32_t>& route, ServerRun& run) {
  const auto& all = run.stream.messages;
  for (std::uint64_t have = 0; have <= all.size(); ++have) {
    scene::StreamRequest request;
    request.resumes = true;
    request.route = route;
    request.have = have;
    std::vector<scene::StreamMessage> rest;
    const std::uint64_t end = server.ask(request, run.stream.header, rest);
    bool same = end == all.size() && rest.size() == all.size() - have;
    for (std::size_t i = 0; same && i < rest.size(); ++i)
      same = scene::to_line(rest[i]) == scene::to_line(all[have + i]);
    if (!same) throw NoAnswer{fmt::format("cut after message {}: what comes then is not the rest", have)};
    ++run.resumed;
  }
}

}  // namespace

ServerRun run_stream_server(const std::vector<std::string>& command, const std::vector<std::uint32_t>& route,
                            std::chrono::milliseconds first, std::chrono::milliseconds time) {
  ServerRun run;
  ServerPipe server(command, time);
  try {
    run.stream.header = server.header(first);
    for (const std::uint32_t cell : route) {
      scene::StreamRequest request;
      request.cell = cell;
      const std::uint64_t end = server.ask(request, run.stream.header, run.stream.messages);
      if (end != run.stream.messages.size()) {
        throw NoAnswer{fmt::format("after cell {} it says that there were {} messages, and there were {}", cell, end,
                                   run.stream.messages.size())};
      }
    }
    cut_everywhere(server, route, run);
  } catch (const NoAnswer& none) {
    run.failed = none.what;
  } catch (const scene::Error& e) {
    run.failed = e.what();
  }
  server.finish();
  return run;
}

}  // namespace clues::validate
