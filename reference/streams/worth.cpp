#include "reference/streams/worth.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "reference/delta/delta.h"

namespace clues::reference {
namespace {

std::uint64_t packets_between(const std::vector<std::vector<std::uint32_t>>& lists,
                              const std::vector<std::vector<std::uint32_t>>& neighbours) {
  std::uint64_t count = 0;
  for (std::size_t a = 0; a < lists.size(); ++a) {
    for (const std::uint32_t b : neighbours[a]) count += !packets_of(lists[a], lists[b]).plus.empty();
  }
  return count;
}

}  // namespace

Dropping without_poor_packets(std::vector<std::vector<std::uint32_t>> lists,
                              const std::vector<std::vector<std::uint32_t>>& neighbours, const NotWorthIt& poor) {
  Dropping out;
  out.packets_before = packets_between(lists, neighbours);
  for (bool grows = true; grows;) {
    grows = false;
    ++out.rounds;
    auto next = lists;
    for (std::size_t a = 0; a < lists.size(); ++a) {
      for (const std::uint32_t b : neighbours[a]) {
        const auto plus = packets_of(lists[a], lists[b]).plus;
        if (plus.empty() || !poor(plus)) continue;
        std::vector<std::uint32_t> both;
        std::set_union(next[a].begin(), next[a].end(), plus.begin(), plus.end(), std::back_inserter(both));
        out.given_up += both.size() - next[a].size();
        next[a] = std::move(both);
        grows = true;
      }
    }
    lists = std::move(next);
  }
  out.packets_after = packets_between(lists, neighbours);
  out.lists = std::move(lists);
  return out;
}

}  // namespace clues::reference
