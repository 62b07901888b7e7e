#!/usr/bin/env bash
# What:   `TimeSignalGenerator.query` of pyLife, called several times for a long load signal.
# Guess:  ten queries of a second are the query of ten seconds. The docstring says that the samples
#         attach smoothly.
# Seen:   they do as long as the time in seconds is below the angular frequency w in rad/s. Whole
#         periods are taken off the time of each query, but a period is taken to last w seconds
#         instead of 2 pi/w: at the first seam after each of them the phase jumps. A torque of
#         100 Nm at 1 Hz, which moves by at most 0.63 Nm a sample, jumps by up to 155 Nm.
# Matters to who builds the load of a long run in chunks: the drivetrain is hit by steps that were
#         never part of the load, and they are counted as cycles.
# Version: pylife 2.3.1
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check pylife==2.3.1 numpy==2.4.6 scipy==1.17.1 \
    pandas==3.1.1 h5py==3.16.0 >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
"$dir/v/bin/python" -W ignore - <<'PY'
from importlib.metadata import version

import numpy as np
from pylife.stress.timesignal import TimeSignalGenerator

RATE, SECONDS, OMEGA = 1000, 100, 2 * np.pi  # Hz, s, rad/s
ONE_SINE = {
    "number": 1,
    "amplitude_median": 100.0,
    "amplitude_std_dev": 0.0,
    "frequency_median": OMEGA,
    "frequency_std_dev": 0.0,
    "offset_median": 0.0,
    "offset_std_dev": 0.0,
}


def signal(chunk):
    """Return the torque (Nm) of the whole run, queried in chunks of `chunk` seconds."""
    np.random.seed(1)  # the phase is drawn from numpy's global stream
    generator = TimeSignalGenerator(RATE, ONE_SINE, None, None)
    return np.concatenate([generator.query(chunk * RATE) for _ in range(SECONDS // chunk)])


print("pylife", version("pylife"))
whole, chunks = signal(SECONDS), signal(1)
allowed = 100.0 * OMEGA / RATE
steps = np.abs(np.diff(chunks))
seams = (np.flatnonzero(steps > 1.01 * allowed) + 1) / RATE
first = np.argmax(np.abs(chunks - whole) > 1e-6) / RATE
print(f"one query: largest step {np.abs(np.diff(whole)).max():.2f} Nm, allowed {allowed:.2f} Nm")
print(f"{SECONDS} queries: guess {allowed:.2f} Nm, seen {steps.max():.2f} Nm, {len(seams)} jumps")
print(f"first at {first:g} s, all at whole seconds: {bool(np.all(seams == np.round(seams)))}")
same = np.abs(np.diff(whole)).max() < 1.01 * allowed
same = same and np.abs(chunks - whole)[: 7 * RATE].max() < 1e-6 and first == 7.0
same = same and len(seams) >= 10 and np.all(seams == np.round(seams))
same = same and steps.max() > 100 * allowed
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
