#include "app/cluster/cluster.h"

#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <utility>

#include "scene/messages/error.h"
#include "validate/processes/dispatcher.h"

namespace clues::app {
namespace {

using validate::WorkerReply;
using validate::WorkPool;
using Clock = std::chrono::steady_clock;

// MPI has nothing that waits without burning a processor, which on this node belongs to those who work.
constexpr std::chrono::milliseconds look_up{2}, look_up_at_work{20};

// The first byte of a message: from rank 0
constexpr char question_is = 'q', task_is = 't', leave_now = 'l';
// and to it.
constexpr char places_are = 'p', done_is = 'd', failed_is = 'f', left = 'b';

template <class Number>
std::string with_number(char kind, Number number, const std::string& text) {
  std::string out(1 + sizeof number, kind);
  std::memcpy(out.data() + 1, &number, sizeof number);
  return out + text;
}

template <class Number>
Number number_of(const std::string& text) {
  Number number{};
  if (text.size() < 1 + sizeof number) throw scene::Error(scene::ErrorCode::internal, "a message of a rank is short");
  std::memcpy(&number, text.data() + 1, sizeof number);
  return number;
}

std::string rest_of(const std::string& text) { return text.substr(1 + sizeof(std::uint64_t)); }

class RankPool : public WorkPool {
 public:
  RankPool(Ranks& ranks, std::unique_ptr<WorkPool> own, int places, Cluster::Known known, Cluster::Learn learn)
      : ranks_(ranks), own_(std::move(own)), known_(std::move(known)), learn_(std::move(learn)) {
    dispatcher_.join(0, places);
  }

  bool idle() const override { return dispatcher_.idle(); }
  bool empty() const override { return dispatcher_.empty(); }

  void start(std::uint64_t task) override {
    const std::size_t rank = dispatcher_.give();
    const std::string known = known_ ? known_(task) : std::string();
    if (rank != 0) return ranks_.send(static_cast<int>(rank), with_number(task_is, task, known));
    if (learn_) learn_(task, known);
    own_->start(task);
  }

  std::optional<WorkerReply> wait(std::chrono::milliseconds most) override {
    const auto end = Clock::now() + most;
    do {
      while (auto message = ranks_.receive()) {
        const auto from = static_cast<std::size_t>(message->from);
        if (message->text[0] == places_are) {
          dispatcher_.join(from, number_of<std::int32_t>(message->text));
          return std::nullopt;  // somebody is idle
        }
        dispatcher_.done(from);
        return WorkerReply{number_of<std::uint64_t>(message->text), message->text[0] == done_is, rest_of(message->text),
                           0};
      }
      if (own_->empty()) {
        poll(nullptr, 0, static_cast<int>(std::min(most, look_up).count()));
      } else if (auto reply = own_->wait(std::min(most, look_up))) {
        dispatcher_.done(0);
        return reply;
      }
    } while (Clock::now() < end);
    return std::nullopt;
  }

 private:
  Ranks& ranks_;
  std::unique_ptr<WorkPool> own_;
  Cluster::Known known_;
  Cluster::Learn learn_;
  validate::Dispatcher dispatcher_;
};

}  // namespace

Cluster::Cluster() : ranks_(joined_ranks()) {}

Cluster::~Cluster() {
  if (!ranks_) return;
  if (ranks_->rank() != 0 && std::uncaught_exceptions() > 0) return;
  if (ranks_->rank() != 0) {
    ranks_->send(0, {left});
  } else {
    for (int r = 1; r < ranks_->size(); ++r) ranks_->send(r, {leave_now});
    // What they had to say is taken, or they would wait for ever.
    for (int still = ranks_->size() - 1; still > 0;) {
      const auto message = ranks_->receive();
      if (!message) poll(nullptr, 0, static_cast<int>(look_up.count()));
      if (message && message->text[0] == left) --still;
    }
  }
  ranks_->leave();
}

int Cluster::threads(int asked) const {
  if (asked > 0 || alone()) return asked;
  // mpirun binds ranks to processors of their own, or, where told to, or where there are too few, to none.
  cpu_set_t ours;
  CPU_ZERO(&ours);
  const int all = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  const int mine = sched_getaffinity(0, sizeof ours, &ours) == 0 ? CPU_COUNT(&ours) : all;
  return std::max(1, mine < all ? mine : all / ranks_->on_this_node());
}

std::unique_ptr<WorkPool> Cluster::pool(const std::string& question, std::unique_ptr<WorkPool> own, int places,
                                        Known known, Learn learn) {
  for (int r = 1; r < size(); ++r) ranks_->send(r, question_is + question);
  return std::make_unique<RankPool>(*ranks_, std::move(own), places, std::move(known), std::move(learn));
}

validate::PoolMaker Cluster::pools(OwnPool own, int places) {
  if (alone()) return nullptr;
  return [this, own = std::move(own), places](const std::string& plan, const validate::Work& work) {
    return pool(plan, own(work), places, nullptr, nullptr);
  };
}

validate::Serve Cluster::serves(const std::string& question, OwnPool own, int places, const std::string& otherwise) {
  return [=, this](const std::string& plan, const validate::Work& work) {
    if (plan != question) throw scene::Error(scene::ErrorCode::bad_argument, otherwise);
    const auto pool = own(work);
    serve(*pool, places, nullptr);
  };
}

std::optional<std::string> Cluster::question() {
  while (true) {
    if (const auto message = ranks_->receive())
      return message->text[0] == question_is ? std::optional(message->text.substr(1)) : std::nullopt;
    poll(nullptr, 0, static_cast<int>(look_up.count()));
  }
}

void Cluster::serve(WorkPool& own, int places, const Learn& learn) {
  ranks_->send(0, with_number(places_are, static_cast<std::int32_t>(places), {}));
  for (int busy = 0; true;) {
    while (const auto message = ranks_->receive()) {
      if (message->text[0] == leave_now) return;
      const auto task = number_of<std::uint64_t>(message->text);
      if (learn) learn(task, rest_of(message->text));
      own.start(task);
      ++busy;
    }
    // With no place free nothing is to be heard but the end.
    const auto most = busy == places ? look_up_at_work : look_up;
    if (busy == 0) {
      poll(nullptr, 0, static_cast<int>(most.count()));
    } else if (auto reply = own.wait(most)) {
      --busy;
      ranks_->send(0, with_number(reply->finished ? done_is : failed_is, reply->task, reply->text));
    }
  }
}

}  // namespace clues::app
