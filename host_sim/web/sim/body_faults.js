// @ts-check
/* What can be wrong with a body: as host_sim/world/body_faults.py has it. */

import { FEEL } from "../generated.js";

/**
 * What is wrong with a body, as `BodyFaults` there.
 * @typedef {Object} Faults
 * @property {boolean} mirrored
 * @property {boolean} swapped
 * @property {number} stuckOn
 * @property {number} stuckOff
 * @property {number} leftLost
 * @property {number} rightLost
 * @property {number} noise
 * @property {number} noiseOf
 * @property {bigint} noiseKey
 * @property {boolean} odometersSwapped
 * @property {number} leftMiscounted
 * @property {number} rightMiscounted
 * @property {number} falseBeacon
 */

/** The bit of each sensor, such as "front-left". */
export const SENSORS = new Map(Object.entries(FEEL).map(([name, bit]) => [name.toLowerCase().replace("_", "-"), bit]));
const NOISE_OF_MAX = 1_000_000;
const FULL_PERCENT = 100;
const BEACON_MAX_MM = 8191;
const WORD = 32n;
const LOW = (1n << WORD) - 1n;
const ROBOTS_A_SEED = 10_000n;

/** @type {Readonly<Faults>} */
export const SOUND = Object.freeze({
  mirrored: false, swapped: false, stuckOn: 0, stuckOff: 0, leftLost: 0, rightLost: 0, noise: 0, noiseOf: 1, noiseKey: 0n,
  odometersSwapped: false, leftMiscounted: 0, rightMiscounted: 0, falseBeacon: 0,
});

/**
 * The faults of a body after one more; undefined if there is no such fault.
 * @param {Faults} faults
 * @param {string} what - Such as "stuck-on:front"; docs/worlds.md has all.
 * @param {bigint} key - The robot's `noiseKey`.
 * @returns {Faults | undefined}
 */
export function withFault(faults, what, key) {
  const [name, ...details] = what.split(":");
  const bit = SENSORS.get(details.join(":"));
  if (what === "repair") return SOUND;
  if (what === "mirror") return { ...faults, mirrored: !faults.mirrored };
  if (what === "swap-motors") return { ...faults, swapped: !faults.swapped };
  if (what === "swap-odometers") return { ...faults, odometersSwapped: !faults.odometersSwapped };
  if (name === "stuck-on" && bit) return { ...faults, stuckOn: faults.stuckOn | bit, stuckOff: faults.stuckOff & ~bit };
  if (name === "stuck-off" && bit) return { ...faults, stuckOff: faults.stuckOff | bit, stuckOn: faults.stuckOn & ~bit };
  if (name === "noise") return withNoise(faults, details.join(":"), key);
  if (name === "odometer") return withOdometer(faults, details.join(":"));
  if (name === "false-beacon") return withFalseBeacon(faults, details.join(":"));
  return name === "weak-motor" ? withWeakMotor(faults, details.join(":")) : undefined;
}

/**
 * @param {Faults} faults
 * @param {string} details
 * @param {bigint} noiseKey
 */
function withNoise(faults, details, noiseKey) {
  const [noise, noiseOf] = (/^(\d{1,7})\/(\d{1,7})$/.exec(details) ?? []).slice(1).map(Number);
  return noise <= noiseOf && noiseOf > 0 && noiseOf <= NOISE_OF_MAX ? { ...faults, noise, noiseOf, noiseKey } : undefined;
}

/**
 * @param {Faults} faults
 * @param {string} details
 */
function withWeakMotor(faults, details) {
  const [, side, share] = /^(left|right):(\d{1,3})%$/.exec(details) ?? [];
  const lost = FULL_PERCENT - Number(share);
  if (!(lost >= 0)) return undefined;
  return side === "left" ? { ...faults, leftLost: lost } : { ...faults, rightLost: lost };
}

/**
 * @param {Faults} faults
 * @param {string} details
 */
function withOdometer(faults, details) {
  const [, side, share] = /^(left|right):(-?\d{1,3})%$/.exec(details) ?? [];
  if (!side) return undefined;
  const miscounted = Number(share) - FULL_PERCENT;
  return side === "left" ? { ...faults, leftMiscounted: miscounted } : { ...faults, rightMiscounted: miscounted };
}

/**
 * @param {Faults} faults
 * @param {string} details
 */
function withFalseBeacon(faults, details) {
  const falseBeacon = /^\d{1,4}$/.test(details) ? Number(details) : Infinity;
  return falseBeacon <= BEACON_MAX_MM ? { ...faults, falseBeacon } : undefined;
}

/**
 * Where a robot's noise begins among all random numbers.
 * @param {number} seed
 * @param {number} robot
 */
export function noiseKey(seed, robot) {
  const wrap = (/** @type {bigint} */ number) => BigInt.asUintN(64, number);
  let mixed = wrap(BigInt(seed) * ROBOTS_A_SEED + BigInt(robot) + 0x9e3779b97f4a7c15n);
  mixed = wrap((mixed ^ (mixed >> 30n)) * 0xbf58476d1ce4e5b9n);
  mixed = wrap((mixed ^ (mixed >> 27n)) * 0x94d049bb133111ebn);
  return mixed ^ (mixed >> 31n);
}

/**
 * The numbers that native/page.h wants, in its order.
 * @param {Faults} faults
 */
export function faultNumbers(faults) {
  const { mirrored, swapped, stuckOn, stuckOff, leftLost, rightLost, noise, noiseOf, noiseKey: key } = faults;
  const halves = [key >> WORD, key & LOW].map(Number);
  const { odometersSwapped, leftMiscounted, rightMiscounted, falseBeacon } = faults;
  const sensors = [Number(mirrored), Number(swapped), stuckOn, stuckOff, leftLost, rightLost, noise, noiseOf, ...halves];
  return [...sensors, Number(odometersSwapped), leftMiscounted, rightMiscounted, falseBeacon];
}
