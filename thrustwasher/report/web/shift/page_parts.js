/* What the scripts of a shift's page share: elements, colours, numbers. */
"use strict";
const Parts = (() => {
  const SVG = new Set(["svg", "path", "rect", "text", "title", "g", "line"]);

  function el(tag, given = {}, ...children) {
    const node = SVG.has(tag) ? document.createElementNS("http://www.w3.org/2000/svg", tag)
      : document.createElement(tag);
    for (const [name, value] of Object.entries(given)) {
      if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
      else if (value !== undefined && value !== false) node.setAttribute(name, value === true ? "" : value);
    }
    node.append(...children);
    return node;
  }

  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  }

  /* A value as a person reads it, in the unit that the page shows. */
  function number(value, signal = { zero: 0, scale: 1 }) {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    const shown = Number(((value - signal.zero) / signal.scale).toPrecision(5));
    return (Math.abs(shown) >= 1e6 || (shown !== 0 && Math.abs(shown) < 1e-4)
      ? shown.toExponential(3) : String(shown)).replace("-", "−");
  }

  function unitOf(signal) {
    return signal.unit === "1" ? "" : signal.unit;
  }

  return { el, colour, number, unitOf };
})();
