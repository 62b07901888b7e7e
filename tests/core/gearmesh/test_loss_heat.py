"""Heat that is the loss: check numbers, closed forms, limits and the balance of heat."""

import math
from dataclasses import replace

import helical_pair
import numpy as np
import pytest
from built import built_fmu
from closed_forms.flash_temperature import (
    ELLIPTIC,
    Body,
    atan_flash,
    blok_flash,
    deep_body_rise,
    pinion_flash,
)
from closed_forms.involute_mesh import Mesh, flanks_at, line_load, start_of_contact
from closed_forms.line_contact import compliance, full_width, peak_pressure
from closed_forms.thermal_fatigue import (
    Endurance,
    contact_stress,
    grouped_factor,
    modification_factor,
    thermal_stress,
)
from helical_pair import Pair
from kernel_part import Part
from scipy.integrate import quad, solve_ivp

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.fmu.stepper import Instance
from thrustwasher.gearmesh.kernels import constants
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.kernels.mesh_point import LEAST_LINE_LOAD
from thrustwasher.gearmesh.parameters import SPEC
from thrustwasher.gearmesh.solve import prepare

OIL, HELIX, FACE, SPEED, FORCE = 358.15, math.radians(20.0), 22e-3, 510.0, 1000.0
SUN = GearMeshParams(
    gear_ratio=38 / 18,
    pinion_teeth=18,
    normal_module=1.5e-3,
    helix_angle=HELIX,
    face_width=FACE,
    mean_roughness=0.3e-6,
    youngs_modulus=206e9,
    conductivity=45.0,
    heat_capacity=440.0,
    density=7800.0,
    viscosity_scale=8.28494e-3 * math.exp(-1074.1 / 214.5),
    viscosity_b=1074.1,
    viscosity_c=129.5,
    pressure_viscosity=1.7e-8,
)
RING = replace(SUN, gear_ratio=74 / 18, internal=True, addendum_gear=0.8)
PAIRS = {
    "sun": (SUN, Pair(18, 38, 1.5e-3, SUN.pressure_angle, HELIX)),
    "ring": (RING, Pair(18, 74, 1.5e-3, SUN.pressure_angle, HELIX, 1.0, 0.8, -1.0)),
    "spur": (replace(SUN, helix_angle=0.0), Pair(18, 38, 1.5e-3, SUN.pressure_angle)),
    "narrow": (replace(SUN, face_width=8e-3), Pair(18, 38, 1.5e-3, SUN.pressure_angle, HELIX)),
}
RADIUS = PAIRS["sun"][1].radius
EFFUSIVITY, THETA = math.sqrt(45.0 * 440.0 * 7800.0), 2.0 * (1.0 - 0.3**2) / 206e9


def at(params, force=FORCE, speed=SPEED, fidelity="field", **changes):
    torque = force * PAIRS["spur" if params.helix_angle == 0.0 else "sun"][1].radius
    return solve_gearmesh(
        replace(params, **changes),
        power=torque * speed,
        speed=speed,
        oil_temperature=OIL,
        fidelity=fidelity,
    )


def arrays(params, fidelity="field"):
    """Return the constants, and positions, weights, shares of the path."""
    par = prepare(params, fidelity)
    n = int(par[L.D_PLACES])
    return par, *(par[i : i + n] for i in (L.D_POSITION, L.D_PATH_LENGTH, L.D_PATH_SHARE))


