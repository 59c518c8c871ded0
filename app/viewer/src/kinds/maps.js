// A hierarchy of `clues maps -o`: the levels of a surface, and its map to the base domain by the pieces of the overlay.
import { flaw } from '../files/flaw.js';
import { NUMBER, PATCHES, SCALE } from '../view/labels.js';
import { dots, lines } from '../view/marks.js';
import { SurfaceBuffer } from '../view/surface.js';

const WHOLE = 2 ** 60, OVERLAY_BELOW = 1.4;

// A list a line, as docs/maps.md has them.
class Lines {
  constructor(text, file) {
    this.file = file;
    this.lines = text.split('\n');
    this.at = 0;
  }
  wrong(what) { throw flaw(this.file, `line ${this.at}: ${what}; is the file complete?`); }
  next() {
    while (this.at < this.lines.length) {
      const line = this.lines[this.at++].replace(/#.*/, '').trim();
      if (line !== '') return line.split(/\s+/);
    }
    this.at = this.lines.length;
    return this.wrong('the file ends here');
  }
  list(name) {
    const [word, count] = this.next();
    if (word !== name || !/^\d+$/.test(count ?? '') || Number(count) > this.lines.length) this.wrong(`"${name}" and how many was expected`);
    return Number(count);
  }
  number(word) {
    const x = Number(word);
    if (word === undefined || !Number.isFinite(x)) this.wrong(`${word ?? 'nothing'} is no number`);
    return x;
  }
  index(word, below) {
    const x = Number(word);
    if (!Number.isSafeInteger(x) || x < 0 || x >= below) this.wrong(`${word ?? 'nothing'} is no number below ${below}`);
    return x;
  }
  triples(name, read) { return Array.from({ length: this.list(name) }, () => { const words = this.next(); return [0, 1, 2].map((k) => read(words[k])); }); }
  carrier(words, from, below) {
    const count = this.index(words[from], 4), out = [];
    if (count === 0) this.wrong('a point has no corner');
    for (let k = 0; k < count; ++k) out.push({ corner: this.index(words[from + 1 + 2 * k], below), weight: this.number(words[from + 2 + 2 * k]) / WHOLE });
    return { corners: out, end: from + 1 + 2 * count };
  }
}

function readText(text, file) {
  const lines_ = new Lines(text, file.path);
  if (lines_.next().join(' ') !== 'clues-maps 1') throw flaw(file.path, 'is a hierarchy of another version');
  const vertices = lines_.triples('vertices', (w) => lines_.number(w)), n = vertices.length, vertex = (w) => lines_.index(w, n);
  const input = lines_.triples('triangles', vertex);
  for (const name of ['features', 'fixed']) for (let i = lines_.list(name); i > 0; --i) lines_.next();
  const removals = Array.from({ length: lines_.list('levels') }, () => {
    const level = Array.from({ length: lines_.list('removals') }, () => {
      const words = lines_.next(), ring = lines_.index(words[3], 65536), at = 4 + ring + 1 + 2 * ring, count = lines_.index(words[at], 65536);
      return { vertex: vertex(words[1]), triangles: Array.from({ length: count }, (_, i) => [1, 2, 3].map((k) => vertex(words[at + 3 * i + k]))) };
    });
    for (let i = lines_.list('kept'); i > 0; --i) lines_.next();
    return level;
  });
  const base = lines_.triples('base', vertex);
  const points = Array.from({ length: lines_.list('points') }, () => {
    const words = lines_.next(), source = lines_.carrier(words, 0, n), image = lines_.carrier(words, source.end, n);
    return { source: source.corners, image: image.corners };
  });
  const pieces = Array.from({ length: lines_.list('pieces') }, () => {
    const words = lines_.next();
    return { corners: [0, 1, 2].map((k) => lines_.index(words[k], points.length)), input: lines_.index(words[3], input.length) };
  });
  if (input.length === 0 || base.length === 0) throw flaw(file.path, 'has no triangles');
  const flat = Float64Array.from(vertices.flat()), place = (carrier) => [0, 1, 2].map((k) => carrier.reduce((x, { corner, weight }) => x + weight * vertices[corner][k], 0));
  for (const p of points) { p.at = place(p.source); p.to = place(p.image); p.far = Math.hypot(...p.at.map((x, k) => x - p.to[k])); }
  const spans = [0, 1, 2].map((k) => { let low = Infinity, high = -Infinity; for (const v of vertices) { low = Math.min(low, v[k]); high = Math.max(high, v[k]); } return high - low; });
  const data = { flat, removals, base, points, pieces, levels: levelsOf(input, removals, n), worst: points.reduce((m, p) => Math.max(m, p.far), 0), span: Math.max(...spans) || 1, colours: 'patches' };
  joinBase(data, file);
  const part = { scene: { file: file.path.split('/').pop(), sha256: null, triangles: input.length }, cell: [], mode: null, data, at: 0 };
  part.mesh = meshAt(part);
  return part;
}

// The triangles of each level: the star of a removed vertex goes, its new triangles come.
function levelsOf(input, removals, n) {
  const alive = new Map(), at = Array.from({ length: n }, () => new Set());
  let next = 0;
  const add = (t) => { alive.set(next, t); for (const v of t) at[v].add(next); ++next; };
  input.forEach(add);
  const out = [Uint32Array.from(input.flat())];
  for (const level of removals) {
    for (const { vertex, triangles } of level) {
      for (const id of [...at[vertex]]) { for (const v of alive.get(id)) at[v].delete(id); alive.delete(id); }
      triangles.forEach(add);
    }
    out.push(Uint32Array.from([...alive.values()].flat()));
  }
  return out;
}

// The base triangle of each piece, and a colour for each base triangle that its neighbours over edges do not have.
function joinBase(data, file) {
  const key = (t) => [...t].sort((a, b) => a - b).join(), number = new Map(data.base.map((t, i) => [key(t), i]));
  for (const piece of data.pieces) {
    const corners = new Set(piece.corners.flatMap((c) => data.points[c].image.map((x) => x.corner)));
    piece.base = number.get(key(corners)) ?? -1;
    if (piece.base < 0) throw flaw(file.path, 'has a piece whose image is in no base triangle');
  }
  const edges = new Map();
  data.base.forEach((t, i) => [0, 1, 2].forEach((k) => { const e = key([t[k], t[(k + 1) % 3]]); edges.set(e, [...(edges.get(e) ?? []), i]); }));
  data.patch = [];
  data.base.forEach((t, i) => {
    const taken = new Set([0, 1, 2].flatMap((k) => edges.get(key([t[k], t[(k + 1) % 3]]))).map((j) => data.patch[j]));
    let colour = i % PATCHES;
    while (taken.has(colour)) colour = (colour + 1) % PATCHES;
    data.patch.push(colour);
  });
}

const isEnd = ({ at, data }) => at === 0 || at === data.removals.length;
const meshAt = ({ data, at }) => ({ points: data.flat, triangles: at === data.removals.length ? Uint32Array.from(data.base.flat()) : data.levels[at], faces: null });
const errorBin = (data, far) => (data.worst === 0 ? 0 : Math.min(SCALE - 1, Math.floor((SCALE * far) / data.worst)));
const percent = (x) => `${Number((100 * x).toPrecision(3))} %`;

function edgesOf(triangles) {
  const out = [];
  for (let t = 0; t < triangles.length; t += 3) for (let k = 0; k < 3; ++k) { const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]]; if (a < b) out.push([a, b]); }
  return out;
}

