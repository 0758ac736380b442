/* The arena of a run, in C: what stands in it, where the robots' bodies are, and their faults. */

import { EDITS, KIT_SETTINGS } from "../generated.js";
import type { SimParams, Traits, WorldEdit } from "../types.js";
import type { NativeRun } from "./native_run.js";

/** What the bodies are like, and the seed that they are drawn from. */
type Bodies = { body?: string | Traits; seed?: number };

/** The names of bodies. */
export const IDEAL = "ideal";
export const KIT = "kit";

/** Parameters that a robot with such a body is set to. */
export function settingsOf(body: Bodies["body"]): Record<string, number> {
  return body === KIT ? { ...KIT_SETTINGS } : {};
}

/** Whether a change is one of the world or of the bodies in it; all others are commands to a robot. */
export function isWorldEdit<T extends { do: string }>(change: T): change is T & WorldEdit {
  return Object.hasOwn(EDITS, change.do);
}

/** A change that cannot be made. */
export class EditError extends Error {}

/** The order of the dimensions in native/page.h. */
const DIMENSIONS = [
  "width_mm", "height_mm", "body_radius_mm", "wheel_track_mm", "sensor_reach_mm", "front_extra_mm", "beam_width_mm",
  "eat_reach_mm", "tick_s", "max_wheel_speed_mm_s", "bar_thickness_mm",
] as const;
/** The order of an edit's numbers. */
const NUMBERS = ["id", "robot", "seed", "heading", "radius"];
const PLACES = ["a", "b", "at"];

/** What stands in the arena of a run. Bars and plants come with their ids, pieces of food with a 1 if they are eaten. */
export class Arena {
  constructor(readonly native: NativeRun, params: SimParams, { body = IDEAL, seed = 0 }: Bodies = {}) {
    native.c.page_set_bodies(body === IDEAL ? 0 : 1, body === KIT ? 1 : 0);
    if (typeof body === "object") this.describe(body);
    native.handOver(DIMENSIONS.map((name) => params[name]));
    native.c.page_build();
    native.c.page_draw_bodies(seed);
  }

  describe(traits: Traits) {
    for (const [name, [value, tolerance]] of Object.entries(traits)) {
      this.native.handOver([], name);
      if (!this.native.c.page_set_trait(value, tolerance)) throw new Error(`this page does not support a body with ${name} ${value}`);
    }
  }

  /** All things. */
  get things() {
    const [bars, plants, food] = this.native.tablesAt(this.native.c.page_scene(), [5, 4, 3]);
    return { bars, plants, food };
  }

  /** For each piece of food, 1 if it was eaten. */
  get eaten() {
    return this.things.food.map(([, , eaten]) => eaten);
  }

  /** What stands in it, for a drawing: to a tenth of a mm. */
  get drawn() {
    const { bars, plants, food } = this.things;
    const tenths = (places: number[]) => places.map((mm) => Math.round(mm * 10) / 10);
    return { bars: bars.map(tenths), food: food.map(([x, y]) => tenths([x, y])), plants: plants.map(tenths) };
  }

  /** @param edit - Of the arena, or of a body. */
  edit(edit: WorldEdit) {
    const fields: Record<string, any> = edit;
    const places = PLACES.flatMap((name) => fields[name] ?? [0, 0]);
    this.native.handOver([...NUMBERS.map((name) => fields[name] ?? 0), ...places], fields.what);
    const why = this.native.c.page_edit(Object.keys(EDITS).indexOf(edit.do));
    if (why) throw new EditError(this.native.textAt(why));
  }
}
