"""Every level in a few calls: short enough to run as plain Python, so that each branch is
walked."""

import numpy as np
import pytest

from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec
from thrustwasher.washer.follow import follow_washer
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import step as kernel
from thrustwasher.washer.kernels.layout import N_ALL, N_HEAD, NOUT
from thrustwasher.washer.kernels.map.map_step import N_MAP_WORK, look_up, map_sens
from thrustwasher.washer.kernels.workspace import Point, size_of_state, size_of_work
from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.map.map_file import SHIPPED

GRID = (5, 8)


@pytest.fixture(scope="module")
def chart():
    return WasherMap(WasherParams(), SHIPPED / "washer.twm")


def test_the_map_is_odd_in_speed_carries_its_load_and_knows_its_folds(chart):
    place = {"speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}
    loads = np.array([25.0, 300.0, 900.0, 1800.0])
    ahead, back = (chart.look_up(load=loads, **{**place, "speed": s}) for s in (545.0, -545.0))
    assert np.array_equal(ahead["friction_torque"], -back["friction_torque"])
    assert [f.kind for f in chart.folds(**place)] == ["film_lost", "film_regained"]
    assert chart.look_up(load=300.0, **{**place, "speed": 1999.0})["branch"] == -1.0


@pytest.mark.parametrize(("load", "branch"), [(300.0, 1.0), (800.0, 3.0), (1500.0, 3.0)])
def test_the_map_has_the_derivatives_of_its_values(chart, load, branch):
    at, along = np.array([load, 545.0, 2e-3, 297.15]), np.array([1.0, 0.3, 0.0, 0.0])
    w, numbers, found = np.zeros(N_MAP_WORK), np.zeros(N_ALL), np.zeros(2)

    def outputs(x):
        assert look_up(chart.data, Point(*x, x[3]), branch, np.zeros(40), w, numbers, found) == 0
        return numbers[:NOUT].copy()

    change = (outputs(at + 1e-3 * along) - outputs(at - 1e-3 * along)) / 2e-3
    outputs(at)
    slope = np.zeros(NOUT)
    assert map_sens(at, along, numbers, w, chart.data, slope) == 0
    assert slope == pytest.approx(change, rel=1e-5, abs=1e-12)


def test_a_map_goes_from_branch_to_branch_step_by_step():
    one = DirectInstance(find_spec("washer"), parameters={"fidelity": "map"})
    one.initialize(0.0, {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15})
    lost = []
    for i, load in enumerate([400.0, 1100.0, 800.0, 200.0]):
        one.set_inputs([load, 545.0, 2e-3, 297.15])
        one.step(i * 1e-3, 1e-3)
        lost.append(one.get(["distress"])[0])
    assert lost == [0.0, 1.0, 1.0, 0.0]
    assert one.directional_derivative(["friction_torque"], ["load"], [1.0])[0] != 0.0


@pytest.mark.parametrize("load", [300.0, 1500.0])
def test_a_mesh_has_the_derivatives_of_its_steps(load):
    par = constants(WasherParams(), GRID)
    state, work = np.zeros(size_of_state(*GRID)), np.zeros(N_HEAD + size_of_work(*GRID))
    out, iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)

    def torque(change):
        inp = np.array([load + change, 545.0, 2e-3, 297.15, 0.0])
        assert kernel.step(par, inp, state, work, out, iout, 0.0, 1e-3) == Status.OK
        return out[0], inp

    difference = (torque(0.05 * load)[0] - torque(-0.05 * load)[0]) / (0.1 * load)
    inp, slope = torque(0.0)[1], np.zeros(kernel.NOUT)
    along = np.array([1.0, 0.0, 0.0, 0.0, 0.0])
    assert kernel.sens(par, inp, state, work, along, slope) == Status.OK
    assert slope[0] == pytest.approx(difference, rel=0.05)  # of a curve over a tenth of its load


def test_bodies_that_store_heat_warm_up_towards_their_steady_state():
    params = WasherParams(thermal_mode="transient", thermal_start="oil")
    profile = follow_washer(
        params, time=[0.0, 0.5, 2.0], load=300.0, speed=545.0, tilt=2e-3, grid=GRID
    )
    steady = solve_washer(WasherParams(), load=300.0, speed=545.0, tilt=2e-3, grid=GRID)
    first, middle, last = profile.temperature
    assert first < middle < last < steady.temperature + 1e-3
