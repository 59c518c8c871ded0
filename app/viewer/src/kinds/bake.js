// The lists of all cells of a scene: a store of `clues bake`, or what `clues view` puts into a page of it.
import { readBakeStore } from '../files/bake_store.js';
import { Fields } from '../files/fields.js';
import { bitOf, bitsOfRuns, without } from '../files/runs.js';
import { LABELS, LAYER_COLOURS, NUMBER, SCALE } from '../view/labels.js';
import { middle } from '../scene/vectors.js';
import { hull, hulls, lines } from '../view/marks.js';
import { Group } from 'three';

const BYTES = 4;  // of a triangle's number in a message
const MOST_SHOWN = 2000;  // cells in lists of the panel

function read(json, file) {
  const top = new Fields(json, file), scene = top.object('scene'), triangles = scene.whole('triangles');
  const nodes = top.list('nodes');
  nodes.forEach((parent, i) => { if (!Number.isSafeInteger(parent) || parent < 0 || (i > 0 && parent >= i)) top.wrong('nodes', 'is no tree'); });
  const cells = top.objects('cells').map((c) => {
    const list = bitsOfRuns(c.text('runs'), triangles) ?? c.wrong('runs', `is no list of ${triangles} triangles`), points = c.points('points');
    if (points.length === 0) c.wrong('points', 'has no point');
    return { name: c.text('name'), node: c.whole('node', nodes.length - 1), fallbacks: c.whole('fallbacks'), points, ...list };
  });
  if (cells.length === 0) top.wrong('cells', 'has none');
  return partOf({ scene: { file: scene.text('file'), sha256: scene.text('sha256'), triangles }, note: top.text('note'), nodes, cells });
}

function partOf({ scene, note, nodes, cells }) {
  for (const c of cells) { c.low = bound(c.points, Math.min); c.high = bound(c.points, Math.max); }
  const data = { nodes, cells, note, near: joined(cells), most: cells.reduce((x, c) => Math.max(x, c.count), 0), least: cells.reduce((x, c) => Math.min(x, c.count), Infinity), path: [0] };
  data.path = longest(data);
  return { scene, cell: cells[0].points, mode: null, data, at: 0 };
}

const bound = (points, least) => [0, 1, 2].map((k) => points.reduce((x, p) => least(x, p[k]), points[0][k]));

// For each cell the others whose boxes share more than an edge with its own: in them one goes from cell to cell. In the order of their beginnings only those that begin
// before a cell ends are looked at.
function joined(cells) {
  const order = cells.map((_, i) => i).sort((i, j) => cells[i].low[0] - cells[j].low[0]), out = cells.map(() => []);
  order.forEach((i, at) => {
    for (let next = at + 1; next < order.length && cells[order[next]].low[0] <= cells[i].high[0]; ++next) {
      const j = order[next], wide = [0, 1, 2].map((k) => Math.min(cells[i].high[k], cells[j].high[k]) - Math.max(cells[i].low[k], cells[j].low[k]));
      if (!wide.every((w) => w >= 0) || wide.filter((w) => w === 0).length > 1) continue;
      out[i].push(j);
      out[j].push(i);
    }
  });
  for (const list of out) list.sort((a, b) => a - b);
  return out;
}

// Fewest steps from a cell to every other: where each was come to from; -1: not at all.
function ways(data, from) {
  const before = new Map([[from, -1]]), queue = [from];
  for (const i of queue) for (const j of data.near[i]) if (!before.has(j)) { before.set(j, i); queue.push(j); }
  return { before, last: queue.at(-1) };
}
function way(data, from, to) {
  const { before } = ways(data, from), out = [];
  if (!before.has(to)) return null;
  for (let i = to; i >= 0; i = before.get(i)) out.unshift(i);
  return out;
}
// From the first cell to one that is as far as can be.
const longest = (data) => way(data, 0, ways(data, 0).last);

const binOf = ({ most, least }, count) => (most === least ? 0 : Math.min(SCALE - 1, Math.floor((SCALE * (count - least)) / (most - least))));

// What the step to this place of the path adds and takes away; null at its beginning.
function stepAt({ data: { cells, path } }, at) {
  if (at === 0) return null;
  const [a, b] = [cells[path[at - 1]], cells[path[at]]];
  return { plus: without(b.bits, a.bits), minus: without(a.bits, b.bits) };
}
const here = ({ data, at }) => data.cells[data.path[at]];

function go(part, app, to) {
  const { data } = part, rest = way(data, data.path[part.at], to);
  data.path = rest ? [...data.path.slice(0, part.at + 1), ...rest.slice(1)] : [to];
  app.setStep(data.path.length - 1);
}

function tree(data) {
  const { nodes, cells } = data;
  const made = nodes.map((_, i) => ({ name: i === 0 ? 'the scene' : `group ${i}`, children: [] }));
  for (let i = 1; i < nodes.length; ++i) made[nodes[i]].children.push(made[i]);
  cells.forEach((c, i) => made[c.node].children.push({ name: c.name, cell: i, note: String(c.count), colour: LABELS[NUMBER[`scale-${binOf(data, c.count)}`]].colour }));
  return made[0];
}

