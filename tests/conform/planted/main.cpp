// The planted implementations: `clues_planted MODE [ID]` speaks the protocol and is wrong in one way. With ID it misbehaves in that
// one case only, and lists everything else. Modes that answer badly are in answers.h, those that cheat in cheats.h; the others, here, misbehave.
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "answers.h"
#include "cheats.h"
#include "scene/messages/error.h"
#include "validate/conform/protocol.h"

namespace {

using namespace clues;

void say(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

std::string reply(std::uint32_t seq, const planted::Ids& ids) {
  validate::Answer answer;
  answer.visible = ids;
  return validate::run_reply(seq, answer);
}

[[noreturn]] void hang() {
  while (true) pause();
}

// What the kernel would do to a program that eats all memory.
void exhaust_memory() {
  std::vector<std::string> eaten;
  while (true) eaten.emplace_back(std::size_t{1} << 24, 'x');
}

void misbehave(const std::string& mode, const validate::Request& request) {
  const auto all = planted::answer("everything-visible", request);
  const auto seq = request.seq;
  const auto number = std::to_string(seq);
  if (mode == "hangs") hang();
  if (mode == "hangs-with-child") {
    if (fork() == 0) hang();  // holds the pipes open, too
    hang();
  }
  if (mode == "hangs-in-another-group") {
    setpgid(0, getpgid(getppid()));
    hang();
  }
  if (mode == "crashes") {
    std::fputs("about to crash\n", stderr);
    std::raise(SIGSEGV);
  } else if (mode == "exits") {
    std::exit(3);
  } else if (mode == "ends-silently") {
    std::exit(0);
  } else if (mode == "crashes-in-its-line") {
    std::fputs(reply(seq, all).substr(0, 9).c_str(), stdout);
    std::fflush(stdout);
    std::raise(SIGSEGV);
  } else if (mode == "answers-twice") {
    say(reply(seq, all));
    say(reply(seq, all));
  } else if (mode == "floods-after-its-answer") {
    say(reply(seq, all));
    while (std::fputs("0123456789abcde\n", stdout) >= 0) continue;
  } else if (mode == "nests-deeply") {
    say("{\"seq\":" + number + ",\"result\":{\"visible\":[" + std::string(400000, '[') + std::string(400000, ']') +
        "]}}");
  } else if (mode == "lies-about-seq") {
    say(reply(seq + 1, all));
  } else if (mode == "out-of-range") {
    auto ids = all;
    ids.push_back(static_cast<std::uint32_t>(all.size()));
    say(reply(seq, ids));
  } else if (mode == "negative-id") {
    say("{\"seq\":" + number + ",\"result\":{\"visible\":[-1]}}");
  } else if (mode == "fractional-id") {
    say("{\"seq\":" + number + ",\"result\":{\"visible\":[0.5]}}");
  } else if (mode == "not-json") {
    say("Loading scene ... done");
  } else if (mode == "unknown-field") {
    say("{\"seq\":" + number + ",\"result\":{\"visible\":[],\"vissible\":[0]}}");
  } else if (mode == "two-kinds") {
    say("{\"seq\":" + number + ",\"result\":{\"visible\":[]},\"skipped\":{\"message\":\"?\"}}");
  } else if (mode == "endless-line") {
    while (std::fputs("0123456789abcdef", stdout) >= 0) continue;
  } else if (mode == "floods-stderr") {
    for (int i = 0; i < 100000; ++i) std::fputs("nothing to see here\n", stderr);
    say(reply(seq, all));
  } else if (mode == "memory") {
    exhaust_memory();
  } else if (mode == "skips" || mode == "rejects" || mode == "errs") {
    validate::Answer answer;
    answer.kind = mode == "skips"     ? validate::AnswerKind::skipped
                  : mode == "rejects" ? validate::AnswerKind::rejected_input
                                      : validate::AnswerKind::errored;
    answer.message = "planted";
    say(validate::run_reply(seq, answer));
  } else {
    throw std::invalid_argument("no such mode: " + mode);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGSEGV, SIG_DFL);  // of its own it does not crash, and what sanitizers make of a crash is not wanted
  if (argc < 2) return 2;
  const std::string mode = argv[1], only = argc > 2 ? argv[2] : "";
  validate::Implementation about;
  about.name = mode;
  about.version = "planted";
  about.float32 = mode == "reads-float32";
  about.solid = mode != "sheet-only";
  const bool lists_all = about.float32 || !about.solid;
  std::string line;
  while (std::getline(std::cin, line)) {
    const auto request = validate::parse_request(line);
    if (request.kind == validate::Request::Kind::stop) break;
    if (request.kind == validate::Request::Kind::start) {
      if (mode == "mute-at-start") hang();
      const auto cheating = planted::cheating_start_reply(mode);
      say(mode == "other-protocol" ? "{\"protocol\":2}" : !cheating.empty() ? cheating : validate::start_reply(about));
    } else if (lists_all || (!only.empty() && line.find("\"id\":\"" + only + "\"") == std::string::npos)) {
      say(reply(request.seq, planted::answer("everything-visible", request)));
    } else if (planted::is_method(mode)) {
      validate::Answer answer;
      try {
        answer.visible = planted::answer(mode, request);
      } catch (const scene::Error& error) {
        const bool internal = error.code() == scene::ErrorCode::internal;
        answer.kind = internal ? validate::AnswerKind::errored : validate::AnswerKind::rejected_input;
        answer.message = error.what();
      }
      say(validate::run_reply(request.seq, answer));
    } else if (planted::is_cheat(mode)) {
      planted::cheat(mode, request);
    } else {
      misbehave(mode, request);
    }
  }
  planted::cheat_at_the_end(mode);
  return 0;
}
