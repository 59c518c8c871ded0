// What MPI is to clues: processes that were started together and send each other texts. The only source that knows MPI is mpi/mpi_ranks.cpp; it is a module
// of its own, clues_mpi.so, which is loaded where mpirun started the process, so that the program neither needs MPI nor pays for it elsewhere.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace clues::app {

struct RankMessage {
  int from = 0;
  std::string text;
};

class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual int on_this_node() const = 0;              // how many of them
  virtual void send(int to, std::string text) = 0;   // never waits; texts of one sender arrive in order
  virtual std::optional<RankMessage> receive() = 0;  // never waits
  virtual void leave() = 0;                          // when all have called it; then nothing else may be
};

// None where this process was started alone. Throws scene::Error unsupported where it was not, and the module is missing: as many programs as there are
// ranks would work on the same store.
std::unique_ptr<Ranks> joined_ranks();

}  // namespace clues::app
