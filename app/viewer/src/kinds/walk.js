// A depth mesh that follows a viewpoint: `clues motion --walk-out`. The bounds, where there are any, were computed by `clues view` (docs/viewer.md).
import { flaw } from '../files/flaw.js';
import { bytesOf } from '../files/mesh_bytes.js';
import { dots, lines, loop } from '../view/marks.js';

const FREE = 0xffffffff, MOST_PLACES = 2 ** 26, DUE = 64;

function readText(text, file) {
  const wrong = (n, what) => { throw flaw(file.path, `line ${n + 1}: ${what}; is the file complete?`); };
  const rows = text.split('\n').map((row) => row.trim());
  while (rows.length > 0 && rows.at(-1) === '') rows.pop();
  const parsed = rows.map((row, n) => { try { return JSON.parse(row); } catch { return wrong(n, 'is no JSON'); } });
  if (parsed[0]?.format !== 'clues-motion-walk/1') throw flaw(file.path, `is a walk of another version: ${String(parsed[0]?.format)}`);
  const whole = (x, below) => Number.isSafeInteger(x) && x >= 0 && x < below;
  const isPoint = (p) => Array.isArray(p) && p.length === 3 && p.every(Number.isFinite);
  let sizes = [0, 0];
  const frames = parsed.slice(1).map((row, i) => {
    const n = i + 1;
    if (row === null || typeof row !== 'object' || !isPoint(row.viewpoint)) wrong(n, 'has no viewpoint');
    if (row.sizes !== undefined) {
      if (!Array.isArray(row.sizes) || row.sizes.length !== 2 || !row.sizes.every((x) => whole(x, MOST_PLACES))) wrong(n, '"sizes" is not [SAMPLES, TRIANGLES]');
      sizes = row.sizes;
    }
    const list = (key) => (row[key] === undefined ? [] : Array.isArray(row[key]) ? row[key] : wrong(n, `"${key}" is no list`));
    const samples = list('samples'), triangles = list('triangles');
    for (const s of samples) if (!Array.isArray(s) || !whole(s[0], sizes[0]) || !isPoint(s.slice(1, 4))) wrong(n, `${JSON.stringify(s).slice(0, 60)} is no sample of ${sizes[0]}`);
    for (const t of triangles) if (!Array.isArray(t) || !whole(t[0], sizes[1]) || !(t.length === 1 || (t.length === 4 && t.slice(1).every((c) => whole(c, sizes[0]))))) wrong(n, `${JSON.stringify(t).slice(0, 60)} is no triangle of ${sizes[1]}`);
    return { viewpoint: row.viewpoint, sizes, samples, triangles };
  });
  if (frames.length === 0) throw flaw(file.path, 'has no frames');
  const bounds = file.bounds ? { step: file.bounds.step, frames: file.bounds.frames.map((f) => new Uint8Array(bytesOf(f))) } : null;
  const data = { frames, bounds, cursor: -1, points: new Float64Array(0), kinds: [], triangles: new Uint32Array(0), colours: bounds ? 'bounds' : 'changes', inside: false };
  const most = frames.reduce((m, f) => f.sizes.map((x, k) => Math.max(x, m[k])), [0, 0]);
  data.places = new Float64Array(3 * most[0]);
  data.kinds = new Array(most[0]).fill('');
  data.triangles = new Uint32Array(3 * most[1]).fill(FREE);
  data.radius = reach(frames);
  const part = { scene: { file: file.path.split('/').pop(), sha256: null, triangles: most[1] }, cell: [], mode: null, data, at: 0 };
  part.mesh = meshOf(part);
  return part;
}

// Of what stands nearby, from the first viewpoint; directions are drawn a little beyond.
function reach(frames) {
  let far = 0;
  for (const f of frames) for (const [, x, y, z, kind] of f.samples) if (!isDirection(kind)) far = Math.max(far, Math.hypot(x - f.viewpoint[0], y - f.viewpoint[1], z - f.viewpoint[2]));
  return far > 0 ? 1.1 * far : 1;
}
const isDirection = (kind) => typeof kind === 'string' && kind.includes('direction');

