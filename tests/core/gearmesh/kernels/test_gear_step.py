"""The gear mesh's step: the common contract of kernels, zero, signs, smoothness."""

import math
from dataclasses import fields

import numpy as np
import pytest
from closed_forms import involute_mesh, line_contact, thermal_fatigue
from hypothesis import assume, given
from hypothesis import strategies as st
from kernel_part import Part
from scipy.optimize import minimize_scalar

from thrustwasher.errors import Status
from thrustwasher.gearmesh.kernels import constants as g
from thrustwasher.gearmesh.kernels import contact
from thrustwasher.gearmesh.kernels import flank_temperature as h
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.kernels import step as k
from thrustwasher.gearmesh.parameters import SPEC, GearMeshParams
from thrustwasher.gearmesh.solve import prepare

from slopes import Unit, disagreement  # isort: skip


NAMES = [s.name for s in SPEC.outputs if s.kind == "real"]


class Mesh(Part):
    def __init__(self, preset=None, **params):
        made = GearMeshParams.preset(preset, **params) if preset else GearMeshParams(**params)
        super().__init__("gearmesh", "field", made)

    def outputs(self, load, speed, oil=299.85):
        assert self.step((load, speed, oil)) == 0
        return self.out.copy()


@given(
    st.floats(-1e5, 1e5),
    st.floats(-5000.0, 5000.0),
    st.floats(233.15, 473.15),
    st.sampled_from(["paper", None]),
)
def test_only_the_loss_has_a_sign_and_it_opposes_motion(load, speed, oil, preset):
    mesh = Mesh(preset=preset)
    out = mesh.outputs(load, speed, oil)
    assert np.isfinite(out).all() and out[L.F_POWER] >= 0.0 and out[L.F_TORQUE] * speed >= 0.0
    assert abs(out[L.F_TORQUE]) <= 0.2 * abs(load)
    turned = mesh.outputs(load, -speed, oil)
    assert turned[L.F_TORQUE] == -out[L.F_TORQUE]
    assert (np.delete(turned, L.F_TORQUE) == np.delete(out, L.F_TORQUE)).all()
    assert (mesh.outputs(-load, speed, oil) == out).all()


def largest_jump(mesh, points):
    """Return, for each output, the largest jump between neighbouring slopes over its variation."""
    values = np.array([mesh.outputs(*p) for p in points])
    steps = np.diff(values, axis=0)
    spread = np.maximum(np.abs(steps).max(axis=0), 1e-30)
    return np.abs(np.diff(steps, axis=0)).max(axis=0) / spread


@pytest.mark.parametrize(
    ("line", "changes"),
    [
        (lambda s: (0.02 * s, 180.0), {}),
        (lambda s: (40.0, 0.01 * s), {}),
        (lambda s: (40.0, 0.5 * s), {}),
        (lambda s: (0.02 * s, 0.01 * s), {}),
        (lambda s: (40.0, 150.0 + 60.0 * s), {}),  # film ratio 1.03 .. 1.5
        (lambda s: (40.0, 250.0 + 100.0 * s), {}),  # through 1.8: the asperities let go
        (lambda s: (1.0, 100.0 + 50.0 * s), {}),  # film switch and hardness bound together
        (lambda s: (40.0, 20.0 + 15.0 * s), {"friction_law": "iso"}),
        (lambda s: (40.0, 180.0 + 150.0 * s), {"traction_law": "limited"}),
        (lambda s: (40.0, 180.0 + 150.0 * s), {"area_law": "greenwood-williamson"}),
        (lambda s: (4.0 * s, 180.0), {"preset": None}),
        (lambda s: (40.0, 0.01 * s), {"preset": None}),
        (lambda s: (40.0, 3.0 + 2.0 * s), {"preset": None}),  # the least rolling speed
    ],
)
def test_outputs_have_continuous_slopes(line, changes):
    """A corner would keep its jump however fine the points; here it shrinks with their distance."""
    mesh = Mesh(**{"preset": "paper", **changes})
    jumps = [largest_jump(mesh, [line(s) for s in np.linspace(-1.0, 1.0, n)]) for n in (801, 6401)]
    moving = jumps[0] > 1e-6
    assert moving.any()
    assert (jumps[1][moving] < 0.3 * jumps[0][moving]).all(), dict(
        zip(np.array(NAMES)[moving], jumps[1][moving] / jumps[0][moving], strict=True)
    )


def test_mixed_friction_loses_power_and_warms_with_continuous_slopes():
    """Contact and temperatures belong to the hottest position, which may be another one."""
    mesh, kept = Mesh(friction_law="mixed"), [L.F_TORQUE, L.F_POWER, L.F_BULK, L.F_OIL_HEAT]
    jumps = [
        largest_jump(mesh, [(40.0, 3.0 + 2.0 * s) for s in np.linspace(-1.0, 1.0, n)])[kept]
        for n in (801, 6401)
    ]
    assert (jumps[1] < 0.3 * jumps[0]).all()


