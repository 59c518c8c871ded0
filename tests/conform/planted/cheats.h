// Ways to cheat the runner. In the case that it is about, a cheat knows the answer of `hides-one`, which is unsound, and tries to get something better
// for it, to have another case pay for it, or to leave something behind.
#pragma once

#include <string>

#include "validate/conform/protocol.h"

namespace clues::planted {

bool is_cheat(const std::string& mode);
void cheat(const std::string& mode, const validate::Request& request);

// The reply to 'start' of a cheat that lies there; empty: the usual one.
std::string cheating_start_reply(const std::string& mode);

// What a cheat does when it was told to stop, after cheat() was called.
void cheat_at_the_end(const std::string& mode);

}  // namespace clues::planted
