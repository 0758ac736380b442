/* The ticks of a run to which the page can jump. */

import type { RobotData } from "../core/run_data.js";
import type { EventKind } from "../types.js";

/**
 * The tick of the next event of a kind after a tick, or of the one before it; undefined if there is none.
 * @param kind - An EventKind, "decision" or "obstacle".
 * @param step - 1 or -1.
 */
export function nextTick(robot: RobotData, kind: string, tick: number, step: number) {
  if (kind === "decision") return search(robot, tick, step, (at) => begins(robot, at));
  if (kind === "obstacle") return search(robot, tick, step, (at) => meets(robot, at));
  return robot.eventFrom(kind as EventKind, tick, step);
}

/** The tick in which the action of a tick began. */
export function actionStart(robot: RobotData, tick: number) {
  return begins(robot, tick) ? tick : (search(robot, tick, -1, (at) => begins(robot, at)) ?? robot.first);
}

function begins({ first, columns: { action } }: RobotData, tick: number) {
  return tick === first || action[tick - first] !== action[tick - first - 1];
}

/** Whether something comes in the way of a robot that had nothing there. */
function meets({ first, columns: { pattern } }: RobotData, tick: number) {
  return pattern[tick - first] !== 0 && (tick === first || pattern[tick - first - 1] === 0);
}

function search(
  { first, columns: { action } }: RobotData,
  from: number,
  step: number,
  wanted: (tick: number) => boolean,
) {
  for (let tick = from + step; tick >= first && tick < first + action.length; tick += step) if (wanted(tick)) return tick;
  return undefined;
}
