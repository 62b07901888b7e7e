/* The washer's fields as discs, at the moments that the page holds, and at the cursor's time if another
   script gives `solveAt(inputs, recorded)`: from the washer's inputs by name [SI] and the run's film ratio
   it promises an object with film_ratio, radius, angle and the fields as rows (radius by angle). */
"use strict";
const Discs = (() => {
  const { el, number } = Parts;
  const SIZE = 250;
  const LEVELS = 8; // contour lines lie between them
  const PAUSE = 60; // ms after the cursor's last move
  // viridis at even steps, after Smith & van der Walt
  const SHADES = [[68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128],
    [94, 201, 98], [173, 220, 48], [253, 231, 37]];

  function shadeOf(share) {
    const at = Math.max(0, Math.min(1, share)) * (SHADES.length - 1);
    const low = Math.min(Math.floor(at), SHADES.length - 2);
    return SHADES[low].map((c, i) => c + (at - low) * (SHADES[low + 1][i] - c));
  }

  /* The value at a place, linear in radius and angle; angles are evenly spaced. */
  function valueAt(rows, radius, angle, r, turn) {
    let i = 0;
    while (i < radius.length - 2 && radius[i + 1] < r) i++;
    const up = (r - radius[i]) / (radius[i + 1] - radius[i]);
    const around = ((turn - angle[0]) / (2 * Math.PI)) * angle.length;
    const at = ((around % angle.length) + angle.length) % angle.length;
    const j = Math.floor(at);
    const next = (j + 1) % angle.length;
    const along = (row) => row[j] + (at - j) * (row[next] - row[j]);
    return along(rows[i]) + up * (along(rows[i + 1]) - along(rows[i]));
  }

  /* An arrow around the middle: which way the washer turns. */
  function turning(context, middle, radius, speed) {
    const way = Math.sign(speed);
    const [first, last] = [-2.6, 2.1].map((turn) => -way * turn);
    const [x, y] = [middle + radius * Math.cos(last), middle + radius * Math.sin(last)];
    const side = (along, across) => [x + 0.2 * radius * (across * Math.cos(last) + along * way * Math.sin(last)),
      y + 0.2 * radius * (across * Math.sin(last) - along * way * Math.cos(last))];
    context.strokeStyle = context.fillStyle = Parts.colour("ink");
    context.lineWidth = 0.03 * radius;
    context.beginPath();
    context.arc(middle, middle, radius, first, last, way > 0);
    context.stroke();
    context.beginPath();
    for (const corner of [side(1.6, 0), side(0, 0.8), side(0, -0.8)]) context.lineTo(...corner);
    context.fill();
  }

  function paint(canvas, fields, rows, least, most, speed) {
    const pixels = SIZE * Math.min(2, Math.ceil(devicePixelRatio));
    canvas.width = canvas.height = pixels;
    const context = canvas.getContext("2d");
    const image = context.createImageData(pixels, pixels);
    const { radius, angle } = fields;
    const level = new Int8Array(pixels * pixels).fill(-1);
    const outer = radius[radius.length - 1];
    for (let k = 0; k < pixels * pixels; k++) {
      const x = ((k % pixels) + 0.5) / pixels * 2.04 - 1.02;
      const y = 1.02 - (Math.floor(k / pixels) + 0.5) / pixels * 2.04;
      const r = outer * Math.hypot(x, y);
      if (r < radius[0] || r > outer) continue;
      const value = valueAt(rows, radius, angle, r, Math.atan2(y, x));
      const share = (value - least) / (most - least || 1);
      level[k] = Math.max(0, Math.min(LEVELS - 1, Math.floor(share * LEVELS)));
      const line = [1, pixels].some((back) => level[k - back] >= 0 && level[k - back] !== level[k]);
      image.data.set([...shadeOf(share).map((c) => (line ? 0.55 * c : c)), 255], 4 * k);
    }
    context.putImageData(image, 0, 0);
    if (speed) turning(context, pixels / 2, (0.24 * pixels * radius[0]) / outer, speed);
  }

  function show(place, data, moment, speed) {
    const discs = Object.entries(data.fields).filter(([name]) => moment[name]).map(([name, field]) => {
      const all = moment[name].flat();
      const [least, most] = [Math.min(...all), Math.max(...all)];
      const canvas = el("canvas", { role: "img", "aria-label": `${field.words} over the washer` });
      paint(canvas, moment, moment[name], least, most, speed);
      const range = `${number(least, field)} to ${number(most, field)} ${field.unit}`;
      return el("figure", {}, canvas, el("figcaption", {}, `${field.words}, ${range}`));
    });
    place.replaceChildren(...discs);
  }

  function inputsAt(state) {
    const run = state.runs[0];
    return Object.fromEntries(run.inputs.map((name) => [name, run.signals.get(`washer.${name}`)?.values[state.index] ?? 0]));
  }

  function start(data, state, place) {
    const run = state.runs[0];
    const found = Object.entries(run.moments);
    if (!found.length && !window.solveAt) return;
    const said = el("p", { class: "small", "aria-live": "polite" });
    const discs = el("div", { class: "discs" });
    const buttons = el("p", { class: "choose" });
    let live = false;
    let waits;
    const press = (one) => buttons.childNodes.forEach((b) => b.setAttribute("aria-pressed", b === one));
    for (const [words, moment] of found) {
      const one = el("button", { type: "button", "aria-pressed": "false", onclick: () => {
        live = false;
        press(one);
        Plots.moveTo(Plots.nearest(moment.time));
        said.textContent = `${words}: solved again at the inputs recorded at ${number(moment.time)} s: film ratio `
          + `${number(moment.film_ratio)}, in the run it was ${number(moment.recorded_film_ratio)}.`;
        show(discs, data, moment, moment.inputs.speed);
      } }, words);
      buttons.append(one);
    }
    if (window.solveAt) buttons.append(cursorButton());
    place.append(buttons, said, discs);
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
      said.textContent = `${words}, ${number(moment.time)} s.`;
      show(discs, data, moment, moment.inputs.speed);
    }

    function cursorButton() {
      const one = el("button", { type: "button", "aria-pressed": "false", onclick: () => {
        live = true;
        press(one);
        solve();
      } }, "at the cursor");
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
        const moment = await window.solveAt(inputs, recorded);
        if (!live || time !== number(state.time[state.index])) return;
        said.textContent = `Solved here at ${time} s: film ratio ${number(moment.film_ratio)}, in the run it was `
          + `${number(recorded)}.`;
        show(discs, data, moment, inputs.speed);
      } catch (problem) {
        said.textContent = `No solution at ${time} s: ${problem.message}. The last one stays.`;
      }
    }
  }

  return { start };
})();
