#!/usr/bin/env bash
# What:   `BearingElement(n, kxx, cxx, mxx, frequency=...)` of ROSS: coefficients given as tables
#         over the speed.
# Guess:  at a speed of the table the element has the value of the table.
# Seen:   a smoothing spline is put through the table with a limit on the sum of squares that is
#         the number of points, whatever the unit. Stiffness in 1e6 N/m is met; an added mass
#         below 1 kg (a seal, a film damper) becomes one plain cubic: its peak is lost. The same
#         table 1000 times larger is met. No warning.
# Matters to who brings measured or calculated seal and damper coefficients: mass and light
#         damping in the critical speeds are not those that were given.
# Version: ross-rotordynamics 2.3.0 (with plotly 5: its theme cannot be made with plotly 6)
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check --no-compile ross-rotordynamics==2.3.0 \
    plotly==5.24.1 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1 pint==0.25.3 >"$dir/log" 2>&1 ||
    { cat "$dir/log" >&2; exit 2; }
cat >"$dir/show.py" <<'PY'
from importlib.metadata import version

import numpy as np
import ross

SPEED = np.linspace(100.0, 1000.0, 10)  # rad/s
MASS = np.array([0.30, 0.32, 0.38, 0.50, 0.80, 0.52, 0.36, 0.28, 0.24, 0.22])  # kg


def at_table(scale):
    """Return the element's mass at the speeds of the table, over the scale."""
    seal = ross.BearingElement(n=0, kxx=1e6, cxx=50.0, mxx=scale * MASS, frequency=SPEED)
    return np.array([seal.M(speed)[0, 0] for speed in SPEED]) / scale


def line(values):
    return " ".join(f"{value:.2f}" for value in values)


small, large = at_table(1.0), at_table(1000.0)
cubic = np.polyval(np.polyfit(SPEED / 1000.0, MASS, 3), SPEED / 1000.0)
print("ross-rotordynamics", version("ross-rotordynamics"))
print("mass given, kg (the guess):", line(MASS))
print("mass seen, kg:             ", line(small))
print("one cubic through them all:", line(cubic))
print("table 1000 times larger:   ", line(large), "(over 1000)")
print(f"largest deviation: {np.abs(small - MASS).max():.2f} kg, and {np.abs(large - MASS).max():.4f} if larger")
same = np.abs(small - cubic).max() < 1e-6 and small[4] < 0.6 and np.abs(large - MASS).max() < 0.01
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
# A property library that ROSS loads writes notes of its own at import; only these lines are shown.
status=0
MPLCONFIGDIR="$dir" "$dir/v/bin/python" -W ignore "$dir/show.py" >"$dir/out" || status=$?
sed -n '/^ross-rotordynamics/,$p' "$dir/out"
exit "$status"
