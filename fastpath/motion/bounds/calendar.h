// Bins over the odometer (A1.7, D30): a calendar queue. Each item is due when the odometer reaches its key; a frame touches the bins that the odometer
// has passed, and no other item. Bins are a ring; what is further away than the ring waits outside, and is looked through each time half of the ring
// has gone by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace clues::fastpath::motion {

class Calendar {
 public:
  struct Entry {
    double key;
    std::uint32_t item,
        stamp;  // of items that come again with another stamp the old entries mean nothing: for the caller to see
  };

  // width > 0: of a bin, in the unit of the odometer. A fraction of the usual step is right.
  explicit Calendar(double width);

  // O(1). A key that is not finite never is due.
  void put(const Entry& entry);
  // Appends all entries with key <= odometer and takes them out. Odometers never fall. O(bins passed + entries in them).
  void take_due(double odometer, std::vector<Entry>& due);
  // As new, but for the memory that it has. O(bins + entries).
  void clear();
  // Takes out all entries but those that are wanted still, and returns how many these are. O(bins + entries).
  template <class Wanted>
  std::size_t keep(const Wanted& wanted) {
    std::erase_if(outside_, [&](const Entry& e) { return !wanted(e); });
    std::size_t kept = outside_.size();
    for (auto& bin : ring_) {
      std::erase_if(bin, [&](const Entry& e) { return !wanted(e); });
      kept += bin.size();
    }
    return kept;
  }

 private:
  static constexpr std::uint64_t kBins = 1024;

  std::uint64_t bin_of(double key) const;  // monotonous; capped
  void look_outside(std::uint64_t now);

  double width_;
  std::uint64_t cursor_ = 0, looked_ = 0;  // bins below the cursor are empty
  std::vector<std::vector<Entry>> ring_;
  std::vector<Entry> outside_;
};

}  // namespace clues::fastpath::motion
