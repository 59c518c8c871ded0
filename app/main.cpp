// The program `clues`: parses the command line, hands over to one subcommand, and turns what it throws into exit codes.
#include <cstdio>

int main() {
  std::puts("clues " CLUES_VERSION);
  return 0;
}