def test_geometry_and_pressures_of_the_sun_mesh():
    pair, par = PAIRS["sun"][1], prepare(SUN, "field")
    line = par[L.D_CENTRE] * math.sin(par[L.D_ANGLE])
    pitch = par[L.D_CONTACT_RATIO] * pair.base_pitch
    start = par[L.D_START] * line
    pole = line / (1.0 + SUN.gear_ratio)
    assert par[L.D_CONTACT_RATIO] == pytest.approx(1.488514, abs=5e-7)
    found = np.array([start, pole, start + pitch])
    assert 1e3 * found == pytest.approx([1.540668, 5.188892, 8.501400], abs=5e-7)
    assert found == pytest.approx(helical_pair.path_of_contact(pair), rel=1e-13)
    position = arrays(SUN)[1]
    load = math.sqrt(FORCE * RADIUS * par[L.D_LOAD])
    peaks = 4.0 / math.pi * load * par[L.D_PATH_PRESSURE : L.D_PATH_PRESSURE + len(position)]
    assert 1e-6 * peaks[0] == pytest.approx(895.366, abs=5e-4)
    assert 1e-6 * peaks[position == 0.0] == pytest.approx(563.299, abs=5e-4)
    assert at(SUN).contact_pressure_max == pytest.approx(peaks[0], rel=1e-14)


def test_pitting_stress_and_its_safety():
    r = at(SUN)
    assert 1e-6 * r.pitting_stress == pytest.approx(581.094, abs=5e-4)
    assert 1e-6 * at(SUN, load_factor=1.5).pitting_stress == pytest.approx(711.69, abs=0.01)
    assert r.pitting_safety == pytest.approx(1500.0 / 581.094, rel=1e-6)
    assert at(SUN, contact_limit=1e9).pitting_safety == pytest.approx(1e3 / 581.094, rel=1e-6)
    for name, (params, pair) in PAIRS.items():
        wanted = helical_pair.pitting_stress(pair, FORCE, params.face_width, 206e9, 0.3)
        assert at(params).pitting_stress == pytest.approx(wanted, rel=1e-12), name


def flash_at(params, pair, rho, friction=1.0):
    """Return Blok's temperature of evenly spread heat where the pinion's radius is ``rho``."""
    force = FORCE * RADIUS / pair.radius
    load = force / (math.cos(pair.angle) * sum(helical_pair.contact_ratios(pair)) * FACE)
    width = full_width(load, helical_pair.normal_radius(pair, rho), THETA)
    speeds = helical_pair.rolling(pair, rho, SPEED)
    return blok_flash(load, friction, *speeds, width, EFFUSIVITY)


@pytest.mark.parametrize("name", ["sun", "ring"])
@pytest.mark.parametrize("fidelity", SPEC.levels)
def test_loss_and_flash_are_those_of_the_closed_forms(name, fidelity):
    params, pair = PAIRS[name]
    r = at(params, fidelity=fidelity, friction_law="constant")
    torque = FORCE * RADIUS

    def heat(rho):
        first, second = helical_pair.rolling(pair, rho, SPEED)
        return abs(first - second)

    start, pole, end = helical_pair.path_of_contact(pair)
    slid = sum(quad(heat, *ends, epsrel=1e-13)[0] for ends in ((start, pole), (pole, end)))
    force = torque / (pair.radius * math.cos(pair.angle) * math.cos(pair.base_helix))
    assert r.friction_power == pytest.approx(0.05 * force * slid / (end - start), rel=1e-12)
    closed = 0.05 * helical_pair.loss_factor(pair, 1.0) * torque * SPEED
    assert r.friction_power == pytest.approx(closed, rel=1e-12)
    most = max(flash_at(params, pair, rho, 0.05) for rho in np.linspace(start, end, 301))
    most *= helical_pair.helical_factor(pair, FACE) ** 0.75
    assert r.flash_max == pytest.approx(most, rel=1e-12)


@pytest.mark.parametrize("name", list(PAIRS))
@pytest.mark.parametrize("law", ["constant", "iso", "li-seireg", "mixed"])
@pytest.mark.parametrize("fidelity", ["field", "fine"])
def test_the_heat_of_all_positions_is_the_friction_power(name, law, fidelity):
    params = replace(PAIRS[name][0], friction_law=law, sigma_rms=0.1e-6, load_factor=1.4)
    pair = PAIRS[name][1]
    _, position, weight, share = arrays(params, fidelity)
    part, torque = Part("gearmesh", fidelity, params), FORCE * RADIUS
    assert part.step((torque, SPEED, OIL)) == 0
    work, out = part.work, part.out
    friction = work[L.W_FRICTION : L.W_FRICTION + len(position)]
    if law in ("constant", "iso"):
        friction = np.full(len(position), work[L.F_FRICTION])
    else:
        assert np.ptp(friction) > 1e-3
    rho = pair.radius * math.sin(pair.angle) + position * pair.base_pitch
    sliding = np.abs(np.subtract(*helical_pair.rolling(pair, rho, SPEED)))
    load = share * torque / (pair.radius * math.cos(pair.angle) * params.face_width)
    q = friction * load * sliding  # W per metre of path and contact line
    total = (q * weight).sum() * params.face_width / math.cos(pair.base_helix)
    assert total == pytest.approx(out[L.F_POWER], rel=1e-12)


