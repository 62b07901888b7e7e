/* The units that pages show: as they come, those of the SI, or those of the workshop; kept in the address. */

const CHOICES = { mixed: "rad/s, °C, kPa", si: "rad/s, K, Pa", workshop: "rpm, °C, bar" };
const OWN = {
  si: { "rad/s": ["rad/s", 1, 0], K: ["K", 1, 0], Pa: ["Pa", 1, 0] },
  workshop: { "rad/s": ["rpm", Math.PI / 30, 0], K: ["°C", 1, 273.15], Pa: ["bar", 1e5, 0] },
};
const words = () => location.hash.slice(1).split("&").filter(Boolean);
const given =
  words()
    .find((word) => word.startsWith("units="))
    ?.slice(6) ?? "mixed";
const known = Object.hasOwn(CHOICES, given),
  mode = known ? given : "mixed";

/* Return [name, factor, zero] of an SI unit where it is not shown as it comes, else undefined. */
export const of = (unit, relative = false) => (relative && unit === "K" ? undefined : OWN[mode]?.[unit]);

/* Return an element in which units are chosen: the page is read again in them. */
export function choice() {
  const list = document.createElement("select");
  list.id = "units";
  for (const [name, text] of Object.entries(CHOICES))
    list.append(new Option(text, name, false, name === mode));
  list.addEventListener("change", () => {
    const others = words().filter((word) => !word.startsWith("units=") && word.includes("="));
    history.replaceState(
      null,
      "",
      `#${[...others, ...(list.value === "mixed" ? [] : [`units=${list.value}`])].join("&")}`,
    );
    location.reload();
  });
  const label = document.createElement("label");
  label.className = "units";
  label.append("units ", list);
  return label;
}

export const wrong = known ? "" : `units = ${given}, allowed: ${Object.keys(CHOICES).join(", ")}`;

export { mode };
