#include "validate/processes/work_pool.h"

#include <utility>

namespace clues::validate {

std::vector<WorkerReply> replies_of(WorkPool& pool, std::size_t count,
                                    const std::function<void(std::size_t done)>& progress) {
  std::vector<WorkerReply> replies(count);
  std::size_t next = 0, done = 0;
  while (done < count) {
    while (next < count && pool.idle()) pool.start(next++);
    auto reply = pool.wait(std::chrono::seconds(10));
    if (!reply) continue;
    const auto task = static_cast<std::size_t>(reply->task);
    replies[task] = std::move(*reply);
    ++done;
    if (progress) progress(done);
  }
  return replies;
}

}  // namespace clues::validate
