// What files and programs say is shown without being obeyed.
#include "scene/messages/printable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/messages/error.h"
#include "scene/messages/percent.h"
#include "scene/messages/shell_word.h"

namespace clues::scene {
namespace {

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("plain \\ text"), "plain \\ text");
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\x0dd");
  EXPECT_EQ(printable("\x1b[2J\x07\x7f"), "\\x1b[2J\\x07\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("gr\xc3\xbc\xc3\x9f"), "gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "\\u{009b}2J");                                                   // CSI as one character
  EXPECT_EQ(printable("\xe2\x80\xae"), "\\u{202e}");                          // right to left
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");                             // no UTF-8, cut short
  EXPECT_EQ(printable("\xc0\xaf\xed\xa0\x80"), "\\xc0\\xaf\\xed\\xa0\\x80");  // overlong; half a surrogate pair
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable_lines("a\nb\x1b"), "a\nb\\x1b");
}

// Found by the targets `vectors` and `store`: a name of two lines went into a message.
TEST(Printable, AnErrorIsOnePrintableLine) {
  EXPECT_STREQ(Error(ErrorCode::malformed, "scene a\nb: no such\x1b[2J").what(), "scene a\\nb: no such\\x1b[2J");
}

TEST(ShellWord, Quotes) {
  EXPECT_EQ(shell_word("a/b-c.off"), "a/b-c.off");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("$(x)"), "'$(x)'");
  EXPECT_EQ(shell_word("-rf"), "'-rf'");
  EXPECT_EQ(shell_word("a\nb'\\\x1b"), "$'a\\012b\\'\\\\\\033'");
}

TEST(Percent, APartOfNothingIsNoNumber) {
  const double huge = std::numeric_limits<double>::infinity();
  EXPECT_EQ(percent(1, 3, 2), "33.33");
  EXPECT_EQ(percent(0, 0, 1), "0.0");
  EXPECT_EQ(percent(huge, huge, 2), "-");
  EXPECT_EQ(percent(1, std::nan(""), 2), "-");
}

}  // namespace
}  // namespace clues::scene
