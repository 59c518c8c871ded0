#include "fuzz/campaign/pair_seeker.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "fuzz/generators/parts.h"
#include "fuzz/oracles/rules.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

constexpr const char* none_turned = "none";
constexpr std::size_t looks_ahead = 4;

}  // namespace

PairSeeker::PairSeeker(std::uint64_t generators, DialsOf dials_of)
    : generators_(generators), dials_of_(std::move(dials_of)), arms_(generators * dials) {
  for (std::uint64_t number = 0; number < arms_.size(); ++number) {
    auto& next = next_.emplace_back();
    while (next.size() < looks_ahead) next.push_back(with_dials(number + next.size() * arms_.size()));
  }
  choose_round();
  choose_round();
}

// Cases of one generator are its scenes one after the other, and each of eight has another strength.
std::size_t PairSeeker::arm_of(std::uint64_t number) const { return number % arms_.size(); }

PairSeeker::Chosen PairSeeker::with_dials(std::uint64_t number) const {
  Chosen out{number, {}};
  for (const auto& [name, value] : dials_of_(number)) out.dials.push_back(name);
  if (out.dials.empty()) out.dials.emplace_back(none_turned);
  return out;
}

double PairSeeker::worth(const Chosen& c) const {
  const Mark& arm = arms_[arm_of(c.number)];
  if (arm.cases == 0) return std::numeric_limits<double>::infinity();
  double best = 0;
  for (const auto& dial : c.dials) {
    const auto at = dials_.find(dial);
    best = std::max(best, (at == dials_.end() ? Mark{} : at->second).worth());
  }
  return arm.worth() + best;
}

void PairSeeker::choose_round() {
  for (std::uint64_t i = 0; i < round(); ++i) choose();
}

void PairSeeker::choose() {
  Chosen* best = nullptr;
  double most = 0;
  for (auto& next : next_) {
    for (Chosen& c : next) {
      const double w = worth(c);
      if (best && (w < most || (w == most && c.number > best->number))) continue;
      best = &c;
      most = w;
    }
  }
  const std::size_t arm = arm_of(best->number);
  ++arms_[arm].cases;
  for (const auto& dial : best->dials) ++dials_[dial].cases;
  order_.push_back(*best);
  auto& next = next_[arm];
  next.erase(next.begin(), next.begin() + (best - next.data()) + 1);
  while (next.size() < looks_ahead)
    next.push_back(with_dials((next.empty() ? order_.back() : next.back()).number + arms_.size()));
}

std::uint64_t PairSeeker::tell(const Counters& counters) {
  std::uint64_t new_pairs = 0;
  for (const auto& [name, value] : counters) {
    if (is_a_pair(name) && met_.insert(name).second) ++new_pairs;
  }
  told(new_pairs);
  return new_pairs;
}

void PairSeeker::told(std::uint64_t new_pairs) {
  found_.push_back(new_pairs);
  if (found_.size() % round() != 0) return;
  for (Mark& mark : arms_) mark.age();
  for (auto& [name, mark] : dials_) mark.age();
  for (std::size_t place = found_.size() - round(); place < found_.size(); ++place) {
    const auto found = static_cast<double>(found_[place]);
    arms_[arm_of(order_[place].number)].found += found;
    for (const auto& dial : order_[place].dials) dials_[dial].found += found;
  }
  choose_round();
}

void PairSeeker::resume(const std::vector<SoughtCase>& cases, const Counters& counters) {
  for (const SoughtCase& c : cases) {
    const std::size_t place = found_.size();
    if (number(place) != c.number)
      throw scene::Error(scene::ErrorCode::malformed,
                         fmt::format("case {} of the order is number {} in the store, and {} by what came before it; "
                                     "the store was changed, or is of another release",
                                     place, c.number, number(place)));
    told(c.new_pairs);
  }
  for (const auto& [name, value] : counters) {
    if (is_a_pair(name)) met_.insert(name);
  }
}

}  // namespace clues::fuzz
