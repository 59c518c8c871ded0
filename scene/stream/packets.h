// D25: a stream in binary ("clues-stream/1", docs/delta.md). Eight bytes that name it, then packets: a length of four
// bytes, a kind of one, and so many bytes less one. All numbers are little-endian. What comes from outside is not
// believed: a length is bounded before anything is read by it, a count must fill its packet to the byte, and numbers are
// below what the header says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/stream/stream_file.h"

namespace clues::scene {

inline constexpr std::string_view stream_magic = "CLUESSTR";
inline constexpr std::uint32_t stream_version = 1;
inline constexpr std::uint32_t most_packet_bytes = std::uint32_t{1} << 30;   // of a packet to a client
inline constexpr std::uint32_t most_request_bytes = std::uint32_t{1} << 20;  // of one to a server

struct Packet {
  std::uint8_t kind = 0;
  std::string body;
};

// Bytes as they come in, cut into packets. Holds what was fed and not taken yet, and no more.
class PacketReader {
 public:
  PacketReader(std::uint32_t most_bytes, std::string where) : most_bytes_(most_bytes), where_(std::move(where)) {}

  void feed(std::string_view bytes) { bytes_.append(bytes); }
  // The eight bytes in front of everything; false: they are not all there. Throws Error malformed where they are others.
  bool take_magic();
  // The next packet; none: it is not all there. Throws Error malformed for a length that none has.
  std::optional<Packet> next();
  bool empty() const { return at_ == bytes_.size(); }

 private:
  std::uint32_t most_bytes_;
  std::string where_;  // for messages
  std::string bytes_;
  std::size_t at_ = 0;
};

// To a client. Throws Error unsupported where a packet would be too long.
std::string to_packet(const StreamHeader& header);  // with the magic bytes in front
std::string to_packet(const StreamMessage& message);
std::string end_packet(std::uint64_t messages);
std::string refusal_packet(std::string_view why);  // the connection ends behind it

// To a server.
std::string to_packet(const StreamRequest& request);

// What a server sends after its header.
struct ServerPacket {
  enum class Kind : std::uint8_t { message, end, refusal };
  Kind kind = Kind::message;
  StreamMessage message;
  std::uint64_t messages = 0;  // end
  std::string why;             // refusal
};

// Throw Error malformed, index_out_of_range, non_finite; unsupported for a stream of another version.
StreamHeader parse_header(const Packet& packet, const std::string& where);
ServerPacket parse_server_packet(const Packet& packet, const std::string& where, const StreamHeader& header);
StreamRequest parse_request(const Packet& packet, const std::string& where, std::uint64_t cells);

// A whole stream of header and messages. Throws as the parts; malformed where it ends within a packet.
Stream parse_packets(std::string_view bytes, const std::string& where);

}  // namespace clues::scene
