#!/usr/bin/env bash
# What:   `PeriodicExcitation(n, omegas).add_sines(node, angular_frequency, amplitude, phase)` of
#         opentorsion.
# Guess:  each amplitude acts at the angular frequency given beside it, or an error says that
#         this frequency is not one of `omegas`.
# Seen:   only the length of `angular_frequency` is read. The amplitudes fill the columns from the
#         left, so a sine for 300 rad/s acts at 100 rad/s, and so does one for a frequency that
#         the excitation does not have.
# Matters to who adds the orders of an engine or of a gear mesh from two tables: the resonance is
#         excited, or missed, by the order of another frequency.
# Version: opentorsion 0.3.2
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check opentorsion==0.3.2 numpy==2.4.6 \
    scipy==1.17.1 matplotlib==3.11.2 >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
MPLCONFIGDIR="$dir" "$dir/v/bin/python" -W ignore - <<'PY'
from importlib.metadata import version

import numpy as np
import opentorsion as ot

OMEGAS = np.array([100.0, 200.0, 300.0])  # rad/s
# Two disks of 1 kg m2 on 20 kNm/rad: the one resonance is at sqrt(2 k / I) = 200 rad/s.
LINE = ot.Assembly([ot.Shaft(0, 1, k=2e4, c=1.0)], [ot.Disk(0, 1.0), ot.Disk(1, 1.0)])


def torques(frequency):
    """Return the shaft's torque amplitude (Nm) by frequency for 10 Nm at `frequency`."""
    excitation = ot.PeriodicExcitation(2, OMEGAS)
    excitation.add_sines(0, [frequency], [10.0], [0.0])
    return np.abs(LINE.vibratory_torque(excitation)[0][0])


def by_hand(frequency):
    """Return the shaft's torque amplitude (Nm), stiffness part, for 10 Nm on one disk."""
    return 2e4 * 10.0 / abs(2e4 * 2 - frequency**2 + 2j * frequency)


print("opentorsion", version("opentorsion"))
print("excitation set up for", OMEGAS, "rad/s; resonance at 200 rad/s; one sine of 10 Nm added")
same = True
for frequency in (100.0, 200.0, 300.0, 777.0):
    seen = torques(frequency)
    guess = "error: not one of the three"
    if frequency in OMEGAS:
        guess = np.array2string(by_hand(frequency) * (frequency == OMEGAS), precision=2)
    print(f"sine at {frequency:.0f} rad/s: guess {guess}, seen {np.array2string(seen, precision=2)} Nm")
    same = same and np.allclose(seen, [by_hand(100.0), 0.0, 0.0])
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
