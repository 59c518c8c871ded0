// The program of `./run demo`: `clues demo` by itself, for those who wait for a first answer. It needs a quarter of the sources.
#include "app/demo/demo_alone.h"

int main(int argc, char** argv) { return clues::app::demo_alone({argv + 1, argv + argc}); }
