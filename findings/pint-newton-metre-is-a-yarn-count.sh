#!/usr/bin/env bash
# What:   the unit text "Nm" in pint, as measurement files, FMUs and data sheets write a torque.
# Guess:  newton metre, or an error that the unit is not defined.
# Seen:   "Nm" is the number metric of the textile trade, 1000 m/kg. So are "kNm" and "mNm", and a
#         stiffness in "Nm/rad" is one per radian. The value is shown as "12 Nm" all the same.
#         In base units its number is 12000, not 12. "N*m", "N m" and "newton_meter" are torques.
# Matters to who takes the units of channels as they stand and calculates in base units: each
#         torque is 1000 times too large, and the text that is printed looks right.
# Version: pint 0.25.3
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check pint==0.25.3 >"$dir/log" 2>&1 ||
    { cat "$dir/log" >&2; exit 2; }
"$dir/v/bin/python" -W ignore - <<'PY'
from importlib.metadata import version

import pint

ureg = pint.UnitRegistry(cache_folder=None)
FACTORS = {"Nm": 1.0, "mNm": 1e-3, "kNm": 1e3, "Nm/rad": 1.0}
print("pint", version("pint"))
same = True
for text, factor in FACTORS.items():
    torque = ureg.Quantity(12.0, text)
    base = torque.to_base_units()
    print(f"12 {text}: guess {12 * factor:g} in base units, seen {base:~}; shown as '{torque:~P}'")
    same = same and f"{torque:~P}" in (f"12 {text}", f"12.0 {text}")
    same = same and abs(base.magnitude / (12e3 * factor) - 1) < 1e-9
    same = same and torque.check("[length] / [mass]")
for text in ("N*m", "N m"):
    torque = ureg.Quantity(12.0, text)
    print(f"12 {text}: {torque.to_base_units():~}")
    same = same and torque.check("[energy]") and torque.to_base_units().magnitude == 12.0
try:
    print((ureg.Quantity(12.0, "Nm") * ureg.Quantity(100.0, "rad/s")).to("W"))
    same = False
except pint.DimensionalityError as err:
    print("torque times speed to W:", err)
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
