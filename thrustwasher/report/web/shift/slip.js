/* Friction of the pack that engages over its slip, which falls; the cursor is that of all plots. */
"use strict";
const Slip = (() => {
  const { colour } = Parts;
  const COLOURS = ["blue", "orange"];

  function start(state, place) {
    const { pack, from, to, levels } = state.runs[0].slip;
    const { signals } = state.runs[0];
    const slip = signals.get(`${pack}.speed`).values;
    const lines = ["friction_coefficient", "friction_with_oil"].map((name) => signals.get(`${pack}.${name}`)).filter(Boolean);
    const order = [...state.time.keys()].filter((i) => state.time[i] >= from && state.time[i] < to && slip[i])
      .sort((a, b) => Math.abs(slip[a]) - Math.abs(slip[b]));
    const named = lines.map((line, i) => [line.help, COLOURS[i], undefined]);
    const level = levels.map(([, words]) => [words, "grey", [6, 4]]);
    const chart = el("div", { role: "img", "aria-label": `friction of the ${pack} over its slip, which falls` });
    const key = el("ul", { class: "happened small" }, ...[...named, ...level].map(([words, shade]) =>
      el("li", {}, el("span", { style: `color: var(--${shade})` }, "▬ "), words)));
    place.append(chart, key);
    const axis = (label) => ({ stroke: () => colour("soft"), label, labelSize: 20, size: 50, font: "12px system-ui, sans-serif",
      labelFont: "13px system-ui, sans-serif", grid: { stroke: () => colour("line"), width: 1 } });
    const plot = new uPlot({
      width: Math.max(200, place.clientWidth), height: 260, legend: { show: false },
      scales: { x: { time: false, dir: -1 }, y: { range: (u, low, high) => [Math.min(0, low), 1.05 * high] } },
      axes: [axis("slip, falling [rad/s]"), axis("friction coefficient [1]")],
      cursor: { y: false, drag: { x: false, y: false } },
      series: [{}, ...[...named, ...level].map(([, shade, dash]) => ({
        stroke: () => colour(shade), width: 1.6, dash, points: { show: false } }))],
    }, [order.map((i) => Math.abs(slip[i])),
      ...lines.map((line) => order.map((i) => (Number.isFinite(line.values[i]) ? line.values[i] : null))),
      ...levels.map(([value]) => order.map(() => value))], chart);
    plot.over.addEventListener("pointermove", (e) => {
      Plots.moveTo(order[plot.posToIdx(e.clientX - plot.over.getBoundingClientRect().left)]);
    });
    state.listeners.push(() => {
      const at = order.indexOf(state.index);
      plot.setCursor({ left: at < 0 ? -10 : plot.valToPos(Math.abs(slip[state.index]), "x"), top: 0 }, false);
    });
    state.others.push(plot);
  }

  return { start };
})();
