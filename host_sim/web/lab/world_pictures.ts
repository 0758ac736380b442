/* The choice of a new run's world: a picture of each world's first environment. */

import { byId, made, typedById } from "../core/dom.js";
import { heard } from "../core/language.js";
import { currentPalette } from "../core/palette.js";
import { RunData } from "../core/run_data.js";
import { RANDOM } from "../core/world_names.js";
import { Renderer } from "../draw/renderer.js";
import { Scene } from "../draw/scene.js";
import { PROFILES } from "../generated.js";
import { experimentOf } from "./shown_run.js";
import type { Experiment } from "../types.js";
import type { Simulator } from "./simulator.js";

type World = NonNullable<Experiment["world"]>;

type Picture = { world: World; canvas: HTMLCanvasElement; renderer?: Renderer; scene?: Scene; drawn: string };

/** Fills the element worlds; the environments are those of the seed in the field seed. */
export class WorldPictures {
  pictures: Picture[] = [];
  isDue = false;

  constructor(readonly simulator: Simulator) {
    byId("seed").addEventListener("change", () => this.ask());
  }

  /** The name of the world that is chosen. */
  get chosen() {
    return byId("worlds").querySelector("input:checked")?.getAttribute("value") ?? RANDOM;
  }

  /** @param worlds - By their names. */
  offer(worlds: Map<string, World>, chosen: string) {
    byId("worlds").replaceChildren();
    this.pictures = [...worlds].map(([value, world]) => {
      const field = made("input", [], { type: "radio", name: "world", value, ...(value === chosen && { checked: "" }) });
      const canvas = made("canvas", [], { "aria-hidden": "true" });
      canvas.style.visibility = "hidden";
      byId("worlds").append(made("label", [field, canvas, heard(value)]));
      return { world, canvas, drawn: "" };
    });
    this.isDue = true;
  }

  /** Asks for the environments of the seed, as soon as they are to be seen. */
  ask() {
    const field = typedById("seed", HTMLInputElement);
    this.isDue = byId("worlds").offsetParent === null;
    if (this.isDue || !field.checkValidity()) return;
    for (const picture of this.pictures) {
      const { world } = picture;
      const wanted = experimentOf({ seed: Number(field.value), environments: 1, robots: 1, profile: PROFILES[0], world });
      this.simulator.run(picture, { ...wanted, ticks_max: 1 }, ({ run, done }) => {
        if (!run || !done) return;
        const data = new RunData(run.run, run.columns);
        picture.scene = new Scene(run.run.measures, data.sceneAt(data.first), data.statesAt(data.first));
        picture.drawn = "";
        this.show();
      });
    }
  }

  /** Draws the pictures that are missing or out of date; they are asked for after that of the run. */
  show() {
    if (this.isDue) setTimeout(() => this.ask());
    for (const picture of this.pictures) {
      const { canvas, scene } = picture;
      if (!scene) continue;
      const renderer = (picture.renderer ??= new Renderer(canvas));
      const look = `${renderer.size.width} ${devicePixelRatio} ${currentPalette().of.floor}`;
      if (!renderer.size.width || look === picture.drawn) continue;
      renderer.draw(scene);
      canvas.style.visibility = "";
      picture.drawn = look;
    }
  }
}