export default {
  id: 'maps',
  name: 'the map',
  formats: [],
  begins: /^\s*clues-maps/,
  view: { id: 'maps', name: 'Levels' },
  readText,
  title: (part) => `hierarchy ${part.scene.file}`,
  label: () => 'level',
  // At both ends the pieces of the overlay, here or as the map has them.
  surface(part, frame) {
    const { data, at } = part;
    if (!isEnd(part)) return null;
    const buffer = new SurfaceBuffer(data.pieces.length), last = at > 0, places = data.points.map((p) => frame.local(last ? p.to : p.at));
    const charts = new Float32Array(9 * data.pieces.length);
    data.pieces.forEach(({ corners, input, base }, i) => {
      const far = Math.max(...corners.map((c) => data.points[c].far));
      const label = data.colours === 'error' ? NUMBER[`scale-${errorBin(data, far)}`] : NUMBER[`patch-${data.patch[base]}`];
      buffer.push(...corners.map((c) => places[c]), last ? base : input, label, true, false);
      corners.forEach((c, k) => data.base[base].forEach((v, m) => { charts[9 * i + 3 * k + m] = data.points[c].image.find((x) => x.corner === v)?.weight ?? 0; }));
    });
    return buffer.geometry(data.colours === 'checkerboard' ? charts : null);
  },
  names: ({ data }) => Object.fromEntries(Array.from({ length: SCALE }, (_, bin) => [`scale-${bin}`, `${percent((bin * data.worst) / SCALE / data.span)} to ${percent(((bin + 1) * data.worst) / SCALE / data.span)}`])),
  summary: ({ data }) => [
    `${data.levels[0].length / 3} triangles on ${data.base.length}, in ${data.removals.length} levels, by ${data.pieces.length} pieces`,
    `a point and its image are up to ${percent(data.worst / data.span)} of the longest side apart`,
  ],
  layers(part, frame) {
    const { data, at } = part, mesh = meshAt(part), place = (i) => [...data.flat.subarray(3 * i, 3 * i + 3)];
    const edges = edgesOf(mesh.triangles).map((e) => e.map(place)), next = (data.removals[at] ?? []).map((r) => place(r.vertex));
    const out = [
      { id: 'edges', name: at === data.removals.length ? 'edges of the base domain' : 'edges of this level', colour: 'ink', on: edges.length < 20000, count: edges.length, make: (ink) => lines(frame, edges, ink, isEnd(part) && at > 0 ? 2.4 : 0.7) },
      { id: 'next', name: 'vertices that the next level takes away', colour: '#ff00d4', on: !isEnd(part), count: next.length, make: () => dots(frame, next, '#ff00d4', 5) },
    ];
    if (isEnd(part)) {
      const where = (c) => (at > 0 ? data.points[c].to : data.points[c].at);
      out.push({ id: 'overlay', name: 'the overlay, when near', colour: '#0072b2', on: true, count: data.pieces.length, make(ink) {
        const drawn = lines(frame, edgesOf(data.pieces.flatMap((p) => p.corners)).map((e) => e.map(where)), ink, 0.5);
        drawn.userData.below = OVERLAY_BELOW;
        return drawn;
      } });
    }
    return out.filter((layer) => layer.count > 0);
  },
  facts(part, t) {
    const { data, at } = part;
    const out = [{ text: `vertices ${[...meshAt(part).triangles.subarray(3 * t, 3 * t + 3)].join(', ')}` }];
    if (!isEnd(part)) return out;
    const mine = data.pieces.filter((p) => (at > 0 ? p.base : p.input) === t), others = new Set(mine.map((p) => (at > 0 ? p.input : p.base)));
    out.push({ text: at > 0 ? `parts of ${others.size} triangles of the surface lie here, in ${mine.length} pieces` : `in ${mine.length} pieces, on ${others.size === 1 ? 'base triangle' : 'base triangles'} ${[...others].slice(0, 8).join(', ')}` });
    const far = Math.max(0, ...mine.flatMap((p) => p.corners.map((c) => data.points[c].far)));
    out.push({ text: `up to ${percent(far / data.span)} of the longest side from its image` });
    return out;
  },
  steps: (part) => part.data.removals.length + 1,
  meshAt,
  state: ({ at, data }) => `${at}:${data.colours}`,
  restore(part, text) {
    const [at, colours] = text.split(':');
    part.at = Math.max(0, Math.min(part.data.removals.length, Number(at) || 0));
    if (['patches', 'checkerboard', 'error'].includes(colours)) part.data.colours = colours;
  },
  panel(part, app) {
    const { data, at } = part, last = data.removals.length;
    return {
      title: at === 0 ? 'The surface' : at === last ? 'The base domain' : `Level ${at} of ${last}`,
      lines: [`${meshAt(part).triangles.length / 3} triangles${at < last ? `; the next level takes ${data.removals[at].length} vertices away` : ''}`, ...(isEnd(part) ? [] : ['Patches are drawn on the surface and on the base domain, at both ends of the slider.'])],
      bars: Array.from({ length: last + 1 }, (_, i) => ({ values: [i === last ? data.base.length : data.levels[i].length / 3], title: `level ${i}: ${i === last ? data.base.length : data.levels[i].length / 3} triangles` })),
      barNames: ['triangles'],
      choices: [{ id: 'maps-colours', name: 'Colours of', value: data.colours, options: [{ id: 'patches', name: 'patches' }, { id: 'checkerboard', name: 'a checkerboard of the base domain' }, { id: 'error', name: 'the distance to the image' }], set: (id) => { data.colours = id; app.setStep(isEnd(part) ? part.at : 0); } }],
      buttons: [],
    };
  },
};
