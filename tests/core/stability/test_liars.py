"""Methods that answer wrongly silently do so where the map says, and no default is one.

Hazard: a wrong number that looks like a right one is built upon; no test of a caller finds it.
Formula: the map's: load, film ratio, temperature, slip energy and swing's energy against truth.
Cure: none of these methods is imported by a solver, a level or a master that is taken by default,
    and the properties that they lack are asked of the defaults here.
"""

import ast
from pathlib import Path

import numpy as np
import pytest

import thrustwasher
from lab.benchmarks.failures import cavitation as c
from lab.benchmarks.failures import lockup as k
from lab.benchmarks.failures import shaft as s
from lab.benchmarks.failures.failure_cells import LIES, OK, SAYS, table
from lab.benchmarks.failures.failure_map import coupling
from lab.benchmarks.failures.failure_washer import Found, balance, closed_forms, judged
from lab.benchmarks.failures.heat_loop import heat_loop
from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import Status
from thrustwasher.shift import load_scene
from thrustwasher.transmission.parameters import TransmissionParams

from gearbox import Gearbox  # isort: skip

PACKAGE = Path(thrustwasher.__file__).parent
SCENES = list((PACKAGE / "shift" / "scenes").glob("*.toml"))


def load(way, height, direction=1.0, n=23):
    pad = c.pad(height, n, direction)
    return way(pad).load / c.active_set(pad).load - 1.0


def verdicts(group):
    return {
        m: dict(zip(group.hazards, (cell.verdict for cell in row), strict=True))
        for m, row in zip(group.methods, group.cells, strict=True)
    }


# Structure: nothing that solves imports a rival, and the defaults are the ways that do not lie.


