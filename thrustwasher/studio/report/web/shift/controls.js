/* The bar above the plots: time, zoom, events and phases; all of it works from the keyboard. */

import { el } from "../draw.js";
import { moveTo, nearest, pan, phaseAt, zoom, zoomBy } from "./cursor.js";
import * as Exports from "./exports.js";
import { number } from "./page_parts.js";
import * as Units from "../units.js";

export function build(state, place) {
  const points = state.time.length;
  const slider = el("input", {
    type: "range",
    min: 0,
    max: points - 1,
    step: 1,
    value: 0,
    id: "time",
    "aria-label": "time of the cursor",
    oninput: () => moveTo(Number(slider.value)),
    onkeydown: keys,
  });
  const output = el("output", { id: "now", for: "time" });
  const all = () => zoom(state.time[0], state.time[points - 1]);
  const bar = el(
    "div",
    { class: "bar", role: "group", "aria-label": "cursor and zoom of all plots" },
    slider,
    output,
    button("zoom in", "+", () => zoomBy(0.5)),
    button("zoom out", "−", () => zoomBy(2)),
    button("earlier", "◀", () => pan(-0.25)),
    button("later", "▶", () => pan(0.25)),
    button("the whole run", "show all", all),
    Exports.ofSignals(state),
    Units.choice(),
  );
  const happened = el("ul", { class: "happened", "aria-label": "events and phases" });
  const marks = state.events.map((event) => mark(state, event, happened));
  const phases = state.runs[0].phases.filter(([, start, end]) => end > start);
  const faceOf = ([name, start, end]) => `${name} ${number(start)}–${number(end)} s`;
  const show = ([, start, end]) => {
    zoom(start, end);
    moveTo(nearest(start));
  };
  if (state.runs[0].shifts > 1) happened.prepend(el("li", {}, chosen()));
  else
    phases.forEach((phase) =>
      happened.append(
        el(
          "li",
          {},
          button(`zoom to ${phase[0]}`, faceOf(phase), () => show(phase)),
        ),
      ),
    );
  const thin = state.runs
    .filter((run) => run.points < run.recorded)
    .map(
      (run) =>
        `${run.points} of ${run.recorded} recorded points of ${run.title} are in this page, with the maximum and minimum of each phase, to four digits; shift.csv has all.`,
    );
  place.append(
    el(
      "p",
      { class: "small" },
      "Drag over a plot to zoom all of them, double-click to see all; with ",
      "Ctrl the wheel zooms, with Shift it moves. On the slider + and − zoom, 0 shows all. ",
      ...thin,
    ),
    happened,
    bar,
  );

  state.select = (event) => {
    moveTo(nearest(event.time));
    const { min, max } = state.view;
    if (event.time < min || event.time > max)
      zoom(event.time - 0.5 * (max - min), event.time + 0.5 * (max - min));
  };
  state.listeners.push(() => {
    const t = state.time[state.index];
    const words = `${number(t)} s${phaseAt(t) ? `, ${phaseAt(t)}` : ""}`;
    slider.value = state.index;
    slider.setAttribute("aria-valuetext", words);
    output.textContent = words;
    marks.forEach((one, i) => {
      const here = nearest(state.events[i].time) === state.index;
      if (here) one.setAttribute("aria-current", "true");
      else one.removeAttribute("aria-current");
    });
  });

  /* A list of shifts: the events of the one that is chosen are buttons. */
  function chosen() {
    const choose = (phase) =>
      marks.forEach((one, i) => {
        one.parentNode.hidden = !(
          phase &&
          state.events[i].time >= phase[1] &&
          state.events[i].time < phase[2]
        );
      });
    choose();
    const list = el(
      "select",
      {
        "aria-label": "shift",
        onchange: () => {
          const phase = phases[list.selectedIndex - 1];
          choose(phase);
          if (phase) show(phase);
          else all();
        },
      },
      el("option", {}, "all shifts"),
      ...phases.map((phase) => el("option", {}, faceOf(phase))),
    );
    return list;
  }

  function keys(e) {
    const what = {
      "+": () => zoomBy(0.5),
      "=": () => zoomBy(0.5),
      "-": () => zoomBy(2),
      0: all,
    }[e.key];
    if (!what) return;
    e.preventDefault();
    what();
  }
}

function button(words, face, onclick) {
  return el(
    "button",
    { type: "button", "aria-label": face.length > 1 ? undefined : words, title: words, onclick },
    face,
  );
}

function mark(state, event, happened) {
  const run = state.runs.length > 1 ? `${event.of}: ` : "";
  const one = button(
    "move the cursor here",
    `${event.number} ${run}${number(event.time)} s ${event.text}`,
    () => state.select(event),
  );
  happened.append(el("li", {}, one));
  return one;
}
