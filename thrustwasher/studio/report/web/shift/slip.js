/* Friction of the pack that engages over its slip, which falls; the cursor is that of all plots. */

import { el } from "../draw.js";
import { NAMES, moveTo } from "./cursor.js";
import { colour } from "./page_parts.js";
import { axisOf } from "./plots.js";
import uPlot from "uplot";

const COLOURS = ["blue", "orange"];

/* A run's friction over its slip: names, colours, dashes and values; `order`: points by rising slip, back from
   the end: where slip grows for a while, what came before its last fall is left out. */
function curveOf(state, run, k) {
  const { pack, from, to, levels } = run.slip;
  const slip = run.signals.get(`${pack}.speed`).values;
  const lines = ["friction_coefficient", "friction_with_oil"]
    .map((name) => run.signals.get(`${pack}.${name}`))
    .filter(Boolean);
  const order = [];
  for (let i = state.time.length - 1; i >= 0; i--) {
    const falls = Math.abs(slip[i]) > (order.length ? Math.abs(slip[order[order.length - 1]]) : 0);
    if (falls && state.time[i] >= from && state.time[i] < to) order.push(i);
  }
  const of = state.runs.length > 1 ? `${NAMES[k]}: ` : "";
  const named = [
    ...lines.map((line, i) => [of + line.help, COLOURS[i], k ? [6, 4] : undefined]),
    ...levels.map(([, words]) => [of + words, "grey", [2, 4]]),
  ];
  const data = [
    order.map((i) => Math.abs(slip[i])),
    ...lines.map((line) => order.map((i) => (Number.isFinite(line.values[i]) ? line.values[i] : null))),
    ...levels.map(([value]) => order.map(() => value)),
  ];
  return { slip, order, named, data };
}

export function start(state, place) {
  const curves = state.runs.flatMap((run, k) => (run.slip ? [curveOf(state, run, k)] : []));
  const named = curves.flatMap((curve) => curve.named),
    { slip, order } = curves[0];
  const chart = el("div", { role: "img", "aria-label": "friction over slip, which falls" });
  const key = el(
    "ul",
    { class: "happened small" },
    ...named.map(([words, shade, dash]) =>
      el("li", {}, el("span", { style: `color: var(--${shade})` }, dash ? "▪▪ " : "▬ "), words),
    ),
  );
  place.append(chart, key);
  const axis = (label) => axisOf({ label, labelSize: 20, size: 50, labelFont: "13px system-ui, sans-serif" });
  const plot = new uPlot(
    {
      width: Math.max(200, place.clientWidth),
      height: 260,
      legend: { show: false },
      scales: {
        x: { time: false, dir: -1 },
        y: { range: (u, low, high) => [Math.min(0, low), 1.05 * high] },
      },
      axes: [axis("slip, falling [rad/s]"), axis("friction coefficient [1]")],
      cursor: { y: false, drag: { x: false, y: false } },
      series: [
        {},
        ...named.map(([, shade, dash]) => ({
          stroke: () => colour(shade),
          width: 1.6,
          dash,
          spanGaps: true,
          points: { show: false },
        })),
      ],
    },
    curves.length > 1 ? uPlot.join(curves.map((curve) => curve.data)) : curves[0].data,
    chart,
  );
  plot.over.addEventListener("pointermove", (e) => {
    const here = plot.posToVal(e.clientX - plot.over.getBoundingClientRect().left, "x");
    const next = order.findIndex((i) => Math.abs(slip[i]) >= here);
    moveTo(order.at(next));
  });
  state.listeners.push(() => {
    const at = order.indexOf(state.index);
    plot.setCursor({ left: at < 0 ? -10 : plot.valToPos(Math.abs(slip[state.index]), "x"), top: 0 }, false);
  });
  state.others.push(plot);
}
