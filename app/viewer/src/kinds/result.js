// What `clues map` wrote: the list, and with --map the regions, segments and wedges.
import { Fields } from '../files/fields.js';
import { fraction, near, plus, text } from '../files/exact.js';
import { LAYER_COLOURS } from '../view/labels.js';
import { body, lines, loop } from '../view/marks.js';

function read(json, file) {
  const top = new Fields(json, file), scene = top.object('scene'), triangles = scene.whole('triangles');
  const last = triangles - 1;
  const data = { listed: new Set(top.wholes('visible', last)), method: top.text('method'), kernel: top.text('kernel'), regions: null, segments: [], wedges: [] };
  const mode = top.oneOf('mode', ['sheet', 'solid']);
  if (top.has('regions')) {
    data.regions = top.objects('regions').map((r) => ({
      triangle: r.whole('triangle', last), side: r.oneOf('side', ['front', 'back']), visible: r.flag('visible'),
      rings: r.list('rings').map((ring) => (Array.isArray(ring) ? ring.map((p) => r.pointOf(p, 'rings')) : r.wrong('rings', 'holds what is no list of points'))),
      exact: r.has('area_fraction') ? fraction(r.text('area_fraction')) ?? r.wrong('area_fraction', 'is no exact number') : null,
      area: r.has('area_estimate') ? r.json.area_estimate : null,
    }));
    data.segments = top.objects('segments').map((s) => ({ boundary: s.flag('boundary'), points: s.pointsOrNull('points') })).filter((s) => s.points);
    data.wedges = top.objects('wedges').map((w) => ({ kind: w.text('kind'), points: w.pointsOrNull('points') })).filter((w) => w.points);
    for (const s of data.segments) if (s.points.length !== 2) top.wrong('segments', 'holds one without two ends');
    for (const w of data.wedges) if (w.points.length !== 4) top.wrong('wedges', 'holds one without four corners');
  }
  const sha256 = scene.has('sha256') ? scene.text('sha256') : null;
  return { scene: { file: scene.text('file'), sha256, triangles }, cell: top.object('cell').points('vertices'), mode, data };
}

const triangleArea = ([a, b, c]) => {
  const u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
  return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
};

// The visible part of a side, as text; null where the map says nothing about it.
export function visiblePart(data, triangle, side, corners) {
  const here = data.regions.filter((r) => r.triangle === triangle && r.side === side);
  if (here.length === 0) return null;
  const seen = here.filter((r) => r.visible);
  if (here.every((r) => r.exact)) {
    const sum = seen.reduce((total, r) => plus(total, r.exact), [0n, 1n]), written = text(sum);
    return `${written.length > 40 ? `${written.slice(0, 18)}…` : written}${sum[1] === 1n ? '' : ` (${percent(near(sum))})`}`;
  }
  const all = here.reduce((total, r) => total + (r.area ?? 0), 0) || triangleArea(corners);
  return `about ${percent(seen.reduce((total, r) => total + (r.area ?? 0), 0) / all)}`;
}

export const percent = (x) => `${Number((100 * x).toPrecision(4))} %`;

export default {
  id: 'result',
  name: 'the list',
  formats: ['clues-result/1'],
  read,
  title: (part) => `map of ${part.scene.file}`,
  listed: (part, t) => part.data.listed.has(t),
  label: (part, t) => (part.data.listed.has(t) ? 'visible' : 'hidden'),
  regions: (part) => part.data.regions,
  summary(part) {
    const { data, scene, mode } = part;
    const out = [`${data.listed.size} of ${scene.triangles} triangles are listed as visible`, `${data.method}, ${data.kernel} kernel, ${mode} mode`];
    if (!data.regions) out.push('Without regions: `clues map --map` writes them.');
    return out;
  },
  layers(part, frame) {
    const { wedges, segments } = part.data, out = [];
    for (const boundary of [true, false]) {
      const chosen = segments.filter((s) => s.boundary === boundary).map((s) => s.points);
      if (chosen.length > 0)
        out.push({ id: boundary ? 'ob' : 'dm', name: boundary ? 'OB segments (visible from hidden)' : 'other DM segments', colour: 'ink', on: true, count: chosen.length,
                   make: (ink) => lines(frame, chosen, ink, boundary ? 2.4 : 1.2, { dashed: !boundary }) });
    }
    for (const kind of new Set(wedges.map((w) => w.kind))) {
      const chosen = wedges.filter((w) => w.kind === kind).map(({ points: [a, b, c, d] }) => [a, b, d, c]);
      const colour = LAYER_COLOURS[kind] ?? '#888888';
      out.push({
        id: kind.toLowerCase(), name: `${kind} wedges`, colour, on: false, count: chosen.length,
        make() {
          const faces = body(frame, chosen.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]), colour, 0.16);
          faces.add(lines(frame, chosen.flatMap(loop), colour, 1));
          return faces;
        },
      });
    }
    return out;
  },
  facts(part, triangle, corners) {
    if (!part.data.regions) return [{ text: part.data.listed.has(triangle) ? 'listed as visible' : 'not listed: hidden' }];
    return ['front', 'back'].map((side) => {
      const seen = visiblePart(part.data, triangle, side, corners);
      return { text: seen === null ? `${side}: no statement` : `${side}: visible part ${seen}` };
    });
  },
};