@pytest.mark.parametrize("name", ["sun", "ring"])
def test_steady_bodies_are_047_of_the_mean_flash_above_the_oil(name):
    params, pair = PAIRS[name]
    r = at(params)
    start, pole, end = helical_pair.path_of_contact(pair)
    mean = sum(
        quad(lambda rho: flash_at(params, pair, rho), *ends, epsrel=1e-10)[0]
        for ends in ((start, pole), (pole, end))
    ) / (end - start)
    mean *= helical_pair.helical_factor(pair, FACE) ** 0.75
    wanted = 0.47 * r.scuffing_friction * mean  # of the standard's friction, whatever the loss
    assert r.bulk_temperature - OIL == pytest.approx(wanted, rel=1e-4)
    sprayed = at(params, lubrication_factor=1.2).bulk_temperature - OIL
    assert sprayed / (r.bulk_temperature - OIL) == pytest.approx(1.2, rel=1e-12)
    assert r.oil_heat == pytest.approx(r.friction_power, rel=1e-13)
    given = at(params, bulk_conductance=10.0).bulk_temperature - OIL
    assert given == pytest.approx(r.friction_power / 10.0, rel=1e-12)


def test_a_ring_and_a_gear_of_endless_size_are_the_same_rack():
    shape = 1e7, 18.0, 0.35, 1.0
    starts = [constants.start_of_contact(*shape, side) for side in (1.0, -1.0)]
    assert starts[0] == pytest.approx(starts[1], rel=1e-5)
    paths = [constants.path_lengths(*shape, x, s) for x, s in zip(starts, (1.0, -1.0), strict=True)]
    assert paths[0] == pytest.approx(paths[1], rel=1e-5)


def test_the_path_of_a_spur_pair_is_that_of_the_papers_geometry():
    p = GearMeshParams()
    loss, paper = prepare(p, "field"), prepare(GearMeshParams.preset("paper"), "field")
    for place in (L.D_START, L.D_CONTACT_RATIO, L.D_LOSS, L.D_LINE, L.D_RADIUS, L.D_SLIDING):
        assert loss[place] == paper[place]
    by_module = replace(p, normal_module=0.254 / 30.0)
    assert prepare(by_module, "field")[L.D_CENTRE] == pytest.approx(0.254, rel=1e-14)


class Run(Part):
    """A mesh stepped through time, with the heat made and that handed to the oil."""

    def __init__(self, params):
        super().__init__("gearmesh", "field", params)
        self.par[L.P_THERMAL_MODE] = 2.0  # which a solution without a past is not
        self.made = self.handed = 0.0

    def step(self, load, speed, oil, dt):
        assert super().step((load, speed, oil), dt) == 0
        self.made += self.out[L.F_POWER] * dt
        self.handed += self.out[L.F_OIL_HEAT] * dt


