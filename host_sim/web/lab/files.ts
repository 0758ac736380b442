/* Files that the page writes and reads, and the tab for them. */

import { CELL_COUNT, EDITS } from "../generated.js";
import { IDEAL } from "../sim/arena.js";
import { RANDOM } from "../core/world_names.js";
import { byId, setText, typedById } from "../core/dom.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { csvOf } from "./curves.js";
import type { RunData } from "../core/run_data.js";
import type { Experiment } from "../types.js";
import type { SidePanel } from "./side_panel.js";

/** The tab "Files". */
export class FilesTab {
  /** The last message, in the language of the page. */
  news = () => "";

  /** @param desk - Begins what is opened. */
  constructor(readonly desk: SidePanel) {
    const { lab } = desk;
    const on = (id: string, action: () => Promise<void>) =>
      byId(id).addEventListener("click", () => this.tell(lab.whole().then(action)));
    on("save-csv", async () => save("octet.csv", [csvOf(lab.lanes)]));
    on("save-log", async () => save("run.log", await lab.simulator.ask("log", { experiment: lab.lane.experiment })));
    on("save-world", async () => {
      const { experiment, data } = lab.lane;
      if (data) save("run.world.json", [worldText(experiment, data, lab.params.front_extra_mm)]);
    });
    on("save-memory", async () => {
      const { lane, simulator, tick } = lab;
      const { experiment, robot, last } = lane;
      save("robot.mem", [Uint8Array.from(await simulator.ask("memory", { experiment, robot, tick: Math.min(tick, last) }))]);
    });
    const input = typedById("open", HTMLInputElement);
    input.addEventListener("change", () => {
      this.tell(this.openFiles([...(input.files ?? [])]));
      input.value = "";
    });
    inEachLanguage(() => this.report(this.news));
  }

  /** @param done - Fails with the reason if something cannot be done with a file. */
  tell(done: Promise<void>) {
    done.catch((error) => this.report(() => heard(error instanceof Error ? error.message : `${error}`)));
  }

  report(news: () => string) {
    this.news = news;
    setText(byId("file-news"), news());
  }

  async openFiles(files: File[]) {
    const named = (...ends: string[]) => files.find(({ name }) => ends.some((end) => name.endsWith(end)));
    const [memory, log, world] = [named(".mem"), named(".log"), named(".json", ".toml")];
    const strange = files.find((file) => ![memory, log, world].includes(file));
    if (strange) throw new Error(`${strange.name}: a log ends with .log, a world with .toml or .json, a memory with .mem`);
    if (log) await this.openLog(log, world);
    else if (world) await this.openWorld(world);
    if (memory) await this.openMemory(memory);
  }

  async openMemory(file: File) {
    const { lane, simulator } = this.desk.lab;
    const memory = await memoryIn(file);
    const robots = lane.experiment.robots.map((it, robot) => (robot === lane.robot ? { ...it, memory } : it));
    const experiment = { ...lane.experiment, robots };
    await simulator.ask("memory", { experiment, robot: lane.robot, tick: 0 }); // it throws if they are not a memory
    this.desk.lab.setUp({ memory });
    this.report(() => say("memoryBegins", { file: file.name }));
  }

  async openWorld(file: File) {
    this.desk.begin(await this.desk.lab.simulator.ask("world", { file: { name: file.name, text: await file.text() }, base: this.desk.wanted }));
    this.report(() => say("worldBegins", { file: file.name }));
  }

  async openLog(log: File, world: File | undefined) {
    this.report(() => say("reading", { file: log.name }));
    const files = { text: await log.text(), world: world ? await world.text() : "" };
    const { experiment, news } = await this.desk.lab.simulator.ask("open", files);
    this.desk.begin(experiment);
    this.report(() => heard(news));
  }
}

/** Lets the browser save a file. */
function save(name: string, parts: BlobPart[]) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob(parts));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href));
}

/** A memory file's bytes. */
async function memoryIn(file: File) {
  const bytes = [...new Uint8Array(await file.arrayBuffer())];
  if (bytes.length !== CELL_COUNT) throw new Error(`${file.name} is not a memory file: it has ${bytes.length} bytes, not ${CELL_COUNT}`);
  return bytes;
}

/** The world file of a run, as host_sim/recording/world_file.py writes it. */
function worldText(
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
