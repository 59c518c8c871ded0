#include "scene/stream/packets.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/messages/error.h"
#include "scene/stream/varints.h"

namespace clues::scene {
namespace {

// To a client, and from 16 on to a server.
struct PacketKind {
  enum : std::uint8_t {
    header = 0,
    plus = 1,
    cell = 2,
    minus = 3,
    end = 4,
    refusal = 5,
    contours = 6,
    enter = 16,
    resume = 17
  };
};

class PacketWriter {
 public:
  explicit PacketWriter(std::uint8_t kind) { bytes_.assign({'\0', '\0', '\0', '\0', static_cast<char>(kind)}); }

  void u32(std::uint32_t x) { number(x, 4); }
  void u64(std::uint64_t x) { number(x, 8); }
  void f64(double x) { number(std::bit_cast<std::uint64_t>(x), 8); }
  void raw(std::string_view text) { bytes_.append(text); }
  void count(std::size_t n) { u32(static_cast<std::uint32_t>(n)); }  // too many make the packet too long
  void text(std::string_view text) {
    count(text.size());
    raw(text);
  }
  std::string done() {
    const std::size_t length = bytes_.size() - 4;
    if (length > most_packet_bytes)
      throw Error(ErrorCode::unsupported, fmt::format("a packet of {} bytes is too long; take smaller cells", length));
    for (std::size_t i = 0; i < 4; ++i) bytes_[i] = static_cast<char>(length >> (8 * i) & 0xffU);
    return std::move(bytes_);
  }

 private:
  void number(std::uint64_t x, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<char>(x >> (8 * i) & 0xffU));
  }

  std::string bytes_;
};

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t x = 0;
  for (std::size_t i = 0; i < size; ++i) x |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return x;
}

class PacketBody {
 public:
  PacketBody(const Packet& packet, const std::string& where) : rest_(packet.body), where_(where) {}

  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::malformed, where_ + ": " + what); }

  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  double f64() {
    const double x = std::bit_cast<double>(number(8));
    if (!std::isfinite(x)) throw Error(ErrorCode::non_finite, where_ + ": a coordinate is no finite number");
    return x;
  }
  std::uint32_t number_from(std::uint64_t from, std::uint64_t below, const char* what) {
    const std::uint32_t x = u32();
    if (below == 0)
      throw Error(ErrorCode::index_out_of_range, fmt::format("{}: {} {}: there is none", where_, what, x));
    if (x < from || x >= below)
      throw Error(ErrorCode::index_out_of_range,
                  fmt::format("{}: {} {} is not {} to {}", where_, what, x, from, below - 1));
    return x;
  }
  // So many items of so many bytes each are still there.
  std::uint32_t count(std::size_t bytes_each) {
    const std::uint32_t n = u32();
    if (n > rest_.size() / bytes_each) fail(fmt::format("a packet of {} items is cut short", n));
    return n;
  }
  std::string text() {
    const std::uint32_t n = count(1);
    std::string text(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return text;
  }
  void require(std::string_view bytes, const char* what) {
    if (!rest_.starts_with(bytes)) fail(what);
    rest_.remove_prefix(bytes.size());
  }
  bool done() const { return rest_.empty(); }
  void finish() const {
    if (!rest_.empty()) fail(fmt::format("a packet has {} bytes too many", rest_.size()));
  }

 private:
  std::uint64_t number(std::size_t size) {
    if (rest_.size() < size) fail("a packet is cut short");
    const std::uint64_t x = number_at(rest_, 0, size);
    rest_.remove_prefix(size);
    return x;
  }

  std::string_view rest_;
  const std::string& where_;
};

// Whether something stands behind the cells.
bool says_more(const StreamHeader& about) { return about.mode != "sheet" || !about.lists_sha256.empty(); }

constexpr std::uint64_t all_slots = std::uint64_t{1} << 32;

StreamMessage plus_of(PacketBody& body, const StreamHeader& about) {
  StreamMessage message;
  message.kind = StreamMessage::Kind::plus;
  for (std::uint32_t n = body.count(28); n > 0; --n) {
    StreamVertex v{body.number_from(1, all_slots, "the slot of a vertex"), {}};
    for (double& x : v.at) x = body.f64();
    message.vertices.push_back(v);
  }
  for (std::uint32_t n = body.count(20); n > 0; --n) {
    StreamTriangle t{
        body.number_from(0, about.scene_triangles, "the triangle"), body.number_from(1, all_slots, "the slot"), {}};
    for (auto& corner : t.corners) corner = body.number_from(1, all_slots, "the slot of a vertex");
    message.plus.push_back(t);
  }
  return message;
}

