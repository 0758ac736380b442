// @ts-check
/* Unpacks the columns of numbers that host_sim/report/replay_page.py packed. */

/** @typedef {Record<string, Int32Array>} Columns - Columns by their names, one number for each tick. */

/** @param {string} text - A zlib stream in base64. */
export async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * Unpacks columns.
 * @param {string} data
 * @param {string[]} names
 * @param {number} ticks
 * @returns {Promise<Columns>}
 */
export async function unpackColumns(data, names, ticks) {
  const bytes = await inflate(data);
  return Object.fromEntries(names.map((name, column) => [name, unpackColumn(bytes, 4 * column * ticks, ticks)]));
}

/**
 * Planes of bytes to differences, differences to values.
 * @param {Uint8Array} bytes
 * @param {number} low - Where the plane of low bytes begins.
 * @param {number} ticks
 */
function unpackColumn(bytes, low, ticks) {
  const values = new Int32Array(ticks);
  let value = 0;
  for (let i = 0; i < ticks; i += 1) {
    const at = low + i;
    const z = bytes[at] | (bytes[at + ticks] << 8) | (bytes[at + 2 * ticks] << 16) | (bytes[at + 3 * ticks] << 24);
    value += (z >>> 1) ^ -(z & 1);
    values[i] = value;
  }
  return values;
}
