// The surface as the map has it: every region (docs/formats.md) as a polygon of its own, on its side of the triangle. What
// the map says nothing about is there too, without a statement.
import { ShapeUtils, Vector2 } from 'three';
import { cross, dot, minus } from '../scene/vectors.js';
import { NUMBER } from './labels.js';
import { SurfaceBuffer } from './surface.js';

const corners = (mesh, t) => [0, 1, 2].map((k) => { const at = 3 * mesh.triangles[3 * t + k]; return [...mesh.points.subarray(at, at + 3)]; });

// Whether a side faces away from the whole cell.
export function facesAway(points, cell, back, frame) {
  const [a, b, c] = points.map((p) => frame.local(p)), n = cross(minus(b, a), minus(c, a));
  const size = Math.sqrt(dot(n, n));
  return cell.every((p) => (back ? -1 : 1) * dot(minus(frame.local(p), a), n) <= 1e-12 * size);
}

export function regionSurface(mesh, frame, regions, cell, isListed) {
  const buffer = new SurfaceBuffer(regions.length * 2 + 16), covered = new Set();
  for (const region of regions) {
    const triangle = corners(mesh, region.triangle), back = region.side === 'back';
    covered.add(2 * region.triangle + (back ? 1 : 0));
    const label = region.visible ? NUMBER.visible : facesAway(triangle, cell, back, frame) ? NUMBER.away : NUMBER.hidden;
    const [a, b, c] = triangle.map((p) => frame.local(p)), n = cross(minus(b, a), minus(c, a));
    const drop = [0, 1, 2].reduce((best, k) => (Math.abs(n[k]) > Math.abs(n[best]) ? k : best), 0);
    const [u, v] = [[1, 2], [2, 0], [0, 1]][drop];
    const rings = region.rings.map((ring) => ring.map((p) => frame.local(p))).filter((ring) => ring.length >= 3);
    if (rings.length === 0) continue;
    const flat = rings.map((ring) => ring.map((p) => new Vector2(p[u], p[v])));
    const all = rings.flat();
    for (const [i, j, k] of ShapeUtils.triangulateShape(flat[0], flat.slice(1))) {
      const turn = dot(cross(minus(all[j], all[i]), minus(all[k], all[i])), n) < 0;
      if (turn !== back) buffer.push(all[i], all[k], all[j], region.triangle, label, isListed(region.triangle), back);
      else buffer.push(all[i], all[j], all[k], region.triangle, label, isListed(region.triangle), back);
    }
  }
  for (let t = 0; t < mesh.triangles.length / 3; ++t) {
    for (const back of [false, true]) {
      if (covered.has(2 * t + (back ? 1 : 0))) continue;
      const [a, b, c] = corners(mesh, t).map((p) => frame.local(p));
      buffer.push(a, back ? c : b, back ? b : c, t, NUMBER.none, isListed(t), back);
    }
  }
  return buffer.geometry();
}
