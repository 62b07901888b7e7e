"""The linearly implicit master in whole shifts."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import NO_DRAG, PetroffWasher, instances, shift

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.shift import cosimulate, load_scene

MASTER = "linearly-implicit"


def test_a_shaft_that_judders_is_neither_damped_nor_fed():
    """Friction falls with slip and feeds the torsional mode, as its eigenvalue says."""
    gearbox = {"washers": 0, "coupling": "torque"}
    run = shift("judder", parts={"transmission": gearbox}, master=MASTER, step=2e-3)
    assert run.judder.kind == "physical"
    assert run.judder.growth == pytest.approx(run.judder.mode_growth, rel=0.05)
    assert run.judder.mode_growth > 3.0


def test_capacities_that_go_on_by_themselves_are_not_corrected():
    """Without drag there is nothing to correct: the run is that of gauss-seidel to the bit."""
    implicit, plain = (shift("msl", step=0.005, master=m) for m in (MASTER, "gauss-seidel"))
    assert all(np.array_equal(implicit.signals[k], plain.signals[k]) for k in plain.signals)


def test_held_capacities_are_corrected_to_the_end_of_the_step():
    """The ramp's capacities are then not late: lock-up errs a quarter of what it did.

    The brake's film is settled: one that is drawn apart goes on by itself, whatever the inputs do.
    """
    gearbox = {"washers": 0, "capacity_extrapolation": False}
    parts = NO_DRAG | {"brake": {"film_dynamics": False}}
    fine = shift("planetary-sun", parts=parts, stop_time=0.8).figures["lock_time"]
    options = {"parts": parts | {"transmission": gearbox}, "stop_time": 0.8, "step": 4e-3}
    held, corrected = (
        shift("planetary-sun", master=m, **options).figures["lock_time"] - fine
        for m in ("gauss-seidel", MASTER)
    )
    assert held > 3e-3 and abs(corrected) < 0.25 * held


def late_drag(master):
    """Return by how much the drag of the teeth in a step is not that of the step's end [N.m]."""
    scene = load_scene("planetary-sun").with_options(master=master, stop_time=0.2, step=2e-3)
    scene = replace(scene, parts={n: p for n, p in scene.parts.items() if n != "washer"})
    found = cosimulate(scene, instances(scene)).signals
    end = {n: found[f"transmission.mesh_{n}"][-1] for n in ("load", "speed")}
    mesh = instances(scene)["mesh"]
    mesh.initialize(0.2, {**end, "oil_temperature": found["mesh.oil_temperature"][-1]})
    return abs(mesh.get(["friction_torque"])[0] - found["transmission.mesh_torque"][-1])


def test_drag_is_that_of_the_load_it_changes_itself():
    """The ramp changes the teeth's load; held, their drag is that of a step before."""
    assert late_drag(MASTER) < 0.1 * late_drag("gauss-seidel")


def test_a_part_that_gives_no_slope_is_named():
    scene = load_scene("planetary-sun").with_options(master=MASTER, stop_time=0.01)
    scene = replace(scene, parts={n: p for n, p in scene.parts.items() if n != "mesh"})
    made = instances(scene)
    assert isinstance(made["washer"], PetroffWasher)
    with pytest.raises((ParameterError, SolveError), match=f"{MASTER}.*washer"):
        cosimulate(scene, made)
