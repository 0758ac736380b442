/* Shows what could not be done, where a person last pressed something or at the element in focus. */

import { byId, setText } from "./dom.js";

const SHOWN_MS = 5000;
const GAP_PX = 14;

/** Fills the element `note`, and moves it to where a person last pressed something, or to the page's status, beside the arena. */
export class Toast {
  timer = 0;
  element = byId("note");
  /** Where a person last pressed something. */
  hand: { x: number; y: number } | undefined;

  constructor() {
    const follow = (event: PointerEvent) => (this.hand = { x: event.clientX, y: event.clientY });
    document.addEventListener("pointerdown", follow, { capture: true });
    document.addEventListener("pointerup", follow, { capture: true });
    document.addEventListener("keydown", () => this.followFocus(), { capture: true });
  }

  /** Moves the hand to the element in focus, for those who use the keyboard. */
  followFocus() {
    const box = document.activeElement?.getBoundingClientRect();
    if (box && document.activeElement !== document.body) this.hand = { x: box.left, y: (box.top + box.bottom) / 2 };
  }

  show(text: string) {
    setText(this.element, text);
    this.place();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => setText(this.element, ""), SHOWN_MS);
  }

  /** Puts the note below the hand, or above it where there is no room, and within the window. */
  place() {
    const { width, height } = this.element.getBoundingClientRect();
    const { clientWidth, clientHeight } = document.documentElement;
    const hand = this.hand ?? byId("status").getBoundingClientRect();
    const below = hand.y + GAP_PX;
    const y = below + height < clientHeight ? below : hand.y - GAP_PX - height;
    this.element.style.setProperty("left", `${Math.max(0, Math.min(hand.x, clientWidth - width))}px`);
    this.element.style.setProperty("top", `${Math.max(0, y)}px`);
  }
}
