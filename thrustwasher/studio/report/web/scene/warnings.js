/*
 * Warnings of a finished run, by the rules of Python's `shift`: each is a list of texts by key, [[key, values], ...]. A
 * third entry is its rank among all, where that is not the key's.
 */

import { effective } from "./profile.js";

const PACKS = ["clutch", "brake"];
const WASHER_INPUTS = ["load", "speed", "tilt", "oil_temperature"];

/** Return the signals that the rules read, "part.variable". */
export function watched(about) {
  const { warnings: w, parts } = about,
    found = new Set(
      ["washer_load", "washer_heat", "washer_speed", "drive_torque", "shaft_torque"].map(
        (name) => `transmission.${name}`,
      ),
    );
  for (const pack of PACKS) {
    found.add(`transmission.${pack}_filled`);
    for (const name of ["friction_torque", "viscous_torque", "load", "torque_capacity"])
      found.add(`${pack}.${name}`);
  }
  for (const [part, ranges] of Object.entries(w.parts)) {
    found.add(`${part}.solver_status`);
    for (const [name] of ranges) found.add(`${part}.${name}`);
  }
  for (const [part, key] of w.boxes) found.add(`${part}.${key}`);
  for (const [part, name] of w.limits) found.add(`${part}.${name}`);
  for (const name of [...WASHER_INPUTS, "fluid_load_share", "friction_torque", "stick_margin", "distress"])
    found.add(`washer.${name}`);
  for (const [steel, meshes] of Object.entries(w.teeth.stress))
    for (const mesh of meshes) found.add(`${mesh}.stress_utilization_aisi${steel}`);
  for (const [kind, meshes] of Object.entries(w.teeth.safety))
    for (const mesh of meshes) for (const name of [`${kind}_safety`, "speed"]) found.add(`${mesh}.${name}`);
  const there = (name) => {
    const [part, key] = name.split(".");
    return parts[part] && [...parts[part].inputs, ...parts[part].outputs].some(([own]) => own === key);
  };
  return [...found].filter(there);
}

const lowest = (values) => values.reduce((low, v) => Math.min(low, v), Infinity);
const highest = (values) => values.reduce((high, v) => Math.max(high, v), -Infinity);
const first = (n, is) => {
  for (let i = 0; i < n; i += 1) if (is(i)) return i;
  return -1;
};

/** Return a signal between points, held at its ends. */
function between(t, time, values) {
  const last = time.length - 1;
  if (t <= time[0]) return values[0];
  if (t >= time[last]) return values[last];
  let i = 0;
  while (time[i + 1] <= t) i += 1;
  return values[i] + ((t - time[i]) / (time[i + 1] - time[i])) * (values[i + 1] - values[i]);
}

/** Return a signal at the last point that is not later. */
function at(t, time, values) {
  let i = 0;
  while (i + 1 < time.length && time[i + 1] <= t) i += 1;
  return values[i];
}

/** Return the profiles that end after the run does. */
export const cutOff = (about, profiles) =>
  Object.entries(about.profiles)
    .map(([name]) => [name, profiles[name].at(-1)[0]])
    .filter(([, last]) => last > about.stop_time)
    .map(([name, last]) => [["cut_off", { profile: name, last, stop: about.stop_time }]]);

function* ofTimes({ about, shift }) {
  const { start_time: start, stop_time: stop } = about,
    { start: begin } = shift,
    end = begin + shift.duration;
  if (begin < start) yield [["begins_before", { begin, start }]];
  if (begin >= stop) yield [["begins_after", { begin, stop }]];
  else if (end > stop) yield [["ends_after", { stop, end }]];
  if (about.warnings.step) {
    const [step, given] = about.warnings.step;
    yield [["other_step", { step, given }]];
  }
}

function liningOf(lining, load) {
  if (!lining) return [];
  const [perLoad, most, kind] = lining,
    pressure = load * perLoad;
  return pressure > most ? [["lining", { load, pressure: pressure / 1e6, most: most / 1e6, kind }]] : [];
}

