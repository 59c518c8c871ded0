// A scene: { points: Float64Array, triangles: Uint32Array, faces: Uint32Array | null }, triangles numbered as clues does (D1):
// in the order of the file, a face with more corners as a fan from its first.
import { flaw } from './flaw.js';

export class MeshBuilder {
  constructor(file) {
    this.file = file;
    this.points = [];
    this.triangles = [];
    this.faces = [];
    this.faceCount = 0;
  }
  point(x, y, z, where) {
    if (!Number.isFinite(x) || !Number.isFinite(y) || !Number.isFinite(z)) throw flaw(this.file, `${where}: a coordinate is missing or no finite number`);
    this.points.push(x, y, z);
  }
  face(corners, where) {
    const count = this.points.length / 3;
    for (const c of corners) if (!Number.isInteger(c) || c < 0 || c >= count) throw flaw(this.file, `${where}: names a point that is not there`);
    for (let i = 2; i < corners.length; ++i) {
      this.triangles.push(corners[0], corners[i - 1], corners[i]);
      this.faces.push(this.faceCount);
    }
    ++this.faceCount;
  }
  mesh(needsTriangles = true) {
    if (needsTriangles && this.triangles.length === 0) throw flaw(this.file, 'there are no triangles in it');
    return { points: Float64Array.from(this.points), triangles: Uint32Array.from(this.triangles), faces: Uint32Array.from(this.faces) };
  }
}

// Base64 of little-endian numbers, as the program embeds them.
export function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// `flags`: a byte a triangle (1: it blocks, 2: it counts), or null where all do both; `parts`: [[first triangle, name], ...], or null.
export function embeddedMesh(file) {
  const flags = file.flags ? new Uint8Array(bytesOf(file.flags)) : null;
  return { points: new Float64Array(bytesOf(file.points)), triangles: new Uint32Array(bytesOf(file.triangles)), faces: null, flags, parts: file.parts ?? null };
}

export const counts = (mesh, t) => !mesh.flags || (mesh.flags[t] & 2) !== 0;
export const blocks = (mesh, t) => !mesh.flags || (mesh.flags[t] & 1) !== 0;

// What the file calls the part that the triangle is of; empty where it has no name.
export function nameOfPart(mesh, t) {
  let name = '';
  for (let low = 0, high = mesh.parts?.length ?? 0; low < high;) {
    const at = (low + high) >> 1;
    if (mesh.parts[at][0] <= t) { name = mesh.parts[at][1]; low = at + 1; } else high = at;
  }
  return name;
}
