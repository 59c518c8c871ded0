// Standing in the cell: viewpoints within it, in a fixed order, and the comparison of the list with everything.
import { Vector3 } from 'three';
import { length, middle, minus, pointToTriangle } from '../scene/vectors.js';
import { BACK, NO_TAG } from './surface.js';

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

// The triangle that a ray meets first, in doubles, and of those that it meets at one place one in the list; -1: none.
function firstHit(places, triangles, listed, eye, ray) {
  let best = -1, nearest = Infinity;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[t + k]);
    const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
    const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
    const px = ray[1] * vz - ray[2] * vy, py = ray[2] * vx - ray[0] * vz, pz = ray[0] * vy - ray[1] * vx;
    const det = ux * px + uy * py + uz * pz;
    if (det === 0) continue;
    const sx = eye[0] - places[a], sy = eye[1] - places[a + 1], sz = eye[2] - places[a + 2];
    const u = (sx * px + sy * py + sz * pz) / det;
    if (!(u >= 0 && u <= 1)) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const v = (ray[0] * qx + ray[1] * qy + ray[2] * qz) / det;
    if (!(v >= 0 && u + v <= 1)) continue;
    const d = (vx * qx + vy * qy + vz * qz) / det;
    if (!(d > 0 && d < nearest * (1 + 1e-9))) continue;
    if (d >= nearest * (1 - 1e-9) && !listed(t / 3)) continue;
    nearest = Math.min(d, nearest);
    best = t / 3;
  }
  return best;
}

// A fifth of a pixel around its middle: what rays in doubles do not find in any of these places was rounding at an edge.
const AROUND = [[0, 0], [0.1, 0], [-0.1, 0], [0, 0.1], [0, -0.1]];
const MOST_CAST = 400;  // in the panel; tests cast all of them

// The picture of the list beside that of everything, from where the camera stands. `differ`: pixels that differ; `real`: those of them (of the first `most`) where rays in
// doubles meet a triangle first that is not in the list, all around the middle of the pixel. The others are edges, or surfaces at one place: the graphics processor
// rounds corners to a part of a pixel, and depths. `seen`: triangles, with their numbers of pixels.
export function compare(stage, { width, height, places, triangles, listed, most = MOST_CAST }) {
  const all = stage.numbers(stage.whole, { width, height }), list = stage.numbers(stage.whole, { width, height, listed: true });
  const camera = stage.camera.get(width / height), eye = stage.camera.place();
  const numberAt = (at) => all[at] + 256 * all[at + 1] + 65536 * all[at + 2];
  let differ = 0, surface = 0, real = 0;
  const seen = new Map(), missing = new Set();
  for (let at = 0; at < all.length; at += 4) {
    if (all[at + 3] !== NO_TAG) { ++surface; seen.set(numberAt(at), (seen.get(numberAt(at)) ?? 0) + 1); }
    if (all[at + 3] >= BACK && all[at + 3] !== NO_TAG) continue;  // in solid mode a back: it blocks, and does not count
    if (all[at] === list[at] && all[at + 1] === list[at + 1] && all[at + 2] === list[at + 2] && all[at + 3] === list[at + 3]) continue;
    if (++differ > most) continue;
    const x = (at / 4) % width, y = Math.floor(at / 4 / width);
    const hits = AROUND.map(([dx, dy]) => {
      const far = new Vector3(((x + 0.5 + dx) / width) * 2 - 1, ((y + 0.5 + dy) / height) * 2 - 1, 0.5).unproject(camera);
      return firstHit(places, triangles, listed, eye, [far.x - eye[0], far.y - eye[1], far.z - eye[2]]);
    });
    if (hits.every((t) => t >= 0 && !listed(t))) { ++real; missing.add(hits[0]); }
  }
  return { pixels: all.length / 4, surface, differ, real, seen: [...seen], missing: [...missing].sort((a, b) => a - b) };
}
