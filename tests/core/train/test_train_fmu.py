"""The train in time: the FMU does what Python does, passes through no torque, books its heat."""

import numpy as np
import pytest
from built import built_fmu
from kernel_part import Part

from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.train.parameters import SPEC, TrainParams
from thrustwasher.train.solve import solve_train

H = 1e-3
NAMES = [s.name for s in SPEC.outputs]


def test_the_fmu_passes_from_drive_to_coasting_without_a_jump():
    """150 N m to -150 N m in 600 steps: the loss moves by no more than its slope allows."""
    with Instance(built_fmu("train", local=True)) as fmu, DirectInstance(SPEC) as direct:
        start = {"torque": 150.0, "speed": 500.0, "oil_temperature": 353.15}
        fmu.initialize(0.0, start)
        direct.initialize(0.0, start)
        losses = []
        for i, torque in enumerate(np.linspace(150.0, -150.0, 601).tolist()):
            for part in (fmu, direct):
                part.set_inputs([torque, 500.0, 353.15])
                part.step(H * i, H)
            found = fmu.outputs()
            assert found == direct.outputs()
            losses.append(found[NAMES.index("loss")])
    assert losses[0] == pytest.approx(1205.0, rel=0.01)
    steps = abs(np.diff(losses))
    assert steps.max() < 1.5 * steps[0] and min(losses) == pytest.approx(losses[300], rel=0.01)


def test_it_begins_as_python_solves_it():
    point = {"torque": 120.0, "speed": 400.0, "oil_temperature": 333.15}
    with Instance(built_fmu("train", local=True)) as fmu:
        fmu.initialize(0.0, point)
        shown = dict(zip(NAMES, fmu.outputs(), strict=True))
    r = solve_train(TrainParams(), **point)
    for name in SPEC.real_outputs:
        if name != "oil_energy" and getattr(r, name) is not None:
            assert shown[name] == pytest.approx(getattr(r, name), rel=1e-9), name
    assert shown["mesh_3_loss"] == shown["shaft_4_bearing_1_life"] == -1.0


def test_heat_of_a_run_is_what_was_lost_less_what_the_bodies_keep():
    """Started as warm as the oil: bodies take up heat, the oil gets the rest."""
    part = Part("train", "handbook", TrainParams(thermal_start="oil"))
    part = _transient(part)
    lost = 0.0
    for _ in range(50):
        assert part.step([150.0, 500.0, 353.15], 0.1) == 0
        lost += 0.1 * part["loss"]
    assert part["oil_energy"] < lost
    before = part["oil_energy"]
    for _ in range(200):
        assert part.step([150.0, 500.0, 353.15], 10.0) == 0
    assert part.step([150.0, 500.0, 353.15], 1.0) == 0
    assert part["oil_heat"] == pytest.approx(part["loss"], rel=1e-6)
    assert part["oil_energy"] > before and part["mesh_1_bulk_temperature"] > 358.0


def _transient(part):
    """``filled`` takes bodies as steady; here they store heat."""
    from thrustwasher.model.parameters import as_numbers

    numbers = as_numbers(part.params)
    part.par[: len(numbers)] = numbers
    assert part.k.derive(part.par) == 0
    return part


def test_where_it_locks_itself_a_step_fails_and_nothing_moves():
    wide = {f"shaft_1_bearing_{k}_diameter": 1.5 for k in (1, 2)}
    wide |= {f"shaft_1_bearing_{k}_load_factor": 0.02 for k in (1, 2)}
    wide |= {f"shaft_1_bearing_{k}_viscous_factor": 0.0 for k in (1, 2)}
    part = Part("train", "handbook", TrainParams(**wide))
    assert part.step([100.0, 50.0, 353.15], H) == 0
    kept = part.state.copy()
    assert part.step([-100.0, 50.0, 353.15], H) == Status.MAX_ITERATIONS
    assert part["solver_status"] == Status.MAX_ITERATIONS
    assert part.state.tobytes() == kept.tobytes()
