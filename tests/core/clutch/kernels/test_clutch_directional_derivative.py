"""The clutch's derivatives over its inputs: against differences, at every level, law and option."""

import numpy as np
import pytest

from thrustwasher.clutch.kernels import layout as L
from thrustwasher.clutch.kernels import rosenbrock, rosenbrock_derivatives
from thrustwasher.clutch.kernels import step as k
from thrustwasher.clutch.kernels.advance import load_memory
from thrustwasher.clutch.kernels.rates import n_unknowns
from thrustwasher.clutch.parameters import FRICTION_LAWS, SPEC, ClutchParams
from thrustwasher.clutch.solve import prepare
from thrustwasher.tribology.holding.memory import IDENTIFIED

from slopes import Unit, differences, disagreement  # isort: skip

NAMES = [s.name for s in SPEC.outputs if s.kind == "real"]
LEVELS = list(SPEC.levels)
OPTIONS = {
    "friction_law": list(FRICTION_LAWS),
    "kink_width": [0.0, 0.3],
    "shear_temperature_slope": [0.0, -1e-3, 3e-3],
    "friction_temperature": ["auto", "slope", "slope", "points"],
    "friction_temperature_slope": [0.0, -1e-3, 2e-3, -1e-2],
    "point_temperature_1": [280.0],
    "point_friction_1": [0.185],
    "point_temperature_2": [350.0],
    "point_friction_2": [0.140],
    "point_temperature_3": [700.0],
    "point_friction_3": [0.1],
    "separating_force": [0.0, 100.0],
    "starts_pressed": [False, True],
    "film_dynamics": [True, True, True, False],
    "shear_heating": [False, True],
    "oil_flow": [0.0, 1e-5, 1e-4],
    "friction_data": ["total", "boundary"],
    "groove_count": [0, 24],
    "land_share": [0.8, 1.0],
    "contact_rise": [False, True],
    "viscosity_constant": [0.0, 3.545],
    "viscosity_scale": [6.31e-5, 1e-2],
    "speed_smoothing": [0.1, 5.0],
}


def pack(fidelity="field", **changes):
    return Unit(k, prepare(ClutchParams(**changes), fidelity))


def random_pack(rng, levels=LEVELS, **fixed):
    changes = {name: values[rng.integers(len(values))] for name, values in OPTIONS.items()}
    return pack(str(rng.choice(levels)), **changes | fixed)


def random_point(rng):
    load = 10.0 ** rng.choice([rng.uniform(0.0, 6.0), rng.uniform(2.5, 4.5)])
    slip = 10.0 ** rng.uniform(-4.0, 3.5) * rng.choice([-1.0, 0.0, 1.0, 1.0])
    drum = rng.uniform(-500.0, 500.0) if slip else 0.0  # sizes are even in the slip only then
    return np.array([load, slip, rng.uniform(250.0, 450.0), drum])


def scale_at(point):
    return [0.5 * point[0], abs(point[1]) + 1e-4, 30.0, 100.0]


