"""What is said when parameters of a gear mesh contradict each other."""

from __future__ import annotations

import math
from typing import Any

from ._rules import Rule

_ALWAYS = "so large that a pair is always in contact"


def _shape(p: Any) -> tuple[float, float, float, float]:
    return p.gear_ratio, float(p.pinion_teeth), p.pressure_angle, p.addendum


def _interference(p: Any) -> str:
    from ..kernels import gear_constants as g

    least = math.floor(g.least_teeth(p.gear_ratio, p.pressure_angle, p.addendum)) + 1
    return (
        f"pinion_teeth = {p.pinion_teeth!r}, allowed: {least} and more for gear_ratio = "
        f"{p.gear_ratio:g}, pressure_angle = {math.degrees(p.pressure_angle):g} deg, addendum "
        f"= {p.addendum:g} (with fewer the gear's tips cut below the pinion's involute: "
        "interference)"
    )


def _contact_ratio(p: Any) -> str:
    from ..kernels import gear_constants as g

    contact = sum(g.path_lengths(*_shape(p), g.start_of_contact(*_shape(p))))
    return (
        f"addendum = {p.addendum!r}, allowed: {_ALWAYS}; the contact ratio is {contact:.4g}, "
        "allowed: 1 and more"
    )


def _base_friction(p: Any) -> str:
    import numpy as np

    from ..kernels.gear_constants import effective_roughness
    from ._params import as_numbers

    s = effective_roughness(np.array(as_numbers(p)))
    return (
        f"f0 = {p.f0!r}, allowed: {0.0864 - 1372.0 * s:.4g} .. 1 for effective_roughness = {s:g} "
        "(below, a thick film would have negative friction)"
    )


def _slide_roll(p: Any) -> str:
    from ..kernels import gear_constants as g

    found = g.slide_roll(p.gear_ratio, g.start_of_contact(*_shape(p)))
    return (
        "friction_law = 'li-seireg', allowed: for slide/roll ratios above 0.27 only, here "
        f"{found:.4g} at the start of contact (pinion_teeth = {p.pinion_teeth!r}); use "
        "friction_law = 'iso'"
    )


RULES = (
    Rule("pinion_teeth = {pinion_teeth}, allowed: more for gear_ratio = {gear_ratio}, "
         "pressure_angle = {pressure_angle} rad, addendum = {addendum} (with so few the gear's "
         "tips cut below the pinion's involute: interference)", _interference),
    Rule(f"addendum = {{addendum}}, allowed: {_ALWAYS} (contact ratio 1 and more)",
         _contact_ratio),
    Rule("effective_roughness = {effective_roughness}, allowed: 7.459e-06 .. 6.297e-05 for "
         "friction_law = 'li-seireg' (0: that of the surface)"),
    Rule("f0 = {f0}, allowed: 0.0864 - 1372 effective_roughness .. 1 "
         "(below, a thick film would have negative friction)", _base_friction),
    Rule("friction_law = 'li-seireg', allowed: for slide/roll ratios above 0.27 only, not reached "
         "at the start of contact (pinion_teeth = {pinion_teeth}); use friction_law = 'iso'",
         _slide_roll),
)  # fmt: skip
