// Rows of the tables of an SQLite file, read and nothing else: what the stores of clues hold (https://www.sqlite.org/fileformat2.html). Whatever is not as it should be is
// a Flaw: pages are visited once, what lies outside of the file is not there, and rows do not share their bytes, so that a table is no longer than the file.
import { flaw } from './flaw.js';

const MAGIC = 'SQLite format 3\0', HEADER = 100;
const LEAF = 13, INNER = 5, INDEX_LEAF = 10, INDEX_INNER = 2;
const LENGTHS = [0, 1, 2, 3, 4, 6, 8, 8, 0, 0];  // of values, by their types below 12
const NAME = /^\s*(?:"([^"]+)"|([^\s",()]+))/;

export class SqliteFile {
  constructor(bytes, file) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.file = file;
    this.text = new TextDecoder('utf-8', { fatal: true });
    if (bytes.length < HEADER || new TextDecoder('latin1').decode(bytes.subarray(0, 16)) !== MAGIC) this.damaged();
    const size = this.view.getUint16(16), pages = this.view.getUint32(28);
    this.size = size === 1 ? 65536 : size;
    this.usable = this.size - bytes[20];
    if (this.size < 512 || (this.size & (this.size - 1)) !== 0 || this.usable < 480 || this.view.getUint32(56) !== 1) this.damaged();
    if (bytes[18] !== 1 || bytes[19] !== 1) throw flaw(file, 'is being written (it has a journal beside it); close the program that does');
    if (bytes.length < pages * this.size) throw flaw(file, 'ends in the middle; is it complete?');
    this.tables = new Map();
    this.guarded(() => {
      for (const { values: [type, name, , root, sql] } of this.rowsOf(1)) if (type === 'table') this.tables.set(name, { root, columns: columnsOf(sql), plain: !/WITHOUT\s+ROWID\s*$/i.test(sql) });
    });
  }
  damaged() { throw flaw(this.file, 'is a damaged store'); }
  guarded(work) {
    try { return work(); } catch (problem) {
      // What else can be thrown here comes of numbers that point out of the file, and of bytes that are no text.
      if (problem instanceof RangeError || problem instanceof TypeError) this.damaged();
      throw problem;
    }
  }
  // All rows of a table, as objects by the names of the columns; null where there is no such table.
  rows(name) {
    const table = this.tables.get(name);
    if (!table) return null;
    return this.guarded(() => [...this.rowsOf(table.root)].map(({ row, values }) => {
      if (values.length > table.columns.length) this.damaged();
      // The number of a row stands for the column that is its key.
      return Object.fromEntries(table.columns.map(({ column, key }, i) => [column, key && table.plain ? row : values[i] ?? null]));
    }));
  }
  rowsOf(root) {
    this.left = this.bytes.length;  // for the records of a table, which are parts of the file and not of each other
    return this.rowsFrom(root, new Set());
  }
  *rowsFrom(root, seen) {
    if (!Number.isSafeInteger(root) || root < 1 || seen.has(root)) this.damaged();
    seen.add(root);
    const start = (root - 1) * this.size, at = root === 1 ? HEADER : start, kind = this.view.getUint8(at), inner = kind === INNER || kind === INDEX_INNER;
    if (![LEAF, INNER, INDEX_LEAF, INDEX_INNER].includes(kind)) this.damaged();
    const count = this.view.getUint16(at + 3), cells = at + (inner ? 12 : 8), index = kind === INDEX_LEAF || kind === INDEX_INNER;
    if (cells + 2 * count > start + this.size) this.damaged();
    for (let i = 0; i < count; ++i) {
      let place = start + this.view.getUint16(cells + 2 * i);
      if (inner) { yield* this.rowsFrom(this.view.getUint32(place), seen); place += 4; }
      if (kind === INNER) continue;
      const length = varint(this.view, place), row = index ? null : varint(this.view, length.end);
      yield { row: row?.value ?? null, values: record(this.payload((row ?? length).end, length.value, index), this.text) };
    }
    if (inner) yield* this.rowsFrom(this.view.getUint32(at + 8), seen);
  }
  // The bytes of a record; what does not find room in the page is on a chain of others.
  payload(at, length, index) {
    const u = this.usable, most = index ? Math.floor(((u - 12) * 64) / 255) - 23 : u - 35;
    if (length < 1 || length > this.left) this.damaged();
    this.left -= length;
    if (length <= most) return this.part(at, length);
    const least = Math.floor(((u - 12) * 32) / 255) - 23, fitting = least + ((length - least) % (u - 4)), here = fitting <= most ? fitting : least;
    const out = new Uint8Array(length);
    out.set(this.part(at, here));
    for (let filled = here, next = this.view.getUint32(at + here); filled < length;) {
      if (next === 0) this.damaged();
      const start = (next - 1) * this.size, some = Math.min(u - 4, length - filled);
      out.set(this.part(start + 4, some), filled);
      filled += some;
      next = this.view.getUint32(start);
    }
    return out;
  }
  part(at, length) { return at >= 0 && at + length <= this.bytes.length ? this.bytes.subarray(at, at + length) : this.damaged(); }
}

// Whole numbers that doubles do not hold are nowhere in our stores.
function small(value) {
  if (value < -9007199254740991n || value > 9007199254740991n) throw new RangeError('no safe number');
  return Number(value);
}

function varint(view, at) {
  let value = 0n;
  for (let i = 0; i < 8; ++i) {
    const byte = view.getUint8(at + i);
    value = (value << 7n) | BigInt(byte & 127);
    if (byte < 128) return { value: small(value), end: at + i + 1 };
  }
  return { value: small(BigInt.asIntN(64, (value << 8n) | BigInt(view.getUint8(at + 8)))), end: at + 9 };
}

// The values of a row: numbers, texts, bytes, or null.
function record(bytes, text) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), head = varint(view, 0), types = [];
  for (let at = head.end; at < head.value;) { const type = varint(view, at); types.push(type.value); at = type.end; }
  let at = head.value;
  return types.map((type) => {
    const length = type >= 12 ? Math.floor((type - 12) / 2) : LENGTHS[type];
    if (length === undefined || at + length > bytes.length) throw new RangeError('past the end of the row');
    const value = bytes.subarray(at, at + length);
    at += length;
    if (type === 0) return null;
    if (type === 7) return view.getFloat64(at - length);
    if (type === 8 || type === 9) return type - 8;
    if (type >= 12) return type % 2 === 0 ? value : text.decode(value);
    return small(BigInt.asIntN(8 * length, value.reduce((sum, byte) => (sum << 8n) | BigInt(byte), 0n)));
  });
}

// The columns that a CREATE TABLE names, and which of them is the number of the row.
function columnsOf(sql) {
  const inside = sql.slice(sql.indexOf('(') + 1, sql.lastIndexOf(')')), out = [];
  let depth = 0, begin = 0;
  for (let i = 0; i <= inside.length; ++i) {
    if (inside[i] === '(') ++depth;
    if (inside[i] === ')') --depth;
    if (i < inside.length && (inside[i] !== ',' || depth > 0)) continue;
    const text = inside.slice(begin, i), found = NAME.exec(text), column = found?.[1] ?? found?.[2];
    if (column && !/^(PRIMARY|UNIQUE|CHECK|FOREIGN|CONSTRAINT)$/i.test(column)) out.push({ column, key: /\bINTEGER\s+PRIMARY\s+KEY\b/i.test(text) });
    begin = i + 1;
  }
  return out;
}
