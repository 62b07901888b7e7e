"use strict";
/* Elements, numbers and units. */

const ABOUT = JSON.parse(document.getElementById("about").textContent);

/** Return an element with properties ("aria-*" and the like as attributes) and children. */
function el(tag, given = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

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

/** Return a quantity as a person reads it: in the first unit whose number is at least 1. */
function shown(value, unit, relative = false, n = 4) {
  if (unit === "1" || unit === "") return digits(value, n);
  if (unit === "K" && !relative) return `${digits(value - 273.15, n)} °C`;
  const known = ABOUT.units[unit] ?? [[unit, 1]];
  const [name, factor] = known.find(([, f]) => Math.abs(value) >= f) ?? known.at(-1);
  return `${digits(value / factor, n)} ${name}`;
}

/** Return the unit and factor that fit the largest of some values, for an axis. */
function axisUnit(values, unit) {
  if (unit === "K") return ["°C", 1, 273.15];
  const known = ABOUT.units[unit] ?? [[unit === "1" ? "" : unit, 1]];
  const most = Math.max(...values.map(Math.abs).filter(Number.isFinite), 0);
  const [name, factor] = known.find(([, f]) => most >= f) ?? known.at(-1);
  return [name, factor, 0];
}

/** Say what a field allows. */
function allowed(field) {
  const unit = field.unit === "1" ? "" : ` ${field.unit}`;
  return `${digits(field.min, 6)} .. ${digits(field.max, 6)}${unit}${field.kind === "integer" ? ", a whole number" : ""}`;
}
