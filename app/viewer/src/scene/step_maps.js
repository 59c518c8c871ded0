// The levels of a hierarchy cut into pieces of which each lies in one triangle of the level and in one of the base domain, and is mapped linearly from the one to the other. The
// map is that of the steps (D32) from the level down: beginning with the base domain, which is its own image, removals are undone. The new triangles of a removal
// and the star that they stand for cover one polygon of the plane, so pieces go from there to here by being cut along the spokes. In doubles: for pictures.
//
// A removal is { vertex, closed, ring, flat, triangles }: flat has the places of the ring in the plane, two numbers each, and the vertex is at 0; closed: the fan goes
// all around. A piece is { base, corners }: six numbers a corner, the weights in the triangle of the level (its vertices ascending) and those in the base triangle. They run
// around as the triangle does.
export const MOST_PIECES = 300000;
const ON_LINE = 1e-12;  // nearer to a spoke than this part of the star's width is on it; the grid of layouts is 2^-24

const ascending = (t) => [...t].sort((a, b) => a - b);
const key = (t) => ascending(t).join();

function basePieces(base) {
  const out = new Map();
  base.forEach((t, i) => {
    const order = ascending(t), corners = t.flatMap((v) => [...order, ...t].map((w) => (w === v ? 1 : 0)));
    out.set(key(t), [{ base: i, corners }]);
  });
  return out;
}

// A polygon of corners (x, y, and three weights) where side >= 0; `side` has a number for each.
function half(corners, side) {
  const out = [];
  for (let i = 0, n = side.length; i < n; ++i) {
    const j = (i + 1) % n;
    if (side[i] >= 0) out.push(corners[i]);
    if ((side[i] < 0 && side[j] > 0) || (side[i] > 0 && side[j] < 0)) {
      // From the same end for both neighbours, so that they get the same corner.
      const [p, q, t] = side[i] > 0 ? [corners[i], corners[j], side[i] / (side[i] - side[j])] : [corners[j], corners[i], side[j] / (side[j] - side[i])];
      out.push(p.map((x, k) => x + (q[k] - x) * t));
    }
  }
  return out.length >= 3 ? out : null;
}

function undo(pieces, { vertex, closed, ring, flat, triangles }) {
  const width = flat.reduce((m, x) => Math.max(m, Math.abs(x)), 0), place = new Map(ring.map((v, i) => [v, [flat[2 * i] / width, flat[2 * i + 1] / width]]));
  const wedges = ring.slice(0, closed ? ring.length : -1).map((from, i) => {
    const to = ring[(i + 1) % ring.length], [a, b] = [place.get(from), place.get(to)], t = [vertex, from, to], order = ascending(t);
    return { a, b, lengths: [Math.hypot(...a), Math.hypot(...b)], area: a[0] * b[1] - a[1] * b[0], from: order.map((v) => t.indexOf(v)), name: key(t), pieces: [] };
  });
  const beside = (p, d) => (Math.abs(d) <= ON_LINE * p ? 0 : d);
  for (const t of triangles) {
    const name = key(t), corner = ascending(t).map((v) => place.get(v));
    for (const { base, corners } of pieces.get(name)) {
      const flatCorners = [];
      for (let i = 0; i < corners.length; i += 6) flatCorners.push([0, 1].map((k) => corners[i] * corner[0][k] + corners[i + 1] * corner[1][k] + corners[i + 2] * corner[2][k]).concat(corners.slice(i + 3, i + 6)));
      for (const { a, b, lengths, area, from, pieces: into } of wedges) {
        let found = flatCorners;
        const cut = (d) => { const side = found.map(d); return side.some((s) => s > 0) ? (side.every((s) => s >= 0) ? found : half(found, side)) : null; };
        found = cut(([x, y]) => beside(lengths[0], a[0] * y - a[1] * x));
        if (found) found = cut(([x, y]) => beside(lengths[1], x * b[1] - y * b[0]));
        if (!found) continue;
        into.push({ base, corners: found.flatMap(([x, y, ...weights]) => {
          const [u, v] = [(x * b[1] - y * b[0]) / area, (a[0] * y - a[1] * x) / area], own = [1 - u - v, u, v];
          return [...from.map((k) => own[k]), ...weights];
        }) });
      }
    }
    pieces.delete(name);
  }
  for (const w of wedges) pieces.set(w.name, w.pieces);
}

// The pieces of each level, made when they are asked for.
export class StepMaps {
  constructor(base, removals) {
    this.removals = removals;
    this.made = [];
    this.made[removals.length] = basePieces(base);
  }
  // By the vertices of the triangle, ascending and joined by commas; null where there are more than MOST_PIECES.
  at(level) {
    let from = level;
    while (this.made[from] === undefined) ++from;
    for (; from > level; --from) {
      const pieces = this.made[from] && new Map(this.made[from]);
      if (pieces) for (const removal of [...this.removals[from - 1]].reverse()) undo(pieces, removal);
      let count = 0;
      for (const list of pieces?.values() ?? []) count += list.length;
      this.made[from - 1] = count > MOST_PIECES ? null : pieces;
    }
    return this.made[level];
  }
}