def test_advice_is_given_for_hot_films_and_stretched_laws_and_not_in_between():
    mesh = Mesh(preset="paper")
    for point, advice in (
        ((40.0, 180.0, 299.85), Status.OK),
        ((40.0, 180.0, 250.0), Status.HOT),
        ((40.0, 1.0, 250.0), Status.OUTSIDE_VERIFIED),
        ((40.0, 180.0, 430.0), Status.OUTSIDE_VERIFIED),
        ((9e4, 180.0, 330.0), Status.OUTSIDE_VERIFIED),
    ):
        mesh.outputs(*point)
        assert mesh.iout[L.IO_STATUS] == advice, point


# Contact, film, friction and stress of the gear mesh against closed forms and checked numbers.

E, NU = 205e9, 0.3
THETA = contact.compliance(E, NU, E, NU)
W, R = 9423.0, 6.89e-3


def test_contact_stress_is_the_peak_pressure_but_for_the_rounded_factor():
    p0 = math.sqrt(W / (math.pi * R * THETA))
    exact = 1.0 / math.sqrt(math.pi * (1.0 - NU * NU))
    assert contact.surface_stress(W, R, E) / p0 == pytest.approx(0.591 / exact, rel=1e-14)
    assert exact == pytest.approx(0.5914, abs=5e-5)


def test_li_seireg_friction_at_a_checked_point_and_its_limits():
    assert contact.li_seireg(1e-6, 0.01, 0.12, 3e-5)[0] == pytest.approx(0.08441831, abs=5e-9)
    assert contact.li_seireg(0.0, 0.01, 0.12, 4.5e-5)[0] == 0.12
    for roughness, thick in ((4.5e-5, 0.0953), (1.5e-5, 0.0542)):
        found = contact.li_seireg(1.0, 0.01, 0.12, roughness)[0]
        assert found == pytest.approx(thick, abs=5e-5)
    wanted = line_contact.li_seireg(4e-4, 2e-5, 0.1)
    assert contact.li_seireg(4e-6, 0.01, 0.1, 2e-5)[0] == pytest.approx(wanted, rel=1e-14)


def test_stresses_and_modification_of_a_chain_worked_by_hand():
    """100.7493 K on a contact of 178.2393 MPa; seven digits in, squared: good to 2e-6."""
    thermal = contact.thermal_stress(100.7493, E, NU, 12e-6)
    assert thermal == pytest.approx(118.0206e6, rel=1e-6)
    soft = contact.modification(thermal, 178.2393e6, 0.77, 0.63)
    hard = contact.modification(thermal, 178.2393e6, 0.40, 0.53)
    assert (soft[0], hard[0]) == pytest.approx((0.2934999, 0.7697331), rel=2e-6)
    assert hard[0] / soft[0] == pytest.approx(2.62, abs=5e-3)
    assert hard[1] == pytest.approx(thermal_fatigue.allowable_ratio(hard[0]), rel=1e-15)


def test_at_the_allowable_ratio_the_endurance_is_used_up_exactly():
    """Scale both stresses until the contact stress is that share of its limit: utilization 1."""
    k, share = contact.modification(118e6, 178e6, 0.40, 0.53)
    scale = share * 0.53 * 1301e6 / 178e6
    used = contact.utilization(scale * 118e6, scale * 178e6, 0.40, 0.53, 1301e6)
    assert used == pytest.approx(1.0, rel=1e-14) and k > 0.0


# Involute geometry of the gear mesh: the start of contact, speeds there, loss over the path.

PHI = math.radians(20.0)


def mesh(ratio, teeth, angle=PHI, addendum=1.0):
    return involute_mesh.Mesh(ratio, teeth, 0.254, angle, addendum)


@pytest.mark.parametrize(("ratio", "least"), [(2.0, 14.16), (5.0, 15.74)])
def test_at_the_least_number_of_teeth_contact_starts_on_the_base_circle(ratio, least):
    found = g.least_teeth(ratio, PHI, 1.0)
    assert found == pytest.approx(least, abs=5e-3)
    assert g.start_of_contact(ratio, found, PHI, 1.0, 1.0) == pytest.approx(0.0, abs=1e-14)
    assert found == pytest.approx(involute_mesh.least_pinion_teeth(ratio, PHI), rel=1e-13)


@given(st.floats(0.3, 3.0), st.floats(0.3, 3.0))
def test_the_loss_is_the_mean_sliding_of_equally_loaded_pairs_however_many(approach, recess):
    """Watch one base pitch pass: average over the pairs in contact, then over the phases."""
    assume(approach + recess >= 1.0)
    n = 2000
    phases = -approach + (np.arange(n) + 0.5) / n
    pairs = phases[:, None] + np.arange(7)
    inside = pairs < recess
    means = (np.abs(pairs) * inside).sum(axis=1) / inside.sum(axis=1)
    found = g.loss_factor(2.0, 20.0, approach, recess, 1.0)
    assert found == pytest.approx(2.0 * math.pi * 3.0 / 40.0 * means.mean(), rel=3e-3)


# Temperature rises of the gear mesh: laws of scale, Atan's printed forms, the viscosity root.

