// Somebody's server of streams, at the other end of a pipe: a route is put to it, its messages are collected for
// judge_stream(), and then the connection is cut after every message and taken up again. docs/delta.md has the lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/stream/stream_file.h"

namespace clues::validate {

struct ServerRun {
  scene::Stream stream;
  std::string failed;  // not empty: the program did not answer as it should; the messages up to there are in `stream`
  std::uint64_t resumed = 0;  // cuts after which the rest came as it should
};

// Starts the program, which speaks lines or packets, enters the cells of the route one after the other, and asks it to go
// on after each message of the session: what comes has to be what came before. Throws scene::Error bad_argument where it
// cannot be started. `time`: for one answer; the header may take as long as `first`.
ServerRun run_stream_server(const std::vector<std::string>& command, const std::vector<std::uint32_t>& route,
                            std::chrono::milliseconds first, std::chrono::milliseconds time);

}  // namespace clues::validate
