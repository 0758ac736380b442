// @ts-check
/* A live page with a robot of its own: it shows that robot and hides the controls that it may not use. */

import { byId, setText, typedById } from "../core/elements.js";
import { inEachLanguage, say } from "../core/language.js";

/**
 * @typedef {import("./live_view.js").LiveView} LiveView
 * @typedef {import("../types.js").Seat} Seat
 */

const KEY = "octet-page";
const KEY_BYTES = 16;

/** Fills the elements own-robot, name-form and my-name. */
export class LiveSeat {
  /** @param {(command: Command) => void} send */
  constructor(send) {
    /** @type {Seat | null} */
    this.seat = null;
    inEachLanguage(() => this.tell());
    this.name = typedById("my-name", HTMLInputElement);
    byId("name-form").addEventListener("submit", (event) => {
      event.preventDefault();
      send({ do: "name", name: this.name.value });
      this.name.blur();
    });
  }

  tell() {
    const { seat } = this;
    setText(byId("own-robot"), seat ? say(seat.node ? "robotYours" : "seatsTaken", seat) : "");
  }

  /**
   * @param {Seat | null} seat - Null where the robots are everyone's.
   * @param {LiveView | undefined} view
   */
  take(seat, view) {
    document.body.classList.toggle("own", seat !== null && seat.node > 0);
    document.body.classList.toggle("watcher", seat?.node === 0);
    this.seat = seat;
    this.tell();
    byId("name-form").hidden = !seat?.node;
    if (!seat?.node) return;
    if (!this.name.value) this.name.value = seat.name;
    view?.editor.pick(seat.node);
  }
}

/** A secret by which the server recognises this page when it is reloaded; it is lost with the tab. */
export function pageKey() {
  try {
    const known = sessionStorage.getItem(KEY) ?? newKey();
    sessionStorage.setItem(KEY, known);
    return known;
  } catch {
    return newKey();
  }
}

function newKey() {
  const bytes = crypto.getRandomValues(new Uint8Array(KEY_BYTES));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}
