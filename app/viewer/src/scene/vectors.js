// Three numbers in a list.
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const along = (a, b, t) => [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const unit = (a) => { const l = length(a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };
export const middle = (points) => [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k] / points.length, 0));

// The nearest points of two segments: their distance, and where on the first (0 to 1).
function segments(p, q, r, s) {
  const d = minus(q, p), e = minus(s, r), w = minus(p, r);
  const a = dot(d, d), b = dot(d, e), c = dot(e, e), f = dot(e, w), g = dot(d, w), clamp = (x) => Math.min(1, Math.max(0, x));
  const det = a * c - b * b;
  let t = det > 0 ? clamp((b * f - g * c) / det) : 0;
  const u = c > 0 ? clamp((b * t + f) / c) : 0;
  t = a > 0 ? clamp((b * u - g) / a) : 0;
  return { distance: length(minus(along(p, q, t), along(r, s, u))), at: t };
}

// How near a segment that does not cross the triangle comes to it.
export function toTriangle(p, q, corners) {
  let best = { distance: Infinity, at: 0 };
  for (let k = 0; k < 3; ++k) {
    const found = segments(p, q, corners[k], corners[(k + 1) % 3]);
    if (found.distance < best.distance) best = found;
  }
  for (const [end, at] of [[p, 0], [q, 1]]) {
    const distance = pointToTriangle(end, corners);
    if (distance < best.distance) best = { distance, at };
  }
  return best;
}

export function pointToTriangle(p, [a, b, c]) {
  const n = cross(minus(b, a), minus(c, a)), size = length(n);
  const inside = size > 0 && [[a, b], [b, c], [c, a]].every(([x, y]) => dot(cross(minus(y, x), minus(p, x)), n) >= 0);
  if (inside) return Math.abs(dot(minus(p, a), n)) / size;
  return Math.min(...[[a, b], [b, c], [c, a]].map(([x, y]) => segments(p, p, x, y).distance));
}
