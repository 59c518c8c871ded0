// D25 in binary, and what can happen to a connection: cut at every byte, servers and clients that are killed, clients that
// are slow or talk nonsense. No hole, and nothing twice.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "reference/streams/stream_session.h"
#include "scene/messages/error.h"
#include "scene/stream/caller.h"
#include "scene/stream/local_socket.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "tests/seed.h"
#include "validate/processes/child_process.h"
#include "validate/stream/conform_server.h"

namespace clues::test {
namespace {

using scene::StreamCaller;

// A connection between a caller and a server: what either says, as long as it holds.
struct Line {
  reference::StreamSession session;
  std::string to_client;

  Line(int horizon, const scene::StreamHeader& header) : session(town().store(horizon), header) {
    to_client = session.greeting();
  }
  void say(const std::string& bytes) {
    session.feed(bytes);
    for (std::string answer = session.answer_next(); !answer.empty(); answer = session.answer_next())
      to_client += answer;
  }
};

std::string lines_of(const std::vector<scene::StreamMessage>& messages) {
  std::string text;
  for (const auto& m : messages) text += scene::to_line(m);
  return text;
}

TEST(StreamPackets, ComeBackAsTheyWereWritten) {
  const auto messages = town().stream({0, 1, 2, 5, 4, 3}, 1);
  std::string bytes = scene::to_packet(town().header());
  for (const auto& m : messages) bytes += scene::to_packet(m);
  const auto back = scene::parse_packets(bytes, "x");
  EXPECT_EQ(back.header.cells, "grid");
  EXPECT_EQ(lines_of(back.messages), lines_of(messages));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // Behind a whole packet it is a shorter stream; anywhere else it is none.
    try {
      const auto part = scene::parse_packets(bytes.substr(0, size), "x");
      EXPECT_LT(part.messages.size(), messages.size());
    } catch (const scene::Error& e) {
      EXPECT_EQ(e.code(), scene::ErrorCode::malformed);
    }
  }
}

// The link is cut after every byte of a session, and a server that knows nothing of it takes over.
TEST(StreamFaults, ACutAtEveryByteLeavesNoHole) {
  const auto header = town().header();
  for (const int horizon : {0, 1}) {
    const auto route = scene::random_route(town().neighbours(), 6, kSeed);
    const std::string expected = lines_of(town().stream(route, horizon));
    std::size_t cuts = 0;
    for (bool was_cut = true; was_cut; ++cuts) {
      StreamCaller caller;
      std::vector<Line> lines;
      lines.emplace_back(horizon, header);
      lines.back().say(caller.connect());
      std::size_t left = cuts;  // bytes that the first connection still carries
      was_cut = false;
      const auto carry = [&] {
        std::string bytes = std::exchange(lines.back().to_client, {});
        if (was_cut || left >= bytes.size()) {
          left -= was_cut ? 0 : bytes.size();
          caller.receive(bytes);
          return;
        }
        caller.receive(std::string_view(bytes).substr(0, left));
        was_cut = true;
        lines.emplace_back(horizon, header);
        lines.back().say(caller.connect());
        caller.receive(std::exchange(lines.back().to_client, {}));
      };
      carry();
      for (const std::uint32_t cell : route) {
        lines.back().say(caller.enter(cell));
        carry();
        ASSERT_FALSE(caller.waits()) << "cut after " << cuts;
      }
      ASSERT_EQ(lines_of(caller.messages()), expected) << "cut after " << cuts;
    }
    EXPECT_GT(cuts, 1000U);
    EXPECT_TRUE(town().judge(town().stream(route, horizon)).findings.empty());
  }
}

TEST(StreamFaults, WhoTalksNonsenseIsToldAndIsOut) {
  const auto header = town().header();
  for (const std::string& bad : {std::string("nonsense, and more than four bytes of it"), std::string(4, '\0'),
                                 std::string("\x05\0\0\0\x10\xff\0\0\0", 9), std::string("\x01\0\0\0\x02", 5)}) {
    reference::StreamSession session(town().store(0), header);
    session.feed(bad);
    const std::string said = session.answer_next();
    EXPECT_TRUE(session.is_over());
    scene::PacketReader reader(scene::most_packet_bytes, "x");
    reader.feed(said);
    const auto packet = reader.next();
    ASSERT_TRUE(packet);
    EXPECT_EQ(scene::parse_server_packet(*packet, "x", header).kind, scene::ServerPacket::Kind::refusal);
    EXPECT_TRUE(session.answer_next().empty());
  }
}

TEST(StreamFaults, AServerOfOtherCellsIsNoticed) {
  StreamCaller caller;
  caller.receive(scene::to_packet(town().header()));
  caller.connect();
  scene::StreamHeader other = town().header();
  other.cells = "another grid";
  EXPECT_THROW(caller.receive(scene::to_packet(other)), scene::Error);
}

// What decides the messages is other: what the first one sent does not fit what the second one would.
TEST(StreamFaults, AServerOfOtherListsOrAnotherModeIsNoticed) {
  scene::StreamHeader header = town().header();
  header.lists_sha256 = "ab";
  StreamCaller caller;
  caller.receive(scene::to_packet(header));
  caller.connect();
  scene::StreamHeader silent = header;
  silent.lists_sha256.clear();
  EXPECT_NO_THROW(StreamCaller(caller).receive(scene::to_packet(silent)));
  EXPECT_NO_THROW(StreamCaller(caller).receive(scene::to_packet(header)));
  scene::StreamHeader solid = header;
  solid.mode = "solid";
  EXPECT_THROW(StreamCaller(caller).receive(scene::to_packet(solid)), scene::Error);
  header.lists_sha256 = "cd";
  EXPECT_THROW(StreamCaller(caller).receive(scene::to_packet(header)), scene::Error);
}

TEST(StreamFaults, AServerThatDoesNotEnterTheCellIsNoticed) {
  StreamCaller caller;
  caller.receive(scene::to_packet(town().header()));
  caller.enter(1);
  scene::StreamMessage right, wrong;
  right.cell = 1;
  EXPECT_NO_THROW(StreamCaller(caller).receive(scene::to_packet(right) + scene::end_packet(1)));
  EXPECT_THROW(StreamCaller(caller).receive(scene::end_packet(0)), scene::Error);
  EXPECT_THROW(StreamCaller(caller).receive(scene::to_packet(wrong)), scene::Error);
  EXPECT_THROW(StreamCaller(caller).receive(scene::to_packet(right) + scene::to_packet(right)), scene::Error);
}

TEST(StreamFaults, AServerThatSendsWithoutEndIsNoticed) {
  const auto header = town().header();
  StreamCaller caller;
  caller.receive(scene::to_packet(header));
  caller.enter(1);
  scene::StreamMessage nothing;
  nothing.kind = scene::StreamMessage::Kind::minus;
  const std::string packet = scene::to_packet(nothing);
  for (std::uint64_t i = 0; i < scene::most_messages_of_a_step(header); ++i) ASSERT_NO_THROW(caller.receive(packet));
  EXPECT_THROW(caller.receive(packet), scene::Error);
}

// A server that only says where the viewer is, and is wrong as $1 says.
constexpr const char* scripted_server = R"sh(
  how=$1 n=0
  sha=abc; [ "$how" = scene ] && sha=other
  echo '{"format":"clues-stream/1","scene_sha256":"'$sha'","scene_triangles":2,"cells":"grid","cell_count":2}'
  [ "$how" = early ] && echo '{"minus":[],"unused":[]}'
  entered=
  while read -r line; do
    case $line in
      *resume*)
        if [ "$how" = forgets ] && [ -z "$entered" ]; then exit 0; fi
        have=${line#*\"have\":}; have=${have%%,*}
        route=${line#*[}; route=${route%%]*}
        IFS=,; set -- $route; unset IFS
        n=$#; [ "$how" = count ] && n=7
        shift "$have"
        for c; do echo "{\"cell\":$c}"; done
        echo "{\"end\":$n}"
        [ "$how" = trail ] && [ "$have" = "$n" ] && echo rubbish ;;
      *)
        entered=1
        c=${line#*:}; c=${c%\}}
        [ "$how" = flood ] && exec yes '{"minus":[],"unused":[]}'
        [ "$how" = endless ] && exec cat /dev/zero
        [ "$how" = stays ] && c=0
        n=$((n + 1))
        [ "$how" = never ] && n=0 || echo "{\"cell\":$c}"
        if [ "$how" = twice ]; then echo "{\"cell\":$c}"; n=$((n + 1)); fi
        echo "{\"end\":$n}" ;;
    esac
  done
  [ "$how" = last ] && echo rubbish
  [ "$how" = killed ] && kill -9 $$
  [ "$how" = status ] && exit 3
  exit 0
)sh";

validate::ServerRun run_scripted(const std::string& how) {
  constexpr std::chrono::minutes time{1};
  return validate::run_stream_server({"sh", "-c", scripted_server, "sh", how}, {"abc", "grid", 2, 2}, {0, 1, 0}, time,
                                     time);
}

TEST(ScriptedServers, OneThatIsRightPasses) {
  const auto run = run_scripted("right");
  EXPECT_EQ(run.failed, "");
  EXPECT_EQ(run.stream.messages.size(), 3U);
  EXPECT_EQ(run.resumed, 4U);
  EXPECT_EQ(run.anew, (std::vector<std::uint64_t>{1, 2, 3}));
}

void expect_failed(const std::string& how, const std::string& why) {
  const auto run = run_scripted(how);
  EXPECT_NE(run.failed.find(why), std::string::npos) << how << ": " << run.failed;
}

TEST(ScriptedServers, EachAnswerEntersItsCellOnce) {
  expect_failed("stays", "did not answer as asked");
  expect_failed("never", "did not answer as asked");
  expect_failed("twice", "did not answer as asked");
}

TEST(ScriptedServers, NothingIsSaidThatWasNotAskedFor) {
  EXPECT_NE(run_scripted("early").failed, "");
  EXPECT_NE(run_scripted("trail").failed, "");
  expect_failed("last", "what was not asked for");
}

TEST(ScriptedServers, TheProgramEndsWithItsInput) {
  expect_failed("killed", "was killed by signal 9");
  expect_failed("status", "ended with exit status 3");
}

TEST(ScriptedServers, AnswersHaveAnEnd) {
  expect_failed("flood", "an answer without end: more than 9 messages");
  expect_failed("endless", "an answer without end");
}

TEST(ScriptedServers, AnotherSceneFails) { expect_failed("scene", "the program serves another scene"); }

TEST(ScriptedServers, AWrongCountWhenAskedToGoOnFails) { expect_failed("count", "there were 7 messages"); }

TEST(ScriptedServers, WhatOnlyTheSameProgramRemembersIsLost) {
  expect_failed("forgets", "started anew after message 1");
  EXPECT_EQ(run_scripted("forgets").resumed, 4U);
}

// The program at a socket, with clients that the tests are.
class SocketServer {
 public:
  explicit SocketServer(const tests::TestFolder& folder)
      : path_(folder.path() / "s"),
        program_({CLUES_PROGRAM, "serve", (folder.path() / "screen.off").string(), "--cells", cells, "--socket",
                  path_.string()},
                 0) {
    std::string line;
    EXPECT_EQ(program_.read_line(line, soon(), 1000), validate::ChildProcess::Io::ok) << program_.stderr_tail();
  }
  const std::filesystem::path& path() const { return path_; }

  static constexpr const char* cells = "grid:2x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0";
  static validate::ChildProcess::Clock::time_point soon() {
    return validate::ChildProcess::Clock::now() + std::chrono::seconds(60);
  }

 private:
  std::filesystem::path path_;
  validate::ChildProcess program_;
};

class SocketClient {
 public:
  explicit SocketClient(const std::filesystem::path& path) { connect(path); }
  void connect(const std::filesystem::path& path) {
    socket_ = scene::connect_to(path);
    ASSERT_TRUE(socket_.is_open());
    to_send_ = caller.connect();
    talk();
  }
  void enter(std::uint32_t cell) {
    to_send_ += caller.enter(cell);
    talk();
  }
  void say(std::string bytes) {
    while (!bytes.empty() && scene::send_some(socket_, bytes) == scene::SocketIo::ok) continue;
  }

  StreamCaller caller;

 private:
  void talk() {
    while (!to_send_.empty() || caller.waits() || !caller.header()) {
      if (!to_send_.empty()) {
        ASSERT_NE(scene::send_some(socket_, to_send_), scene::SocketIo::lost);
        continue;
      }
      ASSERT_TRUE(scene::wait_for(socket_, false, std::chrono::seconds(60)));
      std::string bytes;
      ASSERT_NE(scene::receive_some(socket_, bytes), scene::SocketIo::lost);
      caller.receive(bytes);
    }
  }

  scene::Descriptor socket_;
  std::string to_send_;
};

TEST(StreamFaults, AServerIsKilledAfterEveryStepAndAnotherTakesOver) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::vector<std::uint32_t> route{0, 1, 3, 2, 0, 1};
  std::string undisturbed;
  {
    const SocketServer server(folder);
    SocketClient client(server.path());
    for (const auto cell : route) client.enter(cell);
    undisturbed = lines_of(client.caller.messages());
  }
  EXPECT_GT(undisturbed.size(), 100U);
  std::optional<SocketServer> server(std::in_place, folder);  // replaces the socket of the one that was killed
  SocketClient client(server->path());
  for (const auto cell : route) {
    client.enter(cell);
    server.reset();
    server.emplace(folder);
    client.connect(server->path());
  }
  EXPECT_EQ(lines_of(client.caller.messages()), undisturbed);
}

