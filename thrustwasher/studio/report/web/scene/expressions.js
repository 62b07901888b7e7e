/*
 * Expressions of the rules of warnings, [operation, ...arguments], evaluated over a run as Python does. Arrays hold a
 * value for each point, 1 or 0 where something holds; null is what is not known.
 */

/** A signal that a run has not. */
export class Missing extends Error {}

/** @type {(x: any) => boolean} */
const isArray = (x) => ArrayBuffer.isView(x) || Array.isArray(x);
/** @type {(apply: (...own: any[]) => any) => (...given: any[]) => any} */
const each = (apply) => (a, b, c) => {
  const [inA, inB, inC] = [isArray(a), isArray(b), isArray(c)],
    n = inA ? a.length : inB ? b.length : inC ? c.length : -1;
  if (n < 0) return apply(a, b, c);
  const found = new Float64Array(n);
  if (inA && !inB && !inC) for (let i = 0; i < n; i += 1) found[i] = +apply(a[i], b, c);
  else for (let i = 0; i < n; i += 1) found[i] = +apply(inA ? a[i] : a, inB ? b[i] : b, inC ? c[i] : c);
  return found;
};
const place = (found, from, way) => {
  for (let i = from; i >= 0 && i < found.length; i += way) if (found[i]) return i;
  return null;
};
// Plain loops: methods of arrays of numbers take ten times as long.
const folded = (x, start, join) => {
  let all = start;
  for (let i = 0; i < x.length; i += 1) all = join(all, x[i]);
  return all;
};
const best = (x, better) => {
  let k = 0;
  for (let i = 1; i < x.length; i += 1) if (better(x[i], x[k])) k = i;
  return k;
};
const kept = (x, where) => {
  const found = new Float64Array(x.length);
  let n = 0;
  for (let i = 0; i < x.length; i += 1) if (where[i]) found[n++] = x[i];
  return found.slice(0, n);
};
const inOne = (lists) => {
  const found = new Float64Array(lists.reduce((n, own) => n + own.length, 0));
  let n = 0;
  for (const own of lists) {
    found.set(own, n);
    n += own.length;
  }
  return found;
};
const sum = (x) => folded(x, 0, (all, v) => all + v);
const sorted = (x) => Float64Array.from(x).sort();
const ALMOST = 1e-9; // of an end of a range

/** @type {Record<string, (...given: any[]) => any>} */
const FUNCTIONS = {
  "+": each((a, b) => a + b),
  "-": each((a, b) => a - b),
  "*": each((a, b) => a * b),
  "/": each((a, b) => a / b),
  "<": each((a, b) => a < b),
  "<=": each((a, b) => a <= b),
  ">": each((a, b) => a > b),
  ">=": each((a, b) => a >= b),
  "==": each((a, b) => a === b),
  "!=": each((a, b) => a !== b),
  and: each((a, b) => a && b),
  or: each((a, b) => a || b),
  neg: each((a) => -a),
  not: each((a) => !a),
  abs: each(Math.abs),
  sign: each(Math.sign),
  log: each(Math.log),
  copysign: each((a, b) => (b < 0 || Object.is(b, -0) ? -Math.abs(a) : Math.abs(a))),
  larger: each((a, b) => Math.max(a, b)),
  smaller: each((a, b) => Math.min(a, b)),
  where: each((is, a, b) => (is ? a : b)),
  finite: each(Number.isFinite),
  beyond: (x, [low, high]) => each((v) => v < low * (1 - ALMOST) || v > high * (1 + ALMOST))(x),
  known: (x) => x !== null && !Number.isNaN(x),
  item: (x, i) => (isArray(i) ? kept(x, i) : x.at(i)),
  part: (x, low, high) => x.slice(low, high ?? undefined),
  size: (x) => x.length,
  count: (x) => folded(x, 0, (n, v) => n + (v ? 1 : 0)),
  any: (x) => place(x, 0, 1) !== null,
  all: (x) => x.every(Boolean),
  when: (x, value) => (x.includes(value) ? x.indexOf(value) : null),
  first: (x) => place(x, 0, 1),
  last: (x) => place(x, x.length - 1, -1),
  ever: (x) => {
    const begin = place(x, 0, 1) ?? x.length;
    return new Float64Array(x.length).fill(1, begin);
  },
  max: (x) => folded(x, -Infinity, (most, v) => Math.max(most, v)),
  min: (x) => folded(x, Infinity, (least, v) => Math.min(least, v)),
  highest: (x) => best(x, (a, b) => a > b),
  sum,
  mean: (x) => sum(x) / x.length,
  median: (x) => 0.5 * (sorted(x)[(x.length - 1) >> 1] + sorted(x)[x.length >> 1]),
  diff: (x) => x.slice(1).map((v, i) => v - x[i]),
};

