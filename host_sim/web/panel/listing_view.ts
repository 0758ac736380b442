/* The article's listing, with the line highlighted that the robot executes. */

import { pictureOf } from "./cells_view.js";
import { byId, made, setText } from "../core/dom.js";
import { inEachLanguage, robotWords, say } from "../core/language.js";
import { REASON, SIDE } from "../generated.js";
import { binary } from "../core/phrases.js";
import type { State } from "../generated_types.js";

/** Figure 4 of the article, line by line; a step of the robot is named before its line. */
const LISTING = [
  ["", "while FoodCnt"],
  ["sense", "  Senses = (rFeel()>>1)&7"],
  ["", "  if Senses=0"],
  ["", "    RepeatCount = 0"],
  ["forward", "    rForward Dist"],
  ["", "    if rLook(0)=Green"],
  ["", "      if rBeacon(Green)<30"],
  ["eat", "        FoodCnt--"],
  ["", "      endif"],
  ["", "    else"],
  ["", "      if random(2)"],
  ["look right", "        rTurn 2 +random(10)"],
  ["", "      else"],
  ["look left", "        rTurn -(2+random(10))"],
  ["", "      endif"],
  ["", "    endif"],
  ["", "  else"],
  ["", "    if Mem[Senses]"],
  ["remember left", "      if Mem[Senses] = TurnLeft then rTurn -Deg"],
  ["remember right", "      if Mem[Senses] = TurnRight then rTurn Deg"],
  ["", "      RepeatCount++"],
  ["boredom", "      if RepeatCount=10 then rturn (150+random(60))"],
  ["", "    else"],
  ["", "      call CountSensors(Senses,Cnt)"],
  ["", "      OldSenses = Senses"],
  ["", "      r=random(2)+1"],
  ["try left", "      if r=TurnLeft then rTurn -45"],
  ["try right", "      if r=TurnRight then rTurn 45"],
  ["", "      Senses = (rFeel()>>1)&7"],
  ["", "      call CountSensors(Senses,NewCnt)"],
  ["learn", "      if NewCnt<Cnt then Mem[OldSenses]=r"],
  ["", "    endif"],
  ["", "  endif"],
  ["", "wend"],
] as const;

/** Fills the elements listing, pattern-picture and pattern-sum. */
export class ListingView {
  lines: Map<string, HTMLElement> = new Map();
  shown = "";
  pattern = -1;

  constructor() {
    const list = byId("listing");
    for (const [step, text] of LISTING) {
      const item = made("li", [made("code", [text])]);
      list.append(item);
      if (step) this.lines.set(step, item);
    }
    inEachLanguage(() => (this.pattern = -1));
  }

  /** @param actionTick - The tick in which its action began. */
  show(state: State, actionTick: number) {
    const steps = stepsOf(state, actionTick);
    this.showSenses(state);
    const key = steps.join();
    if (key === this.shown) return;
    this.shown = key;
    for (const [step, line] of this.lines) {
      if (steps.includes(step)) line.setAttribute("aria-current", "true");
      else line.removeAttribute("aria-current");
      if (steps.at(-1) === step) scrollTo(line);
    }
  }

  showSenses({ feel, pattern }: State) {
    setText(byId("pattern-sum"), `(%${feel.toString(2).padStart(5, "0")}>>1)&7 = %${binary((feel >> 1) & 7)} = ${(feel >> 1) & 7}`);
    if (pattern === this.pattern) return;
    this.pattern = pattern;
    const picture = byId("pattern-picture");
    picture.replaceChildren(pictureOf(pattern));
    picture.setAttribute("aria-label", say("decidedWith", { pattern: robotWords().patterns[pattern] }));
  }
}

/** The steps of the listing that the robot executes. */
function stepsOf(state: State, actionTick: number) {
  const side = state.left < state.right ? "left" : "right";
  const steps: Record<number, string> = {
    [REASON.WANDER]: "forward",
    [REASON.TOWARD_FOOD]: "forward",
    [REASON.LOOK_AROUND]: `look ${side}`,
    [REASON.REMEMBERED]: `remember ${side}`,
    [REASON.TRIAL]: `try ${state.trial?.side === SIDE.LEFT ? "left" : "right"}`,
    [REASON.BOREDOM]: "boredom",
    [REASON.EAT]: "eat",
  };
  const begins = state.tick === actionTick;
  const learns = begins && state.learned.includes(state.tick);
  return [...(learns ? ["learn"] : []), ...(begins ? ["sense"] : []), steps[state.reason] ?? ""];
}

function scrollTo(line: HTMLElement) {
  const list = line.parentElement;
  if (!list) return;
  const [top, bottom] = [line.offsetTop - list.offsetTop, line.offsetTop - list.offsetTop + line.offsetHeight];
  if (top < list.scrollTop) list.scrollTop = top;
  else if (bottom > list.scrollTop + list.clientHeight) list.scrollTop = bottom - list.clientHeight;
}
