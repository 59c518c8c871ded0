// clues conform --stream: somebody's server and client, judged by the messages between them (D25).
#pragma once

#include <string>

namespace clues::app {

struct ConformStreamRequest {
  std::string stream, scene, cells;
};

// Exit code.
int run_conform_stream(const ConformStreamRequest& request);

}  // namespace clues::app
