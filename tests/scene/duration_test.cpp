// What counts as a length of time, and what is said of the rest.
#include "scene/duration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/messages/error.h"

namespace clues::tests {
namespace {

using scene::parse_duration;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

TEST(Duration, SecondsMinutesAndHours) {
  EXPECT_EQ(parse_duration("--time", "90"), seconds(90));
  EXPECT_EQ(parse_duration("--time", "90s"), seconds(90));
  EXPECT_EQ(parse_duration("--time", "10m"), minutes(10));
  EXPECT_EQ(parse_duration("--time", "2h"), hours(2));
  EXPECT_EQ(parse_duration("--time", "0.5"), milliseconds(500));
  EXPECT_EQ(parse_duration("--time", "1.5m"), seconds(90));
  EXPECT_EQ(parse_duration("--time", "0.0001"), milliseconds(1));
  EXPECT_EQ(parse_duration("--time", "24h", hours(24)), hours(24));
}

std::string said_of(const std::string& text) {
  try {
    parse_duration("--time", text, hours(24));
  } catch (const scene::Error& error) {
    EXPECT_EQ(error.code(), scene::ErrorCode::bad_argument);
    return error.what();
  }
  return "nothing";
}

TEST(Duration, TheRestIsRefusedInAShortLine) {
  for (const std::string text :
       {"", "s", "m", "20x", "20 s", " 20", "20ms", "1m30s", "1e3", "nan", "inf", "0x10", "+5", "2H"})
    EXPECT_EQ(said_of(text), "--time " + text + ": is no time; write it as 90 or 90s, 10m, 2h");
  for (const std::string text : {"0", "0s", "-1", "-0.5h", "25h", "86401"})
    EXPECT_EQ(said_of(text), "--time " + text + ": give more than 0, and at most 24h");
  EXPECT_LT(said_of(std::string(400, '9')).size(), 500U);
}

}  // namespace
}  // namespace clues::tests
