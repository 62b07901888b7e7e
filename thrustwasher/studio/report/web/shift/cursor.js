/* One time for all plots of a page: the cursor, the zoom, and who hears of them. */

export const NAMES = ["A", "B"];
export const state = /** @type {Record<string, any>} */ ({
  time: [],
  runs: [],
  index: 0,
  view: { min: 0, max: 1 },
  panels: [],
  others: [],
  listeners: [],
});
let awaited = false;

export const first = () => state.time[0];
export const last = () => state.time[state.time.length - 1];

/* The index of the point nearest to a time. */
export function nearest(t) {
  let low = 0,
    high = state.time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (state.time[middle] > t) high = middle;
    else low = middle;
  }
  return t - state.time[low] < state.time[high] - t ? low : high;
}

export function phaseAt(t) {
  const found = state.runs[0].phases.find(([, start, end]) => t >= start && t < end);
  return found ? found[0] : "";
}

export function moveTo(index) {
  state.index = Math.max(0, Math.min(state.time.length - 1, index));
  schedule();
}

export function zoom(min, max) {
  const least = (last() - first()) / state.time.length;
  const wide = Math.min(Math.max(max - min, 2 * least), last() - first());
  const start = Math.max(first(), Math.min(min, last() - wide));
  state.view = { min: start, max: start + wide };
  schedule();
}

/* Zoom about the cursor, or about the middle where the cursor is out of sight. */
export function zoomBy(factor, about = state.time[state.index]) {
  const { min, max } = state.view;
  const centre = about >= min && about <= max ? about : 0.5 * (min + max);
  zoom(centre - (centre - min) * factor, centre + (max - centre) * factor);
}

export function pan(share) {
  const { min, max } = state.view;
  zoom(min + share * (max - min), max + share * (max - min));
}

export function schedule() {
  if (awaited) return;
  awaited = true;
  requestAnimationFrame(() => {
    awaited = false;
    for (const tell of state.listeners) tell(state);
  });
}
