#include "reference/multires/stars/combination.h"

#include <algorithm>

namespace clues::reference {

mpz_class to_integer(exact::Wide value) {
  __extension__ typedef unsigned __int128 Bits;
  const bool negative = value < 0;
  const Bits bits = negative ? -static_cast<Bits>(value) : static_cast<Bits>(value);
  mpz_class out(static_cast<unsigned long>(bits >> 64));
  out <<= 64;
  out += static_cast<unsigned long>(bits);
  return negative ? mpz_class(-out) : out;
}

std::optional<scene::CarrierPoint> combined(
    const std::vector<std::pair<const scene::CarrierPoint*, mpz_class>>& parts) {
  std::vector<std::uint32_t> corners;
  mpz_class whole = 0;
  for (const auto& [point, part] : parts) {
    whole += part;
    for (std::size_t k = 0; k < point->size(); ++k) {
      if (std::find(corners.begin(), corners.end(), point->corner[k]) == corners.end())
        corners.push_back(point->corner[k]);
    }
  }
  if (corners.size() > 3) return std::nullopt;
  std::sort(corners.begin(), corners.end());
  scene::CarrierPoint out;
  std::int64_t left = scene::whole_weight;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    mpz_class sum = 0, weight;
    for (const auto& [point, part] : parts) sum += part * mpz_class(point->weight_of(corners[k]));
    mpz_fdiv_q(weight.get_mpz_t(), sum.get_mpz_t(), whole.get_mpz_t());
    out.corner[k] = corners[k];
    out.weight[k] = weight.get_si();
    if (out.weight[k] == 0) out.weight[k] = 1;  // on the side that it is on
    if (out.weight[k] > out.weight[largest]) largest = k;
    left -= out.weight[k];
  }
  out.weight[largest] += left;
  return out;
}

}  // namespace clues::reference
