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
function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

export function embeddedMesh(file) {
  return { points: new Float64Array(bytesOf(file.points)), triangles: new Uint32Array(bytesOf(file.triangles)), faces: null };
}
