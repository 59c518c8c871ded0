// The oracles: units of one interface that look for something visible which the subject's answer denies. Whatever they claim is confirmed by
// exact/sight/witness.h, which shares nothing with them (D18); a claim that is not confirmed is a contradiction, a defect of ours.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/sight/point_occlusion.h"
#include "fuzz/findings/finding.h"
#include "fuzz/findings/witness_text.h"
#include "fuzz/generators/random.h"
#include "fuzz/subjects/subject.h"
#include "reference/visibility/first_order.h"
#include "validate/verdicts/judge.h"

namespace clues::fuzz {

// One case, answered: what oracles are asked about.
class Exam {
 public:
  // Asks the subject. A subject without a map of its own gets the reference's as a guide to the places worth looking at, or one that has nothing but its
  // own answer (Subject::is_compared). Throws NoAnswer.
  Exam(const Case& scene, const Subject& subject, Outcome& outcome);

  const Case& scene() const { return scene_; }
  const Subject& subject() const { return subject_; }
  const exact::ConvexCell& cell() const { return map().cell; }
  const Answer& answer() const { return answer_; }
  const reference::VisibilityMap& map() const { return answer_.map ? *answer_.map : *guide_; }
  bool is_compared() const { return compared_; }  // the map is an engine's, and not just a guide
  const std::vector<exact::TriangleCorners>& soup() const { return soup_; }
  Random random(const std::string& oracle) const;  // of its own for each case and oracle

  bool lists(std::uint32_t triangle) const;
  bool is_surface(std::uint32_t triangle) const;  // not degenerate

  // A point on a side of a triangle that the subject calls hidden.
  struct Denied {
    std::uint32_t triangle = 0;
    bool front = true;
    exact::Plane3 side;  // positive towards that side
    exact::Point3 p;
  };
  // Up to `per_region` points in each region denied: of the subject's own map, or of triangles that its PVS lacks (first where the guide says visible).
  std::vector<Denied> denied(std::size_t per_region) const;
  // Whether the subject denies the side of the triangle at p.
  bool denies(const validate::Witness& w) const;

  // Files a finding, if the line proves visible what the subject denies; a contradiction where the line is no proof. True: it was filed.
  bool claim(const std::string& oracle, const validate::Witness& witness, const std::string& explanation);
  void file(Finding finding) { outcome_.findings.push_back(std::move(finding)); }
  void contradiction(const std::string& oracle, const std::string& what);
  void count(const std::string& name, std::uint64_t n = 1) { outcome_.counters[name] += n; }

 private:
  void count_map();

  const Case& scene_;
  const Subject& subject_;
  Outcome& outcome_;
  Answer answer_;
  bool compared_ = true;
  std::optional<reference::VisibilityMap> guide_;
  std::vector<exact::TriangleCorners> soup_;
};

// Whether p (on the triangle) lies inside a hidden region of the map on that side; on a border of regions: no.
bool in_hidden_region(const reference::VisibilityMap& map, std::uint32_t triangle, bool front, const exact::Point3& p);

class Oracle {
 public:
  virtual ~Oracle() = default;
  virtual const char* name() const = 0;
  virtual const char* what() const = 0;                          // one line for --help
  virtual std::vector<const char*> needs() const { return {}; }  // counters that must not stay 0 in a campaign
  virtual void examine(Exam& exam) const = 0;                    // at most one finding of each verdict
};

const std::vector<std::unique_ptr<Oracle>>& all_oracles();
// Those with these names, in the order of all_oracles(); all of them when there is no name. Throws scene::Error bad_argument.
std::vector<const Oracle*> oracles_named(const std::vector<std::string>& names);

// One case from beginning to end. What an oracle throws is a contradiction.
Outcome judge_case(const Case& scene, const Subject& subject, const std::vector<const Oracle*>& oracles);

std::unique_ptr<Oracle> make_sight_lines();      // sight_lines.cpp
std::unique_ptr<Oracle> make_point_occlusion();  // oracles.cpp
std::unique_ptr<Oracle> make_metamorphic();      // metamorphic.cpp
std::unique_ptr<Oracle> make_see_through();      // see_through.cpp

}  // namespace clues::fuzz
