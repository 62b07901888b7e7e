#!/usr/bin/env bash
# What:   `Shaft(nl, nr, k=..., I=...)` of opentorsion, I documented as "moment of inertia of the
#         shaft [kgm^2]".
# Guess:  the shaft adds I to the drivetrain, as the same shaft given by length and diameter does.
# Seen:   the element matrix is I * [[2, 1], [1, 2]], whose sum is 6 I (the consistent matrix has
#         I / 6). The same shaft given by its dimensions has the right sum. Nothing is said.
# Matters to who takes k and I of a half shaft or a propeller shaft from a data sheet: the first
#         torsional frequency comes out too low, and the run-up of the line too slow.
# Version: opentorsion 0.3.2
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check opentorsion==0.3.2 numpy==2.4.6 \
    scipy==1.17.1 matplotlib==3.11.2 >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
MPLCONFIGDIR="$dir" "$dir/v/bin/python" -W ignore - <<'PY'
from importlib.metadata import version
from math import pi, sqrt

import opentorsion as ot

LENGTH, DIAMETER, G, RHO, DISK = 1.0, 0.1, 80e9, 7850.0, 0.1
J = pi * DIAMETER**4 / 32
stiffness, inertia = G * J / LENGTH, RHO * J * LENGTH


def first_frequency(shaft):
    """Return the sum of all inertia (kg m2) and the first elastic frequency (Hz)."""
    line = ot.Assembly([shaft], [ot.Disk(0, DISK), ot.Disk(1, DISK)])
    return line.M.sum(), line.modal_analysis()[0].max() / (2 * pi)


def by_hand(shaft_inertia):
    """Return the frequency (Hz) of two equal disks whose shaft has the consistent matrix."""
    return sqrt(2 * stiffness / (DISK + shaft_inertia / 6)) / (2 * pi)


drawn = first_frequency(ot.Shaft(0, 1, L=1e3 * LENGTH, odl=1e3 * DIAMETER, G=G, rho=RHO))
given = first_frequency(ot.Shaft(0, 1, k=stiffness, I=inertia))
print("opentorsion", version("opentorsion"))
print(f"steel shaft 1 m x 100 mm: k = {stiffness:.0f} Nm/rad, I = {inertia:.5f} kg m2; two disks of 0.1")
print(f"guess: total inertia {inertia + 2 * DISK:.4f} kg m2, first elastic mode {by_hand(inertia):.1f} Hz")
print(f"seen with length and diameter: {drawn[0]:.4f} kg m2, {drawn[1]:.1f} Hz")
print(f"seen with k and I:             {given[0]:.4f} kg m2, {given[1]:.1f} Hz")
print(f"shaft's share with k and I: {(given[0] - 2 * DISK) / inertia:.3f} times I")
same = (
    abs(drawn[0] / (inertia + 2 * DISK) - 1) < 1e-9
    and abs(drawn[1] / by_hand(inertia) - 1) < 1e-6
    and abs(given[0] / (6 * inertia + 2 * DISK) - 1) < 1e-9
    and abs(given[1] / by_hand(6 * inertia) - 1) < 1e-6
)
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
