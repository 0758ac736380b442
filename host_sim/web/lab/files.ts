/* Files that the page writes and reads. */

import { CELL_COUNT, EDITS } from "../generated.js";
import { IDEAL } from "../sim/arena.js";
import { RANDOM } from "../core/world_names.js";
import type { RunData } from "../core/run_data.js";
import type { Experiment } from "../types.js";

/** Lets the browser save a file. */
export function save(name: string, parts: BlobPart[]) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob(parts));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href));
}

/** A memory file's bytes. */
export async function memoryIn(file: File) {
  const bytes = [...new Uint8Array(await file.arrayBuffer())];
  if (bytes.length !== CELL_COUNT) throw new Error(`${file.name} is not a memory file: it has ${bytes.length} bytes, not ${CELL_COUNT}`);
  return bytes;
}

/** The world file of a run, as host_sim/recording/world_file.py writes it. */
export function worldText(
  { seed, environments, limit_ticks, robots, changes, world = RANDOM, body = IDEAL }: Experiment,
  data: RunData,
  frontExtraMm: number,
) {
  const begun = data.robots[0].run.events.filter(([, kind]) => kind === "environment");
  const content = {
    format: 1,
    seed,
    of: environments,
    limit_ticks,
    robots: robots.length,
    front_extra_mm: frontExtraMm,
    ...(world !== RANDOM && { world }),
    ...(body !== IDEAL && { body }),
    environments: begun.map(([tick]) => ({ seed, number: data.sceneAt(tick).number, first_tick: tick })),
    edits: changes.filter((change) => Object.hasOwn(EDITS, change.do)),
  };
  return `${JSON.stringify(content)}\n`;
}