function* ofSolvers({ about, time, signals, solved }) {
  const { parts, statuses, outside, distress, linings } = about.warnings;
  for (const part of Object.keys(about.parts)) {
    const ranges = parts[part],
      values = signals[`${part}.solver_status`];
    if (!ranges || !values || !solved(part)) continue;
    const codes = [...new Set(values)].filter((code) => code > 0 && code !== distress);
    for (const code of codes.sort((a, b) => a - b)) {
      const i = values.indexOf(code),
        found = [];
      if (code === outside) {
        for (const [name, unit, relative, low, high, range] of ranges) {
          const value = signals[`${part}.${name}`][i];
          if (!(low <= value && value <= high))
            found.push(["verified", { value: { name, value, unit, relative }, range }]);
        }
        if (linings[part]) found.push(...liningOf(linings[part], signals[`${part}.load`][i]));
      }
      const [advice, name, rank] = statuses[code];
      for (const text of found.length ? found : [["advice", { advice, name }]])
        yield [["status", { part, time: time[i], text }, rank]];
    }
  }
}

function* ofBoxes({ about, signals, solved }) {
  for (const [part, key, unit, least, most, room] of about.warnings.boxes) {
    const values = signals[`${part}.${key}`];
    if (!values || !solved(part)) continue;
    const [low, high] = [lowest(values), highest(values)],
      says = (value) => ({ value, unit });
    if (low < least - room || high > most + room) {
      const ends = { low: says(low), high: says(high), minimum: says(least), most: says(most) };
      yield [["box", { part, key, ...ends }]];
    }
  }
}

function* ofLinings({ about, signals }) {
  for (const part of PACKS)
    for (const text of liningOf(about.warnings.linings[part], highest(signals[`${part}.load`])))
      yield [["of_part", { part, text }]];
}

function* ofMaps({ about, signals, solved }) {
  const { map } = about.warnings,
    rows = WASHER_INPUTS.map((name) => signals[`washer.${name}`]);
  if (!map || !solved("washer") || rows.some((row) => !row)) return;
  const points = rows[0].length;
  let count = 0;
  for (let i = 0; i < points; i += 1) {
    const sizes = rows.map((row) => Math.abs(row[i]));
    if (
      sizes[2] <= map.tilt ||
      map.box.some(([low, high], k) => sizes[k] < low * (1 - 1e-9) || sizes[k] > high * (1 + 1e-9))
    )
      count += 1;
  }
  if (count / points > map.most) {
    const text = ["map_box", { outside: count, points, what: "steps", then: map.then }];
    yield [["of_part", { part: "washer", text }]];
  }
}

function* ofDryFriction({ about, time, signals, solved }) {
  const { dry, film_speed: moving } = about.warnings;
  if (!dry || !solved("washer")) return;
  const [load, speed, share, torque] = ["load", "speed", "fluid_load_share", "friction_torque"].map(
    (name) => signals[`washer.${name}`],
  );
  let text = null,
    at_ = 0,
    count = 0;
  for (let i = 0; i < time.length; i += 1) {
    const contact = Math.abs(speed[i]) >= moving ? load[i] * (1 - share[i]) : 0,
      pressure = contact / dry.face;
    if (!(contact > 0) || (dry.low * (1 - 1e-9) <= pressure && pressure <= dry.high * (1 + 1e-9))) continue;
    const held = Math.min(Math.max(pressure, dry.low), dry.high),
      friction = dry.reference - dry.slope * Math.log(held / 1e6);
    if (friction * contact * dry.radius < dry.counts * Math.abs(torque[i])) continue;
    count += 1;
    if (text) continue;
    text = ["dry_range", { low: dry.low, high: dry.high, pressure, friction }];
    at_ = time[i];
  }
  if (text) yield [["dry_friction", { count, points: time.length, time: at_, text }]];
}

