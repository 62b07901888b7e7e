/* What the address of a report holds: cursor t and zoom from .. to [s], signals switched off and on, units. */

import { moveTo, nearest, zoom } from "./cursor.js";
import * as Units from "../units.js";

const LATER = 250; // ms after the last change
let timer = 0;
const changes = { off: new Set(), on: new Set() };

function read() {
  const found = new Map();
  for (const word of location.hash.slice(1).split("&")) {
    const at = word.indexOf("=");
    if (at > 0) found.set(word.slice(0, at), decodeURIComponentSafely(word.slice(at + 1)));
  }
  return found;
}

function decodeURIComponentSafely(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/* Show what the address names; names and numbers that mean nothing are passed by. */
export function apply(state, choose) {
  const given = read(),
    number = (name) => {
      const v = Number(given.get(name));
      return given.has(name) && Number.isFinite(v) ? v : null;
    };
  const [from, to, t] = ["from", "to", "t"].map(number);
  if (from !== null && to !== null && to > from) zoom(from, to);
  if (t !== null) moveTo(nearest(t));
  for (const [key, on] of [
    ["off", false],
    ["on", true],
  ]) {
    for (const name of (given.get(key) ?? "").split(",").filter(Boolean)) choose(name, on);
  }
  state.listeners.push(() => later(state));
}

export function chose(name, on, usual) {
  changes.on.delete(name);
  changes.off.delete(name);
  if (on !== usual) changes[on ? "on" : "off"].add(name);
}

function later(state) {
  clearTimeout(timer);
  timer = setTimeout(() => keep(state), LATER);
}

function keep(state) {
  const pairs = [],
    { min, max } = state.view,
    short = (v) => String(Number(v.toPrecision(7)));
  if (state.index) pairs.push(`t=${short(state.time[state.index])}`);
  if (min > state.time[0] || max < state.time[state.time.length - 1])
    pairs.push(`from=${short(min)}`, `to=${short(max)}`);
  for (const key of ["off", "on"]) if (changes[key].size) pairs.push(`${key}=${[...changes[key]].join(",")}`);
  if (Units.mode !== "mixed") pairs.push(`units=${Units.mode}`);
  const text = pairs.length ? `#${pairs.join("&")}` : "";
  if (text && text !== location.hash) history.replaceState(null, "", text);
  else if (!text && location.hash.includes("="))
    history.replaceState(null, "", location.pathname + location.search);
  document.documentElement.dataset.state = text;
}
