/* A conversation on a page, with the robot of a run or with ELIZA; answers that are known facts are marked. */

import { byId } from "../core/dom.js";
import { inflate } from "../core/packed_columns.js";
import { Eliza } from "./eliza.js";
import { POINT, RobotFacts, inOrder } from "./facts.js";
import type { Said, WirePlace } from "../types.js";
import type { Known, Script } from "./eliza.js";
import type { Texts } from "./facts.js";

type About = ConstructorParameters<typeof RobotFacts>[0];

const PLACES_MAX = 100;

/** A speaker, by a script and, for its facts, the words of its language. It answers sentence by sentence. */
export class Conversation {
  eliza = new Eliza(structuredClone(this.script));
  joined = this.texts.joined && new RegExp(`,(?=\\s+(?:${this.texts.joined.join("|")})\\s)`, "gi");

  constructor(readonly script: Script, readonly texts: Texts) {}

  /** @param about - What is asked about; undefined where nothing is known. */
  answer(sentence: string, about: About | undefined): Said {
    const facts = (about ? new RobotFacts(about, this.texts) : {}) as unknown as Record<string, ((words: string[]) => Known | null)>;
    const heard = this.joined ? sentence.replace(/(?<=[0-9])[.,](?=[0-9])/g, POINT).replace(this.joined, " ") : sentence;
    try {
      const { text, known } = this.eliza.answer(heard, (name, words) => facts[name.toLowerCase()]?.(words) ?? null);
      const of = (part: "ticks" | "cells" | "food") => inOrder(known.flatMap((it) => it[part]));
      const said = text.replaceAll(POINT, this.texts.words.point);
      return { mark: known.length ? "log" : "words", text: said, ticks: of("ticks"), cells: of("cells"), food: of("food") };
    } catch (error) {
      return { mark: "words", text: error instanceof Error ? error.message : `${error}`, ticks: [], cells: [], food: [] };
    }
  }

  /** Teaches it a word: what it says to each sentence with that word. The answer is not a known fact. */
  teach(word: string, answer: string) {
    const key = word.trim().toUpperCase();
    const transformations = [{ parts: [0], reassemblies: [[[answer.toUpperCase()], null] as [string[], null]], turn: 0 }];
    this.eliza.rules.set(key, { key, substitute: null, tags: [], rank: 99, transformations, link: null });
  }
}

/** All speakers of a page that has the whole run. They are unpacked when one of them is first spoken to. */
export class Conversations {
  unpacked: ReturnType<typeof speakersInPage> | undefined;

  get all() {
    return (this.unpacked ??= speakersInPage());
  }

  /** What is asked, and its answer; and where the robot was in the ticks on which it rests, in this environment. */
  async ask(who: string, sentence: string, about: About) {
    const { data, robot, tick } = about;
    const said = (await this.all)[who].answer(sentence, about);
    const { x, y } = data.robots[robot].columns;
    const here = said.ticks.filter((it) => it >= data.sceneAt(tick).first_tick).slice(-PLACES_MAX);
    const places: WirePlace[] = here.map((it) => [x[it - data.first] / 10, y[it - data.first] / 10]);
    return [{ who, sentence, said, tick }, places] as const;
  }
}

async function speakersInPage() {
  const text = new TextDecoder().decode(await inflate(JSON.parse(byId("speakers").textContent ?? "")));
  const speakers: [string, { script: Script; texts: Texts }][] = Object.entries(JSON.parse(text));
  return Object.fromEntries(speakers.map(([name, { script, texts }]) => [name, new Conversation(script, texts)]));
}
