// PLY and STL, ascii and binary (docs/formats.md).
import { flaw } from './flaw.js';
import { MeshBuilder } from './mesh_bytes.js';

const SIZES = { char: 1, uchar: 1, short: 2, ushort: 2, int: 4, uint: 4, float: 4, double: 8 };
const OTHER_NAMES = { int8: 'char', uint8: 'uchar', int16: 'short', uint16: 'ushort', int32: 'int', uint32: 'uint', float32: 'float', float64: 'double' };
const READ = { char: 'getInt8', uchar: 'getUint8', short: 'getInt16', ushort: 'getUint16', int: 'getInt32', uint: 'getUint32', float: 'getFloat32', double: 'getFloat64' };

function header(bytes, file) {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, 65536));
  const end = /(^|\n)end_header[ \t]*\r?\n/.exec(text);
  if (!text.startsWith('ply') || !end) throw flaw(file, 'has no complete PLY header');
  const elements = [];
  let format = '';
  for (const line of text.slice(0, end.index).split(/\r?\n/)) {
    const words = line.trim().split(/\s+/);
    const type = (word) => { const name = OTHER_NAMES[word] ?? word; if (!SIZES[name]) throw flaw(file, `the type ${word} is unknown`); return name; };
    if (words[0] === 'format') format = words[1];
    if (words[0] === 'element') elements.push({ name: words[1], count: Number(words[2]), properties: [] });
    if (words[0] === 'property' && elements.length === 0) throw flaw(file, 'a property stands before its element');
    if (words[0] === 'property') elements.at(-1).properties.push(words[1] === 'list' ? { name: words[4], list: type(words[2]), type: type(words[3]) } : { name: words[2], type: type(words[1]) });
  }
  if (!['ascii', 'binary_little_endian', 'binary_big_endian'].includes(format)) throw flaw(file, `the format ${format || '(none)'} is unknown`);
  return { format, elements, start: end.index + end[0].length };
}

export function parsePly(bytes, file, needsTriangles = true) {
  const { format, elements, start } = header(bytes, file);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), little = format === 'binary_little_endian';
  let at = start, words = null, word = 0;
  if (format === 'ascii') words = new TextDecoder().decode(bytes.subarray(start)).split(/\s+/).filter((w) => w !== '');
  const next = (type) => {
    if (words ? word >= words.length : at + SIZES[type] > bytes.length) throw flaw(file, 'ends in the middle; is it complete?');
    if (words) return Number(words[word++]);
    at += SIZES[type];
    return view[READ[type]](at - SIZES[type], little);
  };
  const mesh = new MeshBuilder(file);
  for (const element of elements) {
    for (let i = 0; i < element.count; ++i) {
      const values = {};
      for (const p of element.properties) {
        if (!p.list) { values[p.name] = next(p.type); continue; }
        const count = next(p.list);
        if (!(count >= 0 && count <= bytes.length)) throw flaw(file, `${element.name} ${i} has a list of ${count}`);
        values[p.name] = Array.from({ length: count }, () => next(p.type));
      }
      if (element.name === 'vertex') mesh.point(values.x, values.y, values.z, `vertex ${i}`);
      if (element.name === 'face') mesh.face(values.vertex_indices ?? values.vertex_index ?? [], `face ${i}`);
      if (element.name === 'tristrips') throw flaw(file, 'strips of triangles are read by `clues view` only, not by the page');
    }
  }
  return mesh.mesh(needsTriangles);
}

export function parseStl(bytes, file, needsTriangles = true) {
  const mesh = new MeshBuilder(file);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = bytes.length >= 84 ? view.getUint32(80, true) : -1;
  if (count >= 0 && bytes.length === 84 + 50 * count) {
    for (let t = 0; t < count; ++t) {
      for (let c = 0; c < 3; ++c) {
        const at = 84 + 50 * t + 12 + 12 * c;
        mesh.point(view.getFloat32(at, true), view.getFloat32(at + 4, true), view.getFloat32(at + 8, true), `triangle ${t}`);
      }
      mesh.face([3 * t, 3 * t + 1, 3 * t + 2], `triangle ${t}`);
    }
    return mesh.mesh(needsTriangles);
  }
  const lines = new TextDecoder().decode(bytes).split('\n');
  if (!/^\s*solid/i.test(lines[0])) throw flaw(file, 'is no STL: neither text, nor as long as its count of triangles says');
  let corners = [];
  lines.forEach((line, i) => {
    const words = line.trim().split(/\s+/);
    if (words[0].toLowerCase() === 'vertex') {
      corners.push(mesh.points.length / 3);
      mesh.point(Number(words[1]), Number(words[2]), Number(words[3]), `line ${i + 1}`);
    } else if (words[0].toLowerCase() === 'endloop') {
      mesh.face(corners, `line ${i + 1}`);
      corners = [];
    }
  });
  if (corners.length > 0 || !/end\s*solid/i.test(lines.slice(-3).join('\n'))) throw flaw(file, 'ends in the middle; is it complete?');
  return mesh.mesh(needsTriangles);
}
