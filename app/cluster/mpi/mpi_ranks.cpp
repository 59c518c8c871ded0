// The module clues_mpi.so: texts by MPI. A rank that dies ends the run: that is what mpirun does, and no error is caught here.
#include <mpi.h>

#include <algorithm>
#include <list>
#include <utility>

#include "app/cluster/ranks.h"

namespace clues::app {
namespace {

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm node = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    MPI_Comm_size(node, &on_this_node_);
    MPI_Comm_free(&node);
  }
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int on_this_node() const override { return on_this_node_; }

  void send(int to, std::string text) override {
    forget_what_was_sent();
    auto& s = sending_.emplace_back(Sending{std::move(text), MPI_REQUEST_NULL});
    MPI_Isend(s.text.data(), static_cast<int>(s.text.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD, &s.request);
  }

  std::optional<RankMessage> receive() override {
    forget_what_was_sent();
    int there = 0, bytes = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &status);
    if (!there) return std::nullopt;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    RankMessage message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(bytes), '\0')};
    MPI_Recv(message.text.data(), bytes, MPI_BYTE, message.from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
  }

  void leave() override {
    for (auto& s : sending_) MPI_Wait(&s.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }

 private:
  // A text must stay where it is until it is sent; a list moves nothing.
  struct Sending {
    std::string text;
    MPI_Request request;
  };

  void forget_what_was_sent() {
    sending_.remove_if([](Sending& s) {
      int sent = 0;
      MPI_Test(&s.request, &sent, MPI_STATUS_IGNORE);
      return sent != 0;
    });
  }

  int rank_ = 0, size_ = 1, on_this_node_ = 1;
  std::list<Sending> sending_;
};

}  // namespace
}  // namespace clues::app

extern "C" __attribute__((visibility("default"))) clues::app::Ranks* clues_mpi_ranks() {
  return new clues::app::MpiRanks;
}
