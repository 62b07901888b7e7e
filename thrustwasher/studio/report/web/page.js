/* What all pages share: folded tables are open on paper but those that stay, and there the colours are those of light. */

import { byId, every } from "./draw.js";

const root = document.documentElement;
/* A link to a folded chapter opens it. */
const unfold = () => {
  const place = location.hash.includes("=") ? null : byId(location.hash.slice(1));
  if (place?.matches("details")) place.open = true;
  if (place) place.scrollIntoView();
};
addEventListener("hashchange", unfold);
unfold();
let folded = [];
addEventListener("beforeprint", () => {
  folded = every("details:not([open])").filter((d) => !d.hasAttribute("data-stays"));
  for (const one of folded) one.open = true;
  root.classList.add("printed");
});
addEventListener("afterprint", () => {
  for (const one of folded) one.open = false;
  root.classList.remove("printed");
});
