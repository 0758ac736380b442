/* Seven boxes, one for each pattern with something in the way: the turn that the robot knows, and how many beads are in it. */

import { made } from "../core/dom.js";
import { robotWords, say } from "../core/language.js";
import { CELL_COUNT, SIDE } from "../generated.js";
import { makeButton, pictureOf, showSide, sideName } from "../panel/cells_view.js";
import { beadsAt } from "./bead_goals.js";
import type { Lab } from "./course.js";

const ARROWS = ["–", "↰", "↱"];
const BEAD = "●";

/** A tool of a lesson; pressing a box changes what the selected robot knows. */
export class Boxes {
  boxes = Array.from({ length: CELL_COUNT - 1 }, (_, i) => this.makeBox(i + 1));
  element = made("ol", this.boxes.map(({ button }) => made("li", [button])), { class: "boxes" });

  constructor(readonly lab: Lab) {}

  makeBox(cell: number) {
    const { lab } = this;
    const button = makeButton(cell, (_, side) => lab.change({ do: "write", robot: lab.lane.robot, cell, side }));
    const [side, beads] = ["side", "beads"].map((name) => made("span", [], { class: name }));
    button.append(pictureOf(cell), side, beads);
    return { cell, button, side, beads };
  }

  show() {
    const { lane, tick } = this.lab;
    const known = lane.scene?.states[lane.robot].memory ?? [];
    const counts = beadsAt(lane, tick, lane.robot);
    for (const { cell, button, side, beads } of this.boxes) {
      const is = known[cell] ?? SIDE.NOTHING;
      showSide(button, is);
      side.textContent = ARROWS[is];
      beads.textContent = BEAD.repeat(counts[cell]);
      const words = [robotWords().patterns[cell], sideName(is), ...(counts[cell] ? [BEAD.repeat(counts[cell])] : [])];
      button.setAttribute("aria-label", say("cell", { cell, words: words.join(", ") }));
    }
  }
}
