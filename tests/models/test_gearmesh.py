"""The gear mesh as a library: numbers at the operating points of the paper, ranges, messages."""

import pytest

from thrustwasher import GearMeshParams, solve_gearmesh

POINT = {"power": 7500.0, "speed": 180.0}
CASES = [(2, 20), (2, 30), (5, 20), (5, 30)]


def at(ratio, teeth, preset="bounded", **changes):
    params = GearMeshParams.preset(preset, gear_ratio=ratio, pinion_teeth=teeth, **changes)
    return solve_gearmesh(params, **POINT)


# gear ratio, teeth: x_s, V_s [m/s], p0 [MPa], film ratio rough and fine, flash rise rough and fine
CONTACT = [
    (2, 20, 0.08683, 5.782, 233.5, 1.397, 5.580, 27.14, 15.37),
    (2, 30, 0.16217, 4.015, 178.4, 1.846, 7.372, 12.12, 6.82),
    (5, 20, 0.03342, 2.500, 517.4, 0.471, 1.880, 39.98, 22.55),
    (5, 30, 0.07598, 1.702, 350.9, 0.725, 2.895, 15.06, 8.38),
]


@pytest.mark.parametrize(("ratio", "teeth", "xs", "slide", "p0", "lr", "lf", "fr", "ff"), CONTACT)
def test_contact_film_and_flash_at_the_papers_points(ratio, teeth, xs, slide, p0, lr, lf, fr, ff):
    rough = at(ratio, teeth, viscosity_at="inlet")
    fine = at(ratio, teeth, viscosity_at="inlet", surface="fine")
    assert rough.start_of_contact == pytest.approx(xs, abs=6e-6)
    assert rough.sliding_speed == pytest.approx(slide, abs=6e-4)
    assert rough.hertz_pressure == pytest.approx(p0 * 1e6, abs=6e4)
    assert (rough.film_ratio, fine.film_ratio) == pytest.approx((lr, lf), abs=6e-4)
    assert (rough.flash_rise, fine.flash_rise) == pytest.approx((fr, ff), abs=6e-3)
