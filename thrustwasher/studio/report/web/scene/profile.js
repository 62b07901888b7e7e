/* What profiles make of a shift: where it begins, which pack engages, the command over time. */

/** Return the shift that profiles make: its start, duration and the packs' parts in it. */
export function shiftOf(about, profiles) {
  if (!about.by_pressure) {
    const points = profiles.shift_command,
      { from, to, duration } = about.shift;
    const [start, lasts] = points
      ? [points[0][0], points[1][0] - points[0][0]]
      : [about.shift.start, duration];
    return { start, duration: lasts, from, to, engaging: to >= from ? "clutch" : "brake" };
  }
  const profile = (pack) => effective(about, profiles, `${pack}_pressure`) ?? [[0, 0]],
    rise = (points) => points.at(-1)[1] - points[0][1];
  const engaging = rise(profile("brake")) > rise(profile("clutch")) ? "brake" : "clutch",
    points = profile(engaging);
  const at = points.findIndex(([, p], i) => i + 1 < points.length && points[i + 1][1] > p),
    [start] = points[Math.max(at, 0)];
  const [from, to] = engaging === "clutch" ? [0, 1] : [1, 0];
  return { start, duration: points.at(-1)[0] - start, from, to, engaging };
}

/** Return the points of a profile with its factor; null where there is none. */
export function effective(about, profiles, name) {
  const known = about.profiles[name];
  return known ? profiles[name].map(([t, x]) => [t, known.factor * x]) : null;
}

/** Return the shift command at a time. */
export function commandAt(t, { start, duration, from, to }) {
  if (t <= start) return from;
  return t >= start + duration ? to : from + (to - from) * ((t - start) / duration);
}
