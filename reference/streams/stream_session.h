// One client of a server of streams in binary (D25): bytes in, bytes out, whatever carries them. A client that says what
// no client says is told why, and the session is over; others do not notice.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/streams/stream_server.h"
#include "scene/stream/packets.h"

namespace clues::reference {

class StreamSession {
 public:
  StreamSession(const StreamStore& store, const scene::StreamHeader& header)  // keeps references
      : server_(store), header_(&header) {}

  std::string greeting() const { return scene::to_packet(*header_); }
  void feed(std::string_view bytes) { reader_.feed(bytes); }
  // What to send for the next request that is there as a whole, or for the next cell of a route that is resumed; empty:
  // there is none. One at a time, so that who asks much and takes nothing fills no memory but his own.
  std::string answer_next();
  // The client sends no more, and what it sent is answered: a refusal where that ends inside a request; else empty.
  std::string finish();
  bool is_over() const { return refused_.has_value(); }
  const std::string& why_over() const { return *refused_; }

 private:
  std::string refuse(const std::string& why);
  static std::string said(std::span<const scene::StreamMessage> messages);
  std::string resume_some();

  struct Resumed {
    std::vector<std::uint32_t> route;
    std::uint64_t have = 0;
    std::size_t next = 0;
  };
  StreamServer server_;
  std::optional<Resumed> resumed_;
  const scene::StreamHeader* header_;
  scene::PacketReader reader_{scene::most_request_bytes, "client"};
  std::optional<std::string> refused_;  // why
};

}  // namespace clues::reference
