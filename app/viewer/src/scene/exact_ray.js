// What a ray meets first, decided exactly: doubles are whole numbers times a power of two, and so are taken as BigInt. Doubles decide only that a triangle is missed, and
// only where their error cannot matter; there is no tolerance.
//
// The filter. A side of the ray is det(d, p, q) with p = a - o and q = b - o, whose coordinates are each rounded once. Each of the six products has two rounded differences,
// two roundings of its own and at most three of sums: a relative error below 8u, u = 2^-53, and terms of second order. So |det| > 16u (sum of the absolute products) has
// the right sign, where nothing has underflowed; sums of products below 2^-900 are left to whole numbers, and so is what is not finite.
const UNSURE = 16 * 2 ** -53, TINY = 2 ** -900;

const view = new DataView(new ArrayBuffer(8));

// x = m 2^e with a whole m, as [m, e]; of 0, e is Infinity.
function parts(x) {
  if (x === 0) return [0n, Infinity];
  view.setFloat64(0, x);
  const bits = view.getBigUint64(0), field = Number((bits >> 52n) & 0x7ffn), low = bits & 0xfffffffffffffn;
  let m = field === 0 ? low : low | 0x10000000000000n, e = (field === 0 ? 1 : field) - 1075;
  while ((m & 1n) === 0n) { m >>= 1n; ++e; }
  return [x < 0 ? -m : m, e];
}
// Numbers, all times the same power of two, so that they are whole.
function whole(numbers) {
  const found = numbers.map(parts), least = Math.min(...found.map(([, e]) => e));
  return found.map(([m, e]) => (m === 0n ? 0n : m << BigInt(e - least)));
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const det = (a, b, c) => a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);

// -1 or 1 where doubles know, 0 where they do not.
function side(d, p, q) {
  const m = [[p[1] * q[2], p[2] * q[1]], [p[2] * q[0], p[0] * q[2]], [p[0] * q[1], p[1] * q[0]]];
  const value = d[0] * (m[0][0] - m[0][1]) + d[1] * (m[1][0] - m[1][1]) + d[2] * (m[2][0] - m[2][1]);
  const size = [0, 1, 2].reduce((sum, k) => sum + Math.abs(d[k]) * (Math.abs(m[k][0]) + Math.abs(m[k][1])), 0);
  if (!(size > TINY && size < Infinity)) return 0;
  return value > UNSURE * size ? 1 : value < -UNSURE * size ? -1 : 0;
}

// Where the ray d meets a closed triangle with these corners, all whole and as seen from its beginning: volume / facing times d, both positive; or null. A triangle that
// is seen edge-on is not met: a picture does not show it either.
function met(d, p, q, r) {
  const sides = [det(d, p, q), det(d, q, r), det(d, r, p)];
  if (sides.some((s) => s > 0n) && sides.some((s) => s < 0n)) return null;
  let facing = sides[0] + sides[1] + sides[2], volume = det(p, q, r);
  const back = facing > 0n;
  if (!back) { facing = -facing; volume = -volume; }
  return facing > 0n && volume > 0n ? { volume, facing, back } : null;
}

// Of those of the triangles that are met (all scaled by one power of two, so that distances compare) the nearest.
function nearest(o, d, candidates) {
  const dw = whole(d), all = whole([...o, ...candidates.flatMap(({ corners }) => corners.flat())]), ow = all.slice(0, 3);
  let best = null, out = [];
  candidates.forEach(({ triangle }, i) => {
    const [p, q, r] = [0, 3, 6].map((k) => minus(all.slice(3 + 9 * i + k, 6 + 9 * i + k), ow));
    const hit = met(dw, p, q, r);
    if (!hit) return;
    const order = best ? hit.volume * best.facing - best.volume * hit.facing : -1n;
    if (order > 0n) return;
    if (order < 0n) { best = hit; out = []; }
    out.push({ triangle, back: hit.back });
  });
  return out;
}

// All triangles that the ray from o along d meets at the first place where it meets any: [{ triangle, back }]. places: doubles, three a point. O(triangles).
export function firstMet(places, triangles, o, d) {
  const candidates = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [0, 1, 2].map((k) => { const at = 3 * triangles[t + k]; return [places[at], places[at + 1], places[at + 2]]; });
    const [p, q, r] = corners.map((c) => minus(c, o)), x = side(d, p, q), y = side(d, q, r);
    if (x * y < 0) continue;
    const z = side(d, r, p);
    if (x * z >= 0 && y * z >= 0) candidates.push({ triangle: t / 3, corners });
  }
  return nearest(o, d, candidates);
}
