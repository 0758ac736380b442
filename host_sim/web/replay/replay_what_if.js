// @ts-check
/* "What if?" on the page of a recorded run: the laboratory of octet.html over it, with the run and a copy to change. */

import { byId, setText, typedById } from "../core/elements.js";
import { heard, robotWords, say } from "../core/language.js";
import { inflate } from "../core/packed_columns.js";
import { decimal } from "../core/phrases.js";
import { partingOf } from "../panel/divergence.js";

/**
 * What host_sim/report/laboratory.py has put into the page: octet.html, packed, and the run for it; or why it has not.
 * @typedef {{page: string, run: RecordedRun} | {why: string}} Laboratory
 *
 * The laboratory's page, as far as this one knows it.
 * @typedef {Window & {octet?: {repeated: Promise<void>, lanes: {data?: RunData}[]}}} LabWindow
 */

/** How often, and for how long, the script of the laboratory is waited for. */
const LOOK_MS = 20;
const UNPACK_MS = 30_000;

const NONE = {
  why: "This page contains no firmware. This command writes one that does: tools/octet replay out/run.log --html out/replay.html --what-if",
};
const PLACE = '<script type="application/json" id="begin"></script>';

/** Opens and closes the laboratory. */
export class ReplayWhatIf {
  /** @param {RunData} data */
  constructor(data) {
    this.data = data;
    this.view = typedById("what-if-view", HTMLDialogElement);
    /** @type {HTMLIFrameElement | undefined} */
    this.frame = undefined;
    byId("back").addEventListener("click", () => this.view.close());
    this.view.addEventListener("close", () => this.frame?.remove());
  }

  get isOpen() {
    return this.view.open;
  }

  /**
   * Opens the laboratory at a tick, or says why there is none.
   * @param {number} tick
   * @param {number} node - The robot to show.
   */
  async open(tick, node) {
    const text = byId("laboratory").textContent;
    /** @type {Laboratory} */
    const laboratory = text ? JSON.parse(text) : NONE;
    if ("why" in laboratory) {
      setText(byId("no-what-if"), heard(laboratory.why));
      return;
    }
    setText(byId("what-if-news"), heard("the firmware runs the recorded run again"));
    this.view.showModal();
    try {
      const page = await pageOf(laboratory.page, { recorded: laboratory.run, tick, node });
      if (this.isOpen) this.show(page);
    } catch (error) {
      this.giveUp(error);
    }
  }

  /** @param {unknown} error - Why the laboratory is closed. */
  giveUp(error) {
    this.view.close();
    setText(byId("no-what-if"), heard(error instanceof Error ? error.message : `${error}`));
  }

  /** @param {string} html */
  show(html) {
    const frame = document.createElement("iframe");
    frame.title = say("desk");
    frame.srcdoc = html;
    frame.addEventListener("load", () => this.check(/** @type {LabWindow} */ (frame.contentWindow)));
    this.frame?.remove();
    this.frame = this.view.appendChild(frame);
  }

  /**
   * Tells whether the laboratory's run is the recorded one.
   * @param {LabWindow} lab - Its script unpacks itself after the page has loaded.
   */
  async check(lab) {
    for (let waited = 0; !lab.octet && waited < UNPACK_MS; waited += LOOK_MS) await new Promise((done) => setTimeout(done, LOOK_MS));
    const { octet } = lab;
    try {
      await octet?.repeated;
      const [run] = octet?.lanes ?? [];
      setText(byId("what-if-news"), run?.data ? heard(verdict(this.data, run.data)) : "");
    } catch (error) {
      this.giveUp(error);
    }
  }
}

/**
 * @param {RunData} recorded
 * @param {RunData} repeated
 */
function verdict(recorded, repeated) {
  const parting = partingOf(recorded, repeated);
  if (!parting) return "A is the recorded run, tick for tick; B is yours to change.";
  const seconds = decimal((parting.tick * recorded.measures.tick_ms) / 1000, 1, robotWords());
  return `A is not the recorded run: it differs from ${seconds} s on, because something outside influenced that run.`;
}

/**
 * The laboratory's page, with what it is to begin with.
 * @param {string} packed
 * @param {import("../lab/octet.js").Begin} begin
 */
async function pageOf(packed, begin) {
  const html = new TextDecoder().decode(await inflate(packed));
  const data = JSON.stringify(begin).replaceAll("<", "\\u003c");
  return html.replace(PLACE, () => PLACE.replace("></", `>${data}</`));
}
