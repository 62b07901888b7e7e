"""The linearly implicit master in whole shifts."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import NO_DRAG, PetroffWasher, instances, shift, slow_without_jit

from lab.benchmarks.error_controlled import StepDoubling, drive, structure
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.ssp.system_structure import prepared

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


# The shift under a master that chooses its step by doubling, as PyFMI and MasterSim do.
#
# Hazard: values need several exchanges from the command to the packs and back; what two halves of a
# step and the whole differ by is then the same however short the step, and the step goes to 0.
# Cure: the transmission takes a change of its inputs in proportion to a step that is shorter than
# the last ones.


def system(stop):
    return structure(prepared(load_scene("planetary").with_options(stop_time=stop)))


def controlled_instances(found):
    return {c.name: DirectInstance(c.spec, parameters=c.parameters) for c in found.components}


@pytest.mark.parametrize("order", ["parallel", "serial"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-4])
@pytest.mark.slow
@slow_without_jit
def test_the_step_stays_above_a_microsecond_where_the_packs_begin_to_be_pressed(order, rtol):
    found = system(0.15)
    run = drive(found, controlled_instances(found), rtol=rtol, order=order)
    assert run.shortest > 1e-6
    assert run.refused < 1.5 * run.taken


@pytest.mark.slow
@slow_without_jit
def test_a_master_that_never_agrees_is_told_where_its_step_becomes_0():
    found = system(0.15)

    disturbed = [k.input for k in found.links].index("clutch_torque")

    class NeverContent(StepDoubling):
        count = 0

        def settled(self, values, sent):
            self.count += 1
            values[disturbed] += 10.0 * (self.count % 3)
            return values

    master = NeverContent(controlled_instances(found), found.links, rtol=1e-3)
    master.initialize(0.0, {c.name: c.starts for c in found.components})
    with pytest.raises(ParameterError, match=r"by 0\.0 s, allowed: finite, step > 0"):
        master.run(0.05, 0.15)
