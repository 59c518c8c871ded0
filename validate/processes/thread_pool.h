// Tasks by threads of this process, which share the scene.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "validate/processes/work_pool.h"

namespace clues::validate {

class ThreadPool : public WorkPool {
 public:
  // Each of `count` threads does `work`; what that throws becomes a reply that is not finished.
  ThreadPool(int count, std::function<std::string(std::uint64_t task)> work);
  ~ThreadPool() override;  // what is begun is finished

  bool idle() const override { return running_ < threads_.size(); }
  bool empty() const override { return running_ == 0; }
  void start(std::uint64_t task) override;
  std::optional<WorkerReply> wait(std::chrono::milliseconds most) override;

 private:
  void work_on();

  std::function<std::string(std::uint64_t)> work_;
  std::mutex mutex_;
  std::condition_variable changed_, replied_;
  std::deque<std::uint64_t> waiting_;
  std::deque<WorkerReply> replies_;
  bool over_ = false;
  std::size_t running_ = 0;  // of the caller's thread: started and not taken back
  std::vector<std::thread> threads_;
};

}  // namespace clues::validate