export default {
  id: 'bake',
  name: 'the cell',
  formats: ['clues-bake-page/1'],
  begins: /^SQLite format 3/,
  view: { id: 'bake', name: 'Bake' },
  read,
  readBytes: (bytes, file) => partOf(readBakeStore(bytes, file.path)),
  title: (part) => `bake of ${part.scene.file}`,
  listed: (part, t) => bitOf(here(part).bits, t),
  label(part, t) {
    const { data: { cells, path }, at } = part, now = bitOf(cells[path[at]].bits, t);
    if (at === 0) return now ? 'listed' : 'unlisted';
    const before = bitOf(cells[path[at - 1]].bits, t);
    return now ? (before ? 'listed' : 'plus') : before ? 'minus' : 'unlisted';
  },
  summary({ data, scene }) {
    const sum = data.cells.reduce((n, c) => n + c.count, 0), out = [`${data.cells.length} cells; of ${scene.triangles} triangles they list ${data.least} to ${data.most}, ${Number((sum / data.cells.length).toPrecision(4))} in the mean`];
    const fallbacks = data.cells.reduce((n, c) => n + c.fallbacks, 0);
    if (fallbacks > 0) out.push(`${fallbacks} listed without a decision`);
    if (data.note !== '') out.push(data.note);
    return out;
  },
  layers(part, frame) {
    const { data } = part, { cells, path } = data;
    return [
      { id: 'cells', name: 'cells, coloured by the length of their lists', colour: LABELS[NUMBER['scale-4']].colour, on: true, count: cells.length, make(ink) {
        const group = new Group();
        for (let bin = 0; bin < SCALE; ++bin) {
          const of = cells.filter((c, i) => i !== path[part.at] && binOf(data, c.count) === bin), { colour } = LABELS[NUMBER[`scale-${bin}`]];
          group.add(hulls(frame, of.map((c) => c.points), colour, 0.35, ink));
        }
        return group;
      } },
      { id: 'path', name: 'the path', colour: 'ink', on: true, count: path.length, make(ink) {
        const places = path.map((i) => middle(cells[i].points)), group = new Group();
        if (path.length > 1) group.add(lines(frame, places.slice(1).map((p, i) => [places[i], p]), ink, 2.5, { over: true }));
        group.add(hull(frame, cells[path[part.at]].points, LAYER_COLOURS.cell));
        return group;
      } },
    ];
  },
  names({ data }) {
    const at = (bin) => Math.ceil(data.least + (bin * (data.most - data.least)) / SCALE);
    return Object.fromEntries(Array.from({ length: SCALE }, (_, bin) => [`scale-${bin}`, `${at(bin)} to ${bin === SCALE - 1 ? data.most : Math.max(at(bin), at(bin + 1) - 1)} listed`]));
  },
  // Labels of layers, which belong into the legend though no surface has them.
  alsoUsed: ({ data }) => [...new Set(data.cells.map((c) => NUMBER[`scale-${binOf(data, c.count)}`]))],
  facts(part, t) {
    const inCells = part.data.cells.filter((c) => bitOf(c.bits, t)).length;
    return [{ text: bitOf(here(part).bits, t) ? 'listed in this cell' : 'not listed in this cell' }, { text: `listed in ${inCells} of ${part.data.cells.length} cells` }];
  },
  extent: ({ data }) => data.cells.flatMap((c) => c.points),
  steps: (part) => part.data.path.length,
  cellAt: (part) => here(part).points,
  state: (part) => `${part.at}:${part.data.path.join('.')}`,
  restore(part, text) {
    const [at, path] = text.split(':'), cells = (path ?? '').split('.').map(Number);
    if (cells.length === 0 || !cells.every((i) => Number.isSafeInteger(i) && i >= 0 && i < part.data.cells.length)) return;
    part.data.path = cells;
    part.at = Math.max(0, Math.min(cells.length - 1, Number(at) || 0));
  },
  panel(part, app) {
    const { data } = part, { cells, path } = data, cell = here(part), step = stepAt(part, part.at);
    const sizes = path.map((i, k) => { const s = stepAt(part, k); return s ? [BYTES * s.plus.length, BYTES * s.minus.length] : [BYTES * cells[i].count, 0]; });
    const sent = sizes.reduce((sum, [a, b]) => sum + a + b, 0), whole = path.reduce((sum, i) => sum + BYTES * cells[i].count, 0);
    const near = data.near[path[part.at]];
    return {
      title: `Cell ${cell.name}`,
      lines: [
        `step ${part.at} of ${path.length - 1}: ${cell.count} listed${step ? `; + ${step.plus.length}, − ${step.minus.length}` : ', all of them sent'}`,
        `on this path ${sent} bytes are sent, whole lists would be ${whole} (${BYTES} bytes for the number of a triangle)`,
      ],
      bars: sizes.map((values, k) => ({ values, title: `step ${k}, cell ${cells[path[k]].name}: + ${values[0]} bytes, − ${values[1]} bytes` })),
      barNames: ['bytes of +', 'bytes of −'],
      choices: cells.length > 1 && cells.length <= MOST_SHOWN ? [{ id: 'go', name: 'On to', value: '', options: [{ id: '', name: '(a cell)' }, ...cells.map((c, i) => ({ id: String(i), name: `${c.name}: ${c.count}` }))], set: (id) => { if (id !== '') go(part, app, Number(id)); } }] : [],
      buttons: [...near.slice(0, 12).map((j) => ({ name: cells[j].name, title: `on to the neighbour ${cells[j].name}`, does: () => go(part, app, j) })), { name: 'Begin here', title: 'a new path, from this cell', does: () => { data.path = [path[part.at]]; app.setStep(0); } }],
      lists: step ? [{ name: '+', ids: step.plus }, { name: '−', ids: step.minus }] : [],
      tree: cells.length <= MOST_SHOWN ? tree(data) : null,
      choose: (i) => go(part, app, i),
    };
  },
};
