#include "validate/stream/conform_server.h"

#include <fmt/format.h>

#include "scene/messages/error.h"
#include "validate/processes/child_process.h"

namespace clues::validate {
namespace {

constexpr std::size_t longest_answer = std::size_t{1} << 28;  // bytes

// What came instead of an answer.
struct NoAnswer {
  std::string what;
};

class ServerPipe {
 public:
  ServerPipe(const std::vector<std::string>& command, std::chrono::milliseconds time)
      : program_(command, 0), time_(time) {}

  std::string line(ChildProcess::Clock::time_point deadline) {
    std::string text;
    const auto io = program_.read_line(text, deadline, longest_answer);
    if (io == ChildProcess::Io::ok) return text;
    throw NoAnswer{io == ChildProcess::Io::late       ? "no answer in time"
                   : io == ChildProcess::Io::too_long ? "an answer without end"
                                                      : "the program ended; " + program_.stderr_tail()};
  }

  // The messages of the answer, and how many there were in the session.
  std::uint64_t ask(const scene::StreamRequest& request, const scene::StreamHeader& header,
                    std::vector<scene::StreamMessage>& out) {
    std::string text = scene::to_line(request);
    text.pop_back();
    const auto deadline = ChildProcess::Clock::now() + time_;
    if (program_.write_line(text, deadline) != ChildProcess::Io::ok)
      throw NoAnswer{"the program reads no more; " + program_.stderr_tail()};
    for (std::size_t bytes = 0; bytes <= longest_answer;) {
      const std::string reply = line(deadline);
      bytes += reply.size() + 1;
      if (const auto end = scene::parse_stream_end(reply)) return *end;
      out.push_back(scene::parse_stream_message(reply, "server", header));
    }
    throw NoAnswer{"an answer without end"};
  }

  void finish() { program_.finish(ChildProcess::Clock::now() + time_); }

 private:
  ChildProcess program_;
  std::chrono::milliseconds time_;
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

ServerRun run_stream_server(const std::vector<std::string>& command, const std::vector<std::uint32_t>& route, bool cuts,
                            std::chrono::milliseconds first, std::chrono::milliseconds time) {
  ServerRun run;
  ServerPipe server(command, time);
  try {
    run.stream.header = scene::parse_stream_header(server.line(ChildProcess::Clock::now() + first), "server");
    for (const std::uint32_t cell : route) {
      scene::StreamRequest request;
      request.cell = cell;
      const std::uint64_t end = server.ask(request, run.stream.header, run.stream.messages);
      if (end != run.stream.messages.size()) {
        throw NoAnswer{fmt::format("after cell {} it says that there were {} messages, and there were {}", cell, end,
                                   run.stream.messages.size())};
      }
    }
    if (cuts) cut_everywhere(server, route, run);
  } catch (const NoAnswer& none) {
    run.failed = none.what;
  } catch (const scene::Error& e) {
    run.failed = e.what();
  }
  server.finish();
  return run;
}

}  // namespace clues::validate