def imported(path):
    """Return all modules that a file imports, as it writes them."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module or ''}.{name.name}" for name in node.names)


@pytest.mark.slow
def test_nothing_in_the_package_imports_a_rival():
    guilty = [
        str(path.relative_to(PACKAGE))
        for path in PACKAGE.rglob("*.py")
        if any("failures" in name for name in imported(path))
    ]
    assert guilty == []


def test_no_shipped_scene_hands_over_torques_and_no_default_does():
    assert SCENES
    assert TransmissionParams().coupling == "capacity"
    for path in SCENES:
        scene = load_scene(path.stem)
        assert scene.parts["transmission"].params.coupling == "capacity", path.stem
        assert scene.master == "gauss-seidel", path.stem


def test_default_levels_are_solved_and_not_looked_up_or_closed():
    from thrustwasher.clutch import parameters
    from thrustwasher.gearmesh import parameters as gearmesh_params
    from thrustwasher.washer import parameters as washer_params

    for spec in (washer_params.SPEC, parameters.SPEC, gearmesh_params.SPEC):
        assert spec.default_fidelity == "field"


# Cavitating films.


def test_active_sets_meet_the_complementarity_to_rounding():
    pad = c.pad("dimple", 23)
    film = c.active_set(pad)
    rest = c._rest(pad, film.pressure)
    scale = np.abs(pad.source).max()
    assert film.status is Status.OK and (film.pressure >= 0.0).all()
    assert np.abs(rest[film.pressure > 0.0]).max() < 1e-9 * scale
    assert (rest[film.pressure == 0.0] <= 1e-9 * scale).all()


def test_nested_meshes_find_the_same_film_in_fewer_solves():
    cold = c.active_set(c.pad("dimple", 32))
    nested = c.nested(lambda n: c.pad("dimple", n), 32)
    assert nested.load == pytest.approx(cold.load, rel=1e-12)
    assert nested.work < 0.5 * cold.work


def test_the_clamp_is_right_for_one_cavity_swept_the_right_way_only():
    assert abs(load(c.clamp, "one wave")) < 1e-3
    assert load(c.clamp, "one wave", -1.0) < -0.1
    assert load(c.clamp, "two waves") < -0.2
    assert load(c.clamp, "two waves", n=47) < -0.2  # refinement does not cure it


def test_cutting_negatives_afterwards_is_wrong_wherever_there_is_a_cavity():
    for height in ("one wave", "two waves", "waves and tilt", "dimple"):
        assert load(c.cut, height) < -0.15


def test_a_stop_on_the_change_of_a_sweep_stops_too_early_on_fine_meshes():
    errors = [abs(load(c.relax_change, "two waves", n=n)) for n in (15, 31, 63)]
    assert errors[0] < errors[1] < errors[2] and errors[2] > 0.02


def test_a_stop_on_the_residual_does_not():
    assert abs(load(c.relax_rest, "two waves", n=63)) < 1e-5


def test_the_washers_film_stops_on_the_residual_on_every_mesh():
    """Started from a neighbour it moves little in an iteration: that is no reason to stop."""
    for fidelity in ("field", "fine"):
        point = {"speed": 545.0, "tilt": 0.002, "fidelity": fidelity}
        near = solve_washer(WasherParams(), load=299.0, **point)
        warm = solve_washer(WasherParams(), load=300.0, **point, start=near)
        cold = solve_washer(WasherParams(), load=300.0, **point)
        assert abs(warm.fluid_load + warm.contact_load - 300.0) < 1e-4
        assert warm.friction_torque == pytest.approx(cold.friction_torque, rel=2e-5)


# Steps in time.


def test_located_lock_up_is_exact_whatever_the_step():
    clutch = k.Clutch()
    for step in (1e-4, 7e-3, 5e-2):
        profile = k.located(clutch, step)
        assert profile.energy == pytest.approx(clutch.slip_energy, rel=1e-9)
        assert profile.slip[-1] == 0.0


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
    found = verdicts(coupling(quick=True))
    for liar in (
        "explicit fixed step (Runge-Kutta 4)",
        "Gauss-Seidel, friction torque",
        "Jacobi, friction torque",
    ):
        assert set(found[liar].values()) == {LIES}
    for honest in (
        "stick and slip, events located",
        "LSODA, smoothed friction",
        "BDF, smoothed friction",
    ):
        assert set(found[honest].values()) == {OK}
    assert found["step doubling with rollback, friction torque"]["huge step, 50 ms"] != LIES


def test_the_drivelines_own_integration_does_not_know_the_step():
    """An explicit method all the same, but with an embedded error and located events."""
    found = []
    for steps in (1, 3, 1000):
        box = Gearbox(drum_inertia=0.02)
        for _ in range(steps):
            box.step(2.0 / steps, clutch=350.0)
        found.append([box[name] for name in ("lock_time", "lock_speed", "clutch_heat")])
    assert found[1] == pytest.approx(found[0], rel=1e-8)
    assert found[2] == pytest.approx(found[0], rel=1e-8)


def test_the_sums_of_an_uneven_clutch_are_those_of_its_closed_form_where_there_is_one():
    even, almost = k.Clutch(), k.Clutch(lag=1e-9)
    assert almost.lock_time == pytest.approx(even.lock_time, rel=2e-5)
    assert almost.slip_energy == pytest.approx(even.slip_energy, rel=2e-5)


def test_going_back_without_the_film_is_wrong_for_every_way_and_with_it_for_none():
    clutch = k.Clutch(lag=0.2)
    for way in (k.located, k.gauss_seidel, k.step_doubling):
        whole, part = (way(clutch, 5e-4, k.Rewind(200, 20, forgets=f)) for f in (False, True))
        assert whole.energy == pytest.approx(clutch.slip_energy, rel=5e-3)
        assert part.energy < 0.99 * clutch.slip_energy


def test_held_torques_make_energy_in_a_shaft_and_implicit_ones_take_it():
    shaft = s.Shaft(0.02, 10_000)
    assert s.gauss_seidel(shaft) == pytest.approx(np.exp(10_000 * 0.02**2 / 2.0), rel=0.01)
    assert s.jacobi(shaft) > s.gauss_seidel(shaft)
    assert s.linearly_implicit(shaft) < 0.1
    assert s.runge_kutta(s.Shaft(0.2, 10_000)) == pytest.approx(
        1.0 - 10_000 * 0.2**6 / 72.0, abs=2e-3
    )


# Loops and closed forms.


def test_counted_substitution_lies_and_the_package_finds_the_root():
    found = verdicts(heat_loop())
    assert found["substituted 50 times"]["film keeps its height"] == LIES
    assert found["substituted until it stays"]["film keeps its height"] == SAYS
    assert set(found["Newton in a bracket, the package's"].values()) == {OK}


def test_printed_forms_lose_their_digits_at_the_end_and_the_package_s_do_not():
    found = verdicts(closed_forms())
    ours = found["the same, the package's"]
    assert set(ours.values()) == {OK}
    assert all(LIES in row.values() for name, row in found.items() if not name.startswith("the"))


# What a cell may say.


def test_an_exception_is_a_way_of_saying_it():
    def judge(method, hazard):
        raise ValueError("no")

    assert table("", "", {"m": 1}, {"h": 1}, judge).cells[0][0].verdict == SAYS
    assert OK != LIES


def test_an_error_estimate_that_covers_the_error_is_one_too():
    true = Found("", 1.0, 2.0)
    assert judged(true, Found("", 3.0, 4.0)).verdict == LIES
    assert judged(true, Found("", 3.0, 4.0, 1.5)).verdict == SAYS
    assert judged(true, Found("SINGULAR", 3.0, 4.0)).verdict == SAYS
    assert judged(true, Found("", float("nan"), 2.0, 9.0)).verdict == LIES
    assert judged(true, Found("", 1.2, 4.0)).verdict == OK


@pytest.mark.slow
def test_the_default_solver_is_no_liar_where_others_are():
    """Compiles the rival's loops for a minute."""
    found = verdicts(balance())
    for default in (
        "field, the default, cold",
        "field, the default, warm",
        "steps in film thickness",
    ):
        assert set(found[default].values()) == {OK}
    assert found["Newton, limited, cold; temperatures substituted"]["near a fold"] == LIES
    assert found["Newton, limited, cold; temperatures relaxed"]["near a fold"] == OK
