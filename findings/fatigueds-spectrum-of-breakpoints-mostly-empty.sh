#!/usr/bin/env bash
# What:   a random load given to FatigueDS as a spectrum (PSD) of few frequencies with unequal
#         spacing, as specifications and third-octave tables give it.
# Guess:  interpolated between the frequencies, as FLife by the same authors does with these arrays.
# Seen:   each value counts over one width, the spacing of the first two frequencies, around its
#         own frequency. All else is empty. A flat spectrum of 20, 80, 350, 2000 Hz is empty from
#         110 to 320 and from 380 to 1970 Hz: the response at 200 Hz is a fifth, the damage of an
#         exponent of 7 is 1e-5 of that of the same spectrum by the hertz. No error, no warning.
# Matters to who types a test specification in: the part lives a hundred thousand times too long.
# Version: fatigueds 0.3.1, flife 2.3
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

import FLife
import numpy as np
from FatigueDS import Spectrum

NATURAL = np.array([50.0, 200.0, 800.0])  # Hz
POINTS = np.array([20.0, 80.0, 350.0, 2000.0])  # Hz
FINE = np.arange(20.0, 2000.5, 1.0)


def spectra(frequencies, density):
    """Return extreme response (m/s2) and damage for an hour of the load."""
    found = Spectrum(freq_data=NATURAL.copy(), Q=10)
    found.set_random_load((density, frequencies), T=3600)
    found.get_ers()
    found.get_fds(k=7)
    return found.ers, found.fds


def variance(frequencies, density):
    """Return FLife's variance of the load, (m/s2)^2."""
    return FLife.SpectralData({"PSD": density, "f": frequencies}).moments[0]


print("fatigueds", version("fatigueds"), "flife", version("flife"))
flat, fine = np.ones(4), np.ones(len(FINE))
print(f"FLife: {variance(POINTS, flat):g} by 4 frequencies, {variance(FINE, fine):g} by the hertz")
same = abs(variance(POINTS, flat) / variance(FINE, fine) - 1) < 1e-6
(few, few_damage), (many, many_damage) = spectra(POINTS, flat), spectra(FINE, fine)
# 30 Hz to either side of each frequency, nothing below the first or above the last.
distance = np.abs(FINE[:, None] - POINTS)
islands, _ = spectra(FINE, np.sum((distance < 30) + 0.5 * (distance == 30), axis=1))
for k, natural in enumerate(NATURAL):
    print(
        f"{natural:g} Hz: guess {many[k]:.0f} m/s2, seen {few[k]:.0f}, islands of 60 Hz "
        f"{islands[k]:.0f}; damage {few_damage[k] / many_damage[k]:.1e} of the guess"
    )
same = same and np.allclose(few, islands, rtol=0.03)
same = same and bool(np.all(few[1:] < 0.25 * many[1:]) and few_damage[1] < 1e-4 * many_damage[1])
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
