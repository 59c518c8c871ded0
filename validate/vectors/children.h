// Many independent tasks in child processes: each child has numbers of its own (lazy numbers must not be shared between threads), and
// a task that crashes says so and stops nobody else.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace clues::validate {

struct TaskAnswer {
  bool finished = false;
  std::string text;  // what the task returned; when not finished, how its process ended
};

// Runs task(0), ..., task(count-1) in `jobs` child processes (at least 1) and returns what they say, in the order of the tasks. A task may not
// write to files or to the standard output. `progress` is called here, after each answer. Throws Error internal when no process can be made.
std::vector<TaskAnswer> run_in_children(std::size_t count, int jobs,
                                        const std::function<std::string(std::size_t)>& task,
                                        const std::function<void(std::size_t done)>& progress);

}  // namespace clues::validate
