// @ts-check
/* The choice of a new run's world: a picture of each world's first environment. */

import { made } from "../core/dom.js";
import { byId, typedById } from "../core/elements.js";
import { heard } from "../core/language.js";
import { RunData } from "../core/run_data.js";
import { RANDOM } from "../core/world_names.js";
import { Renderer } from "../draw/renderer.js";
import { Scene } from "../draw/scene.js";
import { PROFILES } from "../generated.js";
import { experimentOf } from "./shown_run.js";

/**
 * @typedef {NonNullable<Experiment["world"]>} World
 * @typedef {{world: World, renderer: Renderer, scene: Scene | undefined, drawn: string}} Picture
 */

/** Fills the element worlds; the environments are those of the seed in the field seed. */
export class WorldPictures {
  /** @param {Simulator} simulator */
  constructor(simulator) {
    this.simulator = simulator;
    /** @type {Picture[]} */
    this.pictures = [];
    byId("seed").addEventListener("change", () => this.ask());
  }

  /** The name of the world that is chosen. */
  get chosen() {
    return byId("worlds").querySelector("input:checked")?.getAttribute("value") ?? RANDOM;
  }

  /**
   * @param {Map<string, World>} worlds - By their names.
   * @param {string} chosen
   */
  offer(worlds, chosen) {
    const labels = [...worlds.keys()].map((value) => {
      const field = made("input", [], { type: "radio", name: "world", value, ...(value === chosen && { checked: "" }) });
      return made("label", [field, made("canvas", [], { "aria-hidden": "true" }), heard(value)]);
    });
    byId("worlds").replaceChildren(...labels);
    this.pictures = [...worlds.values()].map((world, i) => {
      const renderer = new Renderer(/** @type {HTMLCanvasElement} */ (labels[i].children[1]));
      renderer.canvas.style.visibility = "hidden";
      return { world, renderer, scene: undefined, drawn: "" };
    });
    this.ask();
  }

  /** Asks for the environments of the seed. */
  ask() {
    const field = typedById("seed", HTMLInputElement);
    if (!field.checkValidity()) return;
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

  /** Draws the pictures that are missing or out of date. */
  show() {
    for (const picture of this.pictures) {
      const { renderer, scene } = picture;
      const look = `${renderer.size.width} ${devicePixelRatio} ${renderer.dark.matches}`;
      if (!scene || !renderer.size.width || look === picture.drawn) continue;
      renderer.draw(scene);
      renderer.canvas.style.visibility = "";
      picture.drawn = look;
    }
  }
}
