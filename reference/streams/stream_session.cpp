#include "reference/streams/stream_session.h"

#include <algorithm>

#include "scene/messages/error.h"

namespace clues::reference {

std::string StreamSession::answer_next() {
  if (is_over()) return {};
  try {
    if (resumed_) return resume_some();
    const auto packet = reader_.next();
    if (!packet) return {};
    const auto request = scene::parse_request(*packet, "client", header_->cell_count);
    if (!request.resumes) {
      const std::string bytes = said(server_.enter(request.cell));
      return bytes + scene::end_packet(server_.messages());
    }
    server_.restart();
    resumed_ = Resumed{request.route, request.have, 0};
    return resume_some();
  } catch (const scene::Error& e) {
    return refuse(e.what());
  }
}

std::string StreamSession::finish() {
  if (is_over() || reader_.empty()) return {};
  return refuse("client: the input ends inside a request");
}

std::string StreamSession::refuse(const std::string& why) {
  refused_ = why;
  return scene::refusal_packet(why);
}

std::string StreamSession::said(std::span<const scene::StreamMessage> messages) {
  std::string bytes;
  for (const auto& message : messages) bytes += scene::to_packet(message);
  return bytes;
}

std::string StreamSession::resume_some() {
  auto& [route, have, next] = *resumed_;
  std::string bytes;
  while (bytes.empty() && next < route.size()) {
    const std::uint64_t before = server_.messages();
    const auto messages = server_.enter(route[next++]);
    const auto known = have > before ? std::min<std::uint64_t>(have - before, messages.size()) : 0;
    bytes = said(std::span(messages).subspan(static_cast<std::size_t>(known)));
  }
  if (next < route.size()) return bytes;
  server_.require_said(have);
  resumed_.reset();
  return bytes + scene::end_packet(server_.messages());
}

}  // namespace clues::reference
