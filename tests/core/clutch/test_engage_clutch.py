"""``engage_clutch``: what it takes, what it refuses, and that points are only samples."""

import numpy as np
import pytest

from thrustwasher import ClutchParams, ParameterError, Status, engage_clutch, release_clutch

PACK = ClutchParams()
T = np.linspace(0.0, 0.2, 21)


def test_one_number_stands_for_a_constant_profile():
    one = engage_clutch(PACK, time=T, load=5000.0, speed=100.0)
    many = engage_clutch(PACK, time=T, load=np.full(21, 5000.0), speed=np.full(21, 100.0))
    assert (one.friction_torque == many.friction_torque).all()


def test_points_are_samples_and_no_steps():
    """Straight profiles given by few or by many points end in the same film and heat."""
    ends = []
    for n in (2, 11, 401):
        t = np.linspace(0.0, 0.2, n)
        e = engage_clutch(PACK, time=t, load=6000.0 * t / 0.2, speed=300.0 - 1000.0 * t)
        ends.append([e.friction_torque[-1], e.temperature[-1], e.film_ratio[-1], e.energy[-1]])
    assert ends[0] == pytest.approx(ends[2], rel=2e-5)
    assert ends[1] == pytest.approx(ends[2], rel=2e-5)


@pytest.mark.parametrize("fidelity", ["closed", "stribeck", "field"])
def test_every_level_answers_with_the_same_fields(fidelity):
    e = engage_clutch(PACK, time=T, load=5000.0, speed=100.0, fidelity=fidelity)
    assert (e.status, e.fidelity, len(e.regime)) == (Status.OK, fidelity, 21)
    arrays = [v for v in e.as_dict().values() if isinstance(v, list) and v is not e.regime]
    assert {len(v) for v in arrays} == {21}
    assert (e.friction_power >= 0.0).all() and (np.diff(e.energy) >= 0.0).all()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"time": [0.0, 0.0]}, "at least two rising"),
        ({"time": [0.0, np.nan]}, r"time\[1\] = nan s"),
        ({"load": [1.0, 2.0]}, r"load: shape \(2,\)"),
        ({"load": -1.0}, r"load\[0\] = -1.0 N, allowed: 0 .."),
        ({"oil_temperature": 24.0}, "oil_temperature = 24.0 K"),
        ({"fidelity": "map"}, "fidelity = 'map'"),
    ],
)
def test_bad_input_is_named(given, message):
    with pytest.raises(ParameterError, match=message):
        engage_clutch(PACK, **({"time": T, "load": 5000.0, "speed": 100.0} | given))


def test_a_cold_release_is_told_with_its_drag_beside_a_warm_one():
    cold = release_clutch(ClutchParams(), load=5e3, speed=100.0, oil_temperature=253.15)
    warm = release_clutch(ClutchParams(), load=5e3, speed=100.0, oil_temperature=353.15)
    assert cold.friction_torque > 10.0 * warm.friction_torque > 1.0
    assert cold.energy > 5.0 * warm.energy and cold.open_after > 5.0 * warm.open_after
    time = [0.0, 0.1, 0.101, 0.201, 0.3]
    profile = {"time": time, "load": [5e3, 5e3, 0.0, 0.0, 0.0], "speed": 100.0}
    pack = ClutchParams(starts_pressed=True)
    told = engage_clutch(pack, **profile, oil_temperature=253.15).warnings
    assert len(told) == 1 and "let go at 0.101 s with oil of -20 °C: 0.1 s later" in told[0]
    for oil, level in ((353.15, "field"), (253.15, "stribeck")):
        assert engage_clutch(pack, **profile, oil_temperature=oil, fidelity=level).warnings == ()
