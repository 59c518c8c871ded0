// The verdict of `clues check --json` on a list.
import { Fields } from '../files/fields.js';
import { chainFact, sightFact } from './sight.js';

const WORDS = ['hidden', 'missing-undecided', 'missing-visible', 'exact', 'first-order', 'loose'];
const LISTED = new Set(['exact', 'first-order', 'loose']);

function read(json, file) {
  const top = new Fields(json, file), words = top.list('triangles'), last = words.length - 1;
  for (const word of words) if (!WORDS.includes(word)) top.wrong('triangles', `holds ${JSON.stringify(word)}, which is no verdict`);
  const end = (f, key) => { const o = f.object(key); return { point: o.exactPoint('exact'), texts: o.list('exact') }; };
  const witnesses = new Map(top.objects('witnesses').map((w) => [w.whole('triangle', last), { side: w.oneOf('side', ['front', 'back']), v: end(w, 'v'), p: end(w, 'p') }]));
  const chains = new Map(top.objects('chains').map((c) => [c.whole('triangle', last), {
    side: c.oneOf('side', ['front', 'back']), links: c.objects('links').map((l) => ({ v: end(l, 'v').point, x: end(l, 'x').point })),
  }]));
  const fractions = top.list('first_order_fractions');
  const measured = top.object('triangles_measured');
  const meets = new Set(top.wholes('meet_cell', last));
  const scene = { file: top.text('scene').split('/').pop(), sha256: top.has('scene_sha256') ? top.text('scene_sha256') : null, triangles: words.length };
  return { scene, cell: top.points('cell'), mode: null, data: { words, witnesses, chains, fractions, meets, verdict: top.text('verdict'), measured: measured.json } };
}

const range = (bounds) => (bounds === null || bounds === undefined ? '-' : bounds.at_least === bounds.at_most ? Number(bounds.at_least.toPrecision(4)) : `${Number(bounds.at_least.toPrecision(4))} to ${Number(bounds.at_most.toPrecision(4))}`);

function sight({ data }, t) {
  const found = data.witnesses.get(t);
  return found ? [found.v.point, found.p.point] : null;
}

export default {
  id: 'judgement',
  name: 'the verdict',
  formats: ['clues-judgement/1'],
  read,
  title: (part) => `verdict on a list for ${part.scene.file}`,
  listed: (part, t) => LISTED.has(part.data.words[t]),
  label: (part, t) => part.data.words[t],
  summary({ data }) {
    const count = (word) => data.words.filter((w) => w === word).length;
    const out = [`verdict: ${data.verdict}`];
    if (data.verdict !== 'sound') out.push(`missing: ${count('missing-visible')} visible, ${count('missing-undecided')} undecided`);
    out.push(`listed: ${count('exact')} with a sight line, ${count('first-order')} without, ${count('loose')} hidden`);
    out.push(`Qo = ${range(data.measured.overestimate_qo)}, Qu = ${range(data.measured.underestimate_qu)}`);
    return out;
  },
  facts({ data }, t) {
    const out = [{ text: `verdict: ${data.words[t]}` }], found = data.witnesses.get(t), chain = data.chains.get(t);
    if (data.meets.has(t)) out.push({ text: 'it meets the cell, and is visible for that (D3)' });
    if (found) out.push(sightFact(found.v.point, found.p.point, found.side, { v: found.v.texts, p: found.p.texts }));
    if (chain) out.push(chainFact(chain.links, chain.side));
    const parts = data.fractions[t];
    if (Array.isArray(parts) && parts.length === 2) out.push({ text: `first-order visible: ${parts[0]} of the front, ${parts[1]} of the back` });
    return out;
  },
  rows(part) {
    const order = ['missing-visible', 'missing-undecided', 'loose', 'first-order', 'exact', 'hidden'];
    return part.data.words
      .map((verdict, triangle) => ({ verdict, name: `triangle ${triangle}`, triangle, sight: sight(part, triangle), bad: verdict === 'missing-visible' }))
      .sort((a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict) || a.triangle - b.triangle);
  },
};