@pytest.mark.parametrize("law", ["iso", "mixed"])
@pytest.mark.parametrize("start", ["steady", "oil"])
@pytest.mark.parametrize(
    "params", [SUN, RING, GearMeshParams.preset("paper")], ids=["sun", "ring", "paper"]
)
def test_heat_made_is_heat_stored_and_handed_to_the_oil(law, start, params):
    if params.film_heat == "loss":
        params = replace(params, friction_law=law, thermal_start=start)
    run, rng = Run(params), np.random.default_rng(4)
    run.step(20.0, 300.0, OIL, 1e-3)
    first = run.out[L.F_BULK] - run.out[L.F_STORED] / run.par[L.D_BULK_CAPACITY]
    for _ in range(400):
        run.step(
            rng.uniform(-30.0, 30.0),
            rng.uniform(-50.0, 600.0),
            OIL + rng.uniform(0.0, 9.0),
            10.0 ** rng.uniform(-4.0, 2.0),
        )
    assert run.out[L.F_STORED] + run.handed == pytest.approx(run.made, rel=1e-9)
    assert run.out[L.F_OIL_ENERGY] == pytest.approx(run.handed, rel=1e-12)
    if params.film_heat == "loss":
        rise = run.out[L.F_BULK] - first
        assert run.par[L.D_BULK_CAPACITY] * rise == pytest.approx(run.out[L.F_STORED], rel=1e-9)


def test_the_bodies_step_is_exact_and_bounded_however_long():
    slow, fast = (Run(replace(SUN, thermal_start="oil")) for _ in range(2))
    for _ in range(1000):
        fast.step(14.0, SPEED, OIL, 0.01)
    slow.step(14.0, SPEED, OIL, 10.0)
    assert fast.out[L.F_BULK] == pytest.approx(slow.out[L.F_BULK], rel=1e-13)
    assert fast.handed == pytest.approx(slow.handed, rel=1e-10)
    slow.step(14.0, SPEED, OIL, 1e9)
    steady = solve_gearmesh(SUN, power=14.0 * SPEED, speed=SPEED, oil_temperature=OIL)
    assert slow.out[L.F_BULK] == pytest.approx(steady.bulk_temperature, rel=1e-12)


def test_the_bodies_cool_at_rest_and_store_by_their_masses():
    run = Run(SUN)
    run.step(14.0, SPEED, OIL, 1.0)
    hot = run.out[L.F_BULK]
    run.step(0.0, 0.0, OIL, 5000.0)
    assert run.out[L.F_BULK] < OIL + 0.01 * (hot - OIL)
    gear = RADIUS * SUN.gear_ratio
    mass = math.pi * FACE * (RADIUS**2 + gear**2) * 7800.0
    assert run.par[L.D_BULK_CAPACITY] == pytest.approx(440.0 * mass, rel=1e-12)


def test_load_factor_raises_temperatures_and_stresses_but_no_heat():
    one, more = at(SUN), at(SUN, load_factor=1.5)
    for name in ("friction_power", "mean_friction", "scuffing_friction", "oil_heat"):
        assert getattr(more, name) == pytest.approx(getattr(one, name), rel=1e-14)
    assert more.flash_max / one.flash_max == pytest.approx(1.5**0.75, rel=1e-13)
    assert more.contact_pressure_max / one.contact_pressure_max == pytest.approx(1.5**0.5)


def test_scuffing_and_micropitting_by_hand():
    r = at(SUN, fzg_stage=9, structural_factor=1.1, permissible_film_ratio=0.4)
    scuffs = 80.0 + (0.85 + 1.4 * 1.1) * 8.28494**-0.05 * 81.0
    touching = r.bulk_temperature + r.flash_max - 273.15
    assert r.scuffing_margin == pytest.approx(scuffs - touching, rel=1e-12)
    assert r.scuffing_safety == pytest.approx((scuffs - 85.0) / (touching - 85.0), rel=1e-10)
    assert r.micropitting_safety == pytest.approx(r.film_ratio_gf / 0.4, rel=1e-14)


