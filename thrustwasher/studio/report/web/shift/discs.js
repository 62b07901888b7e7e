/* The washer's fields as discs, at the moments that the page holds, and at the cursor's time if another
   script gives `solveAt(inputs, recorded)`: from the washer's inputs by name [SI] and the run's film ratio
   it promises an object with film_ratio, radius, angle and the fields, angle by angle. */

import { Disc, el, pixelsOf } from "../draw.js";
import { moveTo, nearest } from "./cursor.js";
import * as Live from "./live.js";
import { number } from "./page_parts.js";

/** @type {any} with `solveAt`, see above */
const page = window;
const PAUSE = 60; // ms after the cursor's last move

function show(place, data, moment, speed) {
  const pixels = pixelsOf(moment.radius, moment.angle);
  place.replaceChildren();
  for (const [name, field] of Object.entries(data.fields)) {
    const tell = (value) => `${number(value, field)} ${field.unit}`;
    if (moment[name]) new Disc(place, { name, title: field.words, tell }).show(moment[name], pixels, speed);
  }
}

function inputsAt(state) {
  const run = state.runs[0];
  return Object.fromEntries(
    run.inputs.map((name) => [name, run.signals.get(`washer.${name}`)?.values[state.index] ?? 0]),
  );
}

export function start(data, state, place) {
  const run = state.runs[0];
  const found = Object.entries(run.moments);
  const message = el("p", { class: "small", "aria-live": "polite" });
  const discs = el("div", { class: "discs" });
  const buttons = el("p", { class: "choose" });
  let live = false;
  let waits;
  const press = (one) => buttons.childNodes.forEach((b) => b.setAttribute("aria-pressed", b === one));
  for (const [words, moment] of found) {
    const one = el(
      "button",
      {
        type: "button",
        "aria-pressed": "false",
        onclick: () => {
          live = false;
          press(one);
          moveTo(nearest(moment.time));
          message.textContent =
            `${words}: solved again at the inputs recorded at ${number(moment.time)} s: film ratio ` +
            `${number(moment.film_ratio)}, in the run it was ${number(moment.recorded_film_ratio)}.`;
          show(discs, data, moment, moment.inputs.speed);
        },
      },
      words,
    );
    buttons.append(one);
  }
  if (page.solveAt) buttons.append(cursorButton());
  else place.append(el("p", { class: "small" }, Live.missing(data.washer)));
  place.append(buttons, message, discs);
  const seen = new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting)) firstLook();
  });
  seen.observe(place);
  addEventListener("beforeprint", firstLook);

  function firstLook() {
    seen.disconnect();
    if (!found.length || discs.childNodes.length) return;
    const [words, moment] = found[0];
    press(buttons.firstChild);
    message.textContent = `${words}, ${number(moment.time)} s.`;
    show(discs, data, moment, moment.inputs.speed);
  }

  function cursorButton() {
    const one = el(
      "button",
      {
        type: "button",
        "aria-pressed": "false",
        onclick: () => {
          live = true;
          press(one);
          solve();
        },
      },
      "at the cursor",
    );
    state.listeners.push(() => {
      clearTimeout(waits);
      if (live) waits = setTimeout(solve, PAUSE);
    });
    return one;
  }

  async function solve() {
    const time = number(state.time[state.index]);
    try {
      const inputs = inputsAt(state);
      const recorded = run.signals.get("washer.film_ratio")?.values[state.index];
      const moment = await page.solveAt(inputs, recorded);
      if (!live || time !== number(state.time[state.index])) return;
      message.textContent =
        `Solved here at ${time} s: film ratio ${number(moment.film_ratio)}, in the run it was ` +
        `${number(recorded)}.`;
      show(discs, data, moment, inputs.speed);
    } catch (problem) {
      message.textContent = `No solution at ${time} s: ${/** @type {Error} */ (problem).message}. The last one stays.`;
    }
  }
}
