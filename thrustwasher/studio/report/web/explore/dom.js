/* Numbers and units. */

import { byId } from "../draw.js";
import * as Units from "../units.js";

export const ABOUT = JSON.parse(byId("about").textContent);

export const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Return a number with some digits, without needless zeros. */
export function digits(value, n = 4) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-3)) return value.toExponential(n - 1).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(n)));
}

/** Return a unit in typography. */
export function pretty(unit) {
  return unit
    .replace(/^deg(?=[CF])/, "°")
    .replace(/^u/, "µ")
    .replaceAll(".", "·")
    .replace(/([ms])([23])/g, (_, name, power) => name + "²³"[power - 2]);
}

/** Return a quantity as a person reads it: in the first unit whose number is at least 1. */
export function shown(value, unit, relative = false, n = 4) {
  if (unit === "1" || unit === "") return digits(value, n);
  const chosen = Units.of(unit, relative);
  if (chosen) return `${digits((value - chosen[2]) / chosen[1], n)} ${pretty(chosen[0])}`;
  if (unit === "K" && !relative) return `${digits(value - 273.15, n)} °C`;
  const known = value ? (ABOUT.units[unit] ?? [[unit, 1]]) : [[unit, 1]];
  const [name, factor] = known.find(([, f]) => Math.abs(value) >= f) ?? known.at(-1);
  return `${digits(value / factor, n)} ${pretty(name)}`;
}

/** @typedef {[name: string, factor: number, offset: number]} Unit of a quantity, from it to the unit of the SI */

/**
 * Read a quantity as the command line does.
 * @param {any} given
 * @param {{unit: string, relative: boolean}} about
 * @returns {{value?: number, wrong: string, as: Unit}} its value, else what is wrong, and the unit that it is in
 */
export function readQuantity(given, { unit, relative }) {
  /** @type {Record<string, [number, number]>} */
  const scales = { [unit]: [1, 0], ...ABOUT.scales[unit] };
  const [, number, rest] = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*$/is.exec(given) ?? [];
  const name =
    rest
      ?.replace("°", "deg")
      .replace(/[·*]/g, ".")
      .replace("^", "")
      .replace("²", "2")
      .replace("³", "3")
      .replace(/[µμ]/, "u")
      .replace(/\s+/g, ".") || unit;
  if (!String(given).trim()) return { wrong: ": a number is missing", as: [unit, 1, 0] };
  if (/\d,\d/.test(given))
    return { wrong: ` = ${given}: a decimal point is required, no comma`, as: [unit, 1, 0] };
  if (!number || !Object.hasOwn(scales, name))
    return {
      wrong: ` = ${given}: a number is required, in ${Object.keys(scales)
        .filter((n) => n !== "1")
        .map(pretty)
        .join(" or ")}`,
      as: [unit, 1, 0],
    };
  const [factor, zero] = scales[name],
    offset = relative ? 0 : zero,
    plain = factor === 1 && !offset;
  return {
    value: plain ? Number(number) : Number((factor * Number(number) + offset).toPrecision(15)),
    as: [name, factor, offset],
    wrong: ` = ${number}${name === "1" ? "" : ` ${pretty(name)}`}`,
  };
}

/**
 * Return the unit that fits the largest of some values, for an axis.
 * @param {number[]} values
 * @param {string} unit
 * @returns {Unit}
 */
export function axisUnit(values, unit) {
  const chosen = Units.of(unit);
  if (chosen) return [pretty(chosen[0]), chosen[1], chosen[2]];
  if (unit === "K") return ["°C", 1, 273.15];
  const known = ABOUT.units[unit] ?? [[unit === "1" ? "" : unit, 1]];
  const most = Math.max(...values.map(Math.abs).filter(Number.isFinite), 0);
  const [name, factor] = known.find(([, f]) => most >= f) ?? known.at(-1);
  return [pretty(name), factor, 0];
}

/**
 * Say what a field allows.
 * @param {any} about
 * @param {Unit} unit
 */
export function allowed({ min, max, kind }, [name, factor, offset]) {
  const [low, high] = [min, max].map((v) => digits((v - offset) / factor, 6));
  return `${low} .. ${high}${name === "1" ? "" : ` ${pretty(name)}`}${kind === "integer" ? ", a whole number" : ""}`;
}

export const SHARES = [0.05, 0.5, 0.95]; // of a band: its ends and its middle

/** Return quantiles of some values, linear between them as numpy.quantile; none of no values. */
export function quantiles(values) {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b),
    last = sorted.length - 1;
  return SHARES.map((share) => {
    const at = share * last,
      k = Math.floor(at);
    return last < 0 ? NaN : sorted[k] + (at - k) * (sorted[Math.min(k + 1, last)] - sorted[k]);
  });
}
