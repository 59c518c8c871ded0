// The store of `clues bake` (docs/bakes.md), as the bake that a page shows: what is missing, unfinished or damaged is a Flaw.
import { decompress } from 'fzstd';
import { flaw } from './flaw.js';
import { SqliteFile } from './sqlite.js';

const FORMAT = 'clues-bake/1';

const MOST = 2 ** 31;  // bytes of lists, unpacked

// The length that a frame of zstd (RFC 8878) says it has; -1: it does not say. So a list cannot make the page ask for more memory than it needs.
function lengthSaid(bytes) {
  if (bytes.length < 6 || [0x28, 0xb5, 0x2f, 0xfd].some((byte, i) => bytes[i] !== byte)) return -1;
  const flags = bytes[4], single = (flags >> 5) & 1, wide = flags >> 6, size = wide > 0 ? 1 << wide : single, at = 6 - single + [0, 1, 2, 4][flags & 3];
  if (size === 0 || at + size > bytes.length) return -1;
  let value = 0;
  for (let i = size; i-- > 0;) value = 256 * value + bytes[at + i];
  return size === 2 ? value + 256 : value;
}

function unpacked(list, triangles) {
  const length = Math.ceil(triangles / 8);
  if (!(list instanceof Uint8Array) || lengthSaid(list) !== length) return null;
  let bits;
  try {
    bits = new Uint8Array(length).fill(255);  // what is not written to makes no list
    decompress(list, bits);
  } catch { return null; }
  if (triangles % 8 > 0 && bits[length - 1] >> (triangles % 8) !== 0) return null;
  let count = 0;
  for (let i = 0; i < length; ++i) for (let rest = bits[i]; rest !== 0; rest &= rest - 1) ++count;
  return { bits, count };
}

function pointsOf(bytes) {
  if (!(bytes instanceof Uint8Array) || bytes.length === 0 || bytes.length % 24 !== 0) return null;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), out = [];
  for (let at = 0; at < bytes.length; at += 24) out.push([0, 8, 16].map((k) => view.getFloat64(at + k, true)));
  return out.every((p) => p.every(Number.isFinite)) ? out : null;
}

// { scene, note, nodes, cells: [{ name, node, fallbacks, points, bits, count }] }
export function readBakeStore(bytes, file) {
  const store = new SqliteFile(bytes, file), damaged = (what) => { throw flaw(file, `${what}; the store was damaged`); };
  const about = new Map((store.tables.has('about') ? store.rows('about') : []).map(({ name, value }) => [name, value]));
  if (about.get('format') !== FORMAT) throw flaw(file, `is no bake of clues (${FORMAT})`);
  const nodeRows = store.rows('nodes') ?? damaged('it has no nodes'), cellRows = store.rows('cells') ?? damaged('it has no cells');
  if (about.get('finished') !== 'yes') throw flaw(file, `is not finished: ${cellRows.filter((c) => c.list !== null).length} of ${cellRows.length} cells; repeat the command of its bake to go on`);
  const text = (name) => (typeof about.get(name) === 'string' ? about.get(name) : damaged(`it does not say its ${name}`)), triangles = Number(text('triangles'));
  if (!/^[1-9]\d*$/.test(text('triangles')) || triangles > 0xffffffff) damaged('no number of triangles');
  const nodes = [0];
  for (const { id, node } of nodeRows) {
    if (id !== nodes.length || !Number.isSafeInteger(node) || node < 0 || node >= id) damaged(`node ${id} is out of order`);
    nodes.push(node);
  }
  if (cellRows.length * Math.ceil(triangles / 8) > MOST) throw flaw(file, `has ${cellRows.length} lists of ${triangles} triangles, more than a page can hold`);
  const cells = cellRows.map(({ id, name, node, points, list, listed, fallbacks }, i) => {
    if (id !== i || typeof name !== 'string' || !Number.isSafeInteger(node) || node < 0 || node >= nodes.length) damaged(`cell ${i} is out of order`);
    const found = unpacked(list, triangles) ?? damaged(`cell ${i} has no list of ${triangles} triangles`);
    if (found.count !== listed) damaged(`the list of cell ${i} is not as long as it says`);
    if (!Number.isSafeInteger(fallbacks) || fallbacks < 0) damaged(`cell ${i} does not say its fallbacks`);
    return { name, node, fallbacks, points: pointsOf(points) ?? damaged(`cell ${i} has no points`), ...found };
  });
  if (cells.length === 0) damaged('it has no cells');
  return { scene: { file: text('scene'), sha256: text('scene_sha256'), triangles }, note: text('note'), nodes, cells };
}
