#include "reference/link/link_simulator.h"

#include <algorithm>
#include <random>

#include "reference/link/penetration.h"
#include "scene/stream/packets.h"

namespace clues::reference {
namespace {

using scene::StreamMessage;

constexpr std::uint64_t second = 1000000;

std::uint64_t bytes_of(const std::vector<StreamMessage>& messages) {
  std::uint64_t bytes = 0;
  for (const StreamMessage& message : messages) bytes += scene::to_packet(message).size();
  return bytes;
}

class LinkClock {
 public:
  explicit LinkClock(const Link& link) : link_(link), random_(link.seed) {}

  // A packet that the server has at this time. Returns when it has arrived; lost: when the connection ends.
  struct Arrival {
    std::uint64_t at_us = 0;
    bool lost = false;
  };
  Arrival send(std::uint64_t now_us, std::uint64_t bytes) {
    const std::uint64_t begins = std::max(now_us, free_us_);
    const std::uint64_t takes = (bytes * second + link_.bytes_per_second - 1) / link_.bytes_per_second;
    free_us_ = begins + takes;
    return {free_us_ + link_.latency_us, random_() % second < link_.losses_per_million};
  }
  void reconnect(std::uint64_t now_us) { free_us_ = now_us; }
  // Bytes that are still to go out at this time, rounded up.
  std::uint64_t waiting(std::uint64_t now_us) const {
    const std::uint64_t left = free_us_ - std::min(free_us_, now_us);
    return (left * link_.bytes_per_second + second - 1) / second;
  }

 private:
  const Link& link_;
  std::mt19937_64 random_;
  std::uint64_t free_us_ = 0;  // the sender's end
};

// The coarsest level whose messages go out within this time; 0 where none does.
std::size_t level_in_time(const StreamServer& server, std::uint32_t cell, std::size_t coarsest, std::uint64_t waiting,
                          const Link& link, std::uint64_t time_us) {
  std::vector<std::uint64_t> sizes;
  for (std::size_t level = coarsest + 1; level-- > 0;) {
    StreamServer tried = server;
    sizes.push_back(bytes_of(tried.enter(cell, level)));
  }
  bool late = false;
  const auto microseconds = [](std::uint64_t us) {
    return exact::FT(static_cast<double>(us)) / exact::FT(static_cast<double>(second));
  };
  return coarsest - detail_in_time(sizes, waiting, link.bytes_per_second, exact::FT(0), microseconds(time_us), late);
}

// When the viewer may enter the cell if no packet is lost. `clock` as it is when these messages are to be sent.
std::uint64_t predicted_entry(LinkClock clock, const std::vector<StreamMessage>& due, std::uint64_t now_us) {
  std::uint64_t at_us = now_us;
  for (const StreamMessage& message : due) {
    at_us = clock.send(now_us, scene::to_packet(message).size()).at_us;
    if (message.kind == StreamMessage::Kind::cell) break;
  }
  return at_us;
}

// FIG. 48B: he is at the face at `face_us`, and hears at `told_us` that data come at `data_us` only. When he gets there.
std::uint64_t regulated_face(std::uint64_t face_us, std::uint64_t told_us, std::uint64_t data_us, LinkReport& report) {
  if (data_us <= face_us || told_us >= face_us) return face_us;
  const std::uint64_t way = face_us - told_us;
  constexpr std::uint64_t parts = 1024;
  const std::uint64_t speed = parts * way / (data_us - told_us);
  if (speed == 0) return face_us;  // he stands as well
  const std::uint64_t later_us = told_us + (parts * way + speed - 1) / speed;
  ++report.slowed;
  report.slowed_us += later_us - face_us;
  report.least_speed =
      std::min(report.least_speed, exact::FT(static_cast<double>(speed)) / exact::FT(static_cast<double>(parts)));
  return later_us;
}

}  // namespace

LinkReport walk_over(const StreamStore& store, const std::vector<TimedStep>& steps, const Link& link,
                     std::uint64_t ahead_us, NodeChoice choice, Pace pace) {
  LinkReport report;
  report.steps_on_level.resize(store.coarsest() + 1);
  LinkClock clock(link);
  StreamServer server(store);
  std::vector<std::uint32_t> route;
  std::vector<std::size_t> levels;
  std::uint64_t delay_us = 0, asked_us = 0;
  for (const TimedStep& step : steps) {
    std::uint64_t face_us = step.reached_us + delay_us;
    asked_us = std::max(asked_us, face_us - std::min(face_us, ahead_us));
    route.push_back(step.cell);
    std::uint64_t at_server_us = asked_us + link.latency_us, entered_us = 0;
    levels.push_back(store.coarsest());
    if (choice == NodeChoice::in_time) {
      // He asks for the next cell when he has been in this one, which is not before the face to it.
      const std::uint64_t next_us = face_us + step.stays_us + link.latency_us;
      const std::uint64_t sent_by_us = next_us - std::min(next_us, ahead_us);
      levels.back() = level_in_time(server, step.cell, store.coarsest(), clock.waiting(at_server_us), link,
                                    sent_by_us - std::min(sent_by_us, at_server_us));
    }
    ++report.steps_on_level[levels.back()];
    std::vector<StreamMessage> due = server.enter(step.cell, levels.back());
    if (pace == Pace::regulated) {
      const std::uint64_t slower_us =
          regulated_face(face_us, at_server_us + link.latency_us, predicted_entry(clock, due, at_server_us), report);
      delay_us += slower_us - face_us;
      face_us = slower_us;
    }
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
      due = server.resume(route, report.messages.size(), levels);
      i = 0;
    }
    report.held += server.mirror().size();
    report.seen += store.seen_from(step.cell).size();
    const std::uint64_t stall = entered_us - std::min(entered_us, face_us);
    report.stalls += stall > 0;
    report.stalled_us += stall;
    report.longest_us = std::max(report.longest_us, stall);
    delay_us += stall;
    if (stall > 0 && route.size() > 1) {
      const exact::FT way(static_cast<double>(face_us - asked_us)),
          time(static_cast<double>(face_us - asked_us + stall));
      report.slowest = std::min(report.slowest, speed_in_time(way * way, time, exact::FT(1)));
    }
  }
  return report;
}

}  // namespace clues::reference
