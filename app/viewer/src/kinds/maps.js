// A hierarchy of `clues maps -o`: the levels of a surface, and its map to the base domain by the pieces of the overlay; from the levels between, by the steps.
import { flaw } from '../files/flaw.js';
import { MOST_PIECES, StepMaps } from '../scene/step_maps.js';
import { NUMBER, PATCHES, SCALE } from '../view/labels.js';
import { dots, lines } from '../view/marks.js';
import { SurfaceBuffer } from '../view/surface.js';

const WHOLE = 2 ** 60, OVERLAY_BELOW = 1.4, MOST_OUTLINED = 60000;

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
      const words = lines_.next(), length = lines_.index(words[3], 65536), at = 4 + length + 1 + 2 * length, count = lines_.index(words[at], 65536);
      return {
        vertex: vertex(words[1]), closed: words[2] !== 'boundary', ring: Array.from({ length }, (_, i) => vertex(words[4 + i])), flat: Array.from({ length: 2 * length }, (_, i) => lines_.number(words[5 + length + i])),
        triangles: Array.from({ length: count }, (_, i) => [1, 2, 3].map((k) => vertex(words[at + 3 * i + k]))),
      };
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
  const data = { flat, removals, base, points, pieces, levels: levelsOf(input, removals, n), maps: new StepMaps(base, removals), worst: points.reduce((m, p) => Math.max(m, p.far), 0), span: Math.max(...spans) || 1, colours: 'patches' };
  joinBase(data, file);
  followsItself(data, file);
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

// What undoing the steps relies on: new triangles are over the ring of their removal, and are there when it is undone; stars are laid out around their vertex.
function followsItself({ removals, levels, base }, file) {
  const key = (t) => [...t].sort((a, b) => a - b).join(), count = (list) => new Set(list).size;
  const last = levels.at(-1), ends = Array.from({ length: last.length / 3 }, (_, i) => key(last.subarray(3 * i, 3 * i + 3)));
  if (count(ends) !== base.length || count([...ends, ...base.map(key)]) !== base.length) throw flaw(file.path, 'has a base domain that is not its last level');
  removals.forEach((level, i) => {
    const next = levels[i + 1], there = new Set(Array.from({ length: next.length / 3 }, (_, k) => key(next.subarray(3 * k, 3 * k + 3))));
    for (const { vertex, ring, closed, flat, triangles } of level) {
      for (const t of triangles) if (!there.delete(key(t)) || !t.every((v) => ring.includes(v))) throw flaw(file.path, `has a removal of vertex ${vertex} that its next level does not have`);
      const turnsLeft = (i, j) => flat[2 * i] * flat[2 * j + 1] - flat[2 * i + 1] * flat[2 * j] > 0;
      if (!ring.every((_, k) => (k + 1 === ring.length && !closed) || turnsLeft(k, (k + 1) % ring.length))) throw flaw(file.path, `has a star of vertex ${vertex} that is not laid out around it`);
    }
  });
}

// The pieces of where one is: { triangle, base, corners: [{ at, to, weights }] } with places in space and weights in the base triangle; at both ends those of the overlay, with
// which the file proves its map, and between them those of the steps. Where these would be too many, triangles are so small that they are taken as a whole.
function piecesHere(part) {
  const { data, at } = part, { base, points, removals } = data;
  if (data.piecesOf === at) return data.here;
  data.piecesOf = at;
  if (isEnd(part)) {
    data.here = data.pieces.map(({ corners, input, base: b }) => ({
      triangle: at > 0 ? b : input, base: b,
      corners: corners.map((c) => ({ at: at > 0 ? points[c].to : points[c].at, far: points[c].far, weights: base[b].map((v) => points[c].image.find((x) => x.corner === v)?.weight ?? 0) })),
    }));
    return data.here;
  }
  const cut = data.maps.at(at), level = data.levels[at], sum = (vertices, weights) => [0, 1, 2].map((k) => vertices.reduce((x, v, i) => x + weights[i] * data.flat[3 * v + k], 0));
  data.here = [];
  if (!cut) data.here = wholeTriangles(data, level);
  for (let t = 0; cut && 3 * t < level.length; ++t) {
    const vertices = [...level.subarray(3 * t, 3 * t + 3)].sort((a, b) => a - b);
    for (const piece of cut.get(vertices.join())) {
      const corners = [];
      for (let i = 0; i < piece.corners.length; i += 6) {
        const weights = piece.corners.slice(i + 3, i + 6), here = sum(vertices, piece.corners.slice(i, i + 3));
        corners.push({ at: here, far: Math.hypot(...sum(base[piece.base], weights).map((x, k) => x - here[k])), weights });
      }
      data.here.push({ triangle: t, base: piece.base, corners });
    }
  }
  return data.here;
}

