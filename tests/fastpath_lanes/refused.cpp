// Built with fused products on purpose: require_float_rules() must notice. Prints "refused" when it does.
#include <cstdio>

#include "fastpath/predicates/float_rules.h"
#include "scene/messages/error.h"

int main() {
  if (!__builtin_cpu_supports("fma")) {
    std::puts("SKIPPED: this processor has no fused multiply-add");
    return 0;
  }
  try {
    clues::fastpath::require_float_rules();
  } catch (const clues::scene::Error&) {
    std::puts("refused");
    return 0;
  }
  std::puts("a library with fused products was accepted");
  return 1;
}
