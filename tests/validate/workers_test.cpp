// Worker processes: what they return, and what becomes of tasks that crash, throw or do not end.
#include "validate/processes/workers.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace clues::validate {
namespace {

using testing::HasSubstr;

TEST(Workers, ACrashStopsNobodyElse) {
  Workers workers(
      2,
      [](std::uint64_t i) -> std::string {
        if (i == 1) std::abort();
        if (i == 3) std::_Exit(5);
        if (i == 4) throw std::runtime_error("no");
        return std::string(i * 100'000, 'x');
      },
      std::nullopt);
  const auto answers = replies_of(workers, 6, nullptr);
  ASSERT_EQ(answers.size(), 6U);
  for (const std::size_t i : {0, 2, 5}) {
    EXPECT_TRUE(answers[i].finished);
    EXPECT_EQ(answers[i].text.size(), i * 100'000);
  }
  EXPECT_FALSE(answers[1].finished);
  EXPECT_THAT(answers[1].text, HasSubstr("signal 6"));
  EXPECT_THAT(answers[3].text, HasSubstr("exit code 5"));
  EXPECT_FALSE(answers[4].finished);
  EXPECT_EQ(answers[4].text, "no");
}

TEST(Workers, WhatDoesNotEndIsGivenUpAndTheNextTaskIsDone) {
  Workers workers(
      1,
      [](std::uint64_t task) -> std::string {
        volatile std::uint64_t turns = 0;
        while (task == 0) turns = turns + 1;
        if (task == 1) pause();
        return "done";
      },
      std::chrono::seconds(1));
  std::string said[3];
  for (const std::uint64_t task : {0, 1, 2}) {
    workers.start(task);
    std::optional<WorkerReply> reply;
    while (!(reply = workers.wait(std::chrono::milliseconds(100)))) EXPECT_FALSE(workers.idle());
    EXPECT_EQ(reply->task, task);
    EXPECT_EQ(reply->finished, task == 2);
    said[task] = reply->text;
  }
  EXPECT_EQ(said[0], "no end within 1 s of processor time");
  EXPECT_EQ(said[1], "no end within 10 s, and less than 1 s of processor time") << "it waits";
  EXPECT_EQ(said[2], "done");
}

}  // namespace
}  // namespace clues::validate
