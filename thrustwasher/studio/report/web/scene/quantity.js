/* Numbers and quantities in texts, as Python writes them. */

/** Return a number as Python's format ".4g", "g", ".2f" or ".0%" writes it. */
export function number(value, form) {
  const [, given, kind] = /^(?:\.(\d+))?([gf%])$/.exec(form) ?? [],
    n = Number(given ?? 6);
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
  if (kind === "f") return value.toFixed(n);
  if (kind === "%") return `${(100 * value).toFixed(n)}%`;
  if (value === 0) return "0";
  const most = Math.max(n, 1),
    [mantissa, power] = value.toExponential(most - 1).split("e"),
    exponent = Number(power);
  const bare = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
  if (exponent < -4 || exponent >= most)
    return `${bare(mantissa)}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
  return bare(value.toFixed(most - 1 - exponent));
}

/** Return significant digits without an exponent where that stays readable. */
function rounded(value, digits) {
  if (value === 0 || !Number.isFinite(value)) return number(value, "g");
  const size = Math.abs(value),
    places = digits - 1 - Math.floor(Math.log10(size));
  if (10 ** (digits + 2) > size && size >= 1e-4) {
    const text = value.toFixed(Math.max(0, places));
    return text.includes(".") ? text.replace(/0+$/, "").replace(/\.$/, "") : text;
  }
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  return `${mantissa}e${Number(power) < 0 ? "-" : "+"}${String(Math.abs(Number(power))).padStart(2, "0")}`;
}

const typeset = (unit) =>
  unit.replace(/([ms])([23])/g, (_, name, k) => name + "²³"[k - 2]).replaceAll(".", "·");

/** Return what writes a quantity [SI unit] with its unit; `units`: SI unit -> [[name, factor], ...]. */
export const writer =
  (units) =>
  (value, unit, digits = 4, relative = false) => {
    if (unit === "K" && !relative) return `${rounded(value - 273.15, digits)} °C`;
    const known = value && Number.isFinite(value) ? (units[unit] ?? [[unit, 1]]) : [[unit, 1]],
      [name, factor] = known.find(([, f]) => Math.abs(value) >= 0.9995 * f) ?? known.at(-1);
    const text = rounded(value / factor, digits);
    return name === "1" ? text : `${text} ${typeset(name)}`;
  };

export const FIELD = /{(\w+)(?::([^}]*))?}/g;

/**
 * Return a text of pieces [text, values] with its values. A value may be {value, unit}, a quantity.
 * @param {[string, Record<string, any>][]} pieces
 * @param {(value: number, unit: string, digits?: number, relative?: boolean) => string} say
 * @returns {string}
 */
export function textOf(pieces, say) {
  const filled = (text, values) =>
    text.replace(FIELD, (_, name, form) => {
      const value = values[name];
      if (value?.unit)
        return `${value.name ? `${value.name} = ` : ""}${say(value.value, value.unit, 4, value.relative)}`;
      if (!form) return String(value);
      if (/^(\.\d+)?[gf%]$/.test(form)) return number(value, form);
      const [unit, digits] = form.split(",");
      return say(value, unit, Number(digits ?? 4));
    });
  return pieces.map(([text, values]) => filled(text, values)).join("");
}
