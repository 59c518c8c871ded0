#include "fastpath/visibility/search/pieces_before.h"

#include <algorithm>
#include <iterator>

namespace clues::fastpath {

bool PiecesBefore::holds(const ValidPiece& p) const {
  const auto begins_after = [&](const ExactPoint* ray0) { return ray0 == p.ray0 || p.on->turn(ray0, p.ray0) >= 0; };
  const auto ends_before = [&](const ExactPoint* ray1) { return ray1 == p.ray1 || p.on->turn(p.ray1, ray1) >= 0; };
  const Strip strip = std::get<Strip>(name_of(p));
  auto it = std::lower_bound(names_.begin(), names_.end(), Name(strip, nullptr, nullptr));
  for (; it != names_.end() && std::get<Strip>(*it) == strip; ++it) {
    if (begins_after(std::get<1>(*it)) && ends_before(std::get<2>(*it))) return true;
  }
  return false;
}

std::vector<ValidPiece> PiecesBefore::others(const std::vector<ValidPiece>& pieces) const {
  std::vector<ValidPiece> others;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(others),
               [&](const ValidPiece& p) { return !holds(p); });
  return others;
}

bool PiecesBefore::replace(const std::vector<ValidPiece>& pieces) {
  std::vector<Name> names;
  names.reserve(pieces.size());
  for (const ValidPiece& p : pieces) names.push_back(name_of(p));
  std::sort(names.begin(), names.end());
  const bool all = std::includes(names.begin(), names.end(), names_.begin(), names_.end());
  names_ = std::move(names);
  return all;
}

}  // namespace clues::fastpath
