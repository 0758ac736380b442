/* A person's hands in the arena: what pointer and keyboard do to obstacles, food and robot. */

import { byId } from "./panel.js";
import { allThings, endsOf, movedBar, thingAt, turnedBar, whole } from "./things.js";

const STEP_MM = 50;
const SMALL_STEP_MM = 10;
const TURN = Math.PI / 12;
const LIFT_AFTER_MM = 30;
const SEND_EVERY_MS = 30;
const NEW_BAR_MM = 250;
const ARROWS = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, -1], arrowdown: [0, 1] };

/** Chooses and moves things; `moved` says that there is something new to draw. */
export class Hands {
  /**
   * @param {import("./renderer.js").Renderer} renderer
   * @param {import("./renderer.js").Scene} scene - Its `selected` and `ghost` are ours.
   * @param {(order: Object) => void} send
   */
  constructor(renderer, scene, send) {
    Object.assign(this, { renderer, scene, send, moved: false, lifting: false, sentAt: 0 });
    const canvas = renderer.canvas;
    canvas.addEventListener("pointerdown", (event) => this.grasp(event));
    canvas.addEventListener("pointermove", (event) => this.carry(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", (event) => this.release(event));
    canvas.addEventListener("keydown", (event) => this.press(event));
    byId("lift").addEventListener("click", () => this.liftOrPut());
    byId("add-bar").addEventListener("click", () => this.addBar());
    byId("remove-bar").addEventListener("click", () => this.removeBar());
  }

  /** The arena has changed: what was chosen may be gone, what was wished for may be there. */
  recheck() {
    const { scene } = this;
    const newest = Math.max(...scene.environment.bars.map(([id]) => id));
    if (this.wished) this.choose({ kind: "bar", id: newest, part: "whole" });
    else if (scene.selected?.kind === "bar" && !endsOf(scene.environment, scene.selected.id)) this.choose(undefined);
    this.wished = false;
  }

  /** The robot is where the state says, unless a person holds it. */
  follow(state) {
    if (state.lifted) this.lifting = false;
    else if (this.scene.ghost && !this.held && !this.lifting) this.scene.ghost = undefined;
    const words = state.lifted ? "Put down the robot" : "Pick up the robot";
    if (byId("lift").textContent !== words) byId("lift").textContent = words;
  }

  choose(thing) {
    this.scene.selected = thing;
    this.moved = true;
    byId("remove-bar").disabled = thing?.kind !== "bar";
  }

  grasp(event) {
    if (!this.scene.state) return;
    const at = this.renderer.placeOf(event);
    const thing = thingAt(this.scene, at);
    this.choose(thing);
    if (!thing) return;
    this.renderer.canvas.setPointerCapture(event.pointerId);
    this.held = { thing, from: at, ends: endsOf(this.scene.environment, thing.id) };
  }

  carry(event) {
    if (!this.held) return;
    const at = this.renderer.placeOf(event);
    if (this.held.thing.kind === "robot") this.carryRobot(at);
    else if (event.timeStamp - this.sentAt > SEND_EVERY_MS) {
      this.sentAt = event.timeStamp;
      this.send(this.dragOrder(at));
    }
  }

  release(event) {
    const held = this.held;
    this.held = undefined;
    if (!held) return;
    const at = this.renderer.placeOf(event);
    const far = Math.hypot(at.x - held.from.x, at.y - held.from.y) > 1;
    if (held.thing.kind === "robot") this.putIfCarried();
    else if (far) this.send(this.dragOrder(at, held));
  }

  dragOrder(at, held = this.held) {
    const { measures } = this.scene;
    if (held.thing.kind === "food") return { do: "move_food", id: held.thing.id, at: whole(at, measures) };
    const [dx, dy] = [at.x - held.from.x, at.y - held.from.y];
    return { do: "move_bar", id: held.thing.id, ...movedBar(held.ends, held.thing.part, dx, dy, measures) };
  }

  carryRobot(at) {
    const { state, ghost } = this.scene;
    const from = this.held.from;
    if (!ghost && Math.hypot(at.x - from.x, at.y - from.y) < LIFT_AFTER_MM) return;
    if (!state.lifted && !ghost) this.lift();
    this.scene.ghost = { x: at.x, y: at.y, heading: ghost?.heading ?? state.heading };
    this.moved = true;
  }

  putIfCarried() {
    const { ghost, measures } = this.scene;
    if (ghost) this.send({ do: "put", at: whole(ghost, measures), heading: ghost.heading });
  }

  liftOrPut() {
    const { state } = this.scene;
    if (!state) return;
    this.scene.ghost ??= { x: state.x, y: state.y, heading: state.heading };
    if (state.lifted) this.putIfCarried();
    else this.lift();
    this.choose({ kind: "robot", id: 0, part: "whole" });
  }

  lift() {
    this.lifting = true;
    this.send({ do: "lift" });
  }

  addBar() {
    const { state, measures } = this.scene;
    if (!state) return;
    const x = Math.round(measures.width / 2);
    const y = Math.round(measures.height * (Math.abs(state.y - measures.height / 2) > 300 ? 0.5 : 0.2));
    this.wished = true;
    this.send({ do: "add_bar", a: [x - NEW_BAR_MM, y], b: [x + NEW_BAR_MM, y] });
  }

  removeBar() {
    const { selected } = this.scene;
    if (selected?.kind === "bar") this.send({ do: "remove_bar", id: selected.id });
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.scene.state) return;
    const key = event.key.toLowerCase();
    const action = this.actionOf(key, event.shiftKey);
    if (!action) return;
    event.preventDefault();
    action();
  }

  actionOf(key, small) {
    const step = small ? SMALL_STEP_MM : STEP_MM;
    if (key in ARROWS) return () => this.nudge(ARROWS[key][0] * step, ARROWS[key][1] * step);
    const actions = {
      q: () => this.chooseNext(-1),
      e: () => this.chooseNext(1),
      r: () => this.turn(small ? -TURN : TURN),
      p: () => this.liftOrPut(),
      a: () => this.addBar(),
      delete: () => this.removeBar(),
      backspace: () => this.removeBar(),
      escape: () => this.choose(undefined),
    };
    return actions[key];
  }

  chooseNext(step) {
    const things = allThings(this.scene);
    const { selected } = this.scene;
    const now = things.findIndex(({ kind, id }) => kind === selected?.kind && id === selected.id);
    const first = step > 0 ? 0 : things.length - 1;
    this.choose(things[now < 0 ? first : (now + step + things.length) % things.length]);
  }

  nudge(dx, dy) {
    const { selected, environment, measures, ghost } = this.scene;
    if (selected?.kind === "robot" && ghost) this.hold({ ...ghost, x: ghost.x + dx, y: ghost.y + dy });
    if (selected?.kind === "food") {
      const [x, y] = environment.food[selected.id];
      this.send({ do: "move_food", id: selected.id, at: whole({ x: x + dx, y: y + dy }, measures) });
    }
    const ends = selected?.kind === "bar" && endsOf(environment, selected.id);
    if (ends) this.send({ do: "move_bar", id: selected.id, ...movedBar(ends, "whole", dx, dy, measures) });
  }

  turn(radians) {
    const { selected, environment, measures, ghost } = this.scene;
    if (selected?.kind === "robot" && ghost) {
      const heading = Math.round(1000 * wrap(ghost.heading / 1000 + radians));
      this.hold({ ...ghost, heading });
    }
    const ends = selected?.kind === "bar" && endsOf(environment, selected.id);
    if (ends) this.send({ do: "move_bar", id: selected.id, ...turnedBar(ends, radians, measures) });
  }

  hold(ghost) {
    this.scene.ghost = ghost;
    this.moved = true;
  }
}

/** An angle in -pi..pi. */
function wrap(radians) {
  return Math.atan2(Math.sin(radians), Math.cos(radians));
}