// The state after frame `part.at`: from the one before, or from the beginning.
function seek(part) {
  const { data } = part;
  if (data.cursor > part.at) {
    data.cursor = -1;
    data.triangles.fill(FREE);
    data.kinds.fill('');
    data.places.fill(0);
  }
  while (data.cursor < part.at) {
    const frame = data.frames[++data.cursor], last = data.cursor === part.at;
    if (last) { data.before = data.triangles.slice(); data.made = new Set(); data.gone = new Set(); }
    data.triangles.fill(FREE, 3 * frame.sizes[1]);
    for (const [i, x, y, z, kind] of frame.samples) {
      if (last && i < (data.frames[data.cursor - 1]?.sizes[0] ?? 0) && data.kinds[i] !== '') data.gone.add(i);
      data.places.set([x, y, z], 3 * i);
      data.kinds[i] = kind ?? 'point';
    }
    for (const [i, ...corners] of frame.triangles) {
      data.triangles.set(corners.length === 3 ? corners : [FREE, FREE, FREE], 3 * i);
      if (last) data.made.add(i);
    }
  }
}

// Triangles keep their places; those that are free, or have a corner at infinity, are points.
function meshOf(part) {
  seek(part);
  const { data } = part, { viewpoint } = data.frames[part.at], points = data.places.slice();
  for (let i = 0; i < data.kinds.length; ++i) {
    if (!isDirection(data.kinds[i])) continue;
    const d = points.subarray(3 * i, 3 * i + 3), size = Math.hypot(...d) || 1;
    for (let k = 0; k < 3; ++k) d[k] = viewpoint[k] + (data.radius * d[k]) / size;
  }
  // Where no sample was ever, the viewpoint, so that the picture does not reach to the origin.
  data.kinds.forEach((kind, i) => { if (kind === '') points.set(viewpoint, 3 * i); });
  const triangles = data.triangles.slice();
  data.sky = 0;
  data.count = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    if (triangles[t] === FREE) { triangles.fill(0, t, t + 3); continue; }
    ++data.count;
    if (![0, 1, 2].some((k) => isDirection(data.kinds[triangles[t + k]]))) continue;
    ++data.sky;
    triangles.fill(triangles[t], t, t + 3);
  }
  data.order = null;
  return { points, triangles, faces: null };
}

// The byte of a place, as the bounds of the frame have it: they come without free places.
function boundOf({ data, at }, t) {
  if (!data.bounds) return null;
  if (!data.order) {
    data.order = new Int32Array(data.triangles.length / 3);
    for (let i = 0, n = 0; i < data.order.length; ++i) data.order[i] = data.triangles[3 * i] === FREE ? -1 : n++;
  }
  return data.bounds.frames[at]?.[data.order[t]] ?? null;
}
const isMade = ({ data, at }, t) => at > 0 && data.made.has(t) && data.triangles[3 * t] !== FREE;
function removed({ data }) {
  const out = [];
  for (const t of data.made) if (data.before[3 * t] !== FREE) out.push([0, 1, 2].map((k) => data.before[3 * t + k]));
  return out;
}
const LIMITS = ['1/4', '1', '4', '16', '64', '256', '1024'];  // in steps, of all but the last
const spread = (bin) => (bin === 0 ? 'less than 1/4 of a step' : bin === LIMITS.length ? '1024 steps or more' : `${LIMITS[bin - 1]} to ${LIMITS[bin]} steps`);

// Numbers of every frame, from the changes alone.
function counts(data) {
  if (!data.counts) {
    data.counts = data.frames.map((f, i) => ({ made: i === 0 ? 0 : f.triangles.filter((t) => t.length === 4).length, due: data.bounds ? data.bounds.frames[i].reduce((n, b) => n + (b >= DUE ? 1 : 0), 0) : 0 }));
  }
  return data.counts;
}

