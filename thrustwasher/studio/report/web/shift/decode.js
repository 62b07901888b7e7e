/* The runs of the page as arrays over one time. Packed are second differences of the bits of single
   precision, all bytes of one rank together, deflated. */

import * as Units from "../units.js";

export async function inflate(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function unpack(bytes, points) {
  const rows = [];
  for (let from = 0; from < bytes.length; from += 4 * points) {
    const bits = new Int32Array(points);
    let step = 0,
      value = 0;
    for (let i = from; i < from + points; i++) {
      const second =
        bytes[i] | (bytes[i + points] << 8) | (bytes[i + 2 * points] << 16) | (bytes[i + 3 * points] << 24);
      step = (step + second) | 0;
      value = (value + step) | 0;
      bits[i - from] = value;
    }
    rows.push(new Float32Array(bits.buffer));
  }
  return rows;
}

/* One time for all runs: every point of each. */
function together(times) {
  if (times.length === 1) return times[0];
  const every = Float64Array.from(times.flatMap((time) => [...time])).sort();
  return every.filter((t, i) => i === 0 || t > every[i - 1]);
}

/* Values between points are linear; there are none (NaN) before the first and after the last one. */
function onto(time, own, values) {
  if (time.length === own.length) return values;
  const last = own.length - 1;
  let i = 0;
  return Float32Array.from(time, (t) => {
    if (t < own[0] || t > own[last]) return NaN;
    while (i < last - 1 && own[i + 1] <= t) i++;
    const wide = own[i + 1] - own[i];
    const share = wide > 0 ? (t - own[i]) / wide : 0;
    return values[i] + share * (values[i + 1] - values[i]);
  });
}

/* The unit of a signal where another one is chosen than that of its run. */
function shownIn(unit) {
  const own = Units.of({ "°C": "K", kPa: "Pa" }[unit] ?? unit, unit === "K");
  return own ? { unit: own[0], scale: own[1], zero: own[2] } : {};
}

/* A signal whose values are made when they are first requested. */
function signalOf(given, make) {
  let values;
  return Object.defineProperty({ ...given, ...shownIn(given.unit) }, "values", {
    get: () => (values ??= make()),
  });
}

/* Return {time, runs}; a run's `signals` are by name: help, unit, zero and values; `end` is its last point. */
export async function all(given) {
  const rows = await Promise.all(given.map(async (run) => unpack(await inflate(run.packed), run.points)));
  const time = together(rows.map((row) => Float64Array.from(row[0])));
  const runs = given.map((run, k) => {
    const signals = new Map();
    for (const signal of run.moving) {
      signals.set(
        signal.name,
        signalOf(signal, () => onto(time, rows[k][0], rows[k][signal.row])),
      );
    }
    for (const signal of run.steady) {
      signals.set(
        signal.name,
        signalOf({ ...signal, steady: true }, () => new Float32Array(time.length).fill(signal.value)),
      );
    }
    return { ...run, signals, end: time.lastIndexOf(rows[k][0].at(-1)) };
  });
  return { time, runs };
}
