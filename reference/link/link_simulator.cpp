#include "reference/link/link_simulator.h"

#include <algorithm>
#include <random>

#include "scene/stream/packets.h"

namespace clues::reference {
namespace {

using scene::StreamMessage;

class LinkClock {
 public:
  explicit LinkClock(const Link& link) : link_(link), random_(link.seed) {}

  // A packet that the server has at this time. Returns when it has arrived; lost: when the connection ends.
  struct Arrival {
    std::uint64_t at_us = 0;
    bool lost = false;
  };
  Arrival send(std::uint64_t now_us, std::uint64_t bytes) {
    constexpr std::uint64_t second = 1000000;
    const std::uint64_t begins = std::max(now_us, free_us_);
    const std::uint64_t takes = (bytes * second + link_.bytes_per_second - 1) / link_.bytes_per_second;
    free_us_ = begins + takes;
    return {free_us_ + link_.latency_us, random_() % second < link_.losses_per_million};
  }
  void reconnect(std::uint64_t now_us) { free_us_ = now_us; }

 private:
  const Link& link_;
  std::mt19937_64 random_;
  std::uint64_t free_us_ = 0;  // the sender's end
};

}  // namespace

LinkReport walk_over(const StreamStore& store, const std::vector<TimedStep>& steps, const Link& link,
                     std::uint64_t ahead_us) {
  LinkReport report;
  LinkClock clock(link);
  StreamServer server(store);
  std::vector<std::uint32_t> route;
  std::uint64_t delay_us = 0, asked_us = 0;
  for (const TimedStep& step : steps) {
    const std::uint64_t face_us = step.reached_us + delay_us;
    asked_us = std::max(asked_us, face_us - std::min(face_us, ahead_us));
    route.push_back(step.cell);
    std::vector<StreamMessage> due = server.enter(step.cell);
    std::uint64_t at_server_us = asked_us + link.latency_us, entered_us = 0;
    for (std::size_t i = 0; i < due.size();) {
      const std::uint64_t bytes = scene::to_packet(due[i]).size();
      const auto arrival = clock.send(at_server_us, bytes);
      ++report.packets;
      report.bytes += bytes;
      if (!arrival.lost) {
        if (due[i].kind == StreamMessage::Kind::cell) entered_us = arrival.at_us;
        report.messages.push_back(std::move(due[i++]));
        continue;
      }
      ++report.losses;
      at_server_us = arrival.at_us + link.outage_us + link.latency_us;
      clock.reconnect(at_server_us);
      server = StreamServer(store);
      due = server.resume(route, report.messages.size());
      i = 0;
    }
    const std::uint64_t stall = entered_us - std::min(entered_us, face_us);
    report.stalls += stall > 0;
    report.stalled_us += stall;
    report.longest_us = std::max(report.longest_us, stall);
    delay_us += stall;
  }
  return report;
}

}  // namespace clues::reference
