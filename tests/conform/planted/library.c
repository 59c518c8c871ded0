/* The planted shared library: as bad as the environment variable CLUES_PLANTED says. */
#define _POSIX_C_SOURCE 200809L
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "clues_iut.h"

int clues_iut_pvs(const double *xyz, size_t nv, const uint32_t *tri, size_t nt, const double *cell_xyz, size_t nc,
                  uint8_t *visible) {
  const char *mode = getenv("CLUES_PLANTED");
  (void)xyz;
  (void)nv;
  (void)tri;
  (void)cell_xyz;
  (void)nc;
  if (mode == NULL) mode = "";
  if (strcmp(mode, "crashes") == 0) raise(SIGSEGV);
  if (strcmp(mode, "hangs") == 0) {
    for (;;) pause();
  }
  if (strcmp(mode, "exits") == 0) exit(0);
  if (strcmp(mode, "prints") == 0) {
    puts("{\"seq\":0,\"result\":{\"visible\":[]}}");
    fflush(stdout);
  }
  if (strcmp(mode, "skips") == 0) return CLUES_IUT_SKIPPED;
  if (strcmp(mode, "rejects") == 0) return CLUES_IUT_REJECTED;
  if (strcmp(mode, "errs") == 0) return 17;
  memset(visible, strcmp(mode, "hides") == 0 ? 0 : strcmp(mode, "writes-255") == 0 ? 255 : 1,
         strcmp(mode, "forgets-the-last") == 0 ? nt - 1 : nt);
  return CLUES_IUT_OK;
}
