// Which gauge an edge gets is a guess about where the viewpoint goes; any is sound.
#include "fastpath/motion/bounds/edge_bounds.h"

#include <algorithm>
#include <cmath>

#include "fastpath/motion/bounds/bounds.h"

namespace clues::fastpath::motion {
namespace {

// A thin needle for a viewpoint that goes straight on, a thick one for one that turns.
constexpr std::array<Gauge, 2> kNeedles{Gauge{{}, 0x1p-5, 0x1p-2}, Gauge{{}, 0x1p-7, 0x1p-4}};
constexpr double kLeastSteps = 6;        // a needle that the viewpoint leaves earlier is of no use
constexpr std::size_t kMostClocks = 64;  // where so many are in use, edges go to the ball

Vec vector_of(const MotionPoint& from, const MotionPoint& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

}  // namespace

void EdgeBounds::resize(std::size_t slots) { edges_.resize(slots); }

void EdgeBounds::move(const MotionPoint& from, const MotionPoint& to) {
  const Vec step = vector_of(from, to);
  if (step.x == 0 && step.y == 0 && step.z == 0) return;
  for (Clock& clock : clocks_) clock.odometer = sum_up(clock.odometer, gauge_up(clock.gauge, step));
  expect(step);
}

void EdgeBounds::expect(const Vec& step) {
  const double length = norm(step);
  choices_ = 1;
  if (!(length >= kLeastLength && length <= kLargestLength)) return;
  const Vec direction = (1 / length) * step;
  if (step_ > 0) turn_ = 0.75 * turn_ + 0.25 * norm(direction - heading_);
  heading_ = direction;
  step_ = length;
  for (const Gauge& needle : kNeedles) {
    if (kLeastSteps * turn_ > needle.head) continue;
    const std::uint32_t clock = clock_along(direction, needle);
    if (clock != kNowhere) now_[choices_++] = clock;
  }
}

// One that points about there, or else a new one in the place of one that no edge has.
std::uint32_t EdgeBounds::clock_along(const Vec& direction, const Gauge& shape) {
  std::uint32_t free = kNowhere, best = kNowhere;
  double nearest = 1 - 0x1p-5 * shape.head * shape.head;  // the cosine of a quarter of the angle of its head
  for (std::uint32_t i = 1; i < clocks_.size(); ++i) {
    const Clock& clock = clocks_[i];
    const double cosine = dot(clock.gauge.u, direction);
    if (clock.gauge.head == shape.head && cosine >= nearest) {
      best = i;
      nearest = cosine;
    }
    if (clock.edges == 0 && (choices_ == 1 || i != now_[1])) free = i;
  }
  if (best != kNowhere) return best;
  if (free == kNowhere) {
    if (clocks_.size() == kMostClocks) return kNowhere;
    free = static_cast<std::uint32_t>(clocks_.size());
    clocks_.emplace_back(shape, width_);
  }
  Clock& clock = clocks_[free];
  clock.gauge = {direction, shape.tail, shape.head};
  clock.calendar.clear();
  clock.odometer = 0;
  clock.entries = 0;
  return free;
}

// How many steps, if the viewpoint goes on turning as it does: after an angle of `head` each step counts for more.
double EdgeBounds::steps_to(const Clock& clock, double reach) const {
  const double steps = reach / step_, straight = clock.gauge.head / (turn_ + 0x1p-40), beyond = steps - straight;
  if (clock.gauge.head == 1 || !(beyond > 0)) return steps;
  return straight + 2 * beyond / (1 + std::sqrt(1 + 2 * turn_ / clock.gauge.tail * beyond));
}

bool EdgeBounds::set(std::uint32_t slot, const DelaunayModel& model, const MotionPoint& at) {
  const Reaches reaches(model);
  std::uint32_t best = 0;
  double longest = -1;
  for (std::size_t i = 0; i < choices_ && choices_ > 1; ++i) {
    const double steps = steps_to(clocks_[now_[i]], reaches.guess(clocks_[now_[i]].gauge));
    if (steps > longest) best = now_[i];
    longest = std::max(longest, steps);
  }
  const double reach = reaches.of(clocks_[best].gauge);
  begin(slot, best, reach, at);
  return reach > 0;
}

void EdgeBounds::begin(std::uint32_t slot, std::uint32_t clock, double reach, const MotionPoint& at) {
  edges_[slot].reach = reach;
  edges_[slot].from = at;
  put(slot, clock, reach);
}

// What is left must be worth it, or the edge is due again at once; of a needle, more, as the viewpoint has turned away from it.
bool EdgeBounds::has_some_left(std::uint32_t slot, const MotionPoint& at) {
  const Edge& edge = edges_[slot];
  const double used = gauge_up(clocks_[edge.clock].gauge, vector_of(edge.from, at));
  if (!(used < (edge.clock == 0 ? 0.75 : 0.5) * edge.reach)) return false;
  put(slot, edge.clock, std::nextafter(edge.reach - used, 0.0));
  return true;
}

void EdgeBounds::put(std::uint32_t slot, std::uint32_t index, double more) {
  drop(slot);
  Clock& clock = clocks_[index];
  edges_[slot].clock = index;
  ++clock.edges;
  if (!(more < kInfinity)) return;
  clock.calendar.put({sum_down(clock.odometer, more), slot, edges_[slot].stamp});
  if (++clock.entries <= 2 * std::size_t{clock.edges} + 1024) return;
  clock.entries = clock.calendar.keep([&](const Calendar::Entry& e) { return is_of(e, index); });
}

void EdgeBounds::drop(std::uint32_t slot) {
  Edge& edge = edges_[slot];
  ++edge.stamp;
  if (edge.clock != kNowhere) --clocks_[edge.clock].edges;
  edge.clock = kNowhere;
}

void EdgeBounds::take_due(std::vector<std::uint32_t>& slots) {
  for (std::uint32_t i = 0; i < clocks_.size(); ++i) {
    Clock& clock = clocks_[i];
    due_.clear();
    clock.calendar.take_due(clock.odometer, due_);
    clock.entries -= due_.size();
    for (const auto& entry : due_) {
      if (is_of(entry, i)) slots.push_back(entry.item);
    }
  }
}

}  // namespace clues::fastpath::motion
