// OBJ and OFF (docs/formats.md).
import { flaw } from './flaw.js';
import { MeshBuilder } from './mesh_bytes.js';

const number = (word) => (word === undefined || word === '' ? NaN : /^[+-]?0x/i.test(word) ? hexFloat(word) : Number(word));

function hexFloat(word) {
  const match = /^([+-]?)0x([0-9a-f]*)\.?([0-9a-f]*)(?:p([+-]?\d+))?$/i.exec(word);
  if (!match || match[2] + match[3] === '') return NaN;
  const value = parseInt(match[2] + match[3], 16) * 2 ** (Number(match[4] ?? 0) - 4 * match[3].length);
  return match[1] === '-' ? -value : value;
}

export function parseObj(text, file, needsTriangles = true) {
  const mesh = new MeshBuilder(file);
  const lines = text.split('\n');
  for (let n = 0; n < lines.length; ++n) {
    let line = lines[n].replace(/\r$/, '');
    const first = n + 1;
    while (line.endsWith('\\') && n + 1 < lines.length) line = line.slice(0, -1) + ' ' + lines[++n].replace(/\r$/, '');
    const words = line.trim().split(/\s+/);
    if (words[0] === 'v') {
      mesh.point(number(words[1]), number(words[2]), number(words[3]), `line ${first}`);
    } else if (words[0] === 'f' || words[0] === 'fo') {
      const count = mesh.points.length / 3;
      mesh.face(words.slice(1).filter((w) => !w.startsWith('#')).map((word) => {
        const index = Number(word.split('/')[0]);
        return index < 0 ? count + index : index - 1;
      }), `line ${first}`);
    }
  }
  return mesh.mesh(needsTriangles);
}

export function parseOff(text, file, needsTriangles = true) {
  const mesh = new MeshBuilder(file);
  const lines = text.split('\n').map((line, i) => ({ words: line.replace(/#.*/, '').trim().split(/\s+/), at: i + 1 })).filter((l) => l.words[0] !== '');
  if (lines.length === 0) throw flaw(file, 'is empty');
  const keyword = /^(ST)?(C)?(N)?OFF$/;
  if (lines[0].words[0].toUpperCase().match(keyword)) {
    lines[0].words.shift();
    if (lines[0].words[0]?.toUpperCase() === 'BINARY') throw flaw(file, 'binary OFF is read by `clues view` only, not by the page');
    if (lines[0].words.length === 0) lines.shift();
  }
  const [points, faces] = (lines.shift()?.words ?? []).map(Number);
  if (!Number.isInteger(points) || !Number.isInteger(faces)) throw flaw(file, 'begins with no counts of points and faces');
  if (lines.length < points + faces) throw flaw(file, `has ${lines.length} lines for ${points} points and ${faces} faces; is it complete? (OFF in free layout is read by \`clues view\` only)`);
  for (const { words, at } of lines.slice(0, points)) mesh.point(number(words[0]), number(words[1]), number(words[2]), `line ${at}`);
  for (const { words, at } of lines.slice(points, points + faces)) {
    const count = Number(words[0]);
    if (!(count >= 1) || words.length <= count) throw flaw(file, `line ${at}: a face of ${words[0]} corners has ${words.length - 1}`);
    mesh.face(words.slice(1, count + 1).map(Number), `line ${at}`);
  }
  return mesh.mesh(needsTriangles);
}
