#!/usr/bin/env bash
# What:   radial force and life of the locating bearing of a helical pinion's shaft in pygritbx.
# Guess:  radial force = root of the two components across the shaft, however the load lies around
#         it; life = (C/P)^3 for an angular contact ball bearing.
# Seen:   the size of the axial force is taken off all three components, the axial one included.
#         With 3000 N radial and 1000 N axial the radial force is 3000, 4123 or 4583 N, as the
#         same load points. The exponent of life is 10/3, that of rollers; balls get 3 under the
#         type "ball" only, which the package neither lists nor calculates with.
# Matters to who sizes the bearings of helical or bevel gears: the choice of axes moves the life by
#         four times, and without any axial force it is 2.5 times too long.
# Version: pygritbx 1.1.4
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check pygritbx==1.1.4 numpy==2.4.6 scipy==1.17.1 \
    matplotlib==3.11.2 >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
MPLBACKEND=Agg MPLCONFIGDIR="$dir" "$dir/v/bin/python" -W ignore - <<'PY'
import contextlib
import io
from importlib.metadata import version

import numpy as np
from pygritbx import Force, Motor, Shaft, Support

AXIS = np.array([0.0, 0.0, 1.0])
BALLS = {"C": 47500.0, "C0": 34000.0, "e": 0.95, "X": 0.6, "Y2": 1.07}
ROLLERS = {"C": 62000.0, "C0": 53000.0, "e": 0.2, "Y": 0.6}


def locating(force):
    """Return the locating bearing with `force` (N) halfway between the two bearings."""
    fixed = Support(
        name="locating", type="Pin", bearingType="Contact Ball", d=40, D=80, B=30.2,
        axis=AXIS, loc=0.0, **BALLS,
    )
    free = Support(
        name="floating", type="Roller", bearingType="Cylindrical", d=40, D=80, B=18,
        axis=AXIS, loc=100.0, **ROLLERS,
    )
    motor = Motor(name="motor", power=15e3, n=1500.0, loc=[0.0, 0.0, -50.0], axis=AXIS)
    with contextlib.redirect_stdout(io.StringIO()):
        shaft = Shaft("pinion", inputs=[motor], axis=AXIS, sups=[fixed, free], loc=[0.0, 0.0, 0.0])
        shaft.updateEFs([Force(np.array(force), np.array([0.0, 0.0, 50.0]))])
        shaft.calculateReactionForces()
        fixed.calculateEquivalentDynamicLoad()
        fixed.calculateA1(rel=90.0)
        fixed.a_skf = 1.0
        fixed.calculateBearingLife()
    return fixed


print("pygritbx", version("pygritbx"))
guess = (BALLS["C"] / 3000.0) ** 3
same = True
for force, seen in (
    ([6000.0, 0.0, 0.0], 3000.0),
    ([-6000.0, 0.0, 1000.0], 3000.0),
    ([6000.0, 0.0, -1000.0], np.hypot(4000.0, 1000.0)),
    ([6000.0, 0.0, 1000.0], np.sqrt(4000.0**2 + 1000.0**2 + 2000.0**2)),
):
    bearing = locating(force)
    print(
        f"load {force} N, reaction {bearing.F_tot.force} N: radial force guess 3000 N, seen "
        f"{bearing.F_r:.0f} N; life guess {guess:.0f}, seen {bearing.L_10m:.0f} million turns"
    )
    same = same and np.allclose(np.abs(bearing.F_tot.force[:2]), [3000.0, 0.0])
    same = same and abs(bearing.F_r / seen - 1) < 1e-9
    same = same and abs(bearing.L_10m / (BALLS["C"] / seen) ** (10 / 3) - 1) < 1e-9
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