B, C = 755.0, 70.0
NO_CAP = 1e300


def root(bulk, rise, exponent, cap=NO_CAP):
    """Solve with a rise of ``rise`` [K] at the bulk's viscosity."""
    t, stress, _, status, n = h.heated_flank(bulk, rise, 1.0, cap, exponent, B, C)
    return t, stress, status, n


def test_viscosity_of_the_papers_oil():
    assert h.oil_viscosity(333.15, 9.7e-5, B, C) == pytest.approx(0.03228646, rel=1e-6)
    assert h.oil_viscosity(299.85, 9.7e-5, B, C) == pytest.approx(0.2386, abs=5e-5)
    assert h.oil_viscosity(200.0, 9.7e-5, B, C) == h.oil_viscosity(h.LOWEST_OIL, 9.7e-5, B, C)


def test_bloks_factor_is_the_peak_under_an_elliptic_heat_source():
    """A band -1..1 passing a deep body: temperature 2/pi^1.5 int sqrt(1 - u^2)/sqrt(s - u) du."""

    def warmth(s):
        v, weight = np.polynomial.legendre.leggauss(400)
        top = math.sqrt(s + 1.0)
        v, weight = 0.5 * top * (v + 1.0), 0.5 * top * weight  # s - u = v^2
        return 2.0 / math.pi**1.5 * (2.0 * weight * np.sqrt(1.0 - (s - v**2) ** 2)).sum()

    best = minimize_scalar(lambda s: -warmth(s), bounds=(-0.5, 0.99), method="bounded")
    assert -best.fun == pytest.approx(h.ELLIPTIC, abs=2e-7)


def test_blok_makes_both_flanks_equally_hot():
    """Even heat: Blok's with factor sqrt(2/pi) is the flash rise of either flank with its share."""
    v1, v2, f, w, width, b = 1.36, 7.14, 0.09, 9e3, 5.7e-5, 13681.0
    share = math.sqrt(v1) / (math.sqrt(v1) + math.sqrt(v2))
    heat = f * w * (v2 - v1)
    pinion = h.flash_rise(share * heat, width, v1, b)
    gear = h.flash_rise((1.0 - share) * heat, width, v2, b)
    assert pinion == pytest.approx(gear, rel=1e-14)
    even = h.blok_rise(f, w, v1, v2, width, b, b) * math.sqrt(2.0 / math.pi) / h.ELLIPTIC
    assert even == pytest.approx(pinion, rel=1e-14)


@given(
    st.floats(233.15, 473.15),
    st.floats(-12.0, 8.0),
    st.sampled_from([0.0, 0.3, 1.0]),
    st.floats(-6.0, 12.0),
)
def test_the_root_is_bracketed_and_exact_from_freezing_to_absurd(bulk, decades, exponent, cap):
    rise, cap = 10.0**decades, 10.0**cap
    t, stress, status, n = root(bulk, rise, exponent, cap)
    assert status == 0 and n <= 60
    assert bulk <= t <= bulk + rise * min(1.0, cap) * (1 + 1e-12) + 1e-9
    assert t - bulk == pytest.approx(rise * stress, rel=1e-9, abs=1e-9)
    shear = math.exp(exponent * B * (1 / (t - 273.15 + C) - 1 / (bulk - 273.15 + C)))
    limited = h.shear_stress(shear, cap)[0]
    assert stress == pytest.approx(limited, rel=1e-9)


def test_a_limited_stress_never_passes_its_limit_and_is_untouched_far_below():
    assert h.shear_stress(1e6, 1e7) == (1e6, 1.0)
    assert h.shear_stress(1e9, 1e7) == (1e7, 0.0)
    assert max(h.shear_stress(s, 1e7)[0] for s in np.linspace(8e6, 1.2e7, 50)) <= 1e7


# The gear mesh's derivatives over its inputs: against differences, at every law and corner.

CHOICES = {
    f.name: list(f.metadata["options"])
    for f in fields(GearMeshParams)
    if f.metadata["kind"] == "enumeration"
}
# What is made of the asperities' rise over the oil: lost in the oil's 300 K if it is minute.
OF_THE_RISE = [i for i, n in enumerate(NAMES) if n.startswith(("thermal", "modification"))]


def slopes_mesh(fidelity="field", **changes):
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
        if changes["friction_law"] in {"mixed", "efficiency"}:
            changes["friction_law"] = "iso"
    changes["permissible_film_ratio"] = float(rng.choice([0.0, 0.3]))
    unit = slopes_mesh(str(rng.choice(list(SPEC.levels))), **changes)
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
    unit = slopes_mesh(friction_law=friction_law)
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
    unit = slopes_mesh(fidelity, friction_law=friction_law)
    worst = compared(unit, np.array([*point, 299.85]))
    if friction_law == "efficiency" and point[0] == 0.0:  # both ways differ by the load's cube
        worst[[NAMES.index(n) for n in ("friction_torque", "friction_power", "oil_heat")], 0] = 0.0
    assert worst.max() < 1e-6
