// Lists of triangles as lengths of runs (docs/viewer.md), unpacked to a bit a triangle.
import { bytesOf } from './mesh_bytes.js';

// Null for what is no such list.
export function bitsOfRuns(base64, triangles) {
  let bytes;
  try { bytes = new Uint8Array(bytesOf(base64)); } catch { return null; }
  const bits = new Uint8Array(Math.ceil(triangles / 8));
  let at = 0, inside = false, count = 0;
  for (let i = 0; i < bytes.length; inside = !inside) {
    let length = 0, factor = 1, byte;
    do {
      if (i >= bytes.length) return null;
      byte = bytes[i++];
      length += (byte & 127) * factor;
      factor *= 128;
    } while (byte >= 128);
    if (at + length > triangles) return null;
    if (inside) {
      count += length;
      for (let t = at; t < at + length; ++t) bits[t >> 3] |= 1 << (t & 7);
    }
    at += length;
  }
  return at === triangles ? { bits, count } : null;
}

export const bitOf = (bits, t) => ((bits[t >> 3] >> (t & 7)) & 1) === 1;

// Triangles that are in the one and not in the other, ascending.
export function without(one, other) {
  const out = [];
  for (let i = 0; i < one.length; ++i) {
    const rest = one[i] & ~other[i];
    for (let k = 0; rest >> k !== 0; ++k) if ((rest >> k) & 1) out.push(8 * i + k);
  }
  return out;
}
