// Fields of JSON that others may have written: a missing or odd one is a sentence (flaw.js) and not an exception from
// somewhere within.
import { point } from './exact.js';
import { flaw } from './flaw.js';

export class Fields {
  constructor(json, file, place = '') {
    this.file = file;
    this.place = place;
    if (json === null || typeof json !== 'object' || Array.isArray(json)) throw flaw(file, `${place || 'the file'} is no JSON object`);
    this.json = json;
  }
  wrong(key, what) { throw flaw(this.file, `"${this.place}${key}" ${what}; is the file complete?`); }
  has(key) { return Object.hasOwn(this.json, key); }
  text(key) {
    const value = this.json[key];
    if (typeof value !== 'string') this.wrong(key, 'is missing, or no text');
    return value;
  }
  oneOf(key, words) {
    const value = this.text(key);
    if (!words.includes(value)) this.wrong(key, `is none of ${words.join(', ')}`);
    return value;
  }
  flag(key) {
    if (typeof this.json[key] !== 'boolean') this.wrong(key, 'is missing, or neither true nor false');
    return this.json[key];
  }
  whole(key, most = Number.MAX_SAFE_INTEGER) {
    const value = this.json[key];
    if (!Number.isSafeInteger(value) || value < 0) this.wrong(key, 'is missing, or no whole number');
    if (value > most) this.wrong(key, `is ${value}, and the last one is ${most}`);
    return value;
  }
  list(key) {
    if (!Array.isArray(this.json[key])) this.wrong(key, 'is missing, or no list');
    return this.json[key];
  }
  object(key) { return new Fields(this.json[key], this.file, `${this.place}${key}.`); }
  objects(key) { return this.list(key).map((json, i) => new Fields(json, this.file, `${this.place}${key}[${i}].`)); }
  wholes(key, most) {
    const values = this.list(key);
    for (const value of values)
      if (!Number.isSafeInteger(value) || value < 0 || value > most) this.wrong(key, `holds ${JSON.stringify(value)}, which is no number from 0 to ${most}`);
    return values;
  }
  // As points(); null where the file has null for a number past the range of doubles.
  pointsOrNull(key) {
    const points = this.list(key).map((p) => (Array.isArray(p) && p.length === 3 && p.includes(null) ? null : this.pointOf(p, key)));
    return points.includes(null) ? null : points;
  }
  points(key) { return this.list(key).map((p) => this.pointOf(p, key)); }
  pointOf(p, key) {
    if (!Array.isArray(p) || p.length !== 3 || !p.every(Number.isFinite)) this.wrong(key, 'holds what is no point of three numbers');
    return p;
  }
  exactPoint(key) { return point(this.json[key]) ?? this.wrong(key, 'is no point of three exact numbers'); }
}
