// @ts-check
/* SHA-512, which a page without a server has no other way to: Python seeds its random numbers with it. */

const MASK = (1n << 64n) - 1n;
const BLOCK_BYTES = 128;
const LENGTH_BYTES = 16;
const ROUNDS = 80;

const PRIMES = primes(ROUNDS);
/** The first 64 bits of the fractions of the primes' cube roots, and of the first eight square roots. */
const ADDED = PRIMES.map((prime) => root(prime << 192n, 3n) & MASK);
const START = PRIMES.slice(0, 8).map((prime) => root(prime << 128n, 2n) & MASK);

/**
 * The digest of a message.
 * @param {Uint8Array} message
 */
export function sha512(message) {
  const view = new DataView(padded(message).buffer);
  let state = START;
  for (let at = 0; at < view.byteLength; at += BLOCK_BYTES) state = compressed(state, schedule(view, at));
  const digest = new DataView(new ArrayBuffer(8 * state.length));
  state.forEach((word, i) => digest.setBigUint64(8 * i, word));
  return new Uint8Array(digest.buffer);
}

/** @param {Uint8Array} message */
function padded(message) {
  const blocks = Math.ceil((message.length + 1 + LENGTH_BYTES) / BLOCK_BYTES);
  const bytes = new Uint8Array(blocks * BLOCK_BYTES);
  bytes.set(message);
  bytes[message.length] = 0x80;
  new DataView(bytes.buffer).setBigUint64(bytes.length - 8, BigInt(8 * message.length));
  return bytes;
}

/**
 * @param {DataView} view
 * @param {number} at
 */
function schedule(view, at) {
  const words = Array.from({ length: 16 }, (_, i) => view.getBigUint64(at + 8 * i));
  for (let i = 16; i < ROUNDS; i += 1) {
    const [far, near] = [words[i - 15], words[i - 2]];
    const small = turned(far, 1n) ^ turned(far, 8n) ^ (far >> 7n);
    const large = turned(near, 19n) ^ turned(near, 61n) ^ (near >> 6n);
    words.push((words[i - 16] + small + words[i - 7] + large) & MASK);
  }
  return words;
}

/**
 * @param {bigint[]} state
 * @param {bigint[]} words
 */
function compressed(state, words) {
  let [a, b, c, d, e, f, g, h] = state;
  for (let i = 0; i < ROUNDS; i += 1) {
    const choice = (e & f) ^ (~e & MASK & g);
    const first = h + (turned(e, 14n) ^ turned(e, 18n) ^ turned(e, 41n)) + choice + ADDED[i] + words[i];
    const second = (turned(a, 28n) ^ turned(a, 34n) ^ turned(a, 39n)) + ((a & b) ^ (a & c) ^ (b & c));
    [a, b, c, d, e, f, g, h] = [(first + second) & MASK, a, b, c, (d + first) & MASK, e, f, g];
  }
  return [a, b, c, d, e, f, g, h].map((word, i) => (word + state[i]) & MASK);
}

/**
 * A word turned right.
 * @param {bigint} word
 * @param {bigint} by
 */
function turned(word, by) {
  return (word >> by) | ((word << (64n - by)) & MASK);
}

/** @param {number} count */
function primes(count) {
  /** @type {bigint[]} */
  const found = [];
  for (let n = 2n; found.length < count; n += 1n) if (found.every((prime) => n % prime)) found.push(n);
  return found;
}

/**
 * The whole part of a root.
 * @param {bigint} of
 * @param {bigint} degree
 */
function root(of, degree) {
  let [low, high] = [0n, 1n << 80n];
  while (high - low > 1n) {
    const middle = (low + high) >> 1n;
    if (middle ** degree <= of) low = middle;
    else high = middle;
  }
  return low;
}