export default {
  id: 'walk',
  name: 'the walk',
  formats: [],
  begins: /^[^\n]*"clues-motion-walk\//,
  view: { id: 'motion', name: 'Motion' },
  readText,
  title: (part) => `walk ${part.scene.file}`,
  label(part, t) {
    const [a, b] = part.mesh.triangles.subarray(3 * t, 3 * t + 2);
    if (a === b) return 'none';  // not drawn
    const byte = boundOf(part, t);
    if (part.data.colours === 'bounds' && byte !== null) return `scale-${byte & 7}`;
    if (byte !== null && byte >= DUE) return 'due';
    return isMade(part, t) ? 'made' : 'kept';
  },
  names: () => Object.fromEntries(Array.from({ length: 8 }, (_, bin) => [`scale-${bin}`, `bound: ${spread(bin)}`])),
  summary(part) {
    const { data } = part, out = [`${data.frames.length} frames`];
    if (!data.bounds) out.push('Without bounds: `clues view` computes them.');
    return out;
  },
  layers(part, frame) {
    const { data, at, mesh } = part, place = (i) => [...mesh.points.subarray(3 * i, 3 * i + 3)];
    const gone = at > 0 ? removed(part).filter((t) => !t.some((c) => isDirection(data.kinds[c]))) : [];
    const edges = [];
    for (let t = 0; t < mesh.triangles.length; t += 3) {
      const [a, b, c] = mesh.triangles.subarray(t, t + 3);
      if (a === b) continue;
      for (const [p, q] of [[a, b], [b, c], [c, a]]) if (p < q) edges.push([place(p), place(q)]);
    }
    const way = data.frames.slice(1).map((f, i) => [data.frames[i].viewpoint, f.viewpoint]);
    return [
      { id: 'edges', name: 'edges', colour: 'ink', on: edges.length < 20000, count: edges.length, make: (ink) => lines(frame, edges, ink, 0.6) },
      { id: 'removed', name: 'triangles removed in this frame', colour: '#ff00d4', on: true, count: gone.length, make: () => lines(frame, gone.flatMap((t) => loop(t.map(place))), '#ff00d4', 1.6, { over: true }) },
      { id: 'way', name: 'the way of the viewpoint', colour: '#00c853', on: true, count: data.frames.length, make() {
        const made = dots(frame, [data.frames[at].viewpoint], '#00c853', 9);
        if (way.length > 0) made.add(lines(frame, way, '#00c853', 2, { over: true }));
        return made;
      } },
    ].filter((layer) => layer.count > 0);
  },
  facts(part, t) {
    const byte = boundOf(part, t), { data } = part;
    if (3 * t >= data.triangles.length || data.triangles[3 * t] === FREE) return [{ text: 'this place is free' }];
    const out = [{ text: `samples ${[...data.triangles.subarray(3 * t, 3 * t + 3)].join(', ')}` }];
    if (byte !== null) out.push({ text: `bound left: ${spread(byte & 7)}` });
    if (byte !== null && byte >= DUE) out.push({ text: 'examined in this frame: its bound was used up' });
    if (isMade(part, t)) out.push({ text: 'made in this frame' });
    return out;
  },
  extent: ({ data }) => data.frames.map((f) => f.viewpoint).concat(data.frames.flatMap((f) => f.samples.filter((x) => !isDirection(x[4])).map((x) => x.slice(1, 4)))),
  steps: (part) => part.data.frames.length,
  meshAt: (part) => (part.mesh = meshOf(part)),
  eyeAt: (part) => (part.data.inside ? part.data.frames[part.at].viewpoint : null),
  state: ({ at, data }) => `${at}:${data.colours}${data.inside ? ':inside' : ''}`,
  restore(part, text) {
    const [at, colours, inside] = text.split(':'), { data } = part;
    part.at = Math.max(0, Math.min(data.frames.length - 1, Number(at) || 0));
    if (colours === 'changes' || (colours === 'bounds' && data.bounds)) data.colours = colours;
    data.inside = inside === 'inside';
  },
  panel(part, app) {
    const { data, at } = part, all = counts(data), gone = at > 0 ? removed(part).length : 0;
    return {
      title: `Frame ${at} of ${data.frames.length - 1}`,
      lines: [
        `${data.count} triangles, ${data.sky} of them with a corner at infinity, which are not drawn`,
        ...(at > 0 ? [`${data.bounds ? `${all[at].due} examined, ` : ''}${gone} removed, ${all[at].made} made`] : []),
        ...(data.bounds ? [`a step is ${Number(data.bounds.step.toPrecision(4))} in the mean; bounds are those of facing, edges and separations`] : []),
      ],
      bars: all.map((c, i) => ({ values: data.bounds ? [c.due, c.made] : [c.made], title: `frame ${i}: ${data.bounds ? `${c.due} examined, ` : ''}${c.made} made` })),
      barNames: data.bounds ? ['examined', 'made'] : ['made'],
      choices: data.bounds ? [{ id: 'walk-colours', name: 'Colours of', value: data.colours, options: [{ id: 'bounds', name: 'the bounds' }, { id: 'changes', name: 'what is examined and made' }], set: (id) => { data.colours = id; app.setStep(part.at); } }] : [],
      buttons: [{ name: data.inside ? 'From outside' : 'From the viewpoint', does: () => { data.inside = !data.inside; app.setStep(part.at); } }],
      plays: true,
    };
  },
};
