"""Washers of every size: alike ones give alike answers, narrow faces those of a finer mesh."""

from dataclasses import replace

import pytest

from thrustwasher import SolveError, WasherParams, solve_washer

LENGTHS = (
    "inner_radius",
    "outer_radius",
    "gear_inner_radius",
    "carrier_thickness",
    "washer_thickness",
    "gear_thickness",
    "roughness",
    "asperity_radius",
)
ROUGH = WasherParams(asperity_density=6e9, roughness=1.4e-6, viscosity_scale=1.2e-4)
SMOOTH = WasherParams(asperity_density=6e9, roughness=5e-7, viscosity_scale=5e-5)


def alike(params, size):
    """Return a washer of another size with the same pressures, temperatures and film ratios.

    Viscosity times speed stays, so does the heat: as much of it goes through bodies of ``size``
    times the length as before.
    """
    lengths = {name: getattr(params, name) * size for name in LENGTHS}
    density = params.asperity_density / size**2
    viscosity = params.viscosity_scale * size**2
    return replace(params, **lengths, asperity_density=density, viscosity_scale=viscosity)


@pytest.mark.parametrize(
    ("params", "size"), [(ROUGH, 0.1102), (SMOOTH, 13.2)], ids=["5 mm", "0.6 m"]
)
@pytest.mark.parametrize(("load", "speed"), [(90.0, 18.0), (300.0, 24.0), (1100.0, 10.0)])
def test_washers_that_are_alike_answer_alike(params, size, load, speed):
    speed = speed if size < 1.0 else 30.0 * speed
    other = alike(params, size)
    point = {"tilt": 0.002, "oil_temperature": 330.0}
    one = solve_washer(params, load=load, speed=speed, **point)
    scaled = solve_washer(other, load=load * size**2, speed=speed / size**2, **point)
    assert scaled.branch == one.branch
    assert scaled.friction_torque == pytest.approx(one.friction_torque * size**3, rel=1e-8)
    assert scaled.temperature == pytest.approx(one.temperature, rel=1e-9)
    assert scaled.film_ratio == pytest.approx(one.film_ratio, rel=1e-7)


@pytest.mark.parametrize("width", [1e-4, 5e-4, 9e-4])
def test_a_face_below_a_millimetre_is_as_on_the_finer_mesh(width):
    radii = {"inner_radius": 0.0227 - width, "gear_inner_radius": 0.0227 - 0.5 * width}
    narrow = WasherParams(outer_radius=0.0227, **radii)
    point = {"load": 5.0, "speed": 300.0, "tilt": 0.001}
    usual, fine = (solve_washer(narrow, **point, fidelity=level) for level in ("field", "fine"))
    assert usual.friction_torque == pytest.approx(fine.friction_torque, rel=2e-3)


@pytest.mark.slow
def test_a_face_like_a_hair_is_said_to_be_too_hard():
    radii = {"inner_radius": 0.02269, "gear_inner_radius": 0.022695}
    with pytest.raises(SolveError, match="work"):
        solve_washer(WasherParams(outer_radius=0.0227, **radii), load=5.0, speed=300.0, tilt=0.001)