TEST(StreamFaults, ClientsThatEndOrHangOrTalkNonsenseDisturbNobody) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const SocketServer server(folder);
  SocketClient good(server.path()), slow(server.path());
  std::string much;
  for (int i = 0; i < 20000; ++i) much += scene::to_packet(scene::StreamRequest{});  // and takes no answer
  slow.say(much);
  for (const std::uint32_t cell : {0U, 1U, 3U, 2U}) {
    {
      SocketClient ends(server.path());
      ends.say(scene::to_packet(scene::StreamRequest{}).substr(0, 6));
      SocketClient talks(server.path());
      talks.say("what?");
    }
    good.enter(cell);
  }
  SocketClient also(server.path());
  for (const std::uint32_t cell : {0U, 1U, 3U, 2U}) also.enter(cell);
  EXPECT_EQ(lines_of(good.caller.messages()), lines_of(also.caller.messages()));
}

TEST(StreamFaults, ASocketThatIsInUseOrNoneIsLeftAlone) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  folder.write("file", "mine");
  const SocketServer server(folder);
  for (const char* path : {"s", "file", "there/is/no/such/folder"}) {
    const auto ran =
        tests::run_clues({"serve", "screen.off", "--cells", SocketServer::cells, "--socket", path}, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << path << ran.out;
  }
  EXPECT_EQ(tests::read_all(folder.path() / "file"), "mine");
}