def test_mixed_friction_has_the_mean_of_the_loss_law_until_its_film_is_full():
    mean = at(SUN).mean_friction
    some = at(SUN, friction_law="mixed", sigma_rms=0.5e-6)
    assert some.mean_friction == pytest.approx(mean, rel=1e-8)
    assert some.friction_coefficient != pytest.approx(mean, rel=1e-2)
    dry = at(SUN, friction_law="mixed", sigma_rms=2e-5)
    assert dry.friction_coefficient == pytest.approx(mean, rel=1e-2)
    full = at(SUN, friction_law="mixed", sigma_rms=1e-9)
    assert full.mean_friction <= SUN.limiting_traction
    # without asperities nothing is left to calibrate: what shears is the film
    thinner = at(SUN, friction_law="mixed", sigma_rms=1e-9, eyring_stress=2.5e6)
    assert thinner.mean_friction < full.mean_friction
    slow, standard = (at(SUN, friction_law=law, speed=1e-3) for law in ("mixed", "schlenk"))
    assert slow.friction_coefficient == pytest.approx(standard.mean_friction, rel=1e-2)
    assert standard.mean_friction <= 0.065  # boundary friction bounds it


def test_li_seireg_and_mixed_follow_the_bodies_temperature():
    for law in ("li-seireg", "mixed"):
        hot = at(SUN, friction_law=law, sigma_rms=0.1e-6, bulk_conductance=0.7)
        cold = at(SUN, friction_law=law, sigma_rms=0.1e-6, viscosity_at="inlet")
        assert hot.bulk_temperature > OIL + 50.0
        assert hot.film_thickness < cold.film_thickness
        rise = hot.friction_power / 0.7
        assert hot.bulk_temperature - OIL == pytest.approx(rise, rel=1e-10)


def test_twice_as_many_positions_hardly_change_the_loss():
    for name, (params, _) in PAIRS.items():
        for law in ("mixed", "li-seireg"):
            field, fine = (
                at(params, fidelity=f, friction_law=law, sigma_rms=0.1e-6).friction_power
                for f in ("field", "fine")
            )
            assert field == pytest.approx(fine, rel=1e-3), (name, law)


@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_what_cannot_be_is_refused_in_one_line(ratio):
    with pytest.raises(ParameterError, match=r"addendum_gear = 1.0, allowed: less for a ring.*$"):
        replace(SUN, internal=True, gear_ratio=ratio)


def test_mixed_friction_needs_the_heat_of_the_loss():
    with pytest.raises(ParameterError, match="friction_law = 'mixed' or 'efficiency': the paper"):
        GearMeshParams.preset("paper", friction_law="mixed")


@pytest.mark.parametrize("celsius", [-10.0, 0.0, 10.0, 26.7, 60.0, 120.0])
def test_a_film_is_no_hotter_than_its_shear_makes_it(celsius):
    params, oil = GearMeshParams(), 273.15 + celsius
    r = solve_gearmesh(params, power=7500.0, speed=180.0, oil_temperature=oil)
    rise, at = r.film_temperature - r.surface_temperature, r.surface_temperature - 273.15
    warm = at + params.viscosity_c
    viscosity = params.viscosity_scale * math.exp(params.viscosity_b / warm)
    # u^2 mu/(8 k) with mu = mu_0 exp(-beta dT): the middle of a film between equal walls
    beta, free = params.viscosity_b / warm**2, viscosity * r.sliding_speed**2 / (8.0 * 0.13)
    sheared = math.log1p(beta * free) / beta
    mean = r.sliding_speed / r.slide_roll_ratio
    line = 0.25 * math.pi * r.hertz_pressure * r.hertz_width
    heat = r.scuffing_friction * line * r.sliding_speed
    carried = heat / (880.0 * 2010.0 * r.film_thickness * mean)
    assert 0.0 < rise < min(sheared, carried)
    assert rise == pytest.approx(1.0 / (1.0 / sheared + 1.0 / carried), rel=1e-6)


def test_hotter_oil_makes_a_hotter_film():
    found = [
        solve_gearmesh(SUN, power=5e4, speed=SPEED, oil_temperature=oil).film_temperature
        for oil in np.linspace(235.0, 420.0, 38)
    ]
    assert np.all(np.diff(found) > 0.0)


# The gear mesh's temperatures and stresses derived again from heat flow and contact.

PHI, E, NU, FORMS_SPEED, POWER, FORMS_FACE = math.radians(20.0), 205e9, 0.3, 180.0, 7500.0, 0.05
STEEL = Body(compliance(E, NU), 50.2, 7850.0, 475.0)
FORMS_THETA = 2.0 * STEEL.compliance
HIGH_CARBON = Endurance(0.53, 0.40)


