/* What scatters in this part, as draws that the page was given. */

import { ABOUT } from "./dom.js";

export const { draws: DRAWS = 0, sources: SOURCES = [] } = ABOUT.scatter ?? {};
export const CHANGES = SOURCES.flatMap(({ changes }) => changes);

/** Return what a change makes of a value in a draw, within the value's range; `counts`: what counts where it is 0. */
export function drawn({ how, values }, k, value, { kind, min, max }, counts = 0) {
  if (kind !== "real") return values[k];
  const own = value || counts,
    found = { times: own * values[k], plus: own + values[k], set: values[k] }[how];
  return Math.min(Math.max(found, min), max);
}