/** Return the last point that is not later than `t`. */
function pointAt(t, time) {
  let i = 0;
  while (i < time.length && !(time[i] > t)) i += 1;
  return Math.max(i - 1, 0);
}

/** Return a signal between points, held at its ends. */
function between(x, t, time) {
  const i = pointAt(t, time);
  if (t <= time[0] || i + 1 >= time.length) return x[i];
  return x[i] + ((t - time[i]) / (time[i + 1] - time[i])) * (x[i + 1] - x[i]);
}

/** Names of values, and of expressions that are evaluated once, when they are asked for. */
export class Scope {
  /** @type {Record<string, any>} */
  values;
  /** @type {Record<string, any>} */
  figures;
  /** @type {Scope | null} */
  outer;
  /** @type {Scope} */
  root;
  /** @type {(name: string) => any} */
  signalOf;
  /** @type {Set<string>} */
  warned;

  /**
   * @param {Record<string, any>} values
   * @param {Record<string, any>} figures
   * @param {Scope | null} outer
   * @param {(name: string) => any} signalOf returns a signal by name, undefined if there is none
   */
  constructor(values, figures, outer = null, signalOf = () => undefined) {
    Object.assign(this, { values: { ...values }, figures, outer, signalOf, warned: new Set() });
    this.root = outer?.root ?? this;
  }

  get(name) {
    if (!(name in this.values)) {
      if (name in this.figures) this.values[name] = this.evaluated(this.figures[name]);
      else if (this.outer) return this.outer.get(name);
      else throw new Error(`${name} is not known`);
    }
    return this.values[name];
  }

  signal(name) {
    const found = this.root.signalOf(name);
    if (!found) throw new Missing(name);
    return found;
  }

  /** Return what all, or some, of several say; further ones only where it is still open. */
  joined(operation, args) {
    /** @type {any} */
    let found = operation === "and";
    for (const tree of args) {
      if (!isArray(found) && Boolean(found) !== (operation === "and")) return found;
      found = FUNCTIONS[operation](found, this.evaluated(tree));
    }
    return found;
  }

  /** Return what an expression is here. */
  evaluated(tree) {
    if (!Array.isArray(tree)) return tree;
    const [operation, ...args] = tree;
    if (operation === "text") return args[0];
    if (operation === "name") return this.get(args[0]);
    if (operation === "and" || operation === "or") return this.joined(operation, args);
    if (operation === "if") return this.evaluated(args[this.evaluated(args[0]) ? 1 : 2]);
    const given = args.map((x) => this.evaluated(x)),
      time = () => this.root.get("time");
    if (operation === "fill") return given.join("");
    if (operation === "signal") return this.signal(given[0]);
    if (operation === "signals") return given.every((name) => this.root.signalOf(name));
    if (operation === "joined") return inOne(given[0].map((name) => this.signal(name)));
    if (operation === "pick") return given[0].map((name) => this.signal(name)[given[1]]);
    if (operation === "at") return given[0][pointAt(given[1], time())];
    if (operation === "between") return between(given[0], given[1], time());
    if (operation === "warned") return this.root.warned.has(given.join(" "));
    if (operation === "quantity") {
      const [value, unit, name = "", relative = false] = given;
      return { value, unit, name, relative };
    }
    return FUNCTIONS[operation](...given);
  }
}
