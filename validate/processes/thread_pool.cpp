#include "validate/processes/thread_pool.h"

#include <exception>
#include <utility>

namespace clues::validate {

ThreadPool::ThreadPool(int count, std::function<std::string(std::uint64_t)> work) : work_(std::move(work)) {
  for (int i = 0; i < count; ++i) threads_.emplace_back([this] { work_on(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void ThreadPool::start(std::uint64_t task) {
  ++running_;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(task);
  }
  changed_.notify_one();
}

std::optional<WorkerReply> ThreadPool::wait(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  if (!replied_.wait_for(lock, most, [&] { return !replies_.empty(); })) return std::nullopt;
  auto reply = std::move(replies_.front());
  replies_.pop_front();
  --running_;
  return reply;
}

void ThreadPool::work_on() {
  while (true) {
    WorkerReply reply;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return over_ || !waiting_.empty(); });
      if (over_) return;
      reply.task = waiting_.front();
      waiting_.pop_front();
    }
    try {
      reply.text = work_(reply.task);
      reply.finished = true;
    } catch (const std::exception& error) {
      reply.text = error.what();
    }
    const std::lock_guard lock(mutex_);
    replies_.push_back(std::move(reply));
    replied_.notify_one();
  }
}

}  // namespace clues::validate
