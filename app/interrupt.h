// Ctrl-C as a wish: long runs that keep what they have finish what is begun and end.
#pragma once

#include <atomic>

namespace clues::app {

// From now on SIGINT and SIGTERM set what is returned, and say so on the standard error. The second one ends the program at once.
const std::atomic<bool>& catch_interrupts();

}  // namespace clues::app
