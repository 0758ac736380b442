/* Unpacks the columns of numbers that host_sim/report/replay_page.py packed. */

/** Columns by their names, one number for each tick. */
export type Columns = Record<string, Int32Array>;

/** @param text - A zlib stream in base64. */
export async function inflate(text: string) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; i += 1) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Unpacks columns. */
export async function unpackColumns(data: string, names: string[], ticks: number): Promise<Columns> {
  const bytes = await inflate(data);
  return Object.fromEntries(names.map((name, column) => [name, unpackColumn(bytes, 4 * column * ticks, ticks)]));
}

/**
 * Turns planes of bytes into differences, and differences into values.
 * @param low - Where the plane of low bytes begins.
 */
function unpackColumn(bytes: Uint8Array, low: number, ticks: number) {
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
