/*
 * Which triangles to draw for a camera: cc -std=c99 example.c -lm -o example && ./example engine/engine.cluespvs 1 2 3
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>

#include "clues_pvs.h"

static void* read_whole(const char* name, size_t* bytes) {
  FILE* file = fopen(name, "rb");
  void* memory = NULL;
  long size;
  if (!file) return NULL;
  fseek(file, 0, SEEK_END);
  size = ftell(file);
  rewind(file);
  if (size > 0) memory = malloc((size_t)size);
  if (memory && fread(memory, 1, (size_t)size, file) != (size_t)size) {
    free(memory);
    memory = NULL;
  }
  fclose(file);
  *bytes = size > 0 ? (size_t)size : 0;
  return memory;
}

int main(int argc, char** argv) {
  size_t bytes = 0, cells, i, k, drawn = 0;
  uint32_t cell[16];
  double camera[3];
  unsigned char* draw;
  void* file = argc == 5 ? read_whole(argv[1], &bytes) : NULL;
  const clues_pvs* pvs = file ? clues_pvs_open(file, bytes) : NULL;
  if (!pvs) {
    fprintf(stderr, "usage: example FILE.cluespvs X Y Z\n");
    return 2;
  }
  for (i = 0; i < 3; ++i) camera[i] = atof(argv[2 + i]);
  cells = clues_pvs_cells(pvs, camera, cell, 16);
  if (cells == 0 || cells > 16) {
    printf("nothing is known there: draw everything\n");
    return 0;
  }
  draw = calloc(pvs->triangles, 1); /* triangles of all cells that hold the camera */
  if (!draw) return 1;
  for (i = 0; i < cells; ++i) {
    size_t count;
    const uint32_t* list = clues_pvs_triangles(pvs, cell[i], &count);
    for (k = 0; k < count; ++k) draw[list[k]] = 1;
  }
  for (k = 0; k < pvs->triangles; ++k) drawn += draw[k];
  printf("%u of %u triangles\n", (unsigned)drawn, (unsigned)pvs->triangles);
  free(draw);
  free(file);
  return 0;
}
