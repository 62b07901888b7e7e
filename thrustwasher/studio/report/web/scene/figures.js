/* Key figures of a finished run, by the kernels that Python reads them with. */

import { effective } from "./profile.js";

/** Return lists of numbers as arrays in the kernels' memory, until the next ones are lent. */
function lent(kernel, lists) {
  return lists.map((list, i) => {
    const own = kernel.lent[i].part(0, list.length);
    own.view.set(list);
    return own;
  });
}

/** Return when a held drum came to rest in the step that ends at point `i`. */
function standstill(kernel, time, signal, i) {
  const power = Math.abs(signal("brake_speed")[i - 1] * signal("brake_reaction")[i - 1]),
    heat = signal("brake_heat");
  return kernel.call("standstill", time[i - 1], time[i], power, heat[i] - heat[i - 1]);
}

/** Return when packs lock and let go: [{time, kind}] in the order of time. */
export function changesOf(kernel, time, signal) {
  const found = [];
  for (const pack of ["clutch", "brake"]) {
    const locked = signal(`${pack}_locked`);
    for (let i = 1; i < time.length; i += 1) {
      const on = locked[i] > 0.5;
      if (on === locked[i - 1] > 0.5) continue;
      let when = time[i];
      if (pack === "clutch" && on) when = signal("lock_time")[i];
      else if (pack === "brake") when = on ? standstill(kernel, time, signal, i) : signal("release_time")[i];
      found.push({ time: when, kind: `${pack}_${on ? "locked" : "released"}` });
    }
  }
  return found.sort((a, b) => a.time - b.time);
}

/** Return the time up to which the pack that engages is meant to hold. */
export function wantedUntil(about, profiles, { engaging }) {
  const points = about.by_pressure ? effective(about, profiles, `${engaging}_pressure`) : null,
    { stop_time: stop } = about;
  if (!points) return stop;
  const enough = about.pressed * Math.max(...points.map(([, p]) => p));
  return points.at(-1)[1] < enough
    ? Math.min(Math.max(...points.filter(([, p]) => p >= enough).map(([t]) => t)), stop)
    : stop;
}

/** Return the lock after which the pack that engages holds; NaN if it does not. */
function lockUp(kernel, about, profiles, shift, changes) {
  const times = (kind) => changes.filter((c) => c.kind === `${shift.engaging}_${kind}`).map((c) => c.time),
    until = wantedUntil(about, profiles, shift);
  return kernel.call("held_from", ...lent(kernel, [times("locked"), times("released")]), shift.start, until);
}

const greatest = (values) => values.reduce((most, v) => Math.max(most, v), -Infinity);
const known = (value) => (Number.isNaN(value) ? null : value);

/** Return jerk, flare and torque hole; {} without a vehicle. */
function comfortOf(kernel, about, { start }, time, signal, lock, end) {
  if (about.reach === null) return {};
  const felt = signal("output_acceleration").map((a) => about.reach * a),
    found = kernel.lent[4].part(0, 6),
    lists = lent(kernel, [time, felt, signal("engine_speed"), signal("output_speed")]);
  kernel.call("comfort", ...lists, about.ratio, start, lock, end, found);
  const read = (at) => known(found.view[at]);
  return {
    ...Object.fromEntries(Object.entries(about.comfort).map(([name, at]) => [name, read(at)])),
    flare_time: read(about.comfort.flare + 1),
  };
}

/**
 * Return the figures by name, null where there is no such thing.
 * @returns {Record<string, any>}
 */
export function figuresOf(kernel, about, profiles, shift, time, signals, changes) {
  const signal = (name) => signals[`transmission.${name}`],
    pack = shift.engaging,
    slips = ["clutch_load", "clutch_speed", "brake_load", "brake_speed"].map(signal);
  const lock = lockUp(kernel, about, profiles, shift, changes),
    end = kernel.call("slip_end", ...lent(kernel, [time, ...slips]), shift.start),
    heat = signal("clutch_heat").map((x, i) => x + signal("brake_heat")[i]);
  return {
    lock_time: known(lock),
    slip_energy: signal(`${pack}_heat`).at(-1),
    lock_after_ramp_start: known(lock - shift.start),
    peak_power: greatest(signals[`${pack}.friction_power`].map(Math.abs)),
    shift_heat: known(kernel.call("shift_heat", ...lent(kernel, [time, heat]), shift.start, end)),
    [`peak_${pack}_temperature`]: greatest(signals[`${pack}.temperature`]),
    ...comfortOf(kernel, about, shift, time, signal, lock, end < 0 ? NaN : time[end]),
  };
}

/** Return where the pressure of the pack that engages leaves the kiss point; null without pistons. */
function kissEnd(about, profiles, { start, engaging }) {
  const points = about.by_pressure ? (effective(about, profiles, `${engaging}_pressure`) ?? []) : [],
    spring = about.springs[engaging];
  let i = points.findIndex(([t, p]) => t >= start && p > spring);
  if (i < 0) return null;
  while (i + 1 < points.length && points[i + 1][1] <= points[i][1]) i += 1;
  return points[i][0];
}

/** Return when the shift has handed over to a pack that does not hold: from then on it sticks and slips. */
export function freeFrom({ about, profiles, shift, time, signals, changes, locks }) {
  const { stop_time: stop } = about,
    other = shift.engaging === "clutch" ? "brake" : "clutch",
    start = Math.min(Math.max(shift.start, about.start_time), stop),
    lock = Math.min(locks[0] ?? stop, stop);
  const was = changes.filter((c) => c.time <= start && c.kind.startsWith(`${other}_`)).at(-1)?.kind,
    handsOver = was ? was === `${other}_locked` : signals[`transmission.${other}_locked`][0] > 0.5;
  if (!handsOver) return lock;
  let opens = shift.start + shift.duration;
  if (kissEnd(about, profiles, shift) !== null) {
    const full = signals[`transmission.${other}_filled`],
      i = full.findIndex((x, k) => k > 0 && full[k - 1] > 0.5 && !(x > 0.5));
    opens = i < 0 ? lock : time[i];
  }
  return Math.min(Math.max(opens, lock), stop);
}
