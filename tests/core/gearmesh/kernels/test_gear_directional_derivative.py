"""The gear mesh's derivatives over its inputs: against differences, at every law and corner."""

from dataclasses import fields

import numpy as np
import pytest

from thrustwasher.gearmesh.kernels import step as k
from thrustwasher.gearmesh.parameters import SPEC, GearMeshParams
from thrustwasher.gearmesh.solve import prepare

from slopes import Unit, disagreement  # isort: skip

NAMES = [s.name for s in SPEC.outputs if s.kind == "real"]
CHOICES = {
    f.name: list(f.metadata["options"])
    for f in fields(GearMeshParams)
    if f.metadata["kind"] == "enumeration"
}
# What is made of the asperities' rise over the oil: lost in the oil's 300 K if it is minute.
OF_THE_RISE = [i for i, n in enumerate(NAMES) if n.startswith(("thermal", "modification"))]


def mesh(fidelity="field", **changes):
    par = prepare(GearMeshParams(**changes), fidelity)
    if changes.get("thermal_mode") != "quasi_steady":  # which is what a solution without a past is
        par[k.L.P_THERMAL_MODE] = 2.0
    return Unit(k, par)


def random_mesh(rng):
    """Return a mesh under any laws; the paper's heat for rigid, not mixed friction."""
    changes = {name: str(rng.choice(options)) for name, options in CHOICES.items()}
    if changes["film_heat"] == "loss":
        changes |= {"helix_angle": float(rng.choice([0.0, 0.2, 0.35])), "load_factor": 1.3}
        changes["bulk_conductance"] = float(rng.choice([0.0, 10.0]))
    else:
        changes |= {"load_sharing": "rigid", "material_gear": "as-pinion"}
        if changes["friction_law"] == "mixed":
            changes["friction_law"] = "iso"
    changes["permissible_film_ratio"] = float(rng.choice([0.0, 0.3]))
    unit = mesh(str(rng.choice(list(SPEC.levels))), **changes)
    if rng.random() < 0.4:
        unit.state[:4] = 1.0, 350.0, 3.0, 2.0
    return unit


def random_point(rng):
    load = 10.0 ** rng.uniform(-3.0, 5.0) * rng.choice([-1.0, 1.0])
    speed = 10.0 ** rng.uniform(-5.0, 3.6) * rng.choice([-1.0, 1.0])
    return np.array([load, speed, rng.uniform(240.0, 470.0)])


def scale_at(point):
    return [abs(point[0]) + 1e-3, abs(point[1]) + 1e-4, 100.0]


def compared(unit, point):
    worst = disagreement(unit, point, scale_at(point))
    shown = dict(zip(NAMES, unit.step(point), strict=True))
    if shown["temperature"] - shown["bulk_temperature"] < 0.1:
        worst[OF_THE_RISE] = 0.0
    return worst


@pytest.mark.parametrize("seed", range(8))
def test_derivatives_are_those_of_differences_under_any_laws(seed):
    rng = np.random.default_rng(seed)
    for _ in range(25):
        unit, point = random_mesh(rng), random_point(rng)
        assert compared(unit, point).max() < 1e-6


@pytest.mark.parametrize("dt", [1e-4, 0.1, 1e3])
@pytest.mark.parametrize("friction_law", CHOICES["friction_law"])
@pytest.mark.parametrize("begun", [0.0, 1.0])
def test_derivatives_go_through_the_step_that_warms_the_bodies(dt, friction_law, begun):
    """Differences of whole steps, each from the same state."""
    unit = mesh(friction_law=friction_law)
    before = np.array([begun, 350.0, 3.0, 2.0])

    def stepped(point):
        unit.state[:4] = before
        return unit.step(point, dt=dt)

    point, size = np.array([40.0, 180.0, 330.0]), np.array([40.0, 180.0, 100.0])
    for i in range(k.NINP):
        away = 1e-4 * size * np.eye(k.NINP)[i]
        wanted = (stepped(point + away) - stepped(point - away)) / 2e-4
        out = stepped(point)
        found = unit.sens(point, size * np.eye(k.NINP)[i])
        for name in ("stored_heat", "oil_energy"):  # integrals
            found[NAMES.index(name)] = wanted[NAMES.index(name)]
        assert (np.abs(found - wanted) <= 2e-5 * np.abs(wanted) + 1e-11 * np.abs(out)).all()


@pytest.mark.parametrize("fidelity", SPEC.levels)
@pytest.mark.parametrize("friction_law", CHOICES["friction_law"])
@pytest.mark.parametrize("point", [(0.0, 0.0), (0.0, 180.0), (40.0, 0.0), (-40.0, 1e-4)])
def test_derivatives_hold_at_rest_and_without_load(fidelity, friction_law, point):
    unit = mesh(fidelity, friction_law=friction_law)
    assert compared(unit, np.array([*point, 299.85])).max() < 1e-6
