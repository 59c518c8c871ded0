// Lines of a stream and of what is asked of a server come back as they were written, and what is no such line is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/messages/error.h"
#include "scene/stream/packets.h"
#include "scene/stream/stream_file.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "validate/stream/judge_stream.h"

namespace clues::test {
namespace {

TEST(StreamRequests, ComeBackAsTheyWereWritten) {
  scene::StreamRequest request;
  request.cell = 3;
  EXPECT_EQ(scene::parse_stream_request(scene::to_line(request), "x", 4).cell, 3U);
  EXPECT_THROW(scene::parse_stream_request(scene::to_line(request), "x", 3), scene::Error);
  request.resumes = true;
  request.route = {0, 1};
  request.have = 5;
  const auto back = scene::parse_stream_request(scene::to_line(request), "x", 4);
  EXPECT_TRUE(back.resumes);
  EXPECT_EQ(back.route, request.route);
  EXPECT_EQ(back.have, 5U);
  for (const char* bad :
       {"{}", "[]", "{\"resume\": 3}", "{\"resume\": {\"route\": [9], \"have\": 0}}", "{\"resume\": {\"route\": []}}",
        "{\"resume\": {\"route\": [0], \"have\": 0, \"x\": 1}}", "{\"enter\": 0, \"x\": 1}", "enter"}) {
    EXPECT_THROW(scene::parse_stream_request(bad, "x", 4), scene::Error) << bad;
  }
  EXPECT_EQ(scene::parse_stream_end(scene::stream_end_line(7)), 7U);
  EXPECT_FALSE(scene::parse_stream_end("{\"cell\": 7}"));
}

TEST(StreamFile, ComesBackAsItWasWritten) {
  const tests::TestFolder folder;
  const auto messages = town().stream({0, 1, 2, 5, 4, 3}, 1);
  std::string text = scene::to_line(scene::StreamHeader{"abc", "grid", town().mesh().triangles.size(), 18});
  for (const auto& m : messages) text += scene::to_line(m);
  const auto back = scene::read_stream(folder.write("s.jsonl", text));
  std::string again = scene::to_line(back.header);
  for (const auto& m : back.messages) again += scene::to_line(m);
  EXPECT_EQ(again, text);
}

TEST(StreamFile, MinusZeroKeepsItsSign) {
  const scene::StreamHeader header{"abc", "grid", 10, 2};
  const auto read = scene::parse_stream_message(R"({"plus": [], "vertices": [[1, -0, 0, -0.0]]})", "x", header);
  ASSERT_EQ(read.vertices.size(), 1U);
  EXPECT_TRUE(std::signbit(read.vertices[0].at[0]));
  EXPECT_FALSE(std::signbit(read.vertices[0].at[1]));
  EXPECT_TRUE(std::signbit(read.vertices[0].at[2]));
}

TEST(StreamFile, HeadersSayModeAndListsWhereThereIsSomethingToSay) {
  scene::StreamHeader header{"abc", "grid", 10, 2};
  const std::string plain = scene::to_line(header);
  EXPECT_EQ(plain.find("mode"), std::string::npos);
  EXPECT_EQ(plain.find("lists_sha256"), std::string::npos);
  for (const auto& [mode, lists] : {std::pair("sheet", ""), {"solid", ""}, {"sheet", "cd"}, {"solid", "cd"}}) {
    header.mode = mode;
    header.lists_sha256 = lists;
    for (const auto& back : {scene::parse_stream_header(scene::to_line(header), "x"),
                             scene::parse_packets(scene::to_packet(header), "x").header}) {
      EXPECT_EQ(back.mode, mode);
      EXPECT_EQ(back.lists_sha256, lists);
      EXPECT_TRUE(difference_of_messages(header, back).empty());
    }
  }
  header.mode = "sold";
  EXPECT_THROW(scene::parse_stream_header(scene::to_line(header), "x"), scene::Error);
  EXPECT_THROW(scene::parse_packets(scene::to_packet(header), "x"), scene::Error);
}

TEST(StreamFile, SaysThatThereIsNoCellWhereThereIsNone) {
  try {
    scene::parse_stream_message(R"({"cell": 0})", "x", scene::StreamHeader{"abc", "grid", 10, 0});
    ADD_FAILURE() << "there is no cell 0";
  } catch (const scene::Error& e) {
    EXPECT_STREQ(e.what(), "x: the cell 0: there is none");
  }
}

TEST(StreamFile, RefusesWhatIsNone) {
  const tests::TestFolder folder;
  const std::string header = scene::to_line(scene::StreamHeader{"abc", "grid", 10, 2});
  for (const std::string& bad :
       {std::string(), std::string("{}\n"), std::string("{\"cell\": 0}\n"), header + "{\"cell\": 2}\n",
        header + "{\"cell\": -1}\n", header + "{\"plus\": []}\n", header + "{\"minus\": [10], \"unused\": []}\n",
        header + "{\"plus\": [[0,0,1,2,3]], \"vertices\": []}\n", header + "nonsense\n", header + "[1]\n",
        header + "{\"plus\": [[0,1,1,2,3]], \"vertices\": [[1,1e999,0,0]]}\n",
        header + "{\"plus\": [[0,1,1,2]], \"vertices\": []}\n", header + "{\"minus\": [], \"unused\": [0]}\n"}) {
    EXPECT_THROW(scene::read_stream(folder.write("s.jsonl", bad)), scene::Error) << bad;
  }
  EXPECT_THROW(scene::read_route(folder.write("r.txt", "0 1 7"), 7), scene::Error);
  EXPECT_THROW(scene::read_route(folder.write("r.txt", "# none\n"), 7), scene::Error);
  EXPECT_THROW(scene::read_route(folder.write("r.txt", "1.5"), 7), scene::Error);
}

}  // namespace
}  // namespace clues::test
