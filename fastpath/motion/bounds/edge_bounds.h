// When the Delaunay condition of each edge has to be asked again (D30, T14): for every edge a key in the odometer of one gauge. The gauges are a ball, and
// needles along where the viewpoint has been heading. A ball is used up by any way; of the edges that the viewpoint comes nearer to a violation of, a needle
// says later when, and that of the others it comes further away. Where it turns, the odometers of needles run faster.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fastpath/motion/bounds/calendar.h"
#include "fastpath/motion/bounds/delaunay_model.h"

namespace clues::fastpath::motion {

class EdgeBounds {
 public:
  // width > 0: of a bin of the calendars, in the unit of the viewpoint.
  explicit EdgeBounds(double width) : width_(width) { clocks_.emplace_back(Gauge{}, width); }

  void resize(std::size_t slots);  // an edge is a slot, as the caller numbers them
  // All odometers go on by a step; the keys of edges that are set next take it that the viewpoint goes on like that. O(gauges in use), and that of a calendar
  // where one is cleared.
  void move(const MotionPoint& from, const MotionPoint& to);
  // The edges that are due, each once; they are due until they are set or dropped. O(due + bins that odometers have passed), and each time half of a ring
  // has gone by, what waits outside of it.
  void take_due(std::vector<std::uint32_t>& slots);

  // Where the viewpoint has turned round, a due edge has much left of its bound: if so, true, and it is due later. O(1).
  bool has_some_left(std::uint32_t slot, const MotionPoint& at);
  // An edge whose model was made at the viewpoint. False where the model says nothing: then it is due each time until it is set again, and whether the
  // condition holds is for the caller to find out.
  bool set(std::uint32_t slot, const DelaunayModel& model, const MotionPoint& at);
  // An edge that holds within this radius.
  void set_ball(std::uint32_t slot, double radius, const MotionPoint& at) { begin(slot, 0, radius, at); }
  void drop(std::uint32_t slot);  // it is kept no more

 private:
  struct Clock {
    Clock(const Gauge& g, double width) : gauge(g), calendar(width) {}
    Gauge gauge;
    Calendar calendar;
    double odometer = 0;
    std::uint32_t edges = 0;  // that have their key here
    std::size_t entries = 0;  // of the calendar, with those that mean nothing any more
  };
  static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
  struct Edge {
    std::uint32_t clock = kNowhere, stamp = 0;  // of its entry
    double reach = 0;                           // in the gauge of the clock, from where it was set
    MotionPoint from{};
  };

  bool is_of(const Calendar::Entry& e, std::uint32_t clock) const {
    return edges_[e.item].clock == clock && edges_[e.item].stamp == e.stamp;
  }
  void expect(const Vec& step);
  std::uint32_t clock_along(const Vec& direction, const Gauge& shape);
  void begin(std::uint32_t slot, std::uint32_t clock, double reach, const MotionPoint& at);
  void put(std::uint32_t slot, std::uint32_t clock, double more);
  double steps_to(const Clock& clock, double reach) const;

  double width_;
  std::vector<Clock> clocks_;                  // the ball first
  std::array<std::uint32_t, 3> now_{0, 0, 0};  // those that new keys are for
  std::size_t choices_ = 1;                    // how many of them there are
  // Guesses: the direction and length of the last step, and the angle between two steps, lately.
  Vec heading_;
  double step_ = 0, turn_ = 0;
  std::vector<Edge> edges_;
  std::vector<Calendar::Entry> due_;
};

}  // namespace clues::fastpath::motion