// Each triangle of a level on the base triangle that holds the images of most of its corners.
function wholeTriangles({ base, points, flat }, level) {
  const around = new Map();
  base.forEach((t, b) => t.forEach((v) => around.set(v, [...(around.get(v) ?? []), b])));
  return Array.from({ length: level.length / 3 }, (_, triangle) => {
    const vertices = [...level.subarray(3 * triangle, 3 * triangle + 3)], holds = (b) => vertices.filter((v) => points[v].image.every((x) => base[b].includes(x.corner))).length;
    const best = vertices.flatMap((v) => around.get(points[v].image[0].corner)).reduce((one, other) => (holds(other) > holds(one) ? other : one));
    const corners = vertices.map((v) => ({ at: [...flat.subarray(3 * v, 3 * v + 3)], far: points[v].far, weights: base[best].map((w) => points[v].image.find((x) => x.corner === w)?.weight ?? 0) }));
    return { triangle, base: best, corners };
  });
}

const isEnd = ({ at, data }) => at === 0 || at === data.removals.length;
const meshAt = ({ data, at }) => ({ points: data.flat, triangles: at === data.removals.length ? Uint32Array.from(data.base.flat()) : data.levels[at], faces: null });
const errorBin = (data, far) => (data.worst === 0 ? 0 : Math.min(SCALE - 1, Math.floor((SCALE * far) / data.worst)));
const percent = (x) => `${Number((100 * x).toPrecision(3))} %`;

// One of the two directions of an edge.
const before = (a, b) => a[0] < b[0] || (a[0] === b[0] && (a[1] < b[1] || (a[1] === b[1] && a[2] < b[2])));

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
  surface(part, frame) {
    const { data } = part, pieces = piecesHere(part);
    const buffer = new SurfaceBuffer(2 * pieces.length), charts = [];
    for (const { triangle, base, corners } of pieces) {
      const far = Math.max(...corners.map((c) => c.far)), places = corners.map((c) => frame.local(c.at));
      const label = data.colours === 'error' ? NUMBER[`scale-${errorBin(data, far)}`] : NUMBER[`patch-${data.patch[base]}`];
      for (let k = 2; k < corners.length; ++k) {
        buffer.push(places[0], places[k - 1], places[k], triangle, label, true, false);
        if (data.colours === 'checkerboard') for (const j of [0, k - 1, k]) charts.push(...corners[j].weights);
      }
    }
    return buffer.geometry(data.colours === 'checkerboard' ? Float32Array.from(charts) : null);
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
    const pieces = piecesHere(part);
    if (isEnd(part) || pieces.length < MOST_OUTLINED) {
      out.push({ id: 'overlay', name: 'the pieces, when near', colour: 'ink', on: true, count: pieces.length, make(ink) {
        const drawn = lines(frame, pieces.flatMap((p) => p.corners.map((c, k) => [c.at, p.corners[(k + 1) % p.corners.length].at])).filter(([a, b]) => before(a, b)), ink, 0.5);
        drawn.userData.below = OVERLAY_BELOW;
        return drawn;
      } });
    }
    return out.filter((layer) => layer.count > 0);
  },
  facts(part, t) {
    const { data, at } = part;
    const out = [{ text: `vertices ${[...meshAt(part).triangles.subarray(3 * t, 3 * t + 3)].join(', ')}` }];
    const mine = piecesHere(part).filter((p) => p.triangle === t), last = at === data.removals.length, bases = new Set(mine.map((p) => p.base));
    if (mine.length === 0) return out;
    out.push({ text: last ? `${mine.length} pieces of the surface lie here` : `in ${mine.length} pieces, on ${bases.size === 1 ? 'base triangle' : 'base triangles'} ${[...bases].slice(0, 8).join(', ')}` });
    const far = Math.max(0, ...mine.flatMap((p) => p.corners.map((c) => c.far)));
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
      lines: [`${meshAt(part).triangles.length / 3} triangles${at < last ? `; the next level takes ${data.removals[at].length} vertices away` : ''}`, ...(isEnd(part) || data.maps.at(at) ? [] : [`In this level patches have more than ${MOST_PIECES} pieces: each triangle is coloured as a whole.`])],
      bars: Array.from({ length: last + 1 }, (_, i) => ({ values: [i === last ? data.base.length : data.levels[i].length / 3], title: `level ${i}: ${i === last ? data.base.length : data.levels[i].length / 3} triangles` })),
      barNames: ['triangles'],
      choices: [{ id: 'maps-colours', name: 'Colours of', value: data.colours, options: [{ id: 'patches', name: 'patches' }, { id: 'checkerboard', name: 'a checkerboard of the base domain' }, { id: 'error', name: 'the distance to the image' }], set: (id) => { data.colours = id; app.setStep(part.at); } }],
      buttons: [],
    };
  },
};
