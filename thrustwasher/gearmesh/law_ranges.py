"""The ranges of the mesh's empirical laws, and which of them a point or a pair is outside of."""

import math
from collections.abc import Iterator
from typing import Any

from ..model.advice import LawRange
from .kernels import constants
from .kernels import layout as k
from .kernels.contact import BOUNDARY_SPEED
from .kernels.working_pair import gear_shift
from .parameter_array import as_array
from .parameters import GearMeshParams

FRICTION = ("iso", "mixed", "schlenk")  # laws with a mean coefficient
MEMORY = "as usually quoted; the text was not at hand"
MEAN = "the mean coefficients of friction"
EXTRAPOLATED = "loss, flash and scuffing_safety are extrapolated"
LOAD = LawRange(
    MEAN,
    "load F_bt/b",
    "N/mm",
    150.0,
    math.inf,
    "real friction is higher than theirs; loss and flash are a lower bound",
    f"minimum load of DIN 3990-4 and ISO/TR 13989-1, {MEMORY}. FZG loss tests (FVA 345) begin with "
    "load stage 5, 94 N m: 199 N/mm on gears C of 14 mm",
)
SLOW = LawRange(
    MEAN, "speed at the pitch line", "m/s", BOUNDARY_SPEED, 50.0, EXTRAPOLATED, f"ibid., {MEMORY}"
)
STIFF = LawRange(
    "the stiffness of a pair",
    "load K F_t/b",
    "N/mm",
    100.0,
    1600.0,
    "shares and loss_factor are extrapolated",
    f"ISO 6336-1, method B, {MEMORY}",
)
SHIFTS = LawRange(
    "the stiffness of a pair",
    "sum of the profile shifts",
    "",
    -0.5,
    2.0,
    "shares and loss_factor are extrapolated",
    f"ISO 6336-1, method B, {MEMORY}",
)
RATING = "of ISO 6336 for flank and root"
CONTACT = LawRange(
    f"the formulas {RATING}",
    "contact ratio",
    "",
    1.0,
    2.5,
    "pitting_stress and root_stress are extrapolated",
    f"ISO 6336-1, scope, {MEMORY}",
)
HELIX = LawRange(
    f"the formulas {RATING}",
    "helix_angle",
    "deg",
    0.0,
    30.0,
    "their results are to be confirmed by tests",
    f"ISO 6336-1, scope, {MEMORY}",
)
ANGLE = LawRange(
    f"the formulas {RATING}",
    "pressure_angle",
    "deg",
    15.0,
    25.0,
    "their results are to be confirmed by tests",
    f"ISO 6336-1, scope, {MEMORY}",
)
SHORT = "outside ISO 6336"
LAW_RANGES = (LOAD, SLOW, STIFF, SHIFTS, CONTACT, HELIX, ANGLE)


def outside_of_pair(p: GearMeshParams) -> Iterator[str]:
    """Yield what of the parameters lies outside the range of a law."""
    par = as_array(p)
    contact = sum(constants.path_of(par)[1:])
    found = [
        CONTACT.line(contact) if contact >= 1.0 else _short(contact, constants.overlap_ratio(par)),
        HELIX.line(math.degrees(p.helix_angle)),
        ANGLE.line(math.degrees(p.pressure_angle)),
    ]
    if p.load_sharing == "elastic" and not p.internal:
        found.append(SHIFTS.line(p.profile_shift_pinion + float(gear_shift(par))))
    yield from (line for line in found if line)


def _short(contact: float, overlap: float) -> str:
    return (
        f"contact ratio = {contact:.4g} with an overlap of {overlap:.4g}: {SHORT}, whose formulas "
        "begin at 1: all safeties, pitting_stress and root_stress are extrapolated; loss, pressure "
        "and flash follow the lines of contact"
    )


def outside_of_point(p: GearMeshParams, par: Any, torque: float, speed: float) -> Iterator[str]:
    """Yield which laws a torque [N m] and a speed [rad/s], sizes both, are outside the range of."""
    load, found = 1e-3 * torque * float(par[k.D_LOAD]), []
    if p.friction_law in FRICTION and p.film_heat == "loss":
        pitch_line = float(par[k.D_ROLLING]) * speed / (2.0 * math.sin(par[k.D_ANGLE]))
        found.append(LOAD.line(load))
        if p.friction_law == "iso" or pitch_line > BOUNDARY_SPEED:  # else said in other words
            found.append(SLOW.line(pitch_line))
    if p.load_sharing == "elastic":
        factor = float(par[k.D_FACTOR]) * math.cos(par[k.D_ANGLE])
        found.append(STIFF.line(factor * load))
    yield from (line for line in found if line)
