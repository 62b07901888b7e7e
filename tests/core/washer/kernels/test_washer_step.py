"""The washer behind the step ABI: what may change, what must not, and what survives."""

from kernel_part import Part

from thrustwasher import solve_washer
from thrustwasher.errors import Status
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.regime_and_status import BOUNDARY, FILM
from thrustwasher.washer.parameters import WasherParams


def stepped(*inputs):
    """Return a washer after a step of 1 ms from nothing."""
    washer = Part("washer", "field")
    assert washer.step(inputs, 1e-3) == Status.OK
    return washer


def test_distress_and_regime_are_told():
    """Past the fold: distress; back below the lower one: none."""
    washer, told = Part("washer", "field"), []
    for load in (300.0, 800.0, 1100.0, 800.0, 500.0):
        assert washer.step((load, 545.0, 0.002, 297.15), 1e-3) == Status.OK
        told.append((washer.iout[L.IO_REGIME], washer.iout[L.IO_STATUS]))
    film, boundary = (FILM, Status.OK), (BOUNDARY, Status.DISTRESS)
    assert told == [film, film, boundary, boundary, film]


def test_a_spot_above_250_degc_is_hot_unless_the_film_is_lost():
    """On a single-valued curve; the result in Python has the same status."""
    washer = stepped(1400.0, 300.0, 0.0012, 400.0)
    assert washer.out[L.O_PEAK] > L.HOT_LIMIT and not washer.iout[L.IO_DISTRESS]
    assert washer.iout[L.IO_STATUS] == Status.HOT
    point = {"load": 1400.0, "speed": 300.0, "tilt": 0.0012, "oil_temperature": 400.0}
    r = solve_washer(WasherParams(), **point)
    assert r.status is Status.HOT and r.temperature_max > L.HOT_LIMIT
    assert Status.HOT.advice in " ".join(r.warnings)


def test_outside_the_verified_range_is_told():
    heavy, cold = stepped(5000.0, 545.0, 0.002, 297.15), stepped(100.0, 545.0, 0.002, 250.0)
    assert heavy.iout[L.IO_STATUS] in (Status.OUTSIDE_VERIFIED, Status.DISTRESS)
    assert cold.iout[L.IO_STATUS] == Status.OUTSIDE_VERIFIED
