"use strict";
/* Numbers and units. */

const ABOUT = JSON.parse(document.getElementById("about").textContent);

function escaped(text) {
  return String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
}

/** Return a number with some digits, without needless zeros. */
function digits(value, n = 4) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e5 || size < 1e-3)) return value.toExponential(n - 1).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(n)));
}

/** Return a unit in typography. */
function pretty(unit) {
  return unit.replaceAll(".", "·").replace(/([ms])([23])/g, (_, name, power) => name + "²³"[power - 2]);
}

/** Return a quantity as a person reads it: in the first unit whose number is at least 1. */
function shown(value, unit, relative = false, n = 4) {
  if (unit === "1" || unit === "") return digits(value, n);
  if (unit === "K" && !relative) return `${digits(value - 273.15, n)} °C`;
  const known = ABOUT.units[unit] ?? [[unit, 1]];
  const [name, factor] = known.find(([, f]) => Math.abs(value) >= f) ?? known.at(-1);
  return `${digits(value / factor, n)} ${pretty(name)}`;
}

/** Return the unit and factor that fit the largest of some values, for an axis. */
function axisUnit(values, unit) {
  if (unit === "K") return ["°C", 1, 273.15];
  const known = ABOUT.units[unit] ?? [[unit === "1" ? "" : unit, 1]];
  const most = Math.max(...values.map(Math.abs).filter(Number.isFinite), 0);
  const [name, factor] = known.find(([, f]) => most >= f) ?? known.at(-1);
  return [pretty(name), factor, 0];
}

/** Say what a field allows. */
function allowed(field) {
  const unit = field.unit === "1" ? "" : ` ${pretty(field.unit)}`;
  return `${digits(field.min, 6)} .. ${digits(field.max, 6)}${unit}${field.kind === "integer" ? ", a whole number" : ""}`;
}
