/* An experiment as the fields of a link, and back; and a link as a QR code, for a phone's camera. */

import qrcode from "qrcode-generator";
import { RANDOM } from "../core/world_names.js";
import { IDEAL } from "../sim/arena.js";
import { experimentOf } from "./shown_run.js";
import { made, setText } from "../core/dom.js";
import { say } from "../core/language.js";
import { drawModules } from "../draw/shapes.js";
import type { Linked } from "../program/link.js";
import type { Experiment } from "../types.js";

/** The fields for a link; a world or a body from a file is left out. */
export function fieldsOf({ seed, environments, robots, changes, world = RANDOM, body = IDEAL }: Experiment): Partial<Linked> {
  const [{ profile, settings, memory, program }] = robots;
  const setups = robots.map((it) => ({ ...it, program: undefined }));
  const differ = setups.some((it) => it.seed !== undefined || JSON.stringify(it) !== JSON.stringify(setups[0]));
  return {
    seed, environments, behaviour: profile,
    ...(robots.length > 1 && { robots: robots.length }),
    ...(typeof world === "string" && { world }),
    ...(typeof body === "string" && body !== IDEAL && { body }),
    ...(memory && { memory }),
    settings,
    ...(differ && { setups }),
    ...(changes.length && { changes }),
    ...(program !== undefined && { program }),
  };
}

/** The experiment that a link has, without its program. */
export function experimentFrom(
  { seed = 1, environments = 5, robots = 1, world, body, behaviour = "article", memory, settings, setups, changes = [] }: Partial<Linked>,
): Experiment {
  const plain = experimentOf({ seed, environments, robots, profile: behaviour, world, body });
  const alike = plain.robots.map((it) => ({ ...it, settings: { ...it.settings, ...settings }, memory: memory ?? it.memory }));
  return { ...plain, robots: setups ?? alike, changes };
}

/** The capacity of the largest code, at the lowest level of error correction. */
const BYTES_MAX = 2953;
const LOCAL = /^(?:|localhost|127\..*|\[::1\])$/;

/** A dialog with the code of an address; Escape or a press closes it. */
export class LinkCode {
  canvas = made("canvas", [], { role: "img" });
  note = made("p", []);
  dialog = made("dialog", [this.canvas, this.note], { id: "link-code" });

  constructor() {
    document.body.append(this.dialog);
    this.dialog.addEventListener("click", () => this.dialog.close());
  }

  /** @param address - In ASCII. */
  show(address: string) {
    const fits = address.length <= BYTES_MAX;
    this.canvas.hidden = !fits;
    if (fits) this.draw(address);
    this.canvas.setAttribute("aria-label", say("codeOfLink"));
    setText(this.note, say(!fits ? "codeTooLong" : LOCAL.test(new URL(address).hostname) ? "codeOnlyHere" : "codeToScan"));
    this.dialog.showModal();
  }

  draw(address: string) {
    const code = qrcode(0, "L");
    code.addData(address);
    code.make();
    drawModules(this.canvas, code.getModuleCount(), (x, y) => code.isDark(y, x));
  }
}
