// All surface of a scene in one buffer: a place and four bytes a corner. The bytes are the number of the triangle (24 bits)
// and a tag: the label (labels.js), whether the triangle is listed, and which side it is. One program of the graphics
// processor draws colours, or triangle numbers (for picking, and to compare images), from the same buffer.
import * as THREE from 'three';
import { LABELS, rgb } from './labels.js';
import { inOrder, spreadOrder } from './spread.js';

export const AT_ONCE = 60000;  // so many triangles are drawn at once also while the camera moves

export const LISTED = 64;
export const BACK = 128;
export const NO_TAG = 255;  // where there is no surface; no label has the number 63

export class SurfaceBuffer {
  constructor(corners) {
    this.places = new Float32Array(9 * corners);
    this.tags = new Uint8Array(12 * corners);
    this.count = 0;
  }
  push(a, b, c, triangle, label, listed, back) {
    if (3 * this.count + 3 > this.places.length / 3) this.grow();
    this.places.set(a, 9 * this.count);
    this.places.set(b, 9 * this.count + 3);
    this.places.set(c, 9 * this.count + 6);
    const tag = label | (listed ? LISTED : 0) | (back ? BACK : 0), at = 12 * this.count++;
    for (let k = 0; k < 12; k += 4) {
      this.tags[at + k] = triangle & 255;
      this.tags[at + k + 1] = (triangle >> 8) & 255;
      this.tags[at + k + 2] = triangle >> 16;
      this.tags[at + k + 3] = tag;
    }
  }
  grow() {
    const larger = (old) => { const made = new old.constructor(2 * old.length + 96); made.set(old); return made; };
    this.places = larger(this.places);
    this.tags = larger(this.tags);
  }
  // `charts`: three numbers a corner that sum to 1, the place in a triangle of which a checkerboard is drawn.
  geometry(charts = null) {
    const geometry = new THREE.BufferGeometry(), order = this.count > AT_ONCE ? spreadOrder(this.places, this.count) : null;
    const add = (name, numbers, each) => geometry.setAttribute(name, new THREE.BufferAttribute(order ? inOrder(order, numbers, 3 * each * numbers.BYTES_PER_ELEMENT) : numbers.subarray(0, 3 * each * this.count), each));
    add('position', this.places, 3);
    add('tag', this.tags, 4);
    if (charts) add('chart', charts, 3);
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 1.01);
    return geometry;
  }
}

// Whole triangles, of both sides, with one label each. Written for a million of them.
export function wholeSurface(mesh, frame, labelOf, isListed) {
  const locals = frame.locals(mesh.points), { triangles } = mesh, count = triangles.length / 3;
  const buffer = new SurfaceBuffer(count), { places, tags } = buffer;
  for (let i = 0; i < triangles.length; ++i) {
    const from = 3 * triangles[i];
    places[3 * i] = locals[from];
    places[3 * i + 1] = locals[from + 1];
    places[3 * i + 2] = locals[from + 2];
  }
  const words = new Uint32Array(tags.buffer);
  for (let t = 0; t < count; ++t) words.fill((t | ((labelOf(t) | (isListed(t) ? LISTED : 0)) << 24)) >>> 0, 3 * t, 3 * t + 3);
  buffer.count = count;
  return buffer.geometry();
}

export const Only = { all: 0, listed: 1 };
export const Draw = { colours: 0, numbers: 1, stand: 2 };

const vertexShader = `
attribute vec4 tag;
#ifdef CHECKERED
attribute vec3 chart;
varying vec3 square;
#endif
uniform float only, alone, hidden[LABEL_COUNT];
varying vec3 place;
flat varying vec4 bytes;
void main() {
  float number = tag.x + 256.0 * tag.y + 65536.0 * tag.z;
  bytes = tag;
#ifdef CHECKERED
  square = chart;
#endif
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
  gl_Position = projectionMatrix * vec4(place, 1.0);
  bool listed = mod(tag.w, 128.0) >= 64.0;
  if (hidden[int(mod(tag.w, 64.0) + 0.5)] > 0.5 || (only > 0.5 && !listed) || (alone >= 0.0 && abs(alone - number) > 0.25)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const fragmentShader = `
uniform float mode, solid, shading, hatching, patternSize;
uniform vec3 palette[LABEL_COUNT];
uniform float hatched[LABEL_COUNT];
varying vec3 place;
#ifdef CHECKERED
varying vec3 square;
#endif
flat varying vec4 bytes;
void main() {
  float tag = bytes.w;
  int label = int(mod(tag, 64.0) + 0.5);
  if (mode > 0.5 && mode < 1.5) {
    if (solid > 0.5 && !gl_FrontFacing && tag < 128.0) tag += 128.0;
    gl_FragColor = vec4(bytes.xyz, tag) / 255.0;
    return;
  }
  vec3 colour = palette[label];
  bool stripes = hatched[label] > 0.5;
  if (mode > 1.5) {
    stripes = false;
    float shift = fract(sin((bytes.x + 256.0 * bytes.y) * 12.9898) * 43758.5453);
    colour = mix(vec3(0.42, 0.60, 0.74), vec3(0.66, 0.80, 0.90), shift);
  }
  if (shading > 0.5) {
    vec3 across = cross(dFdx(place), dFdy(place));
    float size = length(across);
    vec3 normal = size > 0.0 ? across / size : vec3(0.0, 0.0, 1.0);
    colour *= 0.62 + 0.38 * abs(dot(normal, normalize(vec3(0.25, 0.45, 0.86))));
  }
#ifdef CHECKERED
  vec3 steps = floor(square * 8.0 - 1e-4);
  if (mod(steps.x + steps.y + steps.z, 2.0) > 0.5) colour *= 0.45;
#endif
  if (hatching > 0.5 && stripes) {
    float stripe = mod(gl_FragCoord.x + gl_FragCoord.y, patternSize);
    if (stripe < patternSize * 0.28) colour *= 0.72;
  }
  gl_FragColor = vec4(colour, 1.0);
}`;

export function surfaceMaterial(side, checkered = false) {
  return new THREE.ShaderMaterial({
    defines: checkered ? { CHECKERED: 1 } : {},
    vertexShader: vertexShader.replaceAll('LABEL_COUNT', String(LABELS.length)),
    fragmentShader: fragmentShader.replaceAll('LABEL_COUNT', String(LABELS.length)),
    side,
    uniforms: {
      mode: { value: Draw.colours }, solid: { value: 0 }, shading: { value: 1 }, hatching: { value: 1 }, patternSize: { value: 9 },
      only: { value: Only.all }, alone: { value: -1 }, hidden: { value: LABELS.map(() => 0) },
      palette: { value: LABELS.map((label) => new THREE.Vector3(...rgb(label.colour))) },
      hatched: { value: LABELS.map((label) => (label.hatch ? 1 : 0)) },
    },
  });
}

// Four bytes of a picture of numbers: what is there, or null.
export function hitOf(bytes, at = 0) {
  const tag = bytes[at + 3];
  if (tag === NO_TAG) return null;
  return { triangle: bytes[at] + 256 * bytes[at + 1] + 65536 * bytes[at + 2], label: LABELS[tag & 63].id, listed: (tag & LISTED) !== 0, back: (tag & BACK) !== 0 };
}
