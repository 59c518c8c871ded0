// What was found out about contacts and cuts (D16) of a scene, kept for the next part of it, for the same cell or another: complexes of
// parts of one scene repeat most of each other's work. A complex is the same with and without it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "exact/complex/complex_internal.h"

namespace clues::exact {

// For one thread at a time, and tasks that only ask. Grows with the pairs of triangles whose boxes meet, and with what different parts have of the triangles that meet one.
class CutMemory {
 public:
  // Of a sheet: its first triangle's name in the whole scene, or one of these for a part of the cell's border.
  using Name = std::uint32_t;
  static constexpr Name kBorder = 1U << 31U;  // and up

  // The contact of two sheets that need a cut, without points where they need none; nullptr: not known.
  const Contact* contact(Name a, Name b) const {
    const auto& contacts = known_[is_border(a) || is_border(b)].contacts;
    const auto it = contacts.find(both(a, b));
    return it == contacts.end() ? nullptr : &it->second;
  }
  void keep(Name a, Name b, const Contact& contact) {
    known_[is_border(a) || is_border(b)].contacts.try_emplace(both(a, b), contact);
  }

  // Everything that a cut depends on: the sheets of the plane, and for each the sheets that it meets.
  using Situation = std::vector<std::vector<Name>>;
  const std::vector<CutFace>* cut(const Situation& situation) const {
    const auto& cuts = known_[has_border(situation)].cuts;
    const auto it = cuts.find(situation);
    return it == cuts.end() ? nullptr : &it->second;
  }
  void keep(const Situation& situation, const std::vector<CutFace>& faces) {
    known_[has_border(situation)].cuts.try_emplace(situation, faces);
  }

  // Before the first part that is cut for another cell.
  void forget_cell() {
    known_[true] = {};
    if (known_[false].cuts.size() > kMostCuts) known_[false].cuts.clear();
  }
  static constexpr std::size_t kMostCuts = 1U << 17U;  // after a cell, however many there were

 private:
  struct Known {
    std::unordered_map<std::uint64_t, Contact> contacts;
    std::map<Situation, std::vector<CutFace>> cuts;
  };

  static std::uint64_t both(Name a, Name b) { return std::uint64_t{a} << 32U | b; }
  static bool is_border(Name name) { return name >= kBorder; }
  static bool has_border(const Situation& s) {
    return std::any_of(s.begin(), s.end(), [](const std::vector<Name>& names) {
      return std::any_of(names.begin(), names.end(), is_border);
    });
  }

  std::array<Known, 2> known_;  // of the scene alone, and with the cell's border
};

// The memories of a scene whose cells are asked about one after the other, and by several threads at once: each is lent to one.
class CutMemories {
 public:
  // A memory without a cell, until the end of this.
  class Loan {
   public:
    explicit Loan(CutMemories& from) : from_(from), memory_(from.take()) {}
    ~Loan() { from_.give_back(std::move(memory_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    CutMemory& memory() { return *memory_; }

   private:
    CutMemories& from_;
    std::unique_ptr<CutMemory> memory_;
  };

 private:
  std::unique_ptr<CutMemory> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      idle_.reserve(++made_);
      return std::make_unique<CutMemory>();
    }
    auto memory = std::move(idle_.back());
    idle_.pop_back();
    return memory;
  }
  void give_back(std::unique_ptr<CutMemory> memory) noexcept {
    memory->forget_cell();
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(memory));  // there is room
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<CutMemory>> idle_;
  std::size_t made_ = 0;
};

}  // namespace clues::exact
