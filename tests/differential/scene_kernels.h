// One small scene asked of every kernel, with the dials of the case turned. Nothing is thrown: an exception is a flaw like
// any other, and the other kernels are asked as ever.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/visibility/map/local_map.h"
#include "fuzz/findings/finding.h"
#include "reference/visibility/first_order.h"

namespace clues::tests {

// What one kernel says of the scene.
struct KernelAnswer {
  std::string kernel;
  std::vector<std::uint32_t> visible;
  std::uint64_t fallbacks = 0;
  bool first_order = true;                      // promises exactly Omega where it has no fallback; else any sound list
  std::optional<reference::VisibilityMap> map;  // of the reference
  std::optional<std::vector<fastpath::LocalRegion>> regions;  // of the fast path
  std::vector<std::uint32_t> in_doubt = {};                   // of `visible`, first order (D17b); ascending
};

struct KernelSettings {
  bool refined = false;                              // ask the refinements too (D20, D21)
  bool no_fallbacks = false;                         // in scenes of up to ten triangles, without limits, they are flaws
  std::vector<std::string> kernels{};                // only these; empty: all
  std::function<void(KernelAnswer&)> planted_bug{};  // spoils an answer, or throws; for the tests of the tests
};

struct Flaw {
  std::string category;  // what is wrong, of which kernel
  std::string detail;    // where; the witness
};

struct Judgement {
  std::vector<Flaw> flaws;  // at most one of each category
  std::map<std::string, std::uint64_t> counts;
  double seconds = 0;

  void flaw(const std::string& category, const std::string& detail);
  void count(const std::string& what, std::uint64_t n = 1);
  double count_time(const std::string& of, double begin);  // in ms; returns the seconds since then
};

double processor_seconds();  // of this process, so far

// Without line ends, and of files only their names.
std::string one_line(const std::string& what);

std::vector<KernelAnswer> ask_kernels(const fuzz::Case& scene, const exact::ConvexCell& cell,
                                      const KernelSettings& settings, Judgement& out);

}  // namespace clues::tests