def worn_in(unit, rng):
    """Let the pack live through some steps, or none."""
    dt = 10.0 ** rng.uniform(-3.5, -1.5)
    for _ in range(int(rng.integers(0, 4))):
        point = random_point(rng)
        for _ in range(int(rng.integers(1, 12))):
            unit.step(point, dt=dt)


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("seed", range(3))
def test_derivatives_are_those_of_differences_under_any_option(level, seed):
    """Where the film is settled, inputs that run straight heat at once; else: the tests below."""
    rng = np.random.default_rng(seed)
    profiles = ["held", "linear"] if level in ("closed", "stribeck") else ["held"]
    for n in range(30):
        more = {
            "friction_scale": (1.0, 1.0, 1.7)[seed],
            "input_profile": profiles[n % len(profiles)],
        }
        unit = random_pack(rng, [level], **more)
        worn_in(unit, rng)
        point = random_point(rng)
        assert disagreement(unit, point, scale_at(point)).max() < 1e-6


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("profile", ["held", "linear"])
def test_derivatives_of_a_pack_that_holds_are_those_of_its_law(level, profile):
    """Sliding with dips, at lock and held, between two shafts of a driveline."""
    unit = pack(level, input_profile=profile, starts_pressed=True)
    unit.par[L.P_HOLDING] = IDENTIFIED
    slip, held = 40.0, 0
    for n in range(60):
        torque = unit.step([3000.0, slip, 340.0, 0.0], dt=1e-3)[L.O_TORQUE]
        slip += 1e-3 * (30.0 - torque) / 0.05
        if n % 5 == 0 and unit.work[L.W_SUBSTEPS] <= 1.0:
            point = np.array([2900.0, slip + (0.5 if abs(slip) > 5.0 else 1e-4), 341.0, 10.0])
            assert (
                disagreement(unit, point, [300.0, 0.1 * abs(slip) + 1e-4, 10.0, 50.0]).max() < 1e-5
            )
            held += unit.iout[L.IO_LOCKED]
    assert held > 2 and abs(slip) < 1e-9


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("load", [0.5, 9.0, 11.0, 5e3, 9e5])
def test_derivatives_hold_at_zero_slip_from_open_to_crushed(level, load):
    """The pack is open up to 9.8 N. Around zero slip sizes are flat, torques rise."""
    unit = pack(level, starts_pressed=True)
    for slip in (0.0, 1e-6, -1e-6):
        point = np.array([load, slip, 320.0, 40.0])
        assert disagreement(unit, point, [0.1 * load, 1e-4, 30.0, 100.0]).max() < 1e-6
    torque = unit.gradient([load, 0.0, 320.0, 40.0])[NAMES.index("friction_torque"), 1]
    assert torque > 0.0


def engaging(unit, rng):
    """Press a pack for some steps; return the next point and scales of change."""
    dt, load = 10.0 ** rng.uniform(-3.5, -2.0), 10.0 ** rng.uniform(3.0, 4.5)
    slip, oil = rng.uniform(5.0, 300.0), rng.uniform(280.0, 400.0)
    n = int(rng.integers(2, 60))
    for i in range(n + 1):
        way = np.exp(-i * dt / 0.05)
        point = np.array([load * (1.0 - way), slip * np.exp(-i * dt / 0.3), oil, 90.0 + i])
        if i < n:
            unit.step(point, dt=dt)
    return point, [0.1 * load, 0.1 * slip, 10.0, 50.0]


@pytest.mark.parametrize(("level", "n"), [("field", 60), ("fine", 20)])
def test_a_moving_film_is_followed_over_the_stretch_it_has_just_passed(level, n):
    """Where the stretch was one substep: then its size does not change with the inputs."""
    rng = np.random.default_rng(6)
    compared = 0
    for _ in range(n):
        unit = random_pack(rng, [level], input_profile="linear", film_dynamics=True)
        point, scale = engaging(unit, rng)
        unit.step(point)
        if unit.work[L.W_SUBSTEPS] == 1.0:
            assert disagreement(unit, point, scale).max() < 1e-6
            compared += 1
    assert compared > n // 4


def released(unit, rng):
    """Press a pack and let it go; return a point on the way and scales of change."""
    load, oil = 10.0 ** rng.uniform(3.0, 4.0), rng.uniform(245.0, 400.0)
    slip, n = rng.uniform(5.0, 300.0), int(rng.integers(2, 40))
    for i in range(n + 1):
        point = np.array([max(load * (1.0 - i / 8.0), 2.0), slip, oil, 90.0 + i])
        if i < n:
            unit.step(point, dt=1e-3)
    return point, [0.1 * point[0], 0.1 * slip, 10.0, 50.0]


@pytest.mark.parametrize(("level", "n"), [("field", 60), ("fine", 20)])
def test_the_film_of_a_pack_let_go_is_followed_the_same_way(level, n):
    rng = np.random.default_rng(8)
    compared = 0
    for _ in range(n):
        fixed = {"input_profile": "linear", "film_dynamics": True, "starts_pressed": True}
        unit = random_pack(rng, [level], **fixed)
        point, scale = released(unit, rng)
        unit.step(point)
        if unit.work[L.W_SUBSTEPS] == 1.0:
            assert disagreement(unit, point, scale).max() < 2e-6
            compared += 1
    assert compared > n // 4