/** Return that a pack slips under its full load since it cannot carry enough; null: it can. */
function weakPack({ about, shift, time, signals, until, handed }, pack) {
  const { settled, standstill, holding, gears, reserve } = about.warnings,
    own = (name) => signals[`transmission.${name}`],
    n = time.length,
    engages = pack === shift.engaging;
  if (engages && time[n - 1] < shift.start + shift.duration) return null;
  const [load, slip] = [own(`${pack}_load`).subarray(0, n), own(`${pack}_speed`)],
    other = own(`${pack === "clutch" ? "brake" : "clutch"}_load`),
    [from, to] = engages ? [shift.start, until] : [-Infinity, Math.max(shift.start, time[0])],
    greatest = highest(load),
    [engine, output, mobility, grip] = holding[pack],
    capacity = grip * greatest,
    slips = [];
  for (let i = 0; i < n; i += 1) {
    const full = from <= time[i] && time[i] <= to && load[i] > 0 && load[i] >= settled * greatest;
    if (full && other[i] <= 0 && Math.abs(slip[i]) > standstill) slips.push(i);
  }
  if (!slips.length || grip === null) return null;
  const torque = slips.map((i) => engine * own("drive_torque")[i] + output * own("shaft_torque")[i]),
    keeps = torque.reduce((sum, x) => sum + x, 0) / torque.length,
    [need, gear] = [Math.max(...torque.map(Math.abs)), gears[pack]],
    left = time[slips[slips.length - 1]] - time[slips[0]],
    words = { pack, gear, load: greatest, capacity, need };
  if (engages && handed && left > 0) {
    const begins = at(shift.start, time, slip),
      most = Math.sign(begins) * keeps + Math.abs(begins) / (mobility * left);
    if (most > Math.max(need, capacity)) {
      const what = need > capacity ? gear : "the inertia phase";
      return [
        ["weak", { what, ...words }],
        ["weak_phase", { most, slip: Math.abs(begins), left }],
        ["weak_cure", { times: (reserve * Math.max(most, need)) / capacity }],
      ];
    }
  }
  if (need <= capacity) return null;
  return [
    ["weak", { what: gear, ...words }],
    ["weak_cure", { times: (reserve * need) / capacity }],
  ];
}

/** Return the packs that are too weak: {pack: texts}; `held`: the engaging pack holds. */
function weakPacks(run) {
  const { about, shift, held } = run,
    packs = about.warnings.alone ? [] : PACKS.filter((pack) => !(held !== null && pack === shift.engaging));
  return Object.fromEntries(packs.map((pack) => [pack, weakPack(run, pack)]).filter(([, texts]) => texts));
}

function* ofWeakPacks({ weak }) {
  yield* Object.values(weak);
}

function* atTheStart({ about, shift, time, signals, weak }) {
  const { settled, kiss, standstill } = about.warnings,
    until = Math.max(shift.start, time[0]);
  for (const pack of PACKS) {
    if (pack in weak && pack !== shift.engaging) continue;
    const load = signals[`transmission.${pack}_load`],
      slip = signals[`transmission.${pack}_speed`],
      least = (pack === shift.engaging ? settled : kiss) * highest(load);
    const i = first(
      time.length,
      (k) => time[k] <= until && load[k] > least && Math.abs(slip[k]) > standstill,
    );
    if (i >= 0) yield [["before_shift", { time: time[i], pack, load: load[i], slip: Math.abs(slip[i]) }]];
  }
}

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b),
    k = sorted.length >> 1;
  return sorted.length % 2 ? sorted[k] : 0.5 * (sorted[k - 1] + sorted[k]);
};

function* inTurn({ about, shift, time, locks, held }) {
  const { few, turns_share: share, numerical } = about.warnings;
  if (held === null || locks.length < few) return;
  const [begin] = locks;
  if (held - begin <= share * (held - shift.start)) return;
  const inside = [...time].filter((t) => begin <= t && t <= held),
    steps = inside.slice(1).map((t, i) => t - inside[i]),
    step = steps.length ? median(steps) : about.time.step;
  const every = (held - begin) / ((locks.length - 1) * step),
    why = every <= numerical ? ["why_numerical", { every }] : ["why_overloaded", {}];
  yield [["in_turn", { pack: shift.engaging, first: begin, last: held, count: locks.length, why }]];
}

