// One conversation is one process. A line that does not answer the question just put may be left over from the question before it, and a crash
// may have come of it: then the same question, put to a fresh process, gets a proper answer, and the earlier one is to blame. What the last question
// leaves behind shows after 'stop'.
#include "validate/conform/program_subject.h"

#include <fmt/format.h>
#include <signal.h>
#include <wordexp.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>

#include "scene/messages/error.h"
#include "validate/processes/child_process.h"

namespace clues::validate {
namespace {

using Clock = ChildProcess::Clock;
using Io = ChildProcess::Io;

constexpr std::chrono::milliseconds least_time_to_start{10000};
constexpr const char* surplus = "more than one line in reply to one 'run'";

// FNV-1a: the same number for the same case in every run, and hardly ever the number of its neighbour.
std::uint32_t sequence_number(const std::string& id) {
  std::uint32_t hash = 2166136261U;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

std::size_t longest_reply(std::size_t triangles) { return (std::size_t{1} << 20) + 16 * triangles; }

Answer refusal(AnswerKind kind, std::string message) {
  Answer answer;
  answer.kind = kind;
  answer.message = std::move(message);
  return answer;
}

// Whether a process that ended by itself did so for want of memory: killed from outside (as the kernel does), or under a limit of ours that it
// reached or complained about.
bool ran_out_of_memory(const ChildProcess::End& end, const std::string& errors, std::uint64_t limit) {
  if (end.signal == SIGKILL) return true;
  if (limit == 0) return false;
  if (end.peak_memory_bytes >= limit / 4 * 3) return true;
  const char* const complaints[] = {"bad_alloc", "MemoryError", "ut of memory", "annot allocate memory"};
  return std::any_of(std::begin(complaints), std::end(complaints),
                     [&](const char* words) { return errors.find(words) != std::string::npos; });
}

// A process that was told 'start'.
class Conversation {
 public:
  Conversation(const std::vector<std::string>& words, const ProgramLimits& limits)
      : limits_(limits), child_(words, limits.memory_bytes) {}

  // What it says about itself, or why not.
  Implementation start(Answer& failure) {
    const auto deadline = Clock::now() + std::max(limits_.time, least_time_to_start);
    std::string line;
    auto io = child_.write_line(start_request(), deadline);
    if (io == Io::ok || io == Io::closed) io = child_.read_line(line, deadline, longest_reply(0));
    if (io != Io::ok) {
      failure = failed(io, deadline);
      return {};
    }
    try {
      return parse_start_reply(line);
    } catch (const ProtocolError& error) {
      failure = refusal(AnswerKind::malformed_output, error.what());
      child_.finish(Clock::now());
      failure.stderr_tail = child_.stderr_tail();
      return {};
    }
  }

  Answer ask(const VectorCase& test) {
    const auto seq = sequence_number(test.id);
    const auto deadline = Clock::now() + limits_.time;
    std::string line;
    auto io = child_.write_line(run_request(seq, test), deadline);
    // So busy writing that it does not read: what it says is no answer to this.
    if (io == Io::late && child_.has_unread_output()) io = Io::too_long;
    if (io == Io::closed) return failed(io, Clock::now());  // it did not even read the question
    if (io == Io::ok) io = child_.read_line(line, deadline, longest_reply(test.mesh.triangles.size()));
    if (io != Io::ok) return failed(io, deadline);
    auto answer = parse_reply(line, seq, test.mesh.triangles.size());
    if (answer.kind == AnswerKind::malformed_output) child_.finish(Clock::now());
    if (answer.kind == AnswerKind::malformed_output || answer.kind == AnswerKind::errored) {
      answer.stderr_tail = child_.stderr_tail();
    }
    return answer;
  }

  // Says 'stop', and waits for the end. Why the last answer does not count after all, or nothing.
  std::optional<Answer> stop() {
    const auto deadline = Clock::now() + limits_.time;
    std::string line;
    auto io = child_.write_line(stop_request(), deadline);
    if (io != Io::late) io = child_.read_line(line, deadline, longest_reply(0));
    const auto end = child_.finish(io == Io::closed ? deadline : Clock::now());
    std::optional<Answer> flaw;
    if (io == Io::ok || io == Io::too_long || (io == Io::closed && !line.empty())) {
      flaw = refusal(AnswerKind::malformed_output, surplus);
    } else if (end.killed_here) {
      flaw = refusal(AnswerKind::timeout, "answered, but did not end after 'stop'; killed");
    } else if (end.killed_keeper || end.signal != 0 || end.exit_code != 0) {
      flaw = refusal(AnswerKind::crash, "answered, and after 'stop' " + describe(end));
    }
    if (flaw) flaw->stderr_tail = child_.stderr_tail();
    return flaw;
  }

 private:
  Answer failed(Io io, Clock::time_point deadline) {
    Answer answer;
    if (io == Io::too_long) {
      child_.finish(Clock::now());
      answer = refusal(AnswerKind::malformed_output, "wrote without end");
    } else if (io == Io::late) {
      child_.finish(Clock::now());
      answer = refusal(AnswerKind::timeout, "no answer in time; killed");
    } else {
      const bool waits = deadline > Clock::now();
      auto end = child_.finish(deadline);
      if (!waits && end.signal != SIGKILL) end.killed_here = false;  // it was ending
      if (end.killed_here) {
        answer = waits ? refusal(AnswerKind::timeout, "closed its output, " + describe(end))
                       : refusal(AnswerKind::crash, "closed its input, and was killed");
      } else {
        const bool no_memory = !end.killed_keeper && ran_out_of_memory(end, child_.stderr_tail(), limits_.memory_bytes);
        answer = refusal(no_memory ? AnswerKind::resource : AnswerKind::crash, describe(end));
      }
    }
    answer.stderr_tail = child_.stderr_tail();
    return answer;
  }

  ProgramLimits limits_;
  ChildProcess child_;
};

bool leaves_process_usable(AnswerKind kind) {
  return kind == AnswerKind::visible || kind == AnswerKind::skipped || kind == AnswerKind::rejected_input ||
         kind == AnswerKind::errored;
}

// A block of cases, and the process that it was put to last.
class Block {
 public:
  Block(const std::vector<std::string>& words, const ProgramLimits& limits) : words_(words), limits_(limits) {}

  void put(Answer answer) { answers_.push_back(std::move(answer)); }

  void ask(const VectorCase& test) {
    const bool is_fresh = !conversation_;
    auto answer = ask_once(test);
    if (!is_fresh && (answer.kind == AnswerKind::malformed_output || answer.kind == AnswerKind::crash)) {
      auto second = ask_once(test);
      const bool is_of_another =
          answer.kind == AnswerKind::malformed_output
              ? second.kind != AnswerKind::malformed_output
              : leaves_process_usable(second.kind) || second.kind == AnswerKind::malformed_output;
      if (is_of_another) blame_last(of_the_one_before(std::move(answer)));
      answer = std::move(second);
    }
    last_ = answers_.size();
    put(std::move(answer));
  }

  const std::vector<Answer>& answers() const { return answers_; }

  std::vector<Answer> take() {
    if (conversation_) {
      if (auto flaw = conversation_->stop()) blame_last(std::move(*flaw));
    }
    return std::move(answers_);
  }

 private:
  Answer ask_once(const VectorCase& test) {
    Answer answer;
    if (!conversation_) {
      conversation_ = std::make_unique<Conversation>(words_, limits_);
      conversation_->start(answer);
      if (answer.kind != AnswerKind::visible) {
        conversation_.reset();
        answer.message = "when it was started again: " + answer.message;
        return answer;
      }
    }
    answer = conversation_->ask(test);
    if (!leaves_process_usable(answer.kind)) conversation_.reset();
    return answer;
  }

  static Answer of_the_one_before(Answer answer) {
    const bool crashed = answer.kind == AnswerKind::crash;
    answer.message =
        crashed ? "answered, and ended before the next question, which a fresh process answers: " + answer.message
                : surplus;
    return answer;
  }

  void blame_last(Answer flaw) { answers_[last_] = std::move(flaw); }

  const std::vector<std::string>& words_;
  ProgramLimits limits_;
  std::vector<Answer> answers_;
  std::size_t last_ = 0;                        // the answer of the process that is there now, or was last
  std::unique_ptr<Conversation> conversation_;  // that may be asked on
};

// A brace outside of quotes is a letter like others, as it is to a shell in the middle of a word: of {scene}, not of ${HOME}.
std::string with_plain_braces(const std::string& command) {
  std::string out;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
      out += c;
      out += command[++i];
    } else if (quote == 0 && command.compare(i, 2, "${") == 0) {
      const std::size_t end = std::min(command.find('}', i), command.size() - 1);
      out += command.substr(i, end + 1 - i);
      i = end;
    } else {
      if (quote == 0 && (c == '{' || c == '}')) out += '\\';
      out += c;
      if (c == quote) {
        quote = 0;
      } else if (quote == 0 && (c == '\'' || c == '"')) {
        quote = c;
      }
    }
  }
  return out;
}

const char* flaw_of_words(int status) {
  switch (status) {
    case WRDE_BADCHAR:
      return "no shell runs it, so put pipes, redirections and whatever else needs | & ; < > ( ) or a new line into a "
             "script, or quote them";
    case WRDE_CMDSUB:
      return "no shell runs it, so put command substitutions into a script, or quote them";
    case WRDE_BADVAL:
      return "it names a variable that is not set";
    case WRDE_SYNTAX:
      return "a quote or brace is not closed";
    default:
      return "there is no word in it";
  }
}

}  // namespace

