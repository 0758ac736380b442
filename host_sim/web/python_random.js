// @ts-check
/* The random numbers of Python's random.Random(text): a Mersenne Twister, seeded with the text and its SHA-512. */

import { sha512 } from "./sha512.js";

const SIZE = 624;
const MIDDLE = 397;
const TWIST = 0x9908b0df;
const HIGH = 0x80000000;

/** Gives the same numbers as Python for the same text. */
export class PythonRandom {
  /** @param {string} text */
  constructor(text) {
    this.words = new Uint32Array(SIZE);
    this.next = SIZE;
    this.seed(keyOf(new TextEncoder().encode(text)));
  }

  /** A number from 0 up to, but without, 1. */
  random() {
    const [high, low] = [this.word() >>> 5, this.word() >>> 6];
    return (high * 2 ** 26 + low) / 2 ** 53;
  }

  /** @param {Uint32Array} key */
  seed(key) {
    const { words } = this;
    words[0] = 19650218;
    for (let i = 1; i < SIZE; i += 1) words[i] = Math.imul(1812433253, mixed(words[i - 1])) + i;
    let i = 1;
    for (let k = 0; k < SIZE; k += 1) {
      words[i] = (words[i] ^ Math.imul(mixed(words[i - 1]), 1664525)) + key[k % key.length] + (k % key.length);
      i = this.after(i);
    }
    for (let k = 1; k < SIZE; k += 1) {
      words[i] = (words[i] ^ Math.imul(mixed(words[i - 1]), 1566083941)) - i;
      i = this.after(i);
    }
    words[0] = HIGH;
  }

  /**
   * The place after a place, once around.
   * @param {number} i
   */
  after(i) {
    if (i + 1 < SIZE) return i + 1;
    this.words[0] = this.words[SIZE - 1];
    return 1;
  }

  word() {
    if (this.next === SIZE) this.twist();
    let word = this.words[this.next];
    this.next += 1;
    word ^= word >>> 11;
    word ^= (word << 7) & 0x9d2c5680;
    word ^= (word << 15) & 0xefc60000;
    return (word ^ (word >>> 18)) >>> 0;
  }

  twist() {
    const { words } = this;
    for (let i = 0; i < SIZE; i += 1) {
      const joined = (words[i] & HIGH) | (words[(i + 1) % SIZE] & (HIGH - 1));
      words[i] = words[(i + MIDDLE) % SIZE] ^ (joined >>> 1) ^ (joined & 1 ? TWIST : 0);
    }
    this.next = 0;
  }
}

/** @param {number} word */
function mixed(word) {
  return word ^ (word >>> 30);
}

/**
 * A text and its digest as one number, lowest word first.
 * @param {Uint8Array} text
 */
function keyOf(text) {
  const bytes = new Uint8Array([...text, ...sha512(text)]).reverse();
  const whole = new Uint8Array(4 * Math.ceil(bytes.length / 4));
  whole.set(bytes);
  return new Uint32Array(whole.buffer);
}
