// clues conform --stream: somebody's server and client, judged by the messages between them (D25).
#pragma once

#include <string>

#include "app/stream/routes.h"
#include "app/stream/served_cells.h"

namespace clues::app {

struct ConformStreamRequest {
  std::string stream, server;  // one of them
  CellsChoice choice;
  RouteChoice route;  // of the server

  bool asked() const { return !stream.empty() || !server.empty(); }
};

// Exit code.
int run_conform_stream(const ConformStreamRequest& request);

}  // namespace clues::app
