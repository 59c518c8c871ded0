#include "reference/delta/stream_session.h"

#include "scene/messages/error.h"

namespace clues::reference {

std::string StreamSession::answer_next() {
  if (over_) return {};
  try {
    const auto packet = reader_.next();
    if (!packet) return {};
    const auto request = scene::parse_request(*packet, "client", header_->cell_count);
    std::string bytes;
    for (const auto& message :
         request.resumes ? server_.resume(request.route, request.have) : server_.enter(request.cell))
      bytes += scene::to_packet(message);
    return bytes + scene::end_packet(server_.messages());
  } catch (const scene::Error& e) {
    over_ = true;
    return scene::refusal_packet(e.what());
  }
}

}  // namespace clues::reference