def contact(mesh, speed=FORMS_SPEED, power=POWER):
    flanks = flanks_at(start_of_contact(mesh), mesh, speed)
    load = line_load(power / speed, mesh, FORMS_FACE)
    return flanks, load, full_width(load, flanks.radius, FORMS_THETA)


def test_a_deep_body_warms_as_heat_conduction_says():
    """Finite volumes over a depth that the heat does not reach in the time."""
    k, c, time = 50.2, 7850.0 * 475.0, 1e-4
    depth = 12.0 * math.sqrt(k / c * time)
    edges = depth * np.linspace(0.0, 1.0, 241) ** 2
    size, middle = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    between = k / np.diff(middle)

    def warming(_, t):
        flow = np.concatenate(([1.0], -between * np.diff(t), [0.0]))
        return -np.diff(flow) / (c * size)

    run = solve_ivp(
        warming, (0.0, time), np.zeros(240), method="LSODA", lband=1, uband=1, rtol=1e-8, atol=1e-16
    )
    surface = run.y[0, -1] + 1.0 * middle[0] / k
    assert surface == pytest.approx(deep_body_rise(1.0, time, math.sqrt(k * c)), rel=1e-4)


@pytest.mark.parametrize(("m", "n", "ratio"), [(2.0, 20, 1.67), (2.0, 30, 1.32), (5.0, 20, 1.73)])
def test_half_the_heat_overheats_the_slow_flank(m, n, ratio):
    mesh = Mesh(m, n, 0.254, PHI)
    flanks, load, width = contact(mesh)
    half = pinion_flash(mesh, POWER / FORMS_SPEED, FORMS_SPEED, FORMS_FACE, 0.5 * 0.08, STEEL)
    blok = blok_flash(
        load, 0.08, flanks.speed_pinion, flanks.speed_gear, width, STEEL.effusivity, ELLIPTIC
    )
    assert half / blok == pytest.approx(ratio, abs=6e-3)


def test_without_the_cosine_in_eq_9_eq_12_would_not_follow():
    """The load is the torque over the *base* radius; over the pitch radius K is 6.4 % larger."""
    mesh = Mesh(2.0, 25, 0.254, PHI)
    flanks, load, _ = contact(mesh)
    rise = atan_flash(mesh, POWER, FORMS_SPEED, FORMS_FACE, 0.4, STEEL)
    printed = contact_stress(load * math.cos(PHI), flanks.radius, E)
    short = modification_factor(thermal_stress(rise, E, NU, 12e-6), printed, HIGH_CARBON)
    long = grouped_factor(
        mesh, POWER, FORMS_SPEED, FORMS_FACE, 0.4, HIGH_CARBON, E, NU, 12e-6, STEEL.effusivity
    )
    assert max(short / long, long / short) == pytest.approx(1.064, abs=1e-3)


@pytest.mark.parametrize("place", [-0.7, 0.2, 0.9])
def test_the_pressure_flattens_the_gap(place):
    """Slope of two half spaces: -(2 theta/pi) times the principal value of p(s)/(x - s)."""
    load, radius = 2.5e4, 0.008
    half, top = (
        0.5 * full_width(load, radius, FORMS_THETA),
        peak_pressure(load, radius, FORMS_THETA),
    )
    value = quad(lambda u: -math.sqrt(1.0 - u * u), -1.0, 1.0, weight="cauchy", wvar=place)[0]
    assert -2.0 * FORMS_THETA / math.pi * top * value == pytest.approx(
        -place * half / radius, rel=1e-6
    )


# A mesh under torque and speed of either sign: the other flanks bear, the loss stays a loss.

COASTING_PAIRS = {
    "default": GearMeshParams(),
    "helical": GearMeshParams.preset("planet"),
    "shifted": GearMeshParams(profile_shift_pinion=0.3, profile_shift_gear=-0.1),
    "elastic": GearMeshParams(
        load_sharing="elastic", tip_relief_pinion=10e-6, tip_relief_length_pinion=2e-3
    ),
    "paper": GearMeshParams.preset("paper"),
}
QUADRANTS = [(a, b) for a in (1.0, -1.0) for b in (1.0, -1.0)]


