// The ring holds bins cursor_ to cursor_ + kBins - 1; what is outside lies at looked_ + kBins or beyond, which a long step may reach before half
// of the ring has gone by.
#include "fastpath/motion/bounds/calendar.h"

#include <cmath>

namespace clues::fastpath::motion {

Calendar::Calendar(double width) : width_(width), ring_(kBins) {}

// Rounding and cutting off are monotonous: key <= odometer gives bin <= bin.
std::uint64_t Calendar::bin_of(double key) const {
  const double bin = key / width_;
  if (!(bin > 0)) return 0;
  return bin < 0x1p60 ? static_cast<std::uint64_t>(bin) : std::uint64_t{1} << 60U;
}

void Calendar::put(const Entry& entry) {
  if (!std::isfinite(entry.key)) return;
  const std::uint64_t bin = bin_of(entry.key);
  if (bin >= cursor_ + kBins) {
    outside_.push_back(entry);
  } else {
    ring_[(bin < cursor_ ? cursor_ : bin) % kBins].push_back(entry);
  }
}

void Calendar::clear() {
  for (auto& bin : ring_) bin.clear();
  outside_.clear();
  cursor_ = looked_ = 0;
}

void Calendar::look_outside(std::uint64_t now) {
  looked_ = now;
  std::size_t kept = 0;
  for (const Entry& entry : outside_) {
    if (bin_of(entry.key) < now + kBins) {
      put(entry);
    } else {
      outside_[kept++] = entry;
    }
  }
  outside_.resize(kept);
}

void Calendar::take_due(double odometer, std::vector<Entry>& due) {
  const std::uint64_t last = bin_of(odometer);
  const auto take = [&](std::vector<Entry>& bin) {
    std::size_t kept = 0;
    for (const Entry& entry : bin) {
      if (entry.key <= odometer) {
        due.push_back(entry);
      } else {
        bin[kept++] = entry;
      }
    }
    bin.resize(kept);
  };
  if (last >= cursor_ + kBins) {  // the whole ring has gone by
    for (auto& bin : ring_) take(bin);
  } else {
    for (std::uint64_t bin = cursor_; bin <= last; ++bin) take(ring_[bin % kBins]);
  }
  cursor_ = last;
  if (last >= looked_ + kBins) take(outside_);
  if (cursor_ - looked_ >= kBins / 2) look_outside(cursor_);
}

}  // namespace clues::fastpath::motion
