#!/usr/bin/env bash
# What:   `psd_df` of pyLife on a channel whose sample rate is no whole number of hertz.
# Guess:  a line of the signal stands at its frequency, as the index of the frame gives the times.
# Seen:   the sample rate is rounded to whole hertz before it is used. A channel of 12.5 Hz is taken
#         as one of 12 Hz, one of 2.4 Hz as 2 Hz, one of 1.5 Hz as 2 Hz: every frequency is off by
#         that ratio, here by -4, -17 and +33 %. A channel of 0.4 Hz is refused (rate 0). The band
#         filter `butter_bandpass` shifts its limits in the same way.
# Matters to who looks for a shaft's order or a slow hunting of torque in logged channels (80 ms,
#         oil, heat): the line lies at another frequency than in the file of the fast channels.
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
import pandas as pd
from pylife.stress.timesignal import butter_bandpass, psd_df


def channel(rate, frequency, count=4096):
    """Return a torque (Nm) with one line at `frequency`, sampled at `rate` (Hz)."""
    time = np.arange(count) / rate
    torque = 100 * np.sin(2 * np.pi * frequency * time)
    return pd.DataFrame({"torque": torque}, index=time)


print("pylife", version("pylife"))
same = True
for rate, taken in ((1000.0, 1000.0), (12.5, 12.0), (2.4, 2.0), (1.5, 2.0)):
    guess = rate * 104 / 512  # on a line of the transform of 512 values
    seen = psd_df(channel(rate, guess))["torque"].idxmax()
    off = seen / guess - 1
    print(f"rate {rate:g} Hz: line at {guess:.4f} Hz, seen at {seen:.4f} Hz ({off:+.1%})")
    same = same and abs(seen - taken * 104 / 512) < 1e-9
try:
    psd_df(channel(0.4, 0.08))
    same = False
except ValueError as err:
    print("rate 0.4 Hz:", err)
kept = {}
for rate in (12.0, 12.5):  # a line within the band, near its lower limit
    passed = butter_bandpass(channel(rate, 2.55), 2.5, 3.3, order=4)["torque"]
    kept[rate] = passed.iloc[1000:3000].abs().max()
    print(f"rate {rate:g} Hz: 2.5 to 3.3 Hz pass {kept[rate]:.0f} of 100 Nm at 2.55 Hz")
same = same and kept[12.5] < 0.5 * kept[12.0]
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
