/* What the scripts of a shift's page share: colours and numbers. */

import { every } from "../draw.js";
import * as Units from "../units.js";

export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/* A value as a person reads it, in the unit that the page shows. */
export function number(value, signal = { zero: 0, scale: 1 }) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const shown = Number(((value - signal.zero) / signal.scale).toPrecision(5));
  return (
    Math.abs(shown) >= 1e6 || (shown !== 0 && Math.abs(shown) < 1e-4) ? shown.toExponential(3) : String(shown)
  ).replace("-", "−");
}

/* Key figures in the units that are chosen; as they come they stand in the page already. */
export const Figures = {
  show(figures) {
    const known = new Map(figures.map((figure) => [figure.name, figure]));
    for (const place of every("[data-figure]")) {
      const { value, unit, difference } = known.get(place.dataset.figure) ?? {},
        own = unit && Units.of(unit, difference);
      if (!own || value === null) continue;
      const [name, scale, zero] = own;
      (place.querySelector("b") ?? place.cells[1]).textContent = `${number(value, { zero, scale })} ${name}`;
    }
  },
};
