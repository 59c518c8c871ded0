// A sight line and a chain of them (D18), as facts that are drawn.
import { LAYER_COLOURS } from '../view/labels.js';

export const written = (texts) => `(${texts.map((t) => (t.length > 22 ? `${t.slice(0, 20)}…` : t)).join(', ')})`;

export function sightFact(v, p, side, texts) {
  return {
    text: `${side}: free sight line from ${texts ? written(texts.v) : 'the cell'} to ${texts ? written(texts.p) : 'it'}`,
    lines: [{ pairs: [[v, p]], colour: LAYER_COLOURS.sight, width: 3 }], ends: [v, p],
  };
}

export function chainFact(links, side) {
  const pairs = links.map(({ v, x }) => [v, x]);
  return {
    text: `${side}: no sight line; by a chain of ${links.length} link${links.length === 1 ? '' : 's'} the first-order method must list it`,
    lines: [{ pairs, colour: LAYER_COLOURS.chain, width: 2.5 }], ends: pairs.flat(),
  };
}
