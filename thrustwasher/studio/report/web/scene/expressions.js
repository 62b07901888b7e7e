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
  for (let i = 0; i < n; i += 1) found[i] = Number(apply(inA ? a[i] : a, inB ? b[i] : b, inC ? c[i] : c));
  return found;
};
const place = (found, from, way) => {
  for (let i = from; i >= 0 && i < found.length; i += way) if (found[i]) return i;
  return null;
};
const best = (x, better) => x.reduce((k, v, i) => (better(v, x[k]) ? i : k), 0);
const kept = (x, where) => Float64Array.from(x).filter((_, i) => where[i]);
const sum = (x) => x.reduce((all, v) => all + v, 0);
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
  count: (x) => x.filter(Boolean).length,
  any: (x) => x.some(Boolean),
  all: (x) => x.every(Boolean),
  when: (x, value) => (x.includes(value) ? x.indexOf(value) : null),
  first: (x) => place(x, 0, 1),
  last: (x) => place(x, x.length - 1, -1),
  ever: (x) => {
    const begin = place(x, 0, 1) ?? Infinity;
    return x.map((_, i) => Number(i >= begin));
  },
  max: (x) => x.reduce((most, v) => Math.max(most, v), -Infinity),
  min: (x) => x.reduce((least, v) => Math.min(least, v), Infinity),
  highest: (x) => best(x, (a, b) => a > b),
  sum,
  mean: (x) => sum(x) / x.length,
  median: (x) => 0.5 * (sorted(x)[(x.length - 1) >> 1] + sorted(x)[x.length >> 1]),
  diff: (x) => x.slice(1).map((v, i) => v - x[i]),
};

/** Return the last point that is not later than `t`. */
const pointAt = (t, time) => Math.max((place(each((x) => x > t)(time), 0, 1) ?? time.length) - 1, 0);

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
    if (operation === "joined") return Float64Array.from(given[0].flatMap((name) => [...this.signal(name)]));
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
