"""Events of FMI 3.0 as FMPy handles them: where a step ends, and that nothing else is different."""

import numpy as np
import pytest
from built import built_fmu
from fmpy import simulate_fmu

H = 0.01
# The engine's torque falls from 200 to 50 N m; a brake of 180 N m breaks away, a clutch of 150 N m
# locks. No input changes, so that the step does not matter.
UPSHIFT = {
    "engine_torque_points": 2,
    "engine_torque_time_1": 0.0,
    "engine_torque_time_2": 0.5,
    "engine_torque_1": 200.0,
    "engine_torque_2": 50.0,
    "clutch_torque": 150.0,
    "brake_torque": 180.0,
}
FLAGS = ["brake_locked", "clutch_locked"]
MOTION = ["engine_speed", "drum_speed", "release_time", "lock_time", "engine_work", "clutch_heat"]
internal = {"use_event_mode": False, "early_return_allowed": False}
at_steps = {"use_event_mode": True, "early_return_allowed": False}
early = {"use_event_mode": True, "early_return_allowed": True}


@pytest.fixture(scope="module")
def transmission():
    return str(built_fmu("transmission", fmi=3, local=True))


@pytest.fixture(scope="module")
def washer():
    return str(built_fmu("washer", fmi=3, local=True))


def shifted(fmu, step, how):
    return simulate_fmu(
        fmu,
        stop_time=1.5,
        output_interval=step,
        start_values=UPSHIFT,
        output=FLAGS + MOTION,
        **how,
    )


def changes(result, name):
    """Return the times of the rows where a flag has just changed."""
    flag = result[name].astype(int)
    return result["time"][1:][np.diff(flag) != 0]


def at_points(result, step):
    """Return the last row at each regular communication point."""
    points = np.arange(round(1.5 / step) + 1) * step
    return result[np.searchsorted(result["time"], points + 1e-9) - 1]


def test_steps_end_at_break_away_and_lock_up(transmission):
    """To 1e-6 s at steps of 10 ms, next to a run of 0.1 ms steps that handles them inside."""
    fine, coarse = shifted(transmission, 1e-4, internal), shifted(transmission, H, early)
    (broke_away,), (locked,) = (changes(coarse, name) for name in FLAGS)
    assert broke_away == pytest.approx(fine["release_time"][-1], abs=1e-6)
    assert locked == pytest.approx(fine["lock_time"][-1], abs=1e-6)
    for instant in (broke_away, locked):
        assert abs(instant / H - round(instant / H)) > 0.1


@pytest.mark.parametrize("how", [at_steps, early], ids=["event mode", "early return"])
def test_between_events_all_hosts_see_the_same(transmission, how):
    plain, other = shifted(transmission, H, internal), shifted(transmission, H, how)
    a, b = at_points(plain, H), at_points(other, H)
    rtol = 0.0 if how is at_steps else 1e-9  # an early return divides a step
    for name in FLAGS + MOTION:
        np.testing.assert_allclose(b[name], a[name], rtol=rtol, atol=1e3 * rtol, err_msg=name)


def test_without_early_return_events_are_told_at_the_end_of_the_step(transmission):
    result = shifted(transmission, H, at_steps)
    for name in FLAGS:
        (instant,) = changes(result, name)
        assert instant / H == pytest.approx(round(instant / H), abs=1e-9)
        assert (result["time"] == instant).sum() == 2  # before and after event mode


def loaded(fmu, h, how, **start):
    """A washer whose load rises over the fold where its film is lost, and falls again."""
    rows = [(0.0, 200.0), (1.0, 2500.0), (2.0, 100.0)]
    load = np.array(rows, dtype=[("time", float), ("load", float)])
    return simulate_fmu(
        fmu,
        stop_time=2.0,
        output_interval=h,
        input=load,
        output=["distress", "film_ratio", "energy"],
        start_values=start,
        **how,
    )


def test_a_steady_washer_loses_and_regains_its_film_where_the_load_is_set(washer):
    """Without a memory the film follows the load at once: the event is at the step's beginning."""
    plain, found = loaded(washer, 0.02, internal), loaded(washer, 0.02, early)
    lost, regained = changes(found, "distress")
    assert changes(plain, "distress") == pytest.approx([lost + 0.02, regained + 0.02])
    assert plain["energy"][-1] == found["energy"][-1]


@pytest.mark.slow
def test_a_washer_with_a_memory_loses_its_film_within_a_step(washer):
    """Next to a run that is asked at the instant and just before it: flag false, then true."""
    found = loaded(washer, 0.02, early, thermal_mode=2)
    lost, _ = changes(found, "distress")
    start = np.floor(lost / 0.02) * 0.02
    assert 1e-4 < lost - start < 0.02 - 1e-4
    for end, expected in ((lost, 1), (lost - 2e-7, 0)):
        load = np.array([(0.0, 200.0), (1.0, 2500.0)], dtype=[("time", float), ("load", float)])
        result = simulate_fmu(
            washer,
            stop_time=end,
            output_interval=0.02,
            input=load,
            output=["distress"],
            start_values={"thermal_mode": 2},
        )
        assert result["distress"][-1] == expected
