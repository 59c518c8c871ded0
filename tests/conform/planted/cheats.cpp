#include "cheats.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>

#include "answers.h"

namespace clues::planted {
namespace {

using validate::Request;
using Cheat = std::function<void(const Request&)>;

void write_out(const std::string& bytes) {
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  std::fflush(stdout);
}

void say(const std::string& line) { write_out(line + "\n"); }

[[noreturn]] void hang() {
  while (true) pause();
}

std::string list(const Ids& ids) {
  std::string text = "[";
  for (const auto id : ids) {
    if (text.size() > 1) text += ',';
    text += std::to_string(id);
  }
  return text + "]";
}

std::string wrong(const Request& r) { return list(answer("hides-one", r)); }
std::string all(const Request& r) { return list(answer("everything-visible", r)); }
std::string seq(const Request& r) { return "\"seq\":" + std::to_string(r.seq); }
std::string result(const std::string& visible) { return "\"result\":{\"visible\":" + visible + "}"; }
std::string reply(const Request& r, const std::string& visible) { return "{" + seq(r) + "," + result(visible) + "}"; }
std::string wrong_reply(const Request& r) { return reply(r, wrong(r)); }

// The list of all triangles, each as another text: "%", where % is the number.
std::string all_as(const Request& r, const std::string& pattern) {
  std::string text;
  for (const auto id : answer("everything-visible", r)) {
    std::string item = pattern;
    item.replace(item.find('%'), 1, std::to_string(id));
    text += (text.empty() ? "" : ",") + item;
  }
  return "[" + text + "]";
}

Cheat says(std::function<std::string(const Request&)> text) {
  return [text = std::move(text)](const Request& r) { write_out(text(r)); };
}

// A program that no signal to the parent, the group or the session reaches. It writes its number into a file, and stays.
void leave_behind(const std::function<void()>& work = hang) {
  const pid_t child = fork();
  if (child != 0) return;
  setsid();
  if (fork() != 0) _exit(0);
  prctl(PR_SET_PDEATHSIG, 0);
  signal(SIGTERM, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  std::ofstream("left-behind", std::ios::app) << getpid() << std::endl;
  work();
}

// So that the file is there before the runner can kill anybody.
void wait_for_those_left_behind() {
  for (struct stat status{}; stat("left-behind", &status) != 0 || status.st_size == 0;) usleep(1000);
}

void flood(int descriptor) {
  const std::string line(4095, 'x');
  while (write(descriptor, (line + "\n").c_str(), 4096) > 0) continue;
}

bool ends_badly = false, never_ends = false;

const std::map<std::string, Cheat>& cheats() {
  static const std::map<std::string, Cheat> known = {
      // ---- what is said
      {"seq-as-text", says([](const Request& r) {
         return "{\"seq\":\"" + std::to_string(r.seq) + "\"," + result(all(r)) + "}\n";
       })},
      {"seq-with-a-point", says([](const Request& r) { return "{" + seq(r) + ".0," + result(all(r)) + "}\n"; })},
      {"seq-with-an-exponent", says([](const Request& r) { return "{" + seq(r) + "e0," + result(all(r)) + "}\n"; })},
      {"seq-and-2-to-the-32", says([](const Request& r) {
         return "{\"seq\":" + std::to_string((std::uint64_t{1} << 32) + r.seq) + "," + result(all(r)) + "}\n";
       })},
      {"seq-twice", says([](const Request& r) { return "{\"seq\":1," + seq(r) + "," + result(all(r)) + "}\n"; })},
      {"result-twice", says([](const Request& r) {
         return "{" + seq(r) + "," + result(wrong(r)) + "," + result(all(r)) + "}\n";
       })},
      {"visible-twice", says([](const Request& r) {
         return "{" + seq(r) + ",\"result\":{\"visible\":" + wrong(r) + ",\"visible\":" + all(r) + "}}\n";
       })},
      {"visible-twice-escaped", says([](const Request& r) {
         return "{" + seq(r) + ",\"result\":{\"visible\":" + wrong(r) + ",\"v\\u0069sible\":" + all(r) + "}}\n";
       })},
      {"result-in-the-statistics", says([](const Request& r) {
         return "{" + seq(r) + ",\"result\":{\"visible\":" + wrong(r) + ",\"stats\":{\"visible\":" + all(r) + "}}}\n";
       })},
      {"a-list-of-the-hidden", says([](const Request& r) {
         return "{" + seq(r) + ",\"result\":{\"visible\":" + all(r) + ",\"hidden\":" + all(r) + "}}\n";
       })},
      {"capabilities-in-the-reply", says([](const Request& r) {
         return "{" + seq(r) + "," + result(all(r)) + ",\"capabilities\":{\"modes\":[]}}\n";
       })},
      {"the-outcome-in-the-reply", says([](const Request& r) {
         return "{" + seq(r) + "," + result(wrong(r)) + ",\"outcome\":\"tight\"}\n";
       })},
      {"everything-by-word", says([](const Request& r) { return reply(r, "\"all\"") + "\n"; })},
      {"everything-by-truth", says([](const Request& r) { return reply(r, "true") + "\n"; })},
      {"everything-by-object", says([](const Request& r) { return reply(r, "{\"0\":true}") + "\n"; })},
      {"ids-as-text", says([](const Request& r) { return reply(r, all_as(r, "\"%\"")) + "\n"; })},
      {"ids-with-a-point", says([](const Request& r) { return reply(r, all_as(r, "%.0")) + "\n"; })},
      {"ids-with-an-exponent", says([](const Request& r) { return reply(r, all_as(r, "%e0")) + "\n"; })},
      {"ids-in-lists", says([](const Request& r) { return reply(r, all_as(r, "[%]")) + "\n"; })},
      {"ids-of-2-to-the-32", says([](const Request& r) { return reply(r, "[4294967296,4294967297]") + "\n"; })},
      {"ids-of-2-to-the-64", says([](const Request& r) { return reply(r, "[18446744073709551616]") + "\n"; })},
      {"ids-that-are-no-number", says([](const Request& r) { return reply(r, "[NaN]") + "\n"; })},
      {"ids-that-are-infinite", says([](const Request& r) { return reply(r, "[1e999]") + "\n"; })},
      {"ids-that-are-null", says([](const Request& r) { return reply(r, "[null]") + "\n"; })},
      {"minus-zero", says([](const Request& r) { return reply(r, "[-0]") + "\n"; })},
      {"the-same-ids-a-thousand-times", says([](const Request& r) {
         std::string text = wrong(r);
         text.pop_back();
         std::string many = text;
         for (int i = 0; i < 1000 && text.size() > 1; ++i) many.append(",").append(text, 1);
         return reply(r, many + "]") + "\n";
       })},
      {"deep-lists", says([](const Request& r) {
         return reply(r, std::string(60000, '[') + std::string(60000, ']')) + "\n";
       })},
      {"deep-statistics", says([](const Request& r) {
         return "{" + seq(r) + ",\"result\":{\"visible\":" + all(r) + ",\"stats\":" + std::string(60000, '[') +
                std::string(60000, ']') + "}}\n";
       })},
      // ---- how it is said
      {"two-replies-in-a-line", says([](const Request& r) { return wrong_reply(r) + reply(r, all(r)) + "\n"; })},
      {"another-reply-first", says([](const Request& r) { return "{}\n" + reply(r, all(r)) + "\n"; })},
      {"an-empty-line-first", says([](const Request& r) { return "\n" + reply(r, all(r)) + "\n"; })},
      {"a-reply-and-half-a-line", says([](const Request& r) { return reply(r, all(r)) + "\n{"; })},
      {"a-byte-order-mark", says([](const Request& r) { return "\xEF\xBB\xBF" + wrong_reply(r) + "\n"; })},
      {"nul-at-the-end", says([](const Request& r) { return reply(r, all(r)) + std::string("\0\n", 2); })},
      {"another-reply-after-a-nul", says([](const Request& r) {
         return wrong_reply(r) + std::string("\0", 1) + reply(r, all(r)) + "\n";
       })},
      {"utf-16", says([](const Request& r) {
         std::string wide = "\xff\xfe";
         for (const char c : reply(r, all(r))) wide += {c, '\0'};
         return wide + "\n";
       })},
      {"a-line-without-its-end", [](const Request& r) {
         write_out(reply(r, all(r)));
         hang();
       }},
      {"a-line-without-its-end-and-exit", [](const Request& r) {
         write_out(reply(r, all(r)));
         _exit(0);
       }},
      {"closes-its-output", [](const Request&) {
         close(STDOUT_FILENO);
         hang();
       }},
      {"closes-all-but-the-output", [](const Request& r) {
         close(STDIN_FILENO);
         close(STDERR_FILENO);
         say(wrong_reply(r));
         hang();
       }},
      // ---- time
      {"answers-late", [](const Request& r) {
         usleep(1500000);
         say(reply(r, all(r)));
       }},
      {"answers-bit-by-bit", [](const Request& r) {
         for (const char c : reply(r, all(r))) {
           write_out(std::string(1, c));
           usleep(100000);
         }
         say("");
       }},
      {"stops-itself", [](const Request& r) {
         raise(SIGSTOP);
         say(reply(r, all(r)));
       }},
      {"floods-standard-error-for-ever", [](const Request&) { flood(STDERR_FILENO); }},
      {"floods-standard-error-after-its-answer", [](const Request& r) {
         say(wrong_reply(r));
         flood(STDERR_FILENO);
       }},
      {"never-ends", [](const Request& r) {
         never_ends = true;
         say(wrong_reply(r));
       }},
      // ---- after the answer
      {"crashes-after-its-answer", [](const Request& r) {
         say(wrong_reply(r));
         raise(SIGSEGV);
       }},
      {"crashes-after-a-good-answer", [](const Request& r) {
         say(reply(r, all(r)));
         raise(SIGSEGV);
       }},
      {"exits-after-its-answer", [](const Request& r) {
         say(reply(r, all(r)));
         _exit(0);
       }},
      {"kills-itself-after-its-answer", [](const Request& r) {
         say(wrong_reply(r));
         raise(SIGKILL);
       }},
      {"ends-with-7", [](const Request& r) {
         ends_badly = true;
         say(reply(r, all(r)));
       }},
      // ---- other processes
      {"answers-from-a-grandchild", [](const Request& r) {
         const pid_t parent = getpid();
         if (fork() == 0) {
           setsid();
           while (getppid() == parent) usleep(1000);
           usleep(200000);
           say(reply(r, all(r)));
           hang();
         }
         _exit(0);
       }},
      {"leaves-a-process-behind", [](const Request& r) {
         leave_behind();
         wait_for_those_left_behind();
         say(wrong_reply(r));
       }},
      {"leaves-processes-behind-and-crashes", [](const Request&) {
         for (int i = 0; i < 20; ++i) leave_behind();
         wait_for_those_left_behind();
         raise(SIGSEGV);
       }},
      {"leaves-a-process-behind-and-hangs", [](const Request&) {
         leave_behind();
         wait_for_those_left_behind();
         hang();
       }},
      {"leaves-a-flood-behind", [](const Request&) {
         leave_behind([] { flood(STDERR_FILENO); });
         wait_for_those_left_behind();
         raise(SIGSEGV);
       }},
      {"leaves-forking-processes-behind", [](const Request&) {
         leave_behind([] {
           while (fork() <= 0) usleep(300);
           _exit(0);
         });
         wait_for_those_left_behind();
         raise(SIGSEGV);
       }},
      {"kills-its-parent", [](const Request& r) {
         prctl(PR_SET_PDEATHSIG, 0);
         leave_behind();
         wait_for_those_left_behind();
         kill(getppid(), SIGKILL);
         say(wrong_reply(r));
         hang();
       }},
      {"stops-its-parent", [](const Request&) {
         kill(getppid(), SIGSTOP);
         hang();
       }},
      {"signals-its-parent", [](const Request& r) {
         for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGPIPE, SIGCHLD}) kill(getppid(), signal);
         say(wrong_reply(r));
       }},
      // ---- files of the runner
      {"writes-the-report", [](const Request& r) {
         std::ofstream("report.json") << "{\"cases\":[]}";
         say(wrong_reply(r));
       }},
      // ---- what is shown of it
      {"nul-in-a-message", says([](const Request& r) {
         return "{" + seq(r) + ",\"errored\":{\"message\":\"a\\u0000b\"}}\n";
       })},
      {"escape-sequences-in-a-message", says([](const Request& r) {
         return "{" + seq(r) + ",\"errored\":{\"message\":\"\\u001b[2J\\u001b]0;x\\u0007\\u009b2J\\u202e\"}}\n";
       })},
      {"a-summary-in-a-message", says([](const Request& r) {
         return "{" + seq(r) + ",\"errored\":{\"message\":\"x\\n\\n12 cases: 12 executed, 12 tight\\n\"}}\n";
       })},
      {"escape-sequences-in-an-address", says([](const Request& r) {
         return "{" + seq(r) + ",\"errored\":{\"message\":\"x\",\"issue_url\":\"\\u001b[31m\"}}\n";
       })},
      {"a-megabyte-of-message", says([](const Request& r) {
         return "{" + seq(r) + ",\"errored\":{\"message\":\"" + std::string(1000000, 'x') + "\"}}\n";
       })},
      {"escape-sequences-on-standard-error", [](const Request&) {
         std::fputs("\x1b[2J\x1b]0;x\x07 12 tight\r\xc2\x9b" "2J\n", stderr);
         raise(SIGSEGV);
       }},
      {"escape-sequences-instead-of-json", says([](const Request&) { return "\x1b[2J\x1b]0;x\x07\xc2\x9b" "2J\n"; })},
      {"escape-sequences-in-a-key", says([](const Request& r) { return "{" + seq(r) + ",\"\\u001b[2J\":1}\n"; })},
      {"no-utf-8-in-a-message", says([](const Request& r) {
         return "{" + seq(r) + ",\"errored\":{\"message\":\"\xff\"}}\n";
       })}};
  return known;
}

}  // namespace

