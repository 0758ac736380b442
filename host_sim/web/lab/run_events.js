// @ts-check
/* The ticks of a run that one can go to. */

/**
 * The tick of the next event of a kind after a tick, or of the one before it; undefined if there is none.
 * @param {RobotData} robot
 * @param {string} kind - An EventKind, "decision" or "obstacle".
 * @param {number} tick
 * @param {number} step - 1 or -1.
 */
export function nextTick(robot, kind, tick, step) {
  if (kind === "decision") return search(robot, tick, step, (at) => begins(robot, at));
  if (kind === "obstacle") return search(robot, tick, step, (at) => meets(robot, at));
  return robot.eventFrom(/** @type {EventKind} */ (kind), tick, step);
}

/**
 * The tick in which the action of a tick began.
 * @param {RobotData} robot
 * @param {number} tick
 */
export function actionStart(robot, tick) {
  return begins(robot, tick) ? tick : (search(robot, tick, -1, (at) => begins(robot, at)) ?? robot.first);
}

/**
 * @param {RobotData} robot
 * @param {number} tick
 */
function begins({ first, columns: { action } }, tick) {
  return tick === first || action[tick - first] !== action[tick - first - 1];
}

/**
 * Whether something comes in the way of a robot that had nothing there.
 * @param {RobotData} robot
 * @param {number} tick
 */
function meets({ first, columns: { pattern } }, tick) {
  return pattern[tick - first] !== 0 && (tick === first || pattern[tick - first - 1] === 0);
}

/**
 * @param {RobotData} robot
 * @param {number} from
 * @param {number} step
 * @param {(tick: number) => boolean} wanted
 */
function search({ first, columns: { action } }, from, step, wanted) {
  for (let tick = from + step; tick >= first && tick < first + action.length; tick += step) if (wanted(tick)) return tick;
  return undefined;
}