def mesh_of(name):
    return Part("gearmesh", "field", COASTING_PAIRS[name])


def coasting_at(mesh, load, speed):
    """Return the real outputs of the step that FMUs make, at a point."""
    mesh.state[:] = 0.0
    assert mesh.step([load, speed, 353.15]) == 0
    return {name: mesh[name] for name in mesh.reals}


@pytest.mark.parametrize("pair", COASTING_PAIRS)
def test_all_four_quadrants_lose_the_same(pair):
    """Neither flank nor driver is in the laws: the profile is that of both flanks."""
    mesh = mesh_of(pair)
    one = coasting_at(mesh, 40.0, 180.0)
    for load, speed in QUADRANTS:
        found = coasting_at(mesh, 40.0 * load, 180.0 * speed)
        for name, value in one.items():
            sign = speed if name == "friction_torque" else 1.0
            assert found[name] == sign * value, name
        given, left = 40.0 * load * 180.0 * speed, 40.0 * load - found["friction_torque"]
        assert given - left * 180.0 * speed == pytest.approx(found["friction_power"], rel=1e-9)
        assert found["friction_power"] > 0.0


@pytest.mark.parametrize("pair", COASTING_PAIRS)
def test_the_loss_passes_through_no_torque_smoothly(pair):
    """Continuous with its slope, and exact outside the stated width of 2 N/m of line load."""
    mesh = mesh_of(pair)
    width = 2.0 * LEAST_LINE_LOAD / mesh.par[L.D_LINE]
    torques = np.linspace(-2.0 * width, 2.0 * width, 401)
    loss = np.array([coasting_at(mesh, t, 180.0)["friction_torque"] for t in torques])
    slopes = np.diff(loss) / np.diff(torques)
    assert loss[200] == 0.0 and (loss >= 0.0).all() and loss == pytest.approx(loss[::-1])
    assert abs(slopes).max() < 0.2
    assert abs(np.diff(slopes)).max() < 0.05 * abs(slopes).max()
    if COASTING_PAIRS[pair].load_sharing == "rigid":
        found = coasting_at(mesh, width, 180.0)
        sharp = found["mean_friction"] * mesh.par[L.D_LOSS] * width
        assert found["friction_torque"] == pytest.approx(sharp, rel=1e-12)


def test_the_sign_of_the_power_given_does_not_matter():
    """The power of a mesh seen from Python: recuperation has the other sign."""
    drive, coast = (solve_gearmesh(GearMeshParams(), power=p, speed=180.0) for p in (7e3, -7e3))
    assert drive.friction_power == coast.friction_power > 0.0
    back = solve_gearmesh(GearMeshParams(), power=7e3, speed=-180.0)
    assert back.friction_torque == -drive.friction_torque and math.isfinite(back.film_thickness)


def test_the_fmu_passes_from_drive_to_coasting_without_a_jump():
    """1 N m to -1 N m in steps of 0.01 N m: the loss changes by less than 4e-5 N m in each."""
    with Instance(built_fmu("gearmesh", local=True)) as mesh:
        names = [s.name for s in SPEC.outputs]
        place, losses = names.index("friction_torque"), []
        mesh.initialize(0.0, {"load": 1.0, "speed": 180.0, "oil_temperature": 353.15})
        for i, torque in enumerate(np.linspace(1.0, -1.0, 201).tolist()):
            mesh.set_inputs([torque, 180.0, 353.15])
            mesh.step(1e-3 * i, 1e-3)
            losses.append(mesh.outputs()[place])
    assert min(losses) == pytest.approx(0.0, abs=1e-15) and losses[0] > 1e-3
    assert abs(np.diff(losses)).max() < 4e-5
    assert losses == pytest.approx(losses[::-1], rel=1e-3, abs=1e-12)
