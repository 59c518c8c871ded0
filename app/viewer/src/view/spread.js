// The order in which a large surface is drawn while there is no time for all of it: each triangle comes early in proportion to its area, so that any beginning of the order covers
// the scene. Drawing all of it in this order gives the picture that it always gave.
const PER_DOUBLING = 16, BUCKETS = 1024;

// From 0 to 1, and without any pattern that a mesh might have too.
function scattered(t) {
  let x = Math.imul(t ^ (t >>> 16), 0x45d9f3b);
  x = Math.imul(x ^ (x >>> 16), 0x45d9f3b);
  return ((x ^ (x >>> 16)) >>> 0) / 2 ** 32;
}

// Random sampling by weights: in the order of -ln(u) / area. Buckets will do.
export function spreadOrder(places, count) {
  const areas = new Float32Array(count);
  let sum = 0;
  for (let t = 0, at = 0; t < count; ++t, at += 9) {
    const ux = places[at + 3] - places[at], uy = places[at + 4] - places[at + 1], uz = places[at + 5] - places[at + 2], vx = places[at + 6] - places[at], vy = places[at + 7] - places[at + 1], vz = places[at + 8] - places[at + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    sum += areas[t] = Math.sqrt(x * x + y * y + z * z);
  }
  const mean = sum / count || 1, buckets = new Uint16Array(count), starts = new Uint32Array(BUCKETS + 1);
  for (let t = 0; t < count; ++t) {
    const late = areas[t] > 0 ? (-Math.log(scattered(t + 1)) * mean) / areas[t] : Infinity;
    const bucket = buckets[t] = Math.max(0, Math.min(BUCKETS - 1, Math.round(PER_DOUBLING * Math.log2(late)) + BUCKETS / 2));
    ++starts[bucket + 1];
  }
  for (let b = 0; b < BUCKETS; ++b) starts[b + 1] += starts[b];
  const order = new Uint32Array(count);
  for (let t = 0; t < count; ++t) order[starts[buckets[t]]++] = t;
  return order;
}

// `each` bytes of every triangle, in that order: four at a time, whatever they stand for.
export function inOrder(order, numbers, each) {
  const words = new Uint32Array(numbers.buffer, numbers.byteOffset, (order.length * each) / 4), out = new Uint32Array(words.length), width = each / 4;
  for (let i = 0, to = 0; i < order.length; ++i) for (let from = order[i] * width, end = from + width; from < end; ++from) out[to++] = words[from];
  return new numbers.constructor(out.buffer);
}
