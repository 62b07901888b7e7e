"""Methods that answer wrongly without a word do so where the map says, and no default is one."""

import numpy as np
import pytest

from thrustwasher.errors import Status
from thrustwasher.fidelity.stability import LIES, OK, coupling, liars, table
from thrustwasher.rivals import cavitation as c
from thrustwasher.rivals import lockup as k


def load(way, height, direction=1.0, n=23):
    pad = c.pad(height, n, direction)
    return way(pad).load / c.active_set(pad).load - 1.0


def test_active_sets_meet_the_complementarity_to_rounding():
    pad = c.pad(c.dimple, 23)
    film = c.active_set(pad)
    rest = c._rest(pad, film.pressure)
    scale = np.abs(pad.source).max()
    assert film.status is Status.OK and (film.pressure >= 0.0).all()
    assert np.abs(rest[film.pressure > 0.0]).max() < 1e-9 * scale
    assert (rest[film.pressure == 0.0] <= 1e-9 * scale).all()


def test_nested_meshes_find_the_same_film_in_fewer_solves():
    cold = c.active_set(c.pad(c.dimple, 32))
    nested = c.nested(lambda n: c.pad(c.dimple, n), 32)
    assert nested.load == pytest.approx(cold.load, rel=1e-12)
    assert nested.work < 0.5 * cold.work


def test_the_clamp_is_right_for_one_cavity_swept_the_right_way_only():
    assert abs(load(c.clamp, c.one_wave)) < 1e-3
    assert load(c.clamp, c.one_wave, -1.0) < -0.1
    assert load(c.clamp, c.two_waves) < -0.2
    assert load(c.clamp, c.two_waves, n=47) < -0.2  # refinement does not cure it


def test_cutting_negatives_afterwards_is_wrong_wherever_there_is_a_cavity():
    for height in (c.one_wave, c.two_waves, c.waves_and_tilt, c.dimple):
        assert load(c.cut, height) < -0.15


def test_a_stop_on_the_change_of_a_sweep_stops_too_early_on_fine_meshes():
    errors = [abs(load(c.relax_change, c.two_waves, n=n)) for n in (15, 31, 63)]
    assert errors[0] < errors[1] < errors[2] and errors[2] > 0.02


def test_a_stop_on_the_residual_does_not():
    assert abs(load(c.relax_rest, c.two_waves, n=63)) < 1e-5


def test_located_lock_up_is_exact_whatever_the_step():
    clutch = k.Clutch()
    for step in (1e-4, 7e-3, 5e-2):
        course = k.located(clutch, step)
        assert course.energy == pytest.approx(clutch.slip_energy, rel=1e-9)
        assert course.slip[-1] == 0.0


def test_gauss_seidel_bears_steps_twice_as_long_as_jacobi():
    """Without overshoot to kappa = H c/J of 1 and 1/4; unstable from 2 and 1 on."""
    clutch = k.Clutch(drive=0.0, slip=0.01, span=0.2)
    stiffness = clutch.friction / clutch.width

    def last(way, kappa):
        return abs(way(clutch, kappa * clutch.inertia / stiffness).slip[-1])

    assert last(k.gauss_seidel, 1.9) < 1e-6 < last(k.gauss_seidel, 2.2)
    assert last(k.jacobi, 0.95) < 1e-3 < last(k.jacobi, 1.1)
    assert last(k.linearly_implicit, 100.0) < 1e-6


def test_explicit_steps_and_handed_torques_lie_at_lock_up_and_located_events_do_not():
    group = coupling()
    found = {method for method, _ in liars([{**vars(group), "cells": [
        [vars(cell) for cell in row] for row in group.cells]}])}  # fmt: skip
    assert "explicit fixed step (Runge-Kutta 4)" in found
    assert {"Gauss-Seidel, friction torque", "Jacobi, friction torque"} <= found
    assert "stick and slip, events located" not in found
    assert "LSODA, smoothed friction" not in found


def test_an_exception_is_a_way_of_saying_it():
    def judge(method, hazard):
        raise ValueError("no")

    assert table("", "", {"m": 1}, {"h": 1}, judge).cells[0][0].verdict == "says"
    assert OK != LIES


@pytest.mark.slow
def test_the_default_solver_is_no_liar_where_others_are():
    """Compiles the rival's loops for a minute."""
    from thrustwasher.fidelity.stability import balance

    group = balance()
    verdicts = {m: [cell.verdict for cell in row]
                for m, row in zip(group.methods, group.cells, strict=True)}  # fmt: skip
    assert set(verdicts["field, the package's default"]) == {OK}
    near = group.hazards.index("near a fold")
    assert verdicts["Newton, limited; temperatures substituted"][near] == LIES
    assert verdicts["Newton, limited; temperatures relaxed"][near] == OK
