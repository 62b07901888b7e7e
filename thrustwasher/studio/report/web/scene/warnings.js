/* Warnings of a finished run, by the rules that Python's `shift` has. */

import { Missing, Scope } from "./expressions.js";
import { freeFrom } from "./figures.js";
import { FIELD } from "./quantity.js";

const other = (pack) => (pack === "clutch" ? "brake" : "clutch");

/** Return a text with the values that it names: [text, values]. */
function told(piece, own) {
  const text = piece.startsWith("@") ? own.get(piece.slice(1)) : piece;
  return [text, Object.fromEntries([...text.matchAll(FIELD)].map(([, name]) => [name, own.get(name)]))];
}

/** Return a rule's warnings: {key, rank, pieces}. */
function byRule(rule, run) {
  const found = [];
  for (const row of rule.each ? run.get(rule.each) : [{}]) {
    const own = new Scope(row, rule.figures, run);
    try {
      if (!own.evaluated(rule.when)) continue;
      run.warned.add(rule.key).add(`${rule.key} ${row.pack}`);
      const pieces = rule.text
        .filter(([holds]) => holds === null || own.evaluated(holds))
        .map(([, piece]) => told(piece, own));
      found.push({ key: rule.key, rank: row.rank ?? rule.rank, pieces, at: rule.sort && own.get(rule.sort) });
    } catch (problem) {
      if (!(problem instanceof Missing)) throw problem;
    }
  }
  return rule.sort ? found.sort((a, b) => a.at - b.at) : found;
}

const given = (text, rank) => ({ key: "given", rank, pieces: [["{text}", { text }]] });
const byRules = (about, of, run) =>
  about.warnings.rules.filter((rule) => rule.of.includes(of)).flatMap((rule) => byRule(rule, run));

/** Return the warnings of profiles themselves. */
export function ofScene(about, profiles) {
  const rows = Object.keys(about.profiles).map((profile) => ({ profile, last: profiles[profile].at(-1)[0] })),
    known = { ...about.warnings.values, profiles: rows };
  return byRules(about, "scene", new Scope(known, about.warnings.figures));
}

/**
 * Return what expressions of rules know of a run.
 * @param {any} run
 * @param {Record<string, any>} more
 */
function scopeOf({ about, shift, until, time, signals, solved = () => true }, more) {
  const known = {
    engaging: shift.engaging,
    releasing: other(shift.engaging),
    shift_start: shift.start,
    shift_end: shift.start + shift.duration,
    until,
    time,
  };
  const signalOf = (name) => (solved(name.split(".")[0]) ? signals[name] : undefined);
  return new Scope({ ...about.warnings.values, ...known, ...more }, about.warnings.figures, null, signalOf);
}

/**
 * Return the warnings of a run in the order of Python's, those that every run of the scene has among them.
 * @param {any} run about, profiles, shift, time, signals, changes, locks, held, until, flare; solved(part): whether a
 * part was solved, not recorded; maps: boxes of the maps that it was solved by
 * @returns {any[]}
 */
export function warningsOf(run) {
  const { about, shift, changes, locks, held, flare, maps } = run,
    { always, kinds } = about.warnings,
    free = held === null ? freeFrom(run) : about.stop_time,
    turns = free < about.stop_time;
  const scope = scopeOf(run, {
    locks,
    releases: changes.filter((c) => c.kind === `${shift.engaging}_released`).map((c) => c.time),
    lock_time: held,
    whole: true,
    flare: flare[0],
    flare_time: flare[1],
    sticks: turns,
    turns_from: turns ? free : null,
    maps,
  });
  const found = [
    ...always.map((text) => given(text, kinds - 1)),
    ...ofScene(about, run.profiles),
    ...byRules(about, "run", scope),
    ...byRules(about, "record", scope),
  ];
  return found.sort((a, b) => a.rank - b.rank);
}

/** Return why a run may have failed at the last of `n` points: no pack held. */
export function failedBecause(run, n) {
  const reached = Object.fromEntries(
      Object.entries(run.signals).map(([name, values]) => [name, values.subarray(0, n)]),
    ),
    locked = (pack) => reached[`transmission.${pack}_locked`][n - 1] > 0.5;
  if (locked("clutch") || locked("brake")) return [];
  const time = run.time.subarray(0, n),
    scope = scopeOf({ ...run, time, signals: reached }, { lock_time: null, whole: false });
  return byRules(run.about, "failed", scope);
}