function* ofTemperature({ about, signals }) {
  for (const pack of PACKS) {
    const range = about.warnings.warmth[pack];
    if (!range) continue;
    const [low, high, room, hot] = range,
      warm = signals[`${pack}.temperature`],
      [coldest, hottest] = [lowest(warm), highest(warm)];
    if ((low - room <= coldest && hottest <= high + room) || hottest > hot) continue;
    const value = hottest > high ? hottest : coldest,
      ends = { low: low - 273.15, high: high - 273.15 };
    const text = ["warmth_range", { at: { value, unit: "K" }, ...ends }];
    yield [["warmth", { pack, text }]];
  }
}

/** Return where neither pack is pressed, once one was. */
function openAt(signals, n) {
  let once = false;
  return Array.from({ length: n }, (_, i) => {
    const pressed = PACKS.some((pack) => signals[`transmission.${pack}_load`][i] > 0);
    once ||= pressed;
    return once && !pressed;
  });
}

/** Return where neither pack is pressed during the shift. */
const freeAt = ({ shift, time, signals, until }) =>
  openAt(signals, time.length).map((is, i) => is && time[i] >= shift.start && time[i] <= until);

function* neutral(run) {
  const { about, shift, time, weak } = run,
    [most, when] = run.flare,
    free = freeAt(run),
    begin = free.indexOf(true),
    pack = shift.engaging,
    other = pack === "clutch" ? "brake" : "clutch";
  const flares = (most ?? 0) > about.warnings.flare;
  if (begin >= 0) {
    const length = free.slice(begin).indexOf(false),
      end = length < 0 ? time.length - 1 : begin + length;
    const cause = ["neutral", { begin: time[begin], end: time[end], pack, other }];
    yield flares ? [cause, ["neutral_flare", { flare: most }]] : [cause];
  } else if (flares && !Object.keys(weak).length)
    yield [["flare", { flare: most, time: when ?? shift.start, pack, other }]];
}

function* atTheEnd({ shift, time, signals, changes, held, until }) {
  if (held === null) return;
  const gone = changes.filter((c) => c.kind === `${shift.engaging}_released` && c.time >= held);
  if (gone.length && !PACKS.some((pack) => signals[`transmission.${pack}_locked`][time.length - 1] > 0.5))
    yield [["lets_go", { pack: shift.engaging, held, gone: gone.at(-1).time, until }]];
}

function* ofUnloadedWashers({ about, signals }) {
  const load = signals["transmission.washer_load"],
    least = about.warnings.least_washer_load;
  if (!about.parts.washer || !load || highest(load) > least) return;
  const heat = signals["transmission.washer_heat"].at(-1);
  if (heat > 0) yield [["unloaded_washers", { minimum: least, heat }]];
}

/** Return where the pressure of the pack that engages leaves the kiss point; null without pistons. */
function kissEnd(about, profiles, { start, engaging }) {
  const points = about.by_pressure ? (effective(about, profiles, `${engaging}_pressure`) ?? []) : [],
    spring = about.warnings.springs[engaging];
  let i = points.findIndex(([t, p]) => t >= start && p > spring);
  if (i < 0) return null;
  while (i + 1 < points.length && points[i + 1][1] <= points[i][1]) i += 1;
  return points[i][0];
}

