"use strict";
/* Key figures of a finished run, read from its signals as Python reads them. */

/** Return the value at `x` of points over rising `xs`, linear between them, as numpy.interp. */
function interp(x, xs, ys) {
  const last = xs.length - 1;
  if (x <= xs[0]) return ys[0];
  if (x >= xs[last]) return ys[last];
  let low = 0, high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle; else high = middle;
  }
  return ys[low] + ((ys[low + 1] - ys[low]) / (xs[low + 1] - xs[low])) * (x - xs[low]);
}

/** Return when a held drum came to rest in the step that ends at point `i`: by the brake's heat of the step. */
function standstill(time, signal, i) {
  const power = Math.abs(signal("brake_speed")[i - 1] * signal("brake_reaction")[i - 1]), heat = signal("brake_heat");
  return power === 0 ? time[i] : Math.min(time[i], time[i - 1] + (2 * (heat[i] - heat[i - 1])) / power);
}

/** Return when packs lock and let go: [{time, kind}] in the order of time. */
function changesOf(time, signal) {
  const found = [];
  for (const pack of ["clutch", "brake"]) {
    const locked = signal(`${pack}_locked`);
    for (let i = 1; i < time.length; i += 1) {
      const on = locked[i] > 0.5;
      if (on === locked[i - 1] > 0.5) continue;
      let when = time[i];
      if (pack === "clutch" && on) when = signal("lock_time")[i];
      else if (pack === "brake") when = on ? standstill(time, signal, i) : signal("release_time")[i];
      found.push({ time: when, kind: `${pack}_${on ? "locked" : "released"}` });
    }
  }
  return found.sort((a, b) => a.time - b.time);
}

/** Return the time up to which the pack that engages is meant to hold. */
function wantedUntil(about, profiles, { engaging }) {
  const points = about.by_pressure ? effective(about, profiles, `${engaging}_pressure`) : null, { stop_time: stop } = about;
  if (!points) return stop;
  const enough = about.numbers.PRESSED * Math.max(...points.map(([, p]) => p));
  return points.at(-1)[1] < enough ? Math.min(Math.max(...points.filter(([, p]) => p >= enough).map(([t]) => t)), stop) : stop;
}

/** Return the lock after which the pack that engages holds; null if it does not. */
function lockUp(about, profiles, shift, changes) {
  const until = wantedUntil(about, profiles, shift), pack = shift.engaging;
  const locks = changes.filter((c) => c.kind === `${pack}_locked` && shift.start <= c.time && c.time <= until).map((c) => c.time), last = locks.at(-1);
  if (!locks.length || changes.some((c) => c.kind === `${pack}_released` && last <= c.time && c.time <= until)) return null;
  return locks.length >= about.numbers.FEW && until - last <= last - locks[0] ? null : last;
}

/** Return the point from which no pressed pack slips any more; null if one still does. */
function slipEnd(time, signal, { start }) {
  let last = -1;
  for (const pack of ["clutch", "brake"]) {
    const load = signal(`${pack}_load`), slip = signal(`${pack}_speed`);
    for (let i = 0; i < time.length; i += 1) if (load[i] > 0 && slip[i] !== 0 && time[i] >= start) last = Math.max(last, i);
  }
  return last >= 0 && last + 1 < time.length ? last + 1 : null;
}

const greatest = (values) => values.reduce((most, v) => Math.max(most, v), -Infinity);

/** Return jerk, flare and torque hole; {} without a vehicle. */
function comfortOf(about, shift, time, signal, lock, end) {
  if (about.reach === null) return {};
  const { JERK_TIME, SETTLED } = about.numbers, felt = signal("output_acceleration").map((a) => about.reach * a), { start } = shift, last = time.at(-1);
  let peak = -1, hole = null, flare = 0;
  for (let i = 0; i < time.length; i += 1) {
    if (time[i] >= start && time[i] <= last - JERK_TIME) peak = Math.max(peak, Math.abs(interp(time[i] + JERK_TIME, time, felt) - felt[i]));
  }
  const engine = signal("engine_speed"), output = signal("output_speed"), way = interp(start, time, engine) < 0 ? -1 : 1;
  time.forEach((t, i) => {
    if (t >= start && t <= (lock ?? last)) flare = Math.max(flare, way * (engine[i] - about.ratio * output[i]));
  });
  const settled = lock === null ? Infinity : Math.max(lock, end === null ? lock : time[end]) + SETTLED;
  if (settled <= last) {
    const during = felt.filter((_, i) => time[i] >= start && time[i] <= settled);
    const smaller = Math.min(interp(start, time, felt), interp(settled, time, felt));
    if (during.length) hole = Math.max(0, smaller - during.reduce((least, v) => Math.min(least, v), Infinity));
  }
  return { peak_jerk: peak / JERK_TIME, flare, torque_hole: hole };
}

/** Return the figures by name, null where there is no such thing. */
function figuresOf(about, profiles, shift, time, signals) {
  const signal = (name) => signals[`transmission.${name}`], pack = shift.engaging;
  const changes = changesOf(time, signal), lock = lockUp(about, profiles, shift, changes), end = slipEnd(time, signal, shift);
  const heat = signal("clutch_heat").map((x, i) => x + signal("brake_heat")[i]);
  return {
    lock_time: lock,
    slip_energy: signal(`${pack}_heat`).at(-1),
    lock_after_ramp_start: lock === null ? null : lock - shift.start,
    peak_power: greatest(signals[`${pack}.friction_power`].map(Math.abs)),
    shift_heat: end === null ? null : heat[end] - interp(shift.start, time, heat),
    [`peak_${pack}_temperature`]: greatest(signals[`${pack}.temperature`]),
    ...comfortOf(about, shift, time, signal, lock, end),
  };
}
