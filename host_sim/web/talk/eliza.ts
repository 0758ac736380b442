/* The ELIZA of 1966 on a page: answers sentences by a script that host_sim/talk/script.py has read and checked. */

type Part = string | number | { words: string[] } | { tags: string[] };

type Piece = string | number | { fact: string; part: number | null };

/** What is said, and the keyword to go on with. */
type Reassembly = [Piece[] | null, string | null];

type Transformation = { parts: Part[]; reassemblies: Reassembly[]; turn: number };

type Rule = { key: string; substitute: string | null; tags: string[]; rank: number; transformations: Transformation[];
  link: string | null };

export type Script = { greeting: string; rules: Record<string, Rule>; none: Rule; memory: Rule };

/** What a fact says, and what that rests on and speaks of. */
export type Known = { text: string; ticks: number[]; cells: number[]; food: number[] };

/** Gives a fact about some words; null where it is not known. */
type Ask = (fact: string, words: string[]) => Known | null;

const STEPS_MAX = 100_000;
const LIMIT = 4;
const NOTHING_MATCHES = ["PLEASE CONTINUE", "HMMM", "GO ON , PLEASE", "I SEE"];
const DELIMITERS = [",", ".", "BUT"];
const SIGNS: [RegExp, string][] = [[/[!?]/g, "."], [/[:;\u2012-\u2015]/g, ","], [/["`\u201c\u201d\u201e]/g, " "], [/[\u2018\u2019]/g, "'"]];
const WORDS = /[,.]|[^,.\x00-\x20\x7f-\xa0\u1680\u2000-\u200a\u2028\u2029\u202f\u205f\u3000\ufeff]+/g;
/** The characters of the IBM 7094, from the code of the first one on. */
const CODES = new Map([[0, "0123456789"], [0o13, "='"], [0o20, "+ABCDEFGHI"], [0o33, ".)"], [0o40, "-JKLMNOPQR"],
  [0o53, "$*"], [0o60, " /STUVWXYZ"], [0o73, ",("]].flatMap(([first, row]) =>
  [...`${row}`].map((character, i) => ([character, Number(first) + i] as [string, number]))));

/** A conversation. It remembers sentences, and changes the turns of its script. */
export class Eliza {
  rules = new Map(Object.entries(this.script.rules));
  limit = 1;
  memories: string[] = [];

  constructor(readonly script: Script) {}

  /** Answers a sentence. */
  answer(sentence: string, ask: Ask): { text: string; known: Known[] } {
    this.limit = (this.limit % LIMIT) + 1;
    let { words, keys } = this.scan(wordsOf(sentence));
    const remembered = !keys.length && this.limit === LIMIT ? this.memories.shift() : undefined;
    if (remembered !== undefined) return { text: remembered, known: [] };
    const size = words.length;
    let rule = this.script.none;
    for (let step = 0; step < STEPS_MAX && words.length - size <= STEPS_MAX; step += 1) {
      rule = this.rules.get(keys.shift() ?? "") ?? this.script.none;
      const done = this.apply(rule, words, keys, ask);
      if (!Array.isArray(done)) return done;
      words = done;
    }
    throw new Error(`the script loops for ever at ${rule.key}: stopped after ${STEPS_MAX} steps`);
  }

  /** The part that is answered, its words replaced; and its keywords, the first to try in front. */
  scan(words: string[]) {
    const keys: string[] = [];
    let [begin, highest] = [0, -1];
    for (const [i, word] of words.entries()) {
      const rule = this.rules.get(word);
      if (DELIMITERS.includes(word)) {
        if (keys.length) return { words: words.slice(begin, i), keys };
        begin = i + 1;
      } else if (rule) {
        words[i] = rule.substitute ?? word;
        if (!rule.transformations.length && !rule.link) continue;
        if (rule.rank > highest) keys.unshift(word);
        else keys.push(word);
        highest = Math.max(highest, rule.rank);
      }
    }
    return { words: words.slice(begin), keys };
  }

  /** Applies a rule: an answer; or the words to go on with, by the keywords. */
  apply(rule: Rule, words: string[], keys: string[], ask: Ask) {
    if (rule.key === this.script.memory.key) this.remember(words);
    for (const transformation of rule.transformations) {
      const found = this.match(transformation.parts, words);
      if (!found) continue;
      const [pieces, key] = transformation.reassemblies[transformation.turn];
      transformation.turn = (transformation.turn + 1) % transformation.reassemblies.length;
      if (key === null) return (pieces && say(pieces, found, ask)) ?? words;
      keys.unshift(key);
      return pieces ? putTogether(pieces, found) : words;
    }
    if (rule.link === null) return { text: NOTHING_MATCHES[this.limit - 1], known: [] };
    keys.unshift(rule.link);
    return words;
  }

  remember(words: string[]) {
    const { parts, reassemblies } = this.script.memory.transformations[slipHash(words.at(-1) ?? "", 2)];
    const found = this.match(parts, words);
    if (found) this.memories.push(putTogether(reassemblies[0][0] ?? [], found).join(" "));
  }

  /**
   * The words of each part, where every 0 takes as few as it can from left to right; undefined without a match. Between
   * two zeros stands a run of parts of a fixed length, which takes the first place where it fits.
   */
  match(parts: Part[], words: string[]) {
    const runs: Part[][] = [[]];
    for (const part of parts) {
      if (part === 0) runs.push([]);
      else runs[runs.length - 1].push(part);
    }
    const found: string[][] = [];
    let at = 0;
    for (const [i, run] of runs.entries()) {
      const last = words.length - run.reduce((sum: number, part) => sum + sizeOf(part), 0);
      let place = i > 0 && i === runs.length - 1 ? Math.max(at, last) : at;
      while (place <= (i === 0 ? Math.min(0, last) : last) && !this.fits(run, words, place)) place += 1;
      if (place > (i === 0 ? Math.min(0, last) : last)) return undefined;
      if (i > 0) found.push(words.slice(at, place));
      at = place;
      for (const part of run) found.push(words.slice(at, (at += sizeOf(part))));
    }
    return at === words.length ? found : undefined;
  }

  fits(run: Part[], words: string[], at: number) {
    return run.every((part) => {
      const word = words[at];
      at += sizeOf(part);
      if (typeof part === "number") return true;
      if (typeof part === "string") return word === part;
      return "words" in part ? part.words.includes(word) : (this.rules.get(word)?.tags ?? []).some((it) => part.tags.includes(it));
    });
  }
}

function wordsOf(sentence: string) {
  return SIGNS.reduce((text, [signs, to]) => text.replace(signs, to), sentence.toUpperCase()).match(WORDS) ?? [];
}

function sizeOf(part: Part) {
  return typeof part === "number" ? part : 1;
}

/** An answer; null if a fact in it is not known. */
function say(pieces: Piece[], found: string[][], ask: Ask) {
  const texts: string[] = [];
  const known: Known[] = [];
  for (const piece of pieces) {
    if (typeof piece === "object") {
      const fact = ask(piece.fact, piece.part === null ? [] : found[piece.part - 1]);
      if (!fact) return null;
      known.push(fact);
      texts.push(fact.text);
    } else for (const word of putTogether([piece], found)) texts.push(word);
  }
  return { text: texts.join(" "), known };
}

function putTogether(pieces: Piece[], found: string[][]) {
  return pieces.flatMap((piece) => (typeof piece === "number" ? found[piece - 1] : [`${piece}`]));
}

/** SLIP's hash of the last cell of a word, as in host_sim/talk/eliza.py. */
function slipHash(word: string, bits: number) {
  const letters = [...word];
  const last = letters.slice(Math.floor(Math.max(0, letters.length - 1) / 6) * 6).join("");
  const codes = [...last, ..."      "].slice(0, 6).map((it) => CODES.get(it) ?? (it.codePointAt(0) ?? 0) & 0o77);
  const cell = BigInt.asUintN(35, codes.reduce((sum, code) => (sum << 6n) | BigInt(code), 0n));
  return Number(BigInt.asUintN(bits, (cell * cell) >> BigInt(35 - Math.floor(bits / 2))));
}
