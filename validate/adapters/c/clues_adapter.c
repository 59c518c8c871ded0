/* SPDX-License-Identifier: MIT
 * Copyright (c) the clues authors. Permission is granted to use, copy, modify and distribute this file under the MIT licence,
 * whose text is in vectors/LICENSE; it comes without any warranty.
 *
 * An adapter for `clues conform`, to copy: a shared library with one function.
 *
 *     cc -std=c99 -O2 -fPIC -shared -I DIR_OF_CLUES_IUT_H clues_adapter.c -o libmine.so
 *     clues conform --impl ./libmine.so
 *
 * Replace potentially_visible_set. The library runs in a process of its own: it may crash, but should not. */
#include "clues_iut.h"

/* ---------------------------------------------------------------- replace this function ----------------------------------
 * Writes 1 for every triangle that may be visible from some point of the cell, else 0, and returns CLUES_IUT_OK, or another of these
 * values. clues_iut.h says what the arguments are. This one lists everything: sound, and as conservative as can be. */
static int potentially_visible_set(const double *xyz, size_t nv, const uint32_t *tri, size_t nt, const double *cell_xyz, size_t nc,
                                   uint8_t *visible) {
  size_t t;
  (void)xyz;
  (void)nv;
  (void)tri;
  (void)cell_xyz;
  (void)nc;
  for (t = 0; t < nt; ++t) visible[t] = 1;
  return CLUES_IUT_OK;
}
/* ------------------------------------------------------------------------------------------------------------------------ */

int clues_iut_pvs(const double *xyz, size_t nv, const uint32_t *tri, size_t nt, const double *cell_xyz, size_t nc,
                  uint8_t *visible) {
  return potentially_visible_set(xyz, nv, tri, nt, cell_xyz, nc, visible);
}
