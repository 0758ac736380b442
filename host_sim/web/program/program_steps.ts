/* Where a program is: the single steps of the decision in progress at a tick, and its variables. */

import type { ShownRun } from "../lab/shown_run.js";
import type { Simulator } from "../lab/simulator.js";
import type { ProgramState } from "../sim/native_program.js";

const CELLS_SHOWN = 16;   // of an array
const DECIMALS = 1000;

/** `state` is the last known one. */
export class ProgramSteps {
  state: ProgramState | undefined;
  /** The step that is shown; undefined for the last one. */
  place: number | undefined;
  /** What the state belongs to: a run, its experiment and a tick. */
  of: unknown[] = [];
  isAsking = false;
  stepsAt = -1;

  constructor(readonly simulator: Simulator) {}

  /**
   * Asks for the state at a tick, unless it is known.
   * @param lane - Its first robot has a program.
   */
  look(lane: ShownRun, tick: number, onChange: () => void) {
    const asked = { experiment: lane.experiment, robot: 0, tick: Math.min(tick, lane.last) };
    const of = [lane.data, asked.experiment, asked.tick];
    if (this.isAsking || !lane.data || of.every((it, i) => it === this.of[i])) return;
    this.isAsking = true;
    this.simulator.ask("program", asked).then((state) => {
      this.state = state;
      this.place = tick === this.stepsAt ? 0 : undefined;
    }, () => {
      this.state = undefined; // the run itself tells why
    }).finally(() => {
      this.of = of;
      this.isAsking = false;
      onChange();
    });
  }

  /** Shows the first step first at a tick, instead of the last one. */
  beginAt(tick: number) {
    this.stepsAt = tick;
  }

  /** Goes to the next step; returns false if this was the last one. */
  advance() {
    const count = this.state?.steps.length ?? 0;
    const next = this.place === undefined ? 0 : this.nextLine(this.place);
    if (next >= count) return false;
    this.place = next;
    return true;
  }

  /** The next step that begins a line; those before it assign values in this one. */
  nextLine(place: number) {
    const steps = this.state?.steps ?? [];
    let next = place + 1;
    while (next < steps.length && steps[next].cell >= 0) next += 1;
    return next;
  }

  /** The line being executed, from 1; 0 if there is none. */
  get line() {
    const steps = this.state?.steps ?? [];
    return steps[this.place ?? steps.length - 1]?.line ?? 0;
  }

  /** The variables and their values after the step that is shown. */
  get values(): [string, string][] {
    if (!this.state) return [];
    const { steps, before, variables } = this.state;
    const cells = [...before];
    for (const { cell, value } of steps.slice(0, this.place === undefined ? steps.length : this.nextLine(this.place))) {
      if (cell >= 0) cells[cell] = value;
    }
    return variables.map(({ name, cell, size }) =>
      [name, cells.slice(cell, cell + Math.min(size || 1, CELLS_SHOWN)).map(shortened).join(" ")]);
  }
}

function shortened(value: number) {
  return `${Math.round(value * DECIMALS) / DECIMALS}`;
}
