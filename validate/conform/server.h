// The implementation's side of the protocol: a loop that answers 'start', 'run' and 'stop' with what it is given.
#pragma once

#include <cstdio>
#include <functional>
#include <istream>

#include "validate/conform/protocol.h"

namespace clues::validate {

// Serves until 'stop' or the end of the input. What `answer` throws becomes a reply: scene::Error a rejected input, any other exception
// errored. Throws ProtocolError for a request that is none, and std::runtime_error when a reply cannot be written.
void serve(std::istream& in, std::FILE* out, const Implementation& about,
           const std::function<Answer(const Request&)>& answer);

}  // namespace clues::validate
