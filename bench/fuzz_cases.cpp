// Small scenes of every generator, put to the reference and judged by all oracles on one core: scenes a second, where the time goes, and how the sight lines of
// the fuzzer were decided.
#include <fmt/core.h>

#include <chrono>
#include <ctime>

#include "fuzz/campaign/generators.h"
#include "fuzz/oracles/oracle.h"

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The reference, and how long it took.
class Timed : public clues::fuzz::Subject {
 public:
  clues::fuzz::Answer answer(const clues::fuzz::Case& scene) const override {
    const double begin = cpu_seconds();
    auto answer = reference_->answer(scene);
    seconds_ += cpu_seconds() - begin;
    ++questions_;
    return answer;
  }
  std::string name() const override { return reference_->name(); }
  double seconds() const { return seconds_; }
  int questions() const { return questions_; }

 private:
  std::unique_ptr<clues::fuzz::Subject> reference_ = clues::fuzz::make_subject("reference");
  mutable double seconds_ = 0;
  mutable int questions_ = 0;
};

}  // namespace

int main() {
  using namespace clues;
  constexpr std::uint64_t kSeed = 1, kScenes = 8;
  fmt::print("{:<20} {:>9} {:>8} {:>9} {:>6}", "generator", "triangles", "CPU s", "cases/s", "maps");
  const auto oracles = fuzz::oracles_named({});
  for (const auto* o : oracles) fmt::print(" {:>17}", o->name());
  fmt::print("   (shares of the time)\n");
  fuzz::Counters counters;
  double all_seconds = 0;
  std::uint64_t all_cases = 0;
  std::vector<double> of_oracles(oracles.size());
  const fuzz::GivenScenes none;
  for (const auto& g : fuzz::generators_named({}, none)) {
    const Timed subject;
    std::vector<double> shares(oracles.size());
    std::size_t triangles = 0;
    std::uint64_t cases = 0;
    const double begin = cpu_seconds();
    for (std::uint64_t i = 0; i < kScenes; ++i) {
      const fuzz::Case scene = g.make(kSeed, i);
      if (scene.mesh.triangles.size() > 40) continue;
      ++cases;
      triangles += scene.mesh.triangles.size();
      fuzz::Outcome outcome;
      fuzz::Exam exam(scene, subject, outcome);
      for (std::size_t k = 0; k < oracles.size(); ++k) {
        const double before = cpu_seconds();
        oracles[k]->examine(exam);
        shares[k] += cpu_seconds() - before;
      }
      for (const auto& [name, n] : outcome.counters) counters[name] += n;
    }
    if (cases == 0) continue;
    const double seconds = cpu_seconds() - begin;
    all_seconds += seconds;
    all_cases += cases;
    fmt::print("{:<20} {:>9.1f} {:>8.2f} {:>9.2f} {:>5.0f}%", g.name,
               static_cast<double>(triangles) / static_cast<double>(cases), seconds,
               static_cast<double>(cases) / seconds, 100 * subject.seconds() / seconds);
    for (std::size_t k = 0; k < oracles.size(); ++k) fmt::print(" {:>16.0f}%", 100 * shares[k] / seconds);
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("{} scenes of at most 40 triangles in {:.1f} s of CPU time: {:.2f} a second\n", all_cases, all_seconds,
             static_cast<double>(all_cases) / all_seconds);
  for (const char* name :
       {"sight lines decided", "blocks of triangles decided in floats", "triangles decided in doubles",
        "triangles decided in whole numbers", "first-order fallbacks"})
    fmt::print("{:>12}  {}\n", counters[name], name);
}
