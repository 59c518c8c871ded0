// Exact numbers of our files, "p/q" or "p": as sums, and as the double nearby that is drawn.
const FORM = /^(-?\d+)(?:\/(\d+))?$/;

export function fraction(text) {
  const match = typeof text === 'string' ? FORM.exec(text) : null;
  if (!match || (match[2] !== undefined && /^0+$/.test(match[2]))) return null;
  return [BigInt(match[1]), BigInt(match[2] ?? 1)];
}

const greatest = (a, b) => { while (b) [a, b] = [b, a % b]; return a < 0n ? -a : a; };

export function plus([a, b], [c, d]) {
  const p = a * d + c * b, q = b * d, g = greatest(p, q);
  return g > 1n ? [p / g, q / g] : [p, q];
}

export const text = ([p, q]) => (q === 1n ? `${p}` : `${p}/${q}`);

// 64 bits of the quotient, as a double; good to the last bit or so.
export function near([p, q]) {
  if (p === 0n) return 0;
  const size = (n) => n.toString(16).length * 4;
  const minus = p < 0n, a = minus ? -p : p;
  const shift = 64 - (size(a) - size(q));
  const quotient = shift >= 0 ? (a << BigInt(shift)) / q : a / (q << BigInt(-shift));
  // In two steps, so that neither leaves the range of doubles before the product does.
  const half = Math.trunc(shift / 2);
  const value = Number(quotient) * 2 ** -half * 2 ** -(shift - half);
  return minus ? -value : value;
}

// Three exact texts as a point of doubles, or null.
export function point(texts) {
  if (!Array.isArray(texts) || texts.length !== 3) return null;
  const parts = texts.map(fraction);
  return parts.includes(null) ? null : parts.map(near);
}
