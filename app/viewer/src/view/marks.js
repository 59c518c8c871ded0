// Lines, outlines, bodies and points that are drawn besides the surface. Coordinates are those of the scene.
import * as THREE from 'three';
import { ConvexHull } from 'three/addons/math/ConvexHull.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

// Pairs of points as lines of so many pixels.
export function lines(frame, pairs, colour, width, { over = false, dashed = false } = {}) {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(pairs.flatMap(([a, b]) => [...frame.local(a), ...frame.local(b)]));
  const material = new LineMaterial({ color: colour, linewidth: width, dashed, dashSize: 0.012, gapSize: 0.008, depthTest: !over });
  const object = new LineSegments2(geometry, material);
  if (dashed) object.computeLineDistances();
  object.renderOrder = over ? 10 : 2;
  object.frustumCulled = false;
  return object;
}

export const loop = (ring) => ring.map((p, i) => [p, ring[(i + 1) % ring.length]]);

// Triangles (three points each) as a translucent body.
export function body(frame, triangles, colour, opacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(triangles.flatMap((t) => t.flatMap((p) => frame.local(p))), 3));
  const material = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.renderOrder = 3;
  mesh.frustumCulled = false;
  return mesh;
}

export function dots(frame, points, colour, size) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(points.flatMap((p) => frame.local(p)), 3));
  const object = new THREE.Points(geometry, new THREE.PointsMaterial({ color: colour, size, sizeAttenuation: false, depthTest: false }));
  object.renderOrder = 11;
  object.frustumCulled = false;
  return object;
}

// The faces of the hull of points of a solid cell as triangles, and its edges as pairs; of a flat cell all pairs.
const known = new WeakMap();
function hullParts(frame, points) {
  if (!known.has(points)) known.set(points, makeHull(frame, points));
  return known.get(points);
}
function makeHull(frame, points) {
  const local = points.map((p) => new THREE.Vector3(...frame.local(p)));
  const size = new THREE.Box3().setFromPoints(local).getSize(new THREE.Vector3());
  if (points.length < 4 || !spansSpace(local, Math.max(size.x, size.y, size.z))) return { triangles: [], pairs: points.flatMap((p, i) => points.slice(i + 1).map((q) => [p, q])) };
  const faces = new ConvexHull().setFromPoints(local).faces.map((face) => {
    const corners = [];
    let edge = face.edge;
    do { corners.push(edge.head().point); edge = edge.next; } while (edge !== face.edge);
    return { corners, normal: face.normal };
  });
  const number = new Map(local.map((p, i) => [p, i])), world = (v) => points[number.get(v)];
  const triangles = faces.flatMap(({ corners }) => corners.slice(2).map((_, i) => [corners[0], corners[i + 1], corners[i + 2]].map(world)));
  // Edges between faces of one plane are not drawn.
  const normals = new Map();
  const key = (a, b) => [a, b].map((p) => number.get(p)).sort((x, y) => x - y).join();
  for (const { corners, normal } of faces)
    corners.forEach((p, i) => { const k = key(p, corners[(i + 1) % corners.length]); normals.set(k, [...(normals.get(k) ?? []), normal]); });
  const pairs = [...normals].filter(([, [a, b]]) => !b || a.dot(b) < 1 - 1e-9).map(([k]) => k.split(',').map((i) => points[Number(i)]));
  return { triangles, pairs };
}

// The hull of the points of a cell: a body with its edges; of a flat cell, what there is of it.
export function hull(frame, points, colour) {
  const group = new THREE.Group(), { triangles, pairs } = hullParts(frame, points);
  group.add(dots(frame, points, colour, 4));
  if (triangles.length > 0) group.add(body(frame, triangles, colour, 0.22));
  if (pairs.length > 0) group.add(lines(frame, pairs, colour, 2.5));
  return group;
}

// Many of them at once, each a list of points; their edges in another colour.
export function hulls(frame, cells, colour, opacity, ink) {
  const group = new THREE.Group(), parts = cells.map((points) => hullParts(frame, points)), triangles = parts.flatMap((p) => p.triangles), pairs = parts.flatMap((p) => p.pairs);
  if (triangles.length > 0) group.add(body(frame, triangles, colour, opacity));
  if (pairs.length > 0) group.add(lines(frame, pairs, ink, 0.7));
  return group;
}

function spansSpace(points, spread) {
  const [first, ...others] = points, far = others.reduce((best, p) => (p.distanceTo(first) > best.distanceTo(first) ? p : best));
  const axis = far.clone().sub(first);
  let area = new THREE.Vector3();
  for (const p of others) {
    const found = axis.clone().cross(p.clone().sub(first));
    if (found.length() > area.length()) area = found;
  }
  if (!(area.length() > 1e-9 * spread * spread)) return false;
  const normal = area.normalize();
  return others.some((p) => Math.abs(normal.dot(p.clone().sub(first))) > 1e-9 * spread);
}

export function release(object) {
  object.traverse((part) => { part.geometry?.dispose(); part.material?.dispose(); });
  object.removeFromParent();
}
