// D17: when the search has ended, sources that a wedge which is not there may separate from the place that stands for them, or whose walk does not count (one_label.h, 3).
// They are left out themselves.
#pragma once

#include <memory>
#include <vector>

#include "fastpath/visibility/labels/left_out.h"
#include "fastpath/visibility/search/sources.h"

namespace clues::fastpath {

class DoubtfulSources {
 public:
  // Keeps references. What it adds to `left_out` lives as long as this.
  DoubtfulSources(const LocalScene& scene, const std::vector<ContourEdge>& contours, const Sources& sources,
                  Contacts& contacts, LeftOut& left_out, Workers& workers)
      : scene_(scene),
        contours_(contours),
        sources_(sources),
        contacts_(contacts),
        left_out_(left_out),
        workers_(workers) {}

  // Until there is none that what was added last concerns. O(sources * what is left out near them in the end). Needs RoundedUp in scope.
  void leave_out();

 private:
  // A source with a place: a part of an edge from lo to hi with a point y of it, or a vertex, which is all three.
  struct Placed {
    const ExactPoint *lo = nullptr, *hi = nullptr, *y = nullptr, *beside = nullptr;
    const Walk* walk = nullptr;
    const ContourEdge* contour = nullptr;  // none: a vertex
    std::uint32_t vertex = 0;
    IntervalBox around{};  // of it, its place and its walk
    bool settled = false;  // no matter what else is left out
  };
  enum class Doubt { none, settled, left_out };

  std::vector<Placed> placed() const;
  Doubt doubt_of(const Placed& s, std::size_t i) const;
  Doubt doubt_from(const Placed& s, std::size_t first) const;  // by what was left out from this number on
  const Apex& apex_at(const ContourEdge& c, const ExactPoint* x);
  LeftOut::Around around(const Placed& s);

  const LocalScene& scene_;
  const std::vector<ContourEdge>& contours_;
  const Sources& sources_;
  Contacts& contacts_;
  LeftOut& left_out_;
  Workers& workers_;
  Pool pool_;
  std::vector<std::unique_ptr<Apex>> apexes_;
};

}  // namespace clues::fastpath