StreamMessage minus_of(PacketBody& body, const StreamHeader& about) {
  StreamMessage message;
  message.kind = StreamMessage::Kind::minus;
  for (std::uint32_t n = body.count(4); n > 0; --n)
    message.minus.push_back(body.number_from(0, about.scene_triangles, "the triangle"));
  for (std::uint32_t n = body.count(4); n > 0; --n)
    message.unused.push_back(body.number_from(1, all_slots, "the slot of a vertex"));
  return message;
}

StreamMessage contours_of(PacketBody& body, const StreamHeader& about, const std::string& where) {
  StreamMessage message;
  message.kind = StreamMessage::Kind::contours;
  std::uint64_t from = 0;
  for (std::uint32_t n = body.count(8); n > 0; --n) {
    CellContour contour{body.number_from(from, about.cell_count, "the cell of a contour"), {}, {}};
    from = contour.cell + std::uint64_t{1};
    const std::string bytes = body.text();
    VarintReader in(bytes, where);
    read_ascending(in, edges_of(about) / 3, contour.seeds);
    read_ascending(in, edges_of(about), contour.boundary);
    if (!in.done()) in.fail("a contour has bytes too many");
    message.contours.push_back(std::move(contour));
  }
  return message;
}

}  // namespace

bool PacketReader::take_magic() {
  const std::string_view rest = std::string_view(bytes_).substr(at_);
  const std::size_t there = std::min(rest.size(), stream_magic.size());
  if (rest.substr(0, there) != stream_magic.substr(0, there))
    throw Error(ErrorCode::malformed, where_ + ": is no stream, which begins with CLUESSTR");
  if (there < stream_magic.size()) return false;
  at_ += there;
  return true;
}

std::optional<Packet> PacketReader::next() {
  const std::size_t there = bytes_.size() - at_;
  if (there < 4) return std::nullopt;
  const std::uint64_t length = number_at(bytes_, at_, 4);
  if (length == 0 || length > most_bytes_)
    throw Error(ErrorCode::malformed,
                fmt::format("{}: a packet of {} bytes, which is not 1 to {}", where_, length, most_bytes_));
  if (there - 4 < length) return std::nullopt;
  Packet packet{static_cast<std::uint8_t>(bytes_[at_ + 4]), bytes_.substr(at_ + 5, length - 1)};
  at_ += 4 + length;
  if (at_ > bytes_.size() / 2) {
    bytes_.erase(0, at_);
    at_ = 0;
  }
  return packet;
}

std::string to_packet(const StreamHeader& about) {
  PacketWriter out(PacketKind::header);
  out.u32(stream_version);
  out.u64(about.scene_triangles);
  out.u64(about.cell_count);
  out.text(about.scene_sha256);
  out.text(about.cells);
  if (says_more(about)) {
    out.text(about.mode);
    out.text(about.lists_sha256);
  }
  return std::string(stream_magic) + out.done();
}

std::string to_packet(const StreamMessage& message) {
  if (message.kind == StreamMessage::Kind::cell) {
    PacketWriter out(PacketKind::cell);
    out.u32(message.cell);
    return out.done();
  }
  if (message.kind == StreamMessage::Kind::plus) {
    PacketWriter out(PacketKind::plus);
    out.count(message.vertices.size());
    for (const auto& v : message.vertices) {
      out.u32(v.slot);
      for (const double x : v.at) out.f64(x);
    }
    out.count(message.plus.size());
    for (const auto& t : message.plus) {
      for (const std::uint32_t x : {t.triangle, t.slot, t.corners[0], t.corners[1], t.corners[2]}) out.u32(x);
    }
    return out.done();
  }
  if (message.kind == StreamMessage::Kind::contours) {
    PacketWriter out(PacketKind::contours);
    out.count(message.contours.size());
    for (const CellContour& contour : message.contours) {
      out.u32(contour.cell);
      VarintWriter packed;
      write_ascending(contour.seeds, packed);
      write_ascending(contour.boundary, packed);
      out.text(packed.bytes);
    }
    return out.done();
  }
  PacketWriter out(PacketKind::minus);
  out.count(message.minus.size());
  for (const std::uint32_t t : message.minus) out.u32(t);
  out.count(message.unused.size());
  for (const std::uint32_t slot : message.unused) out.u32(slot);
  return out.done();
}

