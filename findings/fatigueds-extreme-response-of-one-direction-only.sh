#!/usr/bin/env bash
# What:   the extreme response spectrum (`get_ers`) of a measured time history in FatigueDS.
# Guess:  the largest response in either direction, so turning the sensor round changes nothing.
# Seen:   the largest positive relative displacement only. A shock and the same shock with its sign
#         turned differ by up to six times. For sines the package takes the absolute value, and its
#         fatigue damage spectrum is the same for both signs.
# Matters to who compares shocks of a drivetrain (engagement, tip-in) with a test specification:
#         what a part must bear depends on how the sensor was glued on.
# Version: fatigueds 0.3.1
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check numpy==2.4.6 scipy==1.17.1 \
    matplotlib==3.11.2 rainflow==3.2.0 fatpack==0.7.8 tqdm==4.70.1 >"$dir/log" 2>&1 &&
    "$dir/v/bin/pip" install --disable-pip-version-check --no-deps fatigueds==0.3.1 flife==2.3 \
        >>"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
MPLBACKEND=Agg MPLCONFIGDIR="$dir" TQDM_DISABLE=1 "$dir/v/bin/python" -W ignore - <<'PY'
from importlib.metadata import version

import numpy as np
from FatigueDS import Spectrum
from scipy.signal import lsim

STEP, DAMPING = 1e-4, 0.05
FREQUENCIES = np.array([20.0, 80.0, 140.0, 200.0])  # Hz
TIME = np.arange(0.0, 0.5, STEP)
SHOCK = np.where(TIME < 0.01, 100 * np.sin(np.pi * TIME / 0.01), 0.0)  # half a sine, m/s2


def spectra(history):
    """Return FatigueDS' extreme response (m/s2) and damage by natural frequency."""
    found = Spectrum(freq_data=FREQUENCIES, damp=DAMPING)
    found.set_random_load((history, STEP))
    found.get_ers()
    found.get_fds(k=5)
    return found.ers, found.fds


def by_hand(frequency):
    """Return the largest and smallest w0^2 z (m/s2) of one oscillator on a shaken base."""
    w0 = 2 * np.pi * frequency
    system = ([-(w0**2)], [1.0, 2 * DAMPING * w0, w0**2])
    answer = lsim(system, SHOCK, TIME)[1]
    return answer.max(), answer.min()


print("fatigueds", version("fatigueds"))
(plus, damage), (minus, damage_minus) = spectra(SHOCK), spectra(-SHOCK)
same = True
for k, frequency in enumerate(FREQUENCIES):
    high, low = by_hand(frequency)
    print(
        f"{frequency:g} Hz: guess {max(high, -low):.1f} m/s2, seen {plus[k]:.1f} for the shock, "
        f"{minus[k]:.1f} for the shock turned round"
    )
    same = same and abs(plus[k] / high - 1) < 0.02 and abs(minus[k] / -low - 1) < 0.02
same = same and (minus / plus).max() > 5.0 and np.allclose(damage, damage_minus, rtol=1e-6)
sine = Spectrum(freq_data=FREQUENCIES, damp=DAMPING)
sine.set_sine_load(sine_freq=50.0, amp=100.0)
sine.get_ers()
print("sine of 50 Hz:", np.array2string(sine.ers, precision=1), "m/s2, all positive")
same = same and bool(np.all(sine.ers > 0))
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
