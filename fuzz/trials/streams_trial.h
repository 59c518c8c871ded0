// The subject "streams": what a server says to a viewer on a route through cells (D25), judged message by message, and taken up again where it was cut.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/trials/trial.h"
#include "reference/streams/stream_server.h"

namespace clues::fuzz {

// What a session said, step by step, and what is in the slots of its mirror after each (DisplayList::bytes).
struct SaidInSteps {
  std::vector<std::vector<scene::StreamMessage>> messages;
  std::vector<std::string> mirrors;
};

// A server. Tests plant mistakes in each.
struct StreamMakers {
  std::function<SaidInSteps(const reference::StreamStore& store, const std::vector<std::uint32_t>& route)> walk;
  // All messages of a route but the first so many.
  std::function<std::vector<scene::StreamMessage>(const reference::StreamStore& store,
                                                  const std::vector<std::uint32_t>& route, std::uint64_t have)>
      resume;
  // The bytes that the server sends for the bytes of a client.
  std::function<std::string(const reference::StreamStore& store, const scene::StreamHeader& header,
                            const std::string& asked)>
      answer;
};

std::unique_ptr<Trial> make_streams_trial();
std::unique_ptr<Trial> make_streams_trial(StreamMakers makers);
StreamMakers our_stream_makers();

}  // namespace clues::fuzz
