// Standing in the cell: viewpoints within it, in a fixed order, and the comparison of the list with everything.
import { Vector3 } from 'three';
import { firstMet } from '../scene/exact_ray.js';
import { length, middle, minus, pointToTriangle } from '../scene/vectors.js';
import { BACK, LISTED, NO_TAG } from './surface.js';

export const VIEWPOINTS = 100;
const MOST_MEASURED = 200000;

// Van der Corput's sequence to a base.
function radical(i, base) {
  let value = 0, part = 1 / base;
  for (; i > 0; i = Math.floor(i / base), part /= base) value += (i % base) * part;
  return value;
}

const PRIMES = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];

// Viewpoint 0 is the middle. The others spread over the cell: a box evenly, another hull by weights of its corners.
export function viewpoint(cell, index) {
  if (index === 0) return middle(cell);
  const low = [0, 1, 2].map((k) => Math.min(...cell.map((p) => p[k]))), high = [0, 1, 2].map((k) => Math.max(...cell.map((p) => p[k])));
  const corner = (p) => p.every((x, k) => x === low[k] || x === high[k]);
  const sides = [0, 1, 2].filter((k) => low[k] < high[k]).length;
  const distinct = new Set(cell.map(String)).size;
  if (cell.every(corner) && distinct === 2 ** sides) return low.map((x, k) => x + (high[k] - x) * (0.002 + 0.996 * radical(index, PRIMES[k])));
  const weights = cell.map((_, i) => -Math.log(1e-12 + radical(index + 7 * Math.floor(i / PRIMES.length), PRIMES[i % PRIMES.length])) + 1e-6);
  const sum = weights.reduce((a, b) => a + b, 0);
  return [0, 1, 2].map((k) => cell.reduce((x, p, i) => x + (p[k] * weights[i]) / sum, 0));
}

// How near the camera's pictures may begin without cutting anything: half way to the nearest surface. Local coordinates.
export function nearest(locals, triangles, eye) {
  if (triangles.length > 3 * MOST_MEASURED) return 1e-4;
  let best = Infinity;
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [0, 1, 2].map((k) => locals.subarray(3 * triangles[t + k], 3 * triangles[t + k] + 3));
    // No triangle is nearer than its first corner less its longest edge from there.
    const reach = Math.max(length(minus(corners[1], corners[0])), length(minus(corners[2], corners[0])));
    if (length(minus(corners[0], eye)) - reach >= best) continue;
    best = Math.min(best, pointToTriangle(eye, corners));
  }
  return Math.max(1e-5, Math.min(0.5 * best, 0.5));
}

const MOST_CAST = 400;  // in the panel; tests cast all of them

// The picture of the list beside that of everything, from where the camera stands. Both are drawn from the same buffer in the same order, and for the list the others are moved out
// of the picture: so depths and colours of what is listed are the same to the last bit, and a pixel can only differ (`differ`) where a triangle that is not listed won.
// `unequal` counts what contradicts that, and is 0. Why any such triangle wins though nothing is missing: a graphics processor moves corners to a part of a pixel and rounds
// depths, so that at the outline of a body its hidden side is at once as near as the side that hides it, and where bodies touch what is behind shows in the crack.
// So the picture itself is taken from rays: a pixel that differs is the ray from the viewpoint through its middle, and what that meets first is decided exactly
// (scene/exact_ray.js). `real`: those (of the first `most`) where no triangle that it meets first is in the list. `seen`: triangles, with their numbers of pixels.
// `eye`: in coordinates of the scene, and in the cell.
export function compare(stage, { width, height, mesh, solid, listed, eye, most = MOST_CAST }) {
  const all = stage.numbers(stage.whole, { width, height }), list = stage.numbers(stage.whole, { width, height, listed: true });
  const camera = stage.camera.get(width / height), from = stage.camera.place();
  const numberAt = (at) => all[at] + 256 * all[at + 1] + 65536 * all[at + 2];
  let differ = 0, unequal = 0, surface = 0, real = 0;
  const seen = new Map(), missing = new Set();
  for (let at = 0; at < all.length; at += 4) {
    if (all[at + 3] !== NO_TAG) { ++surface; seen.set(numberAt(at), (seen.get(numberAt(at)) ?? 0) + 1); }
    if (all[at + 3] >= BACK && all[at + 3] !== NO_TAG) continue;  // in solid mode a back: it blocks, and does not count
    if (all[at] === list[at] && all[at + 1] === list[at + 1] && all[at + 2] === list[at + 2] && all[at + 3] === list[at + 3]) continue;
    if (all[at + 3] === NO_TAG || (all[at + 3] & LISTED) !== 0) { ++unequal; continue; }
    if (++differ > most) continue;
    const x = (at / 4) % width, y = Math.floor(at / 4 / width);
    const far = new Vector3(((x + 0.5) / width) * 2 - 1, ((y + 0.5) / height) * 2 - 1, 0.5).unproject(camera);
    const met = firstMet(mesh.points, mesh.triangles, eye, [far.x - from[0], far.y - from[1], far.z - from[2]]);
    if (met.length === 0 || met.some(({ triangle, back }) => listed(triangle) || (solid && back))) continue;
    ++real;
    for (const { triangle } of met) missing.add(triangle);
  }
  return { pixels: all.length / 4, surface, differ, unequal, real, seen: [...seen], missing: [...missing].sort((a, b) => a - b) };
}
