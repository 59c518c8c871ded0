#include "scene/stream/caller.h"

#include <fmt/format.h>

#include "scene/messages/error.h"

namespace clues::scene {

std::string StreamCaller::enter(std::uint32_t cell) {
  route_.push_back(cell);
  waits_ = true;
  StreamRequest request;
  request.cell = cell;
  return to_packet(request);
}

std::string StreamCaller::connect() {
  reader_ = PacketReader(most_packet_bytes, "server");
  magic_ = greeted_ = false;
  waits_ = !route_.empty();
  if (route_.empty()) return {};
  StreamRequest request;
  request.resumes = true;
  request.route = route_;
  request.have = messages_.size();
  return to_packet(request);
}

void StreamCaller::receive(std::string_view bytes) {
  reader_.feed(bytes);
  if (!magic_) magic_ = reader_.take_magic();
  if (!magic_) return;
  while (const auto packet = reader_.next()) take(*packet);
}

void StreamCaller::take(const Packet& packet) {
  if (!greeted_) {
    const StreamHeader header = parse_header(packet, "server");
    const std::string other = header_ ? difference_of_messages(*header_, header) : "";
    if (!other.empty())
      throw Error(ErrorCode::bad_argument, "the server is not like the one before, but of " + other + "; begin anew");
    header_ = header;
    greeted_ = true;
    return;
  }
  auto in = parse_server_packet(packet, "server", *header_);
  if (in.kind == ServerPacket::Kind::refusal) throw Error(ErrorCode::bad_argument, "the server refuses: " + in.why);
  if (!waits_) throw Error(ErrorCode::malformed, "the server sends what was not asked for");
  if (in.kind == ServerPacket::Kind::message) {
    take_message(std::move(in.message));
    return;
  }
  if (in.messages != messages_.size())
    throw Error(ErrorCode::bad_argument, fmt::format("the server says that there were {} messages, and {} have come",
                                                     in.messages, messages_.size()));
  if (entered_ != route_.size())
    throw Error(ErrorCode::malformed, fmt::format("the server does not answer as asked: cell {} was asked for, and the "
                                                  "answer ends without it",
                                                  route_[entered_]));
  waits_ = false;
}

void StreamCaller::take_message(StreamMessage message) {
  if (messages_.size() / route_.size() >= most_messages_of_a_step(*header_))
    throw Error(ErrorCode::malformed, "the server sends more messages than there is to say");
  if (message.kind == StreamMessage::Kind::cell) {
    if (entered_ == route_.size() || message.cell != route_[entered_])
      throw Error(
          ErrorCode::malformed,
          fmt::format("the server does not answer as asked: it says that the viewer is in cell {}", message.cell));
    ++entered_;
  }
  messages_.push_back(std::move(message));
}

}  // namespace clues::scene
