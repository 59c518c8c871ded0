/* clues_iut.h - the one function of a shared library that `clues conform --impl LIB.so` can test. C99 and C++.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the clues authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the
 * "Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge,
 * publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so,
 * subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF
 * MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE
 * FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION
 * WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
 */
#ifndef CLUES_IUT_H
#define CLUES_IUT_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CLUES_IUT_API __attribute__((visibility("default")))
#else
#define CLUES_IUT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What the function returns. Any other value counts as CLUES_IUT_FAILED. */
enum {
  CLUES_IUT_OK = 0,       /* `visible` holds the answer */
  CLUES_IUT_SKIPPED = 1,  /* this kind of input is not supported; counted, never held against anyone */
  CLUES_IUT_REJECTED = 2, /* the input is bad */
  CLUES_IUT_FAILED = 3    /* it should have worked, and did not */
};

/* Which triangles can be seen from the cell?
 *
 * xyz       3*nv doubles, the vertices; finite.
 * tri       3*nt vertex numbers below nv; triangle t has the corners tri[3t], tri[3t+1], tri[3t+2]. Corners may coincide or be collinear: such
 *           a triangle is no surface. Both sides of a triangle can be seen (mode "sheet").
 * cell_xyz  3*nc doubles: the view cell is the convex hull of these nc >= 1 points.
 * visible   nt bytes to be written, each of them: 1 if the triangle may be visible from some point of the cell, 0 if it is hidden from
 *           all of them. An answer is sound when every visible triangle has a 1.
 *
 * The inputs belong to the caller. The function is called many times in one process, from one thread, in a process of its own: a crash, a
 * hang or an exit is reported, and ends nothing else. It may write to standard output and standard error. */
CLUES_IUT_API int clues_iut_pvs(const double* xyz, size_t nv, const uint32_t* tri, size_t nt, const double* cell_xyz,
                                size_t nc, uint8_t* visible);

#ifdef __cplusplus
}
#endif

#endif
