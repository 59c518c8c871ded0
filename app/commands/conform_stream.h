// clues conform --stream: somebody's server and client, judged by the messages between them (D25).
#pragma once

#include <cstdint>
#include <string>

namespace clues::app {

struct ConformStreamRequest {
  std::string stream, server;  // one of them
  std::string scene, cells;
  std::string route;  // of the server; empty: `steps` at random
  std::uint64_t steps = 40, seed = 1;

  bool asked() const { return !stream.empty() || !server.empty(); }
};

// Exit code.
int run_conform_stream(const ConformStreamRequest& request);

}  // namespace clues::app