function* ofLockUp({ about, profiles, shift, time, signals, changes, locks, held }) {
  if (held !== null) return;
  const { stop_time: stop } = about,
    pack = shift.engaging,
    other = pack === "clutch" ? "brake" : "clutch";
  const start = Math.min(Math.max(shift.start, about.start_time), stop),
    lock = Math.min(locks[0] ?? stop, stop);
  const was = changes.filter((c) => c.time <= start && c.kind.startsWith(`${other}_`)).at(-1)?.kind;
  const handsOver = was ? was === `${other}_locked` : signals[`transmission.${other}_locked`][0] > 0.5;
  let free = lock;
  if (handsOver) {
    let opens = shift.start + shift.duration;
    if (kissEnd(about, profiles, shift) !== null) {
      const full = signals[`transmission.${other}_filled`],
        i = first(time.length, (k) => k > 0 && full[k - 1] > 0.5 && !(full[k] > 0.5));
      opens = i < 0 ? lock : time[i];
    }
    free = Math.min(Math.max(opens, lock), stop);
  }
  yield free < stop ? [["never_held", { pack, start: free }]] : [["not_locked", { pack }]];
}

function* ofTieUp({ about, shift, time, signals }) {
  const pack = shift.engaging,
    other = pack === "clutch" ? "brake" : "clutch",
    n = time.length;
  const torque = signals[`transmission.${other}_reaction`],
    load = signals[`transmission.${other}_load`],
    heat = signals[`transmission.${other}_heat`],
    locked = signals[`transmission.${other}_locked`],
    own = signals[`${other}.friction_torque`];
  const held = between(shift.start, time, torque),
    way = -Math.sign(held),
    against = (i) => load[i] > 0 && way * torque[i] > 0;
  let begins = -1,
    most = -Infinity;
  for (let i = 0; i < n; i += 1) {
    if (!(time[i] > shift.start && against(i))) continue;
    if (begins < 0) begins = i;
    most = Math.max(most, way * torque[i]);
  }
  if (begins < 1 || most <= about.warnings.tie_up_share * Math.abs(held)) return;
  const free = first(n, (i) => i > begins && !against(i)),
    last = free < 0 ? n - 1 : free,
    [t0, t1] = [time[begins - 1], time[begins]],
    [x0, x1] = [way * torque[begins - 1], way * torque[begins]];
  const begin = x0 >= 0 ? t0 : t0 + ((0 - x0) / (x1 - x0)) * (t1 - t0);
  let top = begins;
  const carried = (i) => {
    const size = Math.abs(locked[i] > 0.5 ? torque[i] : own[i]);
    return torque[i] < 0 || Object.is(torque[i], -0) ? -size : size;
  };
  for (let i = begins; i <= last; i += 1) if (way * carried(i) > way * carried(top)) top = i;
  /** @type {any[]} */
  const said = [
    [
      "tie_up",
      {
        begin,
        lasted: time[last] - begin,
        other,
        before: at(shift.start, time, torque),
        most: carried(top),
        heat: heat[last] - heat[begins - 1],
      },
    ],
  ];
  const [oil, whole] = ["viscous_torque", "friction_torque"].map((name) =>
    Math.abs(at(begin, time, signals[`${pack}.${name}`] ?? [0])),
  );
  if (oil && whole && oil / whole >= about.warnings.sheared)
    said.push(["sheared", { pack, share: oil / whole, begin, oil: about.warnings.oil }]);
  yield said;
}

function* ofWashers({ about, time, signals, solved }) {
  if (!about.parts.washer || !solved("washer")) return;
  const { standstill, turning, least_load: least } = about.warnings,
    own = (name) => signals[`washer.${name}`];
  const turns = signals["transmission.washer_speed"];
  let lost = 0;
  for (let i = 1; i < time.length; i += 1)
    if (own("distress")[i] > 0.5 && Math.abs(turns[i]) > standstill) lost += time[i] - time[i - 1];
  if (lost > 0) yield [["distress", { time: lost }]];
  const [margin, speed, load] = ["stick_margin", "speed", "load"].map(own);
  if (!margin) return;
  let k = -1;
  for (let i = 0; i < time.length; i += 1)
    if (Math.abs(speed[i]) > turning && load[i] > least && (k < 0 || margin[i] < margin[k])) k = i;
  if (k >= 0 && margin[k] < 1) yield [["gap_2", { time: time[k], load: load[k], margin: margin[k] }]];
}

