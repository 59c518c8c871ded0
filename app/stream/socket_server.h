// Several clients of one store, at a local socket.
#pragma once

#include <filesystem>

#include "reference/streams/stream_session.h"

namespace clues::app {

// Answers until it is interrupted, and takes the socket away then. A client that is slow, or ends in the middle of a
// packet, keeps no other waiting. Throws as scene::listen_at.
void serve_at(const std::filesystem::path& path, const reference::StreamStore& store,
              const scene::StreamHeader& header);

}  // namespace clues::app
