// What was found out about contacts and cuts (D16) of a scene, kept for the next part of it: complexes of growing parts of one
// scene repeat most of each other's work. A complex is the same with and without it.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "exact/complex/complex_internal.h"

namespace clues::exact {

class CutMemory {
 public:
  // Of a sheet: its first triangle's name in the whole scene, or one of these for a part of the cell's border.
  using Name = std::uint32_t;
  static constexpr Name kBorder = 1U << 31U;  // and up

  // The contact of two sheets that need a cut, without points where they need none; nullptr: not known.
  const Contact* contact(Name a, Name b) const {
    const auto it = contacts_.find({a, b});
    return it == contacts_.end() ? nullptr : &it->second;
  }
  void keep(Name a, Name b, const Contact& contact) { contacts_.try_emplace(std::pair{a, b}, contact); }

  // Everything that a cut depends on: the sheets of the plane, and for each the sheets that it meets.
  using Situation = std::vector<std::vector<Name>>;
  const std::vector<CutFace>* cut(const Situation& situation) const {
    const auto it = cuts_.find(situation);
    return it == cuts_.end() ? nullptr : &it->second;
  }
  void keep(const Situation& situation, const std::vector<CutFace>& faces) { cuts_.try_emplace(situation, faces); }

 private:
  std::map<std::pair<Name, Name>, Contact> contacts_;
  std::map<Situation, std::vector<CutFace>> cuts_;
};

}  // namespace clues::exact
