// A small process between the caller and a program that is not trusted. Whatever the program starts belongs to the keeper, however it hides from its
// parents (a session of its own, a parent that ends at once): when the program ends, or the caller does, all of it is killed.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>

namespace clues::validate {

struct Wiring {
  int in = -1, out = -1, err = -1;  // of the program
  int failure = -1;                 // an errno comes here when it cannot be executed
  int leash = -1;                   // when the other end is closed, everything is killed
  int report = -1;                  // one KeeperReport comes here, when nothing of the program is left
};

struct KeeperReport {
  int status = 0;  // of the program, as waitpid has it
  rusage usage{};
};

// What a child does between fork and its end: starts words[0], looked up in PATH, and keeps it. Makes system calls only: other threads may have
// held any lock.
[[noreturn]] void keep(char* const* words, const Wiring& wiring, std::uint64_t memory_bytes);

// For the caller, in case that the program kills its keeper: processes without a parent then come to this one.
void adopt_orphans();

// Forks, and knows the child as one of ours. -1: errno says why.
pid_t fork_known();
// To be called before it is waited for.
void forget_known(pid_t pid);
// Kills all children of this process that fork_known did not make.
void kill_orphans();

}  // namespace clues::validate