std::string end_packet(std::uint64_t messages) {
  PacketWriter out(PacketKind::end);
  out.u64(messages);
  return out.done();
}

std::string refusal_packet(std::string_view why) {
  PacketWriter out(PacketKind::refusal);
  out.text(why);
  return out.done();
}

std::string to_packet(const StreamRequest& request) {
  if (!request.resumes) {
    PacketWriter out(PacketKind::enter);
    out.u32(request.cell);
    return out.done();
  }
  PacketWriter out(PacketKind::resume);
  out.u64(request.have);
  out.count(request.route.size());
  for (const std::uint32_t c : request.route) out.u32(c);
  return out.done();
}

StreamHeader parse_header(const Packet& packet, const std::string& where) {
  PacketBody body(packet, where);
  if (packet.kind != PacketKind::header) body.fail("a stream begins with a header");
  const std::uint32_t version = body.u32();
  if (version != stream_version)
    throw Error(ErrorCode::unsupported, fmt::format("{}: a stream of version {}; this program reads version {}", where,
                                                    version, stream_version));
  StreamHeader about;
  about.scene_triangles = body.u64();
  about.cell_count = body.u64();
  about.scene_sha256 = body.text();
  about.cells = body.text();
  if (!body.done()) {
    about.mode = body.text();
    about.lists_sha256 = body.text();
    if (about.mode != "sheet" && about.mode != "solid") body.fail("the mode must be sheet or solid");
    if (!says_more(about)) body.fail("a header ends behind the cells where it says no more");  // it has one form
  }
  body.finish();
  return about;
}

ServerPacket parse_server_packet(const Packet& packet, const std::string& where, const StreamHeader& about) {
  PacketBody body(packet, where);
  ServerPacket out;
  switch (packet.kind) {
    case PacketKind::plus:
      out.message = plus_of(body, about);
      break;
    case PacketKind::minus:
      out.message = minus_of(body, about);
      break;
    case PacketKind::contours:
      out.message = contours_of(body, about, where);
      break;
    case PacketKind::cell:
      out.message.cell = body.number_from(0, about.cell_count, "the cell");
      break;
    case PacketKind::end:
      out.kind = ServerPacket::Kind::end;
      out.messages = body.u64();
      break;
    case PacketKind::refusal:
      out.kind = ServerPacket::Kind::refusal;
      out.why = body.text();
      break;
    default:
      body.fail(fmt::format("a server sends no packet of kind {}", packet.kind));
  }
  body.finish();
  return out;
}

StreamRequest parse_request(const Packet& packet, const std::string& where, std::uint64_t cells) {
  PacketBody body(packet, where);
  StreamRequest request;
  if (packet.kind == PacketKind::enter) {
    request.cell = body.number_from(0, cells, "the cell");
  } else if (packet.kind == PacketKind::resume) {
    request.resumes = true;
    request.have = body.u64();
    for (std::uint32_t n = body.count(4); n > 0; --n) request.route.push_back(body.number_from(0, cells, "the cell"));
  } else {
    body.fail(fmt::format("a client sends no packet of kind {}", packet.kind));
  }
  body.finish();
  return request;
}

Stream parse_packets(std::string_view bytes, const std::string& where) {
  PacketReader reader(most_packet_bytes, where);
  reader.feed(bytes);
  std::optional<Packet> packet;
  if (reader.take_magic()) packet = reader.next();
  if (!packet) throw Error(ErrorCode::malformed, where + ": is cut short in its header");
  Stream stream;
  stream.header = parse_header(*packet, where);
  for (std::uint64_t number = 1; (packet = reader.next()); ++number) {
    const std::string place = fmt::format("{}: packet {}", where, number);
    auto in = parse_server_packet(*packet, place, stream.header);
    if (in.kind != ServerPacket::Kind::message) throw Error(ErrorCode::malformed, place + ": is no message");
    stream.messages.push_back(std::move(in.message));
  }
  if (!reader.empty()) throw Error(ErrorCode::malformed, where + ": is cut short in its last packet");
  return stream;
}

}  // namespace clues::scene
