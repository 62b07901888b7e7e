/* Profiles over time: what stands in the file, and that the address and fields may set. */

import { ABOUT, shown } from "../explore/dom.js";

const GAP = 1e-3; // s between two points, at least
const SNAP = { s: 1e-3, Pa: 1e3, "N.m": 0.5, 1: 0.01 }; // what a dragged point moves by
const COMMAND = {
  unit: "1",
  min: 0,
  max: 1,
  text: "shift command: 0 first gear, 1 second gear",
  fixed: [ABOUT.shift.from, ABOUT.shift.to],
};
const RAMP = [
  [ABOUT.shift.start, ABOUT.shift.from],
  [ABOUT.shift.start + ABOUT.shift.duration, ABOUT.shift.to],
];
export const KNOWN = {
  ...ABOUT.profiles,
  ...(ABOUT.by_pressure ? {} : { shift_command: { ...COMMAND, points: RAMP } }),
};

/** Return all profiles of the scene as it is: name -> [[time, value], ...]. */
export const profilesOf = () =>
  Object.fromEntries(Object.entries(KNOWN).map(([name, { points }]) => [name, points.map((p) => p.slice())]));

/** Return what is wrong with the points of a profile, "" if nothing is. */
export function wrongWith(name, points) {
  const { min, max, unit, fixed } = KNOWN[name],
    most = fixed ? points.length : ABOUT.most_points,
    words = (v) => shown(v, unit);
  if (!points.length || points.length > most) return `${points.length} points, allowed: 1 .. ${most}`;
  if (fixed && (points.length !== fixed.length || points.some(([, x], i) => x !== fixed[i])))
    return `values, allowed: ${fixed.join(" and ")}, a ramp between two times`;
  for (const [i, [t, x]] of points.entries()) {
    if (!Number.isFinite(t) || Math.abs(t) > 1e6)
      return `time of point ${i + 1} = ${t} s, allowed: -1e6 .. 1e6`;
    if (!(x >= min && x <= max))
      return `point ${i + 1} = ${x} ${unit}, allowed: ${words(min)} .. ${words(max)}`;
    if (i && !(fixed ? t >= points[i - 1][0] : t > points[i - 1][0]))
      return `time of point ${i + 1} = ${t} s, allowed: after point ${i} at ${points[i - 1][0]} s`;
  }
  return "";
}

/** Read a profile as the address has it, "0.1:0,0.11:40000" [s:SI]; return {points} or what is {wrong}. */
export function readProfile(name, text) {
  const number = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i,
    pairs = text.split(",").map((pair) => pair.split(":").map((word) => word.trim()));
  if (!pairs.every((pair) => pair.length === 2 && pair.every((word) => number.test(word)))) {
    return {
      wrong: `${name} = ${text.slice(0, 60)}, allowed: pairs time:value, as in ${writtenProfile(KNOWN[name].points.slice(0, 2))}`,
    };
  }
  const points = pairs.map((pair) => pair.map(Number)),
    wrong = wrongWith(name, points);
  return wrong ? { wrong: `${name}: ${wrong}` } : { points };
}

export const writtenProfile = (points) => points.map(([t, x]) => `${t}:${x}`).join(",");
export const isSame = (one, other) => writtenProfile(one) === writtenProfile(other);

/** Return the point of a profile moved to (t, x): between its neighbours, on the grid. */
export function movedPoint(name, points, i, t, x) {
  const { unit, min, max, fixed } = KNOWN[name],
    snap = (v, by) => Number((Math.round(v / by) * by).toPrecision(12));
  const low = i ? points[i - 1][0] + GAP : ABOUT.start_time,
    high = i + 1 < points.length ? points[i + 1][0] - GAP : Math.max(ABOUT.stop_time, points[i][0]);
  const at = Math.min(Math.max(snap(t, SNAP.s), Number(low.toPrecision(12))), Number(high.toPrecision(12)));
  return [at, fixed ? fixed[i] : Math.min(Math.max(snap(x, SNAP[unit] ?? 1e-9), min), max)];
}
