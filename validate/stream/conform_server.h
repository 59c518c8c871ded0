// Somebody's server of streams, at the other end of a pipe: a route is put to it, its messages are collected for
// judge_stream(), and then it is asked to go on after every message, and after some of them another one that was
// started anew and knows of nothing. docs/delta.md has the lines.
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
  std::uint64_t resumed = 0;        // messages after which the same program sent the rest as it should
  std::vector<std::uint64_t> anew;  // messages after which a new one did
};

// Starts the program, which speaks lines or packets, and has to be of the scene and cells of `about`. Enters the cells
// of the route, one at least, one after the other: each answer has to have one message `cell`, that of its cell. Asks
// the same program to go on after each message of the session, and new ones after the first, the middle and the last
// one, with the part of the route that a client has asked for by then: what comes has to be what came before. A program
// has to say nothing else, and to end with exit status 0 when its input does. Throws scene::Error bad_argument where it
// cannot be started. `time`: for one answer, and to end; the header may take as long as `first`.
ServerRun run_stream_server(const std::vector<std::string>& command, const scene::StreamHeader& about,
                            const std::vector<std::uint32_t>& route, std::chrono::milliseconds first,
                            std::chrono::milliseconds time);

}  // namespace clues::validate
