"""Recordings that lack rows or values: what goes on, what is named, what is not made up."""

from functools import cache

import numpy as np
import pytest
from rigs import OIL, PACK, history

from thrustwasher import ClutchParams, ParameterError, calibrate_traces, engage_clutch


@cache
def stopped(scale, inertia=0.25, steps=25):
    """Return a recording of a wheel that a pack stops, by repeated integration of its torque.

    Tests share it: they only read it.
    """
    way = history(601) | {"speed": np.full(601, 300.0)}
    for _ in range(steps):
        made = engage_clutch(ClutchParams(friction_scale=scale), **way, oil_temperature=OIL)
        torque = made.friction_torque
        area = 0.5 * (torque[1:] + torque[:-1]) * np.diff(way["time"])
        way["speed"] = np.maximum(300.0 - np.append(0.0, np.cumsum(area)) / inertia, 0.0)
    return {**way, "oil_temperature": OIL, "friction_torque": torque}


def without(data, low, high):
    """Return a recording without its rows between two times [s]."""
    kept = (data["time"] <= low) | (data["time"] >= high)
    return {name: x[kept] if np.ndim(x) else x for name, x in data.items()}


WHEEL = {"inertia": 0.25, "errors": {"slip": 0.3, "friction_torque": 1.0}}


@pytest.mark.parametrize(
    ("low", "about"),
    [
        (0.08, {}),
        pytest.param(0.12, WHEEL, marks=pytest.mark.slow),
        pytest.param(0.2, {}, marks=pytest.mark.slow),
        (0.3, WHEEL),
    ],
    ids=str,
)
def test_a_short_gap_in_an_engagement_carries_film_and_heat_on(low, about):
    """The same recording without its gap gives 0.9 too; two recordings would give 0.87 .. 0.895."""
    data = without(stopped(0.9), low, low + 0.03)
    found = calibrate_traces(PACK, data, fit=["friction_scale"], **about)
    assert found["friction_scale"].value == pytest.approx(0.9, rel=5e-4)
    assert found.engagements == 1 and not found.warnings
    assert any("1 gap up to 30 ms bridged" in text for text in found.notes)


def test_a_recording_that_starts_under_load_is_named_and_counted_beside_the_number():
    data = without(stopped(0.9), 0.15, 0.26)  # longer than what is bridged
    found = calibrate_traces(PACK, data, fit=["friction_scale"])
    assert len(found.points.runs) == 2
    assert "(452 friction_torque) of 2 recordings" in str(found)
    assert any("starts under load (5 kN at 0.26 s)" in text for text in found.warnings)


def test_slip_is_found_by_torque_only_where_that_is_recorded():
    """A torque that ends at 0.3 s says nothing of the slip behind."""
    data = stopped(0.9)
    torque = np.where(data["time"] <= 0.3, data["friction_torque"], np.nan)
    given = {n: x for n, x in data.items() if n != "speed"} | {"friction_torque": torque}
    found = calibrate_traces(PACK, given, fit=["friction_scale"], inertia=0.25, at={"speed": 300.0})
    assert found["friction_scale"].value == pytest.approx(0.9, rel=1e-4)
    assert found.time.max() == pytest.approx(0.3)
    short = given | {"friction_torque": np.where(data["time"] <= 0.003, torque, np.nan)}
    with pytest.raises(ParameterError, match="friction_torque has 4 values from 0 to"):
        calibrate_traces(PACK, short, fit=["friction_scale"], inertia=0.25, at={"speed": 300.0})


def test_a_piece_in_which_an_output_is_missing_counts_by_the_others():
    """Temperature is recorded in the first of two engagements only."""
    data = stopped(0.9)
    twice = {n: np.concatenate([x, x]) for n, x in data.items() if np.ndim(x)}
    twice["time"][601:] += 10.0
    way = {n: data[n] for n in ("time", "load", "speed")}
    warm = engage_clutch(ClutchParams(friction_scale=0.9), **way, oil_temperature=OIL).temperature
    twice["temperature"] = np.append(warm, np.full(601, np.nan))
    errors = {"temperature": 1.0, "friction_torque": 1.0}
    given = twice | {"oil_temperature": OIL}
    found = calibrate_traces(PACK, given, fit=["friction_scale"], errors=errors)
    assert found["friction_scale"].value == pytest.approx(0.9, rel=1e-4)
    assert found.points.output.count("temperature") < found.points.output.count("friction_torque")


def test_a_recording_whose_second_row_is_pressed_does_not_start_under_load():
    whole = stopped(0.9)
    first = int(np.argmax(whole["load"] > 0.0)) - 1
    data = {n: x[first::5] if np.ndim(x) else x for n, x in whole.items()}
    data["load"] = np.concatenate([[0.0], np.full(len(data["load"]) - 1, data["load"].max())])
    found = calibrate_traces(PACK, data, fit=["friction_scale"])
    assert not any("starts under load" in text for text in found.warnings)
