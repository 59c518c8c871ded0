// Only in the build for coverage, which links every program with --wrap=_exit: processes that end by _exit (workers,
// keepers) leave the counts of what they ran, too.
extern "C" {
void __gcov_dump();
[[noreturn]] void __real__exit(int status);
[[noreturn]] void __wrap__exit(int status);
}

void __wrap__exit(int status) {
  __gcov_dump();
  __real__exit(status);
}
