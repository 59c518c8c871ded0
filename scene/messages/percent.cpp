#include "scene/messages/percent.h"

#include <fmt/format.h>

#include <cmath>

namespace clues::scene {

std::string percent(double part, double whole, int decimals) {
  const double share = whole > 0 ? 100 * part / whole : whole == 0 ? 0 : std::nan("");
  return std::isfinite(share) ? fmt::format("{:.{}f}", share, decimals) : "-";
}

}  // namespace clues::scene
