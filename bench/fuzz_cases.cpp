// Small scenes of every generator, put to a subject and judged by all oracles on one core: scenes a second, where the time goes, and how the sight lines of
// the fuzzer were decided. Usage: clues_bench_fuzz_cases [SUBJECT [SCENES [FILE]]]: of each generator so many (8), with dials as in a campaign; FILE gets the seconds of
// each case, in the order of a campaign, for clues_bench_cluster.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>

#include "fuzz/campaign/generators.h"
#include "fuzz/findings/dials.h"
#include "fuzz/oracles/oracle.h"

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A subject, and how long it took.
class Timed : public clues::fuzz::Subject {
 public:
  explicit Timed(const std::string& name) : subject_(clues::fuzz::make_subject(name)) {}
  clues::fuzz::Answer answer(const clues::fuzz::Case& scene) const override {
    const double begin = cpu_seconds();
    auto answer = subject_->answer(scene);
    seconds_ += cpu_seconds() - begin;
    return answer;
  }
  std::string name() const override { return subject_->name(); }
  bool takes_dials() const override { return subject_->takes_dials(); }
  bool is_compared(const clues::fuzz::Case& scene) const override { return subject_->is_compared(scene); }
  double seconds() const { return seconds_; }

 private:
  std::unique_ptr<clues::fuzz::Subject> subject_;
  mutable double seconds_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  using namespace clues;
  constexpr std::uint64_t kSeed = 1;
  const std::string name = argc > 1 ? argv[1] : "reference";
  const std::uint64_t scenes = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 8;
  std::map<std::uint64_t, double> times;  // by number in a campaign
  fmt::print("{:<20} {:>9} {:>8} {:>9} {:>8} {:>6}", "generator", "triangles", "CPU s", "cases/s", "subject", "guide");
  const auto oracles = fuzz::oracles_named({});
  for (const auto* o : oracles) fmt::print(" {:>17}", o->name());
  fmt::print("   (shares of the time)\n");
  fuzz::Counters counters;
  double all_seconds = 0, of_subject = 0, of_guides = 0;
  std::uint64_t all_cases = 0;
  std::size_t all_bytes = 0, most_bytes = 0;  // of outcomes, as processes send them
  std::vector<double> of_oracles(oracles.size());
  const fuzz::GivenScenes none;
  const auto generators = fuzz::generators_named({}, none);
  for (const auto& g : generators) {
    const Timed subject(name);
    std::vector<double> shares(oracles.size());
    std::size_t triangles = 0;
    std::uint64_t cases = 0;
    double guides = 0;
    const double begin = cpu_seconds();
    for (std::uint64_t i = 0; i < scenes; ++i) {
      const double started = cpu_seconds();
      const fuzz::Case scene = fuzz::with_dials(g.make(kSeed, i), subject.takes_dials());
      ++cases;
      triangles += scene.mesh.triangles.size();
      fuzz::Outcome outcome;
      const double asked = cpu_seconds(), before_answer = subject.seconds();
      fuzz::Exam exam(scene, subject, outcome);
      guides += cpu_seconds() - asked - (subject.seconds() - before_answer);
      for (std::size_t k = 0; k < oracles.size(); ++k) {
        const double before = cpu_seconds();
        oracles[k]->examine(exam);
        shares[k] += cpu_seconds() - before;
      }
      const std::size_t bytes = fuzz::to_json_text(outcome).size();
      all_bytes += bytes;
      most_bytes = std::max(most_bytes, bytes);
      for (const auto& [counter, n] : outcome.counters) counters[counter] += n;
      times[i * generators.size() + static_cast<std::uint64_t>(&g - generators.data())] = cpu_seconds() - started;
    }
    if (cases == 0) continue;
    const double seconds = cpu_seconds() - begin;
    all_seconds += seconds;
    of_subject += subject.seconds();
    of_guides += guides;
    all_cases += cases;
    fmt::print("{:<20} {:>9.1f} {:>8.2f} {:>9.2f} {:>7.0f}% {:>5.0f}%", g.name,
               static_cast<double>(triangles) / static_cast<double>(cases), seconds,
               static_cast<double>(cases) / seconds, 100 * subject.seconds() / seconds, 100 * guides / seconds);
    for (std::size_t k = 0; k < oracles.size(); ++k) {
      fmt::print(" {:>16.0f}%", 100 * shares[k] / seconds);
      of_oracles[k] += shares[k];
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("{:<20} {:>9} {:>8} {:>9} {:>8.1f} {:>6.1f}", "all, ms a case", "", "", "",
             1e3 * of_subject / static_cast<double>(all_cases), 1e3 * of_guides / static_cast<double>(all_cases));
  for (const double s : of_oracles) fmt::print(" {:>17.1f}", 1e3 * s / static_cast<double>(all_cases));
  fmt::print("\n{} scenes in {:.1f} s of CPU time: {:.2f} a second\n", all_cases, all_seconds,
             static_cast<double>(all_cases) / all_seconds);
  fmt::print("bytes of an outcome: {} on average, {} at most\n", all_bytes / all_cases, most_bytes);
  for (const char* counter :
       {"sight lines decided", "blocks of triangles decided in floats", "triangles decided in doubles",
        "triangles decided in whole numbers", "first-order fallbacks"})
    fmt::print("{:>12}  {}\n", counters[counter], counter);
  if (argc > 3) {
    std::ofstream out(argv[3]);
    for (const auto& [number, seconds] : times) out << "1 " << seconds << "\n";
  }
}
