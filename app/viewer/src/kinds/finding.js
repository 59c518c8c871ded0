// A finding of `clues fuzz`: the folder, with the scene as it was met and as it was shrunk.
import { Fields } from '../files/fields.js';
import { flaw } from '../files/flaw.js';
import { sightFact } from './sight.js';

// `beside(name)` is another file of the folder: a mesh, or JSON.
function readFolder(json, file, beside) {
  const top = new Fields(json, file), out = [];
  for (const [folder, words] of [['', 'after shrinking'], ['original/', 'as it was met']]) {
    const mesh = beside(`${folder}scene.off`, true), cell = beside(`${folder}cell.obj`, false), witness = beside(`${folder}witness.json`);
    if (!mesh || !cell || !witness) {
      if (folder === '') throw flaw(file, 'a finding is a folder; drop all of it, or at least finding.json, scene.off, cell.obj and witness.json');
      continue;
    }
    const w = new Fields(witness, `${folder}witness.json`), last = mesh.triangles.length / 3 - 1;
    const data = {
      oracle: top.text('oracle'), verdict: top.text('verdict'), explanation: top.text('explanation'), subject: top.text('subject'), words,
      triangle: w.has('triangle') ? w.whole('triangle', last) : null,
      side: w.has('side') ? w.text('side') : null,
      v: w.has('v') ? w.exactPoint('v') : null, p: w.has('p') ? w.exactPoint('p') : null, texts: { v: w.json.v, p: w.json.p },
    };
    const points = [...Array(cell.points.length / 3).keys()].map((i) => [...cell.points.subarray(3 * i, 3 * i + 3)]);
    out.push({ mesh, scene: { file: 'scene.off', sha256: null, triangles: last + 1 }, cell: points, mode: top.oneOf('mode', ['sheet', 'solid']), data });
  }
  for (const part of out) part.data.both = out.map((other) => other.data);
  return out;
}

const rowOf = (data) => ({
  verdict: data.verdict, name: `${data.words}: ${data.triangle === null ? data.oracle : `triangle ${data.triangle}`}`, note: data.oracle, triangle: data.triangle,
  sight: data.v && data.p ? [data.v, data.p] : null, bad: true, goto: data,
});

export default {
  id: 'finding',
  name: 'the finding',
  formats: ['clues-finding/2'],
  readFolder,
  title: ({ data }) => `finding, ${data.words}: ${data.verdict}`,
  // What was answered is known for the one triangle only.
  label: ({ data }, t) => (t === data.triangle ? (data.v ? 'missing-visible' : 'missing-undecided') : 'none'),
  summary: ({ data, scene }) => [`${data.oracle}: ${data.verdict}`, data.explanation, `subject: ${data.subject}`, `${data.words}: ${scene.triangles} triangle${scene.triangles === 1 ? '' : 's'}`],
  facts({ data }, t) {
    if (t !== data.triangle) return [];
    const out = [{ text: `the finding is about this triangle: ${data.verdict}` }];
    if (data.v && data.p) out.push(sightFact(data.v, data.p, data.side, data.texts));
    return out;
  },
  // Before and after shrinking, from either of them.
  rows: ({ data }) => data.both.map(rowOf),
};
