#!/usr/bin/env bash
# What:   a speed in "rpm" asked for in hertz in pint, as orders and tooth passing frequencies need.
# Guess:  60 rpm are 1 Hz (one turn a second), or an error that an angle is no number of turns.
# Seen:   6.283 Hz. "rpm" is 2 pi rad a minute, the radian counts as 1, and hertz is 1/s, so what is
#         called hertz is rad/s. "1/min", the other unit of the same channel, gives 1 Hz. A turn a
#         second is 6.283 Hz, 1 rad/s is 1 Hz. No error, no warning, also in a chain: 23
#         teeth at 3000 rpm pass with 7226 Hz instead of 1150.
# Matters to who compares a measured spectrum with orders of a shaft: the lines lie 6.28 times too
#         high, and two files of one rig differ if one says rpm and the other 1/min.
# Version: pint 0.25.3
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check pint==0.25.3 >"$dir/log" 2>&1 ||
    { cat "$dir/log" >&2; exit 2; }
"$dir/v/bin/python" -W error - <<'PY'
from importlib.metadata import version
from math import isclose, pi

import pint

ureg = pint.UnitRegistry(cache_folder=None)
print("pint", version("pint"))
same = True
for number, text, guess, seen in (
    (60.0, "rpm", 1.0, 2 * pi),
    (60.0, "1/min", 1.0, 1.0),
    (1.0, "rad/s", 1 / (2 * pi), 1.0),
    (1.0, "turn/s", 1.0, 2 * pi),
):
    found = ureg.Quantity(number, text).to("Hz")
    print(f"{number:g} {text}: guess {guess:.4g} Hz, seen {found:.4g~P}")
    same = same and isclose(found.magnitude, seen, rel_tol=1e-9)
mesh = (23 * ureg.Quantity(3000.0, "rpm")).to("Hz")
print(f"23 teeth at 3000 rpm: guess 1150 Hz, seen {mesh:.5g~P}")
same = same and isclose(mesh.magnitude, 23 * 50 * 2 * pi, rel_tol=1e-9)
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
