"""The rim of a map: its last point, the first one outside, and the rim that is a fold.

Hazard: a table read past its end extrapolates, and its numbers look like any others; a table read
    up to a fold reads across it; and a host that walks along the rim flickers between two levels.
Formula: inside is low <= value <= high, both ends included; one unit in the last place decides.
    Near film_lost the film ratio goes like sqrt(1 - load/load_lost): no polynomial in the load.
Cure: outside the box the map says nothing and the field answers, under its own name; the fold is
    a chart of its own, and loads are looked up along the film ratio.
"""

import math

import numpy as np
import pytest

from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import BranchError, Status
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.parameters import SPEC

MIDDLE = {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 300.0}


@pytest.fixture(scope="module")
def shipped():
    return WasherMap(WasherParams())


def rims(shipped):
    """Yield (input, value at a rim, direction outwards); a box from zero speed on has one end."""
    for name, (low, high) in shipped.box.items():
        if low > 0.0:
            yield name, low, -1.0
        yield name, high, 1.0


def test_one_unit_in_the_last_place_of_the_load_decides(shipped):
    for rim, out in zip(shipped.box["load"], (-math.inf, math.inf), strict=True):
        assert shipped.covers(**{**MIDDLE, "load": rim})
        assert not shipped.covers(**{**MIDDLE, "load": math.nextafter(rim, out)})


def test_a_billionth_of_the_other_inputs_decides(shipped):
    """Their limits are kept as logarithms: what is lost in taking those is inside."""
    for name, rim, out in rims(shipped):
        assert shipped.covers(**{**MIDDLE, name: rim}), name
        assert not shipped.covers(**{**MIDDLE, name: rim * (1.0 + 2e-8 * out)}), name


def test_inside_and_outside_of_the_rim_agree_and_bear_their_names(shipped):
    for name, rim, out in rims(shipped):
        last = solve_washer(WasherParams(), **{**MIDDLE, name: rim}, fidelity="map")
        place = {**MIDDLE, name: rim * (1.0 + 2e-8 * out)}
        first = solve_washer(WasherParams(), **place, fidelity="map")
        assert (last.fidelity, first.fidelity) == ("map", "field"), name
        said = Status.OUTSIDE_MAP if last.status is Status.OK else last.status
        assert first.status is said and not last.status.is_failure, name
        assert last.friction_torque == pytest.approx(first.friction_torque, rel=5e-3), name


def test_outside_rows_are_no_numbers_and_say_so(shipped):
    loads = np.array([shipped.box["load"][1] * 1.5, 300.0])
    rows = shipped.look_up(load=loads, speed=545.0, tilt=0.002, oil_temperature=300.0)
    assert rows["branch"].tolist() == [-1.0, 1.0]
    assert math.isnan(rows["friction_torque"][0]) and rows["friction_torque"][1] > 0.0


def test_an_fmu_walks_over_the_rim_and_back_without_a_jump(shipped):
    """At the rim map and field differ by the verified error; the memory goes over with it."""
    speed = shipped.box["speed"][1]
    washer = DirectInstance(SPEC, parameters={"fidelity": "map"})
    washer.initialize(0.0, {**MIDDLE, "speed": speed})
    torques = []
    for i, off in enumerate((-1e-9, 1e-9, 0.0, 1e-12, -1e-12, 1e-6, -1e-6)):
        washer.set_inputs([300.0, speed * (1.0 + off), 0.002, 300.0])
        washer.step(i * 1e-3, 1e-3)
        torque, status = washer.get(["friction_torque", "solver_status"])
        assert status < 10.0
        torques.append(torque)
    assert max(torques) == pytest.approx(min(torques), rel=5e-3)


@pytest.mark.parametrize("speed", [300.0, 545.0, 900.0])
def test_up_to_the_fold_the_film_is_read_and_past_it_the_contact(shipped, speed):
    place = {"speed": speed, "tilt": 0.002, "oil_temperature": 300.0}
    lost, regained = (f.load for f in shipped.folds(**place))
    for share in (0.9, 0.99, 0.999, 1.0 - 2e-5):
        r = solve_washer(WasherParams(), load=share * lost, **place, fidelity="map")
        assert (r.fidelity, r.branch, r.distress) == ("map", "film", False)
    for share in (1.0 + 2e-5, 1.001, 1.1):
        r = solve_washer(WasherParams(), load=share * lost, **place, fidelity="map")
        assert (r.branch, r.distress) == ("contact", True)
        with pytest.raises(BranchError):
            solve_washer(WasherParams(), load=share * lost, **place, fidelity="map", branch="film")
    held = solve_washer(
        WasherParams(), load=regained * (1.0 + 2e-5), **place, fidelity="map", branch="contact"
    )
    assert held.branch == "contact"


def test_near_the_fold_the_map_keeps_its_digits(shipped):
    """Like a square root: a table in the load would be off by a tenth here."""
    lost = shipped.folds(speed=545.0, tilt=0.002, oil_temperature=300.0)[0].load
    for share in (0.9, 0.99, 0.998):
        point = {**MIDDLE, "load": share * lost}
        here = solve_washer(WasherParams(), **point, fidelity="map")
        there = solve_washer(WasherParams(), **point, fidelity="fine")
        assert here.friction_torque == pytest.approx(there.friction_torque, rel=8e-3)
