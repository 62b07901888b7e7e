#!/usr/bin/env bash
# What:   `kin2dyn` and `dyn2kin` of the package tribology, which change kinematic viscosity
#         into dynamic viscosity and back.
# Guess:  eta = nu * rho, so water at 20 C (1.004 mm2/s, 998.2 kg/m3) gives 1.002 mPa s.
# Seen:   kin2dyn returns nu / rho and dyn2kin returns eta * rho. There and back gives the first
#         number again, so a round-trip test finds nothing.
# Matters to everybody who puts an oil of a data sheet (cSt and density) into a film thickness,
#         a drag torque or a Reynolds number: the viscosity is too small by rho squared.
# Version: tribology 0.4.5
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
python3.11 -m venv "$dir/v" || exit 2
"$dir/v/bin/pip" install --disable-pip-version-check tribology==0.4.5 numpy==2.4.6 scipy==1.17.1 \
    numexpr==2.14.2 matplotlib==3.11.2 pillow==13.0.0 opencv-python-headless==5.0.0.93 \
    setuptools==80.9.0 >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
MPLCONFIGDIR="$dir" "$dir/v/bin/python" -W ignore - <<'PY'
from importlib.metadata import version

import tribology

NU, RHO = 1.004e-6, 998.2  # water at 20 C: m2/s, kg/m3; its dynamic viscosity is 1.002e-3 Pa s
eta = tribology.kin2dyn(NU, RHO)
nu = tribology.dyn2kin(1.002e-3, RHO)
back = tribology.dyn2kin(eta, RHO)
print("tribology", version("tribology"))
print(f"guess: kin2dyn(1.004e-6 m2/s, 998.2 kg/m3) = {NU * RHO:.3e} Pa s")
print(f"seen:  {eta:.3e}, which is the guess divided by {NU * RHO / eta:.0f} (rho squared)")
print(f"guess: dyn2kin(1.002e-3 Pa s, 998.2 kg/m3) = {1.002e-3 / RHO:.3e} m2/s")
print(f"seen:  {nu:.3e}")
print(f"there and back: {back:.3e} m2/s, so a round trip shows nothing")
same = (
    abs(eta * RHO / NU - 1) < 1e-9
    and abs(nu / (1.002e-3 * RHO) - 1) < 1e-9
    and abs(back / NU - 1) < 1e-9
)
print("as described" if same else "CHANGED")
raise SystemExit(0 if same else 1)
PY