TEST(StreamFaults, PacketsOnStandardInputThatAreNoneOrNotWholeAreToldOfAndExitWithTwo) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string enter = scene::to_packet(scene::StreamRequest{false, 1, {}, 0});
  const std::string inside = "inside a request";
  for (const auto& [input, why] : {std::pair{enter, std::string{}},
                                   {enter + enter.substr(0, enter.size() - 1), inside},
                                   {enter.substr(0, 1), inside},
                                   {std::string(64, '\xFF'), "client: "}}) {
    const auto ran =
        tests::run_clues_on(input, {"serve", "screen.off", "--cells", SocketServer::cells, "--binary"}, folder.path());
    EXPECT_EQ(ran.exit_code, why.empty() ? 0 : 2) << ran.err;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.empty(), why.empty()) << ran.err;
    EXPECT_NE(ran.out.find(why), std::string::npos);  // as a refusal
  }
}

TEST(StreamServers, TheProgramIsOneInPacketsAndItsWalkIsAClient) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string cells = SocketServer::cells;
  const auto judged =
      tests::run_clues({"conform", "--stream-server",
                        std::string(CLUES_PROGRAM) + " serve screen.off --binary --horizon 1 --cells " + cells,
                        "--scene", "screen.off", "--cells", cells, "--steps", "6"},
                       folder.path());
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_NE(judged.out.find("sound: 7 cells entered"), std::string::npos) << judged.out;
  const SocketServer server(folder);
  for (const char* form : {"--binary", "--seed=1"}) {
    const auto walked = tests::run_clues({"walk", "screen.off", "--cells", cells, "--camera",
                                          "walk:-0.2,-0.2,-0.1:0.2,0.2,-0.1", "--connect", "s", "-o", "walk", form},
                                         folder.path());
    EXPECT_EQ(walked.exit_code, 0) << walked.out << walked.err;
    const auto sound =
        tests::run_clues({"conform", "--stream", "walk", "--scene", "screen.off", "--cells", cells}, folder.path());
    EXPECT_EQ(sound.exit_code, 0) << sound.out << sound.err;
    EXPECT_NE(sound.out.find("sound: 3 cells entered"), std::string::npos) << sound.out;
  }
}

}  // namespace
}  // namespace clues::test