def passed(unit, point, sizes, seed):
    """Return film and heat after substeps of given sizes, and how they change along ``seed``."""
    par, state, work, inputs = unit.par, unit.state, unit.work, [float(x) for x in point]
    load_memory(par, inputs[0], inputs[2], state, work)
    profile = (
        state[L.S_LOAD],
        state[L.S_SLIP],
        state[L.S_OIL],
        *inputs[:3],
        state[L.S_DRUM],
        inputs[3],
    )
    work[L.W_VARIED : L.W_VARIED + L.NY] = 0.0
    done = 0.0
    for share in sizes:
        rosenbrock.substep(par, profile, done, share, state[L.S_DURATION], work)
        rosenbrock_derivatives.follow(par, profile, seed, done, share, state[L.S_DURATION], work)
        work[: L.NY] = work[L.W_TRIAL : L.W_TRIAL + L.NY]
        done += share
    counted = [L.Y_FILM, *range(L.Y_HEAT, n_unknowns(par))]
    return work[counted], work[L.W_VARIED + np.array(counted)]


@pytest.mark.parametrize("level", ["field", "fine"])
@pytest.mark.parametrize(
    "sizes",
    [
        (1.0,),
        (0.5, 0.5),
        (0.02, 0.12, 0.3, 0.56),
        pytest.param((0.1,) * 10, marks=pytest.mark.slow),
    ],
)
@pytest.mark.slow
def test_a_moving_film_is_followed_through_any_substeps(sizes, level):
    rng = np.random.default_rng(13)
    for _ in range(5):
        moves = level == "field" or bool(rng.random() < 0.7)
        unit = random_pack(rng, [level], input_profile="linear", film_dynamics=moves)
        point, scale = engaging(unit, rng)
        for seed in np.diag(scale):
            _, found = passed(unit, point, sizes, tuple(seed.tolist()))
            best = np.inf
            for h in (1e-3, 1e-2, 1e-4, 1e-1, 1e-5):  # a corner may be near
                ends = [
                    passed(unit, point + x * h * seed, sizes, (0.0,) * 4)[0]
                    for x in (1.0, -1.0, 0.5, -0.5)
                ]
                wanted = (8.0 * (ends[2] - ends[3]) - (ends[0] - ends[1])) / (6.0 * h)
                wrong, size = np.abs(found - wanted), np.abs(wanted)
                film = wrong[0] / max(size[0], 1e-6)  # a change by less is none
                best = min(best, max(film, wrong[1:].max() / max(size[1:].max(), 1e-9)))
                if best < 2e-6:
                    break
            assert best < 2e-6


def test_a_pack_that_opens_at_another_instant_is_another_pack():
    """The rate of the film jumps where the load passes the limit; substeps keep their tolerance."""
    unit = pack("field", input_profile="linear")
    for load in (40.0, 40.0, 60.0):
        unit.step([load, 50.0, 330.0, 0.0], dt=5e-3)
    point, place = np.array([3.0, 50.0, 330.0, 0.0]), NAMES.index("film_ratio")
    found = unit.gradient(point)[place, 0]
    wanted = differences(unit, point, [1.0] * 4, 1.5)[place, 0]
    tolerance = rosenbrock.TOLERANCE_FILM * (1.0 + unit.step(point)[place])
    assert abs(found - wanted) * 3.0 < 4.0 * tolerance < 0.01 * abs(3.0 * found)


def test_derivatives_of_a_running_profile_need_no_solve_before():
    """Right after a step ``work`` belongs to its start; the derivative is that of now."""
    rng = np.random.default_rng(9)
    for level in ("stribeck", "field"):
        unit = random_pack(rng, [level], input_profile="linear", film_dynamics=True)
        point, _ = engaging(unit, rng)
        unit.step(point, dt=1e-3)
        seed = np.array([100.0, -1.0, 2.0, 3.0])
        at_once = unit.sens(point, seed)
        unit.step(point)
        assert unit.sens(point, seed) == pytest.approx(at_once, rel=1e-12)
