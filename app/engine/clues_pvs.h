/*
 * Which triangles may be seen from a point: reads the flat file that `clues bake --export` writes. Header only, C99 and C++.
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
#ifndef CLUES_PVS_H
#define CLUES_PVS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The file, little-endian, as it lies in memory (read or mapped, at an address that is a multiple of 8). Offsets are in bytes from its beginning. */
typedef struct {
  char magic[8]; /* "CLUESPVS" */
  uint32_t version, triangles, cells, grid[3];
  double low[3], per_unit[3];         /* voxel along an axis: floor((x - low) * per_unit) */
  uint64_t voxel_starts, voxel_cells; /* uint32_t[voxels + 1], uint32_t[]: cells that may hold points of a voxel */
  uint64_t plane_starts, planes;      /* uint32_t[cells + 1], double[][4]: n x <= d for all points of a cell */
  uint64_t list_starts, lists;        /* uint64_t[cells + 1], uint32_t[]: triangles, ascending */
  uint64_t bytes;                     /* of the file */
} clues_pvs;

/* The file, or NULL where it is none, or not whole. Nothing is copied. */
static inline const clues_pvs* clues_pvs_open(const void* file, size_t bytes) {
  const clues_pvs* pvs = (const clues_pvs*)file;
  if (bytes < sizeof(clues_pvs) || ((uintptr_t)file & 7u) != 0) return NULL;
  if (memcmp(pvs->magic, "CLUESPVS", 8) != 0 || pvs->version != 1 || pvs->bytes != bytes) return NULL;
  return pvs;
}

/* The cells that may hold the point: up to `most` of them go into `cells`; returns how many there are. What may be seen from the point is in the lists of those that
 * hold it, so take the triangles of all. 0: the point is in no cell, and nothing is known. Constant time for a bounded number of cells a voxel. */
static inline size_t clues_pvs_cells(const clues_pvs* pvs, const double point[3], uint32_t* cells, size_t most) {
  const char* base = (const char*)pvs;
  const uint32_t* starts = (const uint32_t*)(base + pvs->voxel_starts);
  const uint32_t* candidates = (const uint32_t*)(base + pvs->voxel_cells);
  const uint32_t* plane_starts = (const uint32_t*)(base + pvs->plane_starts);
  const double* planes = (const double*)(base + pvs->planes);
  size_t voxel = 0, found = 0;
  int axis;
  uint32_t i, k;
  for (axis = 2; axis >= 0; --axis) {
    const double at = floor((point[axis] - pvs->low[axis]) * pvs->per_unit[axis]);
    if (!(at >= 0 && at < pvs->grid[axis])) return 0;
    voxel = voxel * pvs->grid[axis] + (size_t)at;
  }
  for (i = starts[voxel]; i < starts[voxel + 1]; ++i) {
    const uint32_t cell = candidates[i];
    int inside = 1;
    for (k = plane_starts[cell]; inside && k < plane_starts[cell + 1]; ++k) {
      const double* p = planes + 4 * (size_t)k;
      inside = p[0] * point[0] + p[1] * point[1] + p[2] * point[2] <= p[3];
    }
    if (!inside) continue;
    if (found < most) cells[found] = cell;
    ++found;
  }
  return found;
}

/* The triangles that may be seen from a cell, ascending. */
static inline const uint32_t* clues_pvs_triangles(const clues_pvs* pvs, uint32_t cell, size_t* count) {
  const uint64_t* starts = (const uint64_t*)((const char*)pvs + pvs->list_starts);
  *count = (size_t)(starts[cell + 1] - starts[cell]);
  return (const uint32_t*)((const char*)pvs + pvs->lists) + starts[cell];
}

#endif
