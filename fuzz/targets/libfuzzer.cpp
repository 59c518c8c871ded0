// The entry points of libFuzzer. CLUES_TARGET is the name of the target that this program is for.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/targets/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const clues::fuzz::Target& target = clues::fuzz::target_named(CLUES_TARGET);
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
