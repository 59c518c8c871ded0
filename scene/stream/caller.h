// D25: a client's end of a stream in binary, without its connection: which bytes to send, and what has come. A
// connection may be lost at any byte; what had come of a packet is dropped, and the next server, of the same scene,
// cells and options, is asked for the rest of the route.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/stream/packets.h"

namespace clues::scene {

class StreamCaller {
 public:
  // Asks to enter the cell; the answer to what was asked before is there.
  std::string enter(std::uint32_t cell);
  // A new connection: forgets the rest of the old one. The bytes are for the new one, which owes the rest of the answers
  // so far.
  std::string connect();

  // Throws as the parsers of packets.h; bad_argument where the server refuses, or is not one that goes on where the one
  // before stopped (difference_of_messages), or has counted other messages; malformed where it answers something else:
  // the cells that it names have to be those of the route, each in the answer to it.
  void receive(std::string_view bytes);

  bool waits() const { return waits_; }  // for the end of an answer
  const std::optional<StreamHeader>& header() const { return header_; }
  const std::vector<StreamMessage>& messages() const { return messages_; }

 private:
  void take(const Packet& packet);
  void take_message(StreamMessage message);

  PacketReader reader_{most_packet_bytes, "server"};
  bool magic_ = false, greeted_ = false, waits_ = false;
  std::optional<StreamHeader> header_;
  std::vector<std::uint32_t> route_;
  std::size_t entered_ = 0;  // cells of the route that have come
  std::vector<StreamMessage> messages_;
};

}  // namespace clues::scene
