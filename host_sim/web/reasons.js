/* Why the robot does what it does, as in hal/protocol/octet.dbc. */

export const REASON = {
  stop: 0, wander: 1, towardFood: 2, lookAround: 3, remembered: 4, trial: 5, boredom: 6, eat: 7,
};
