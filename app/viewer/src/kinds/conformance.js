// The table of `clues conform --json`. `clues view` adds the scenes of the cases that are unsound, where it finds the suite.
import { Fields } from '../files/fields.js';
import { point } from '../files/exact.js';
import { embeddedMesh } from '../files/mesh_bytes.js';
import { sightFact } from './sight.js';

const BAD = new Set(['unsound', 'malformed_output', 'crash', 'timeout']);

function readCases(json, file) {
  const top = new Fields(json, file), implementation = top.object('implementation');
  const name = `${implementation.text('name')} ${implementation.text('version')}`;
  const cases = top.objects('cases').map((c) => {
    const first = c.has('missed') ? c.objects('missed')[0] : undefined;
    return {
      id: c.text('id'), outcome: c.text('outcome'), message: c.has('message') ? c.text('message') : '',
      first: first && { triangle: first.whole('triangle'), side: first.has('side') ? first.text('side') : null, v: first.has('v') ? point(first.json.v) : null, p: first.has('p') ? point(first.json.p) : null, texts: { v: first.json.v, p: first.json.p } },
      missed: c.has('missed') ? c.objects('missed').map((m) => m.whole('triangle')) : [],
    };
  });
  const scenes = json.scenes ?? {};
  const rows = cases.map((c) => ({ verdict: c.outcome, name: c.id, note: c.message, bad: BAD.has(c.outcome), goto: null }));
  const shown = cases.filter((c) => scenes[c.id]).map((c) => {
    const mesh = embeddedMesh(scenes[c.id]);
    return { mesh, scene: { file: c.id, sha256: null, triangles: mesh.triangles.length / 3 }, cell: scenes[c.id].cell, mode: null, data: { name, case: c, rows } };
  });
  for (const { data } of shown) rows.find((r) => r.name === data.case.id).goto = data;
  return shown.length > 0 ? shown : [{ mesh: null, scene: null, cell: [], mode: null, data: { name, case: null, rows } }];
}

export default {
  id: 'conformance',
  name: 'the outcome',
  formats: ['clues-conformance/1'],
  readCases,
  title: ({ data }) => (data.case ? `${data.name}: ${data.case.id}` : `conformance of ${data.name}`),
  label: ({ data }, t) => (data.case?.missed.includes(t) ? 'missing-visible' : 'none'),
  summary({ data }) {
    const counts = new Map();
    for (const row of data.rows) counts.set(row.verdict, (counts.get(row.verdict) ?? 0) + 1);
    return [`implementation: ${data.name}`, [...counts].map(([outcome, n]) => `${n} ${outcome}`).join(', '), ...(data.case ? [`case ${data.case.id}: ${data.case.outcome}`] : ['No scenes of cases here: `clues view` puts in those of the unsound ones.'])];
  },
  facts({ data }, t) {
    if (!data.case?.missed.includes(t)) return [];
    const { first } = data.case, out = [{ text: 'missing, though visible' }];
    if (first.triangle === t && first.v && first.p) out.push(sightFact(first.v, first.p, first.side, first.texts));
    return out;
  },
  rows({ data }) {
    return data.rows.map((row) => {
      const first = data.case && row.name === data.case.id ? data.case.first : null;
      return { ...row, triangle: first?.triangle ?? null, sight: first?.v && first?.p ? [first.v, first.p] : null };
    }).sort((a, b) => b.bad - a.bad);
  },
};
