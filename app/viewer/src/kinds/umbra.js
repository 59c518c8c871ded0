// The hidden space as a body: `clues map --umbra`.
import { Fields } from '../files/fields.js';
import { point } from '../files/exact.js';
import { LAYER_COLOURS } from '../view/labels.js';
import { body, lines, loop } from '../view/marks.js';

function read(json, file) {
  const top = new Fields(json, file), scene = top.object('scene'), triangles = scene.whole('triangles');
  const vertices = top.list('vertices_exact').map((texts) => point(texts) ?? top.wrong('vertices_exact', 'holds what is no exact point'));
  const facets = top.objects('facets').map((f) => {
    const corners = f.wholes('corners', vertices.length - 1), kind = f.oneOf('kind', ['surface', 'wedge', 'bound']);
    if (corners.length !== 3) f.wrong('corners', 'is no triangle');
    return { kind, points: corners.map((c) => vertices[c]), triangle: kind === 'surface' ? f.whole('triangle', triangles - 1) : null };
  });
  return { scene: { file: scene.text('file'), sha256: scene.has('sha256') ? scene.text('sha256') : null, triangles }, cell: top.object('cell').points('vertices'), mode: null, data: { facets } };
}

export default {
  id: 'umbra',
  formats: ['clues-umbra/1'],
  read,
  title: (part) => `umbra of ${part.scene.file}`,
  summary({ data }) {
    const count = (kind) => data.facets.filter((f) => f.kind === kind).length;
    return [`umbra: ${count('surface')} facets on surfaces, ${count('wedge')} on wedges, ${count('bound')} on the box that ends it`];
  },
  layers({ data }, frame) {
    const of = (...kinds) => data.facets.filter((f) => kinds.includes(f.kind)).map((f) => f.points);
    const outer = of('surface', 'wedge'), bound = of('bound'), colour = LAYER_COLOURS.umbra;
    return [
      { id: 'umbra', name: 'umbra', colour, on: true, count: outer.length, make() { const made = body(frame, outer, colour, 0.2); made.add(lines(frame, of('wedge').flatMap(loop), colour, 0.8)); return made; } },
      { id: 'umbra-box', name: 'where its box ends it', colour, on: false, count: bound.length, make: () => body(frame, bound, colour, 0.12) },
    ].filter((layer) => layer.count > 0);
  },
  facts({ data }, t) {
    const facets = data.facets.filter((f) => f.triangle === t);
    if (facets.length === 0) return [];
    return [{ text: `${facets.length} facet${facets.length === 1 ? '' : 's'} of the umbra lie${facets.length === 1 ? 's' : ''} on it`, lines: [{ pairs: facets.flatMap((f) => loop(f.points)), colour: LAYER_COLOURS.umbra, width: 2.5 }] }];
  },
};
