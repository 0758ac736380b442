/* The part of TOML that world files use: keys with numbers, and lists of lists of numbers. Errors name the line. */

type Value = number | unknown[];

/** The keys and their values, and in which line each stands: the key, and each entry of its list. */
export type Toml = { content: Map<string, Value>; lines: Map<string, [number, number[]]> };

const TOKEN = /([A-Za-z_][\w-]*)|([-+]?\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][-+]?\d+)?)|([[\],=])|(\s+|#[^\n]*)|(.)/gy;

/** A line cannot be read. */
export class LineError extends Error {
  constructor(readonly line: number, what: string) {
    super(what);
  }
}

export function parseToml(text: string): Toml {
  const reader = new Reader(text);
  const toml: Toml = { content: new Map(), lines: new Map() };
  while (reader.token) {
    const { line } = reader;
    const key = reader.key();
    if (toml.content.has(key)) throw new LineError(line, `there is a second '${key}'`);
    toml.content.set(key, reader.value(0));
    toml.lines.set(key, [line, reader.entries.splice(0)]);
  }
  return toml;
}

/** Goes through a text, word by word. `entries` are the lines of the entries of the list that was read last. */
class Reader {
  words: IterableIterator<RegExpMatchArray>;
  nextLine: number;
  line: number;
  entries: number[] = [];
  token: { word: string; name: string; number: string } | undefined;

  constructor(text: string) {
    this.words = text.matchAll(TOKEN);
    this.line = this.nextLine = 1;
    this.token = this.next();
  }

  /** The next word that is not a space. */
  next() {
    for (const [word, name, number, , space] of this.words) {
      this.line = this.nextLine;
      this.nextLine += word.split("\n").length - 1;
      if (space === undefined) return { word, name, number };
    }
    return undefined;
  }

  take(wanted: string) {
    if (this.token?.word !== wanted) throw this.error(`'${wanted}'`);
    this.token = this.next();
  }

  /** A key, and what follows it. */
  key() {
    const name = this.token?.name;
    if (name === undefined) throw this.error("a key");
    this.token = this.next();
    this.take("=");
    return name;
  }

  /** @param depth - In how many lists it stands. */
  value(depth: number): Value {
    if (depth === 1) this.entries.push(this.line);
    const { word = "", number } = this.token ?? {};
    if (number === undefined && word !== "[") throw this.error("a number or a list of numbers");
    this.token = this.next();
    return number === undefined ? this.list(depth + 1) : Number(number.replaceAll("_", ""));
  }

  list(depth: number) {
    const values = [];
    while (this.token?.word !== "]") {
      values.push(this.value(depth));
      if (this.token?.word !== "]") this.take(",");
    }
    this.take("]");
    return values;
  }

  error(wanted: string) {
    const found = this.token ? `'${this.token.word}'` : "the end";
    return new LineError(this.line, `expected ${wanted}, found ${found}`);
  }
}