ProgramSubject::ProgramSubject(std::vector<std::string> words, const ProgramLimits& limits)
    : words_(std::move(words)), limits_(limits) {
  Conversation conversation(words_, limits_);
  Answer failure;
  about_ = conversation.start(failure);
  if (failure.kind != AnswerKind::visible) {
    const auto said = failure.stderr_tail.empty() ? "" : "; it said: " + failure.stderr_tail;
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("{}: no proper reply to 'start': {}{}; see docs/protocol.md", fmt::join(words_, " "),
                                   failure.message, said));
  }
  conversation.stop();
}

std::vector<Answer> ProgramSubject::answer(std::span<const VectorCase* const> cases, const GoOn& go_on) const {
  Block block(words_, limits_);
  for (const auto* test : cases) {
    const bool solid = test->mode == CaseMode::solid;
    if (solid ? !about_.solid : !about_.sheet) {
      block.put(refusal(AnswerKind::unsupported, solid ? "mode solid" : "mode sheet"));
    } else if (!test->is_plain() && !about_.see_through) {
      block.put(refusal(AnswerKind::unsupported, "triangles that do not block or do not count"));
    } else if (about_.float32 && !is_exact_in_float32(*test)) {
      block.put(refusal(AnswerKind::skipped, "coordinates that are not single-precision numbers"));
    } else {
      block.ask(*test);
    }
    if (!go_on(block.answers().size() - 1, block.answers().back())) break;
  }
  return block.take();
}

std::vector<std::string> split_command(const std::string& command) {
  wordexp_t expanded{};
  const int status = wordexp(with_plain_braces(command).c_str(), &expanded, WRDE_NOCMD | WRDE_UNDEF);
  std::vector<std::string> words;
  if (status == 0) words.assign(expanded.we_wordv, expanded.we_wordv + expanded.we_wordc);
  if (status == 0 || status == WRDE_NOSPACE) wordfree(&expanded);
  if (status == WRDE_NOSPACE) throw std::bad_alloc();
  if (words.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       "'" + command + "': not a command: " + flaw_of_words(status) +
                           "; give a program and its arguments, quoted as for the shell");
  }
  return words;
}

bool is_exact_in_float32(const VectorCase& test) {
  const auto is_exact = [](const scene::Point& p) {
    return std::all_of(p.begin(), p.end(), [](double x) { return static_cast<double>(static_cast<float>(x)) == x; });
  };
  return std::all_of(test.mesh.points.begin(), test.mesh.points.end(), is_exact) &&
         std::all_of(test.cell.begin(), test.cell.end(), is_exact);
}

}  // namespace clues::validate