function* ofTeeth({ about, signals }) {
  const { stress, safety } = about.warnings.teeth,
    over = [];
  for (const [steel, meshes] of Object.entries(stress)) {
    const most = Math.max(
      ...meshes.map((mesh) => highest(signals[`${mesh}.stress_utilization_aisi${steel}`])),
    );
    if (Number.isFinite(most) && most > 1) over.push(["endures", { times: most, steel }]);
  }
  if (over.length) {
    const [one, two] = over;
    yield [["tooth_stress", { stress: two ? ["both", { one, two }] : one }]];
  }
  for (const [kind, meshes] of Object.entries(safety)) {
    let least = Infinity;
    for (const mesh of meshes) {
      const values = signals[`${mesh}.${kind}_safety`],
        speed = signals[`${mesh}.speed`];
      for (let i = 0; i < values.length; i += 1)
        if (Math.abs(speed[i]) >= about.warnings.film_speed && Number.isFinite(values[i]))
          least = Math.min(least, values[i]);
    }
    if (least < 1) yield [["teeth", { kind, safety: least }]];
  }
}

function* ofHotParts({ about, time, signals, solved }) {
  const found = [];
  for (const [part, name, limit] of about.warnings.limits) {
    const values = signals[`${part}.${name}`],
      i = values && solved(part) ? first(time.length, (k) => values[k] > limit) : -1;
    if (i >= 0) found.push({ time: time[i], text: ["hot_part", { part, limit }] });
  }
  for (const one of found.sort((a, b) => a.time - b.time)) yield [["hotter", one]];
}

/** @type {((run: any) => Generator<any>)[]} */
const RULES = [
  ofTimes,
  ofSolvers,
  ofBoxes,
  ofLinings,
  ofMaps,
  ofDryFriction,
  ofWeakPacks,
  atTheStart,
  inTurn,
  ofTemperature,
  neutral,
  atTheEnd,
  ofUnloadedWashers,
  ofLockUp,
  ofTieUp,
  ofWashers,
  ofTeeth,
  ofHotParts,
];
/** @type {Set<any>} */
const BESIDES = new Set([neutral, atTheEnd]); // of a shift, not of a pack that acts alone

/**
 * Return the warnings of a run in the order of Python's, those that every run of the scene has among them.
 * @param {any} run about, profiles, shift, time, signals, changes, locks, held, until, flare; solved(part): whether a
 * part was solved by its own fidelity level
 * @returns {any[]}
 */
export function warningsOf(run) {
  const rules = RULES.filter((rule) => !(BESIDES.has(rule) && run.about.warnings.alone));
  const { always, ranks } = run.about.warnings,
    handed = !freeAt(run).includes(true),
    known = { ...run, weak: weakPacks({ ...run, handed }) };
  const found = [
    ...always.map((text) => [["given", { text }]]),
    ...cutOff(run.about, run.profiles),
    ...rules.flatMap((rule) => [...rule(known)]),
  ];
  const rank = ([[key, , own]]) => own ?? ranks[key];
  return found.sort((a, b) => rank(a) - rank(b));
}

/** Return why a run may have failed at the last of `n` points: no pack held. */
export function failedBecause(run, n) {
  const { time, signals } = run,
    locked = (i) => PACKS.some((pack) => signals[`transmission.${pack}_locked`][i] > 0.5),
    last = n - 1;
  if (locked(last)) return [];
  let held = last;
  while (held >= 0 && !locked(held)) held -= 1;
  const state = [openAt(signals, n)[last] ? "failed_open" : "failed_slipping", {}],
    speed = signals["transmission.engine_speed"][last];
  const reached = { ...run, time: time.subarray(0, n), held: null, handed: false };
  return [
    ...Object.values(weakPacks(reached)),
    [["failed", { since: time[Math.max(held, 0)], state, time: time[last], speed }]],
  ];
}