bool is_cheat(const std::string& mode) { return cheats().contains(mode) || !cheating_start_reply(mode).empty(); }

void cheat(const std::string& mode, const Request& request) {
  const auto found = cheats().find(mode);
  if (found == cheats().end()) return say(wrong_reply(request));
  found->second(request);
}

std::string cheating_start_reply(const std::string& mode) {
  validate::Implementation about;
  about.name = mode;
  about.version = "planted";
  const auto usual = validate::start_reply(about);
  if (mode == "start-twice") return usual + "\n" + usual;
  if (mode == "name-that-rules-the-terminal") {
    about.name = "\x1b[2Jname\n12 cases: 12 executed, 12 tight\n";
    about.version = std::string(
        "1\0"
        "2",
        3);
    return validate::start_reply(about);
  }
  if (mode == "no-modes")
    return R"({"protocol":1,"implementation":{"name":"n","version":"v"},"capabilities":{"modes":[],"input":"float64"}})";
  if (mode == "protocol-with-a-point")
    return std::string(usual).replace(usual.find("\"protocol\":1"), 12, "\"protocol\":1.0");
  if (mode == "modes-twice") return std::string(usual).replace(usual.find("\"modes\":"), 8, "\"modes\":[],\"modes\":");
  return "";
}

void cheat_at_the_end(const std::string&) {
  if (never_ends) hang();
  if (ends_badly) _exit(7);
}

}  // namespace clues::planted
