// The transition between two cells: `clues delta`.
import { Fields } from '../files/fields.js';
import { hull } from '../view/marks.js';
import { NUMBER } from '../view/labels.js';
import { SurfaceBuffer } from '../view/surface.js';

const SEEN = ['neither', 'from', 'to', 'both'];
const ENDS = ['first', 'second'];

function readEnd(top, key, last) {
  const end = top.object(key);
  return { cell: end.object('cell').points('vertices'), listed: new Set(end.wholes('visible', last)) };
}

function read(json, file) {
  const top = new Fields(json, file), scene = top.object('scene'), triangles = scene.whole('triangles'), last = triangles - 1;
  const packets = top.object('packets');
  const data = { ends: [readEnd(top, 'from', last), readEnd(top, 'to', last)], plus: packets.wholes('plus', last), minus: packets.wholes('minus', last), vertices: null, fragments: null };
  if (top.has('fragments')) {
    const f = top.object('fragments');
    data.vertices = f.points('vertices');
    data.fragments = f.objects('triangles').map((t) => {
      const corners = t.wholes('corners', data.vertices.length - 1);
      if (corners.length !== 3) t.wrong('corners', 'is no triangle');
      return { corners, triangle: t.whole('triangle', last), back: t.oneOf('side', ['front', 'back']) === 'back', seen: t.oneOf('seen', SEEN) };
    });
  }
  return { scene: { file: scene.text('file'), sha256: scene.text('sha256'), triangles }, cell: data.ends[0].cell, mode: top.oneOf('mode', ['sheet', 'solid']), data, at: 0 };
}

function areas({ vertices, fragments }) {
  const sum = Object.fromEntries(SEEN.map((word) => [word, 0]));
  for (const { corners, seen } of fragments) {
    const [a, b, c] = corners.map((i) => vertices[i]), u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
    sum[seen] += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return sum;
}

export default {
  id: 'delta',
  name: 'the transition',
  formats: ['clues-delta/1'],
  view: { id: 'delta', name: 'From cell to cell' },
  read,
  title: (part) => `transition in ${part.scene.file}`,
  listed: (part, t) => part.data.ends[part.at].listed.has(t),
  label({ data: { ends } }, t) {
    return SEEN[(ends[0].listed.has(t) ? 1 : 0) + (ends[1].listed.has(t) ? 2 : 0)];
  },
  surface({ data }, frame, listed) {
    if (!data.fragments) return null;
    const buffer = new SurfaceBuffer(data.fragments.length), places = data.vertices.map((p) => frame.local(p));
    for (const { corners: [a, b, c], triangle, back, seen } of data.fragments) buffer.push(places[a], places[b], places[c], triangle, NUMBER[seen], listed(triangle), back);
    return buffer.geometry();
  },
  summary({ data }) {
    const out = [`the first cell lists ${data.ends[0].listed.size} triangles, the second ${data.ends[1].listed.size}`, `packets: + ${data.plus.length}, − ${data.minus.length}`];
    if (!data.fragments) return [...out, 'Whole triangles: `clues delta --fragments` writes their parts.'];
    const sum = areas(data);
    return [...out, `area newly visible about ${Number(sum.to.toPrecision(5))}, newly hidden about ${Number(sum.from.toPrecision(5))}`];
  },
  layers: ({ data }, frame) => [{ id: 'cell-to', name: 'the second cell', colour: '#cc79a7', on: true, make: () => hull(frame, data.ends[1].cell, '#cc79a7') }],
  facts({ data }, t) {
    const words = data.plus.includes(t) ? ['in the packet +'] : data.minus.includes(t) ? ['in the packet −'] : [];
    const parts = data.fragments?.filter((f) => f.triangle === t).map((f) => `${f.back ? 'back' : 'front'}: ${f.seen === 'neither' ? 'neither' : f.seen === 'both' ? 'both' : f.seen === 'from' ? 'the first only' : 'the second only'}`) ?? [];
    return [...words, ...[...new Set(parts)].map((p) => `${p} (${parts.filter((x) => x === p).length} fragments)`)].map((text) => ({ text }));
  },
  extent: ({ data }) => data.ends.flatMap((end) => end.cell),
  steps: () => 2,
  cellAt: (part) => part.data.ends[part.at].cell,
  state: (part) => String(part.at),
  restore(part, text) { if (text === '0' || text === '1') part.at = Number(text); },
  panel: (part) => ({
    title: `In the ${ENDS[part.at]} cell`,
    lines: [`${part.data.ends[part.at].listed.size} triangles are listed here; standing in the cell shows what they draw.`],
    lists: [{ name: '+', ids: part.data.plus }, { name: '−', ids: part.data.minus }],
  }),
};
