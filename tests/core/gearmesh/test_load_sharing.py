"""One load share X along the path: from spur teeth to those whose overlap is 1 without a jump."""

import math
from dataclasses import replace
from itertools import pairwise

import helical_pair
import numpy as np
import pytest
from helical_pair import Pair
from reference_pairs import H951, of_viscosity
from scipy.integrate import quad

from thrustwasher import GearMeshParams, ParameterError, Status, solve_gearmesh
from thrustwasher.gearmesh.kernels import constants
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.kernels.load_sharing import pitch_of, shared, single_stiffness
from thrustwasher.gearmesh.kernels.step import sens, step
from thrustwasher.gearmesh.solve import prepare

HELIX, MODULE, OIL = math.radians(20.0), 1.5e-3, 358.15
SUN = GearMeshParams(
    gear_ratio=38 / 18,
    pinion_teeth=18,
    normal_module=MODULE,
    helix_angle=HELIX,
    surface="fine",
    mean_roughness=0.3e-6,
    friction_law="constant",
)
FACE = math.pi * MODULE / math.sin(HELIX)  # of an overlap of 1
PAIR = Pair(18, 38, MODULE, SUN.pressure_angle, HELIX)
RING = replace(SUN, gear_ratio=74 / 18, internal=True, addendum_gear=0.8)
HIGH = replace(SUN, pinion_teeth=40, gear_ratio=2.0, addendum=1.35)  # contact ratio above 2.05


def at(overlap, params=SUN, fidelity="field", **changes):
    """Solve under the same force per face width."""
    params = replace(params, face_width=overlap * FACE, **changes)
    return solve_gearmesh(
        params, power=14.0 * overlap * 500.0, speed=500.0, oil_temperature=OIL, fidelity=fidelity
    )


def path(params, overlap, fidelity="field"):
    par = prepare(replace(params, face_width=overlap * FACE), fidelity)
    n = int(par[L.D_PLACES])
    return par, *(par[i : i + n] for i in (L.D_POSITION, L.D_PATH_LENGTH, L.D_PATH_SHARE))


@pytest.mark.parametrize("params", [SUN, RING, HIGH], ids=["sun", "ring", "high"])
@pytest.mark.parametrize("fidelity", ["field", "fine"])
@pytest.mark.parametrize("overlap", [0.1, 0.5, 0.9, 1.0, 1.7])
def test_all_shares_together_are_the_load(params, fidelity, overlap):
    """Over a mesh cycle: one base pitch passes, every pair adds its share."""
    par, _, length, share = path(params, overlap, fidelity)
    assert (share * length).sum() == pytest.approx(1.0, rel=1e-13)
    assert par[L.D_OVERLAP] == pytest.approx(overlap, rel=1e-13)


def test_spur_and_wide_teeth_share_as_they_did():
    par, position, _, share = path(replace(SUN, helix_angle=0.0), 0.7)
    alone = (position > 1.0 - par[L.D_APPROACH]) & (position < par[L.D_RECESS] - 1.0)
    assert set(share) == {0.5, 1.0} and (share[alone] == 1.0).all()
    shape = SUN.gear_ratio, 18.0, par[L.D_APPROACH], par[L.D_RECESS], 1.0
    assert par[L.D_LOSS] == constants.loss_factor(*shape)
    for overlap in (1.0 + 1e-9, 2.3):
        par, _, _, share = path(SUN, overlap)
        assert set(share) == {1.0 / par[L.D_CONTACT_RATIO]}
        shape = SUN.gear_ratio, 18.0, par[L.D_APPROACH], par[L.D_RECESS], 1.0
        assert par[L.D_LOSS] == constants.wide_loss_factor(*shape) / par[L.D_COS_BASE]


@pytest.mark.parametrize("fidelity", ["field", "fine"])
@pytest.mark.parametrize("law", ["iso", "mixed"])
def test_nothing_jumps_where_the_overlap_passes_one(fidelity, law):
    """The mean flash is summed on other positions there: the bodies' rise moves by rounding."""
    below, above = (
        at(1.0 + side * 1e-9, fidelity=fidelity, friction_law=law, sigma_rms=1e-7)
        for side in (-1.0, 1.0)
    )
    rel = 1e-7 if law == "iso" else 1e-3  # of mixed friction the sum has an error of its own
    for name in ("contact_pressure_max", "flash_max", "pitting_stress"):
        assert getattr(below, name) == pytest.approx(getattr(above, name), rel=rel), name
    assert below.film_ratio_gf == pytest.approx(above.film_ratio_gf, rel=1e-4)
    assert below.friction_power == pytest.approx(above.friction_power, rel=rel)
    rises = [r.bulk_temperature - OIL for r in (below, above)]
    assert rises[0] == pytest.approx(rises[1], rel=1e-3)


def test_nothing_jumps_where_a_helix_begins():
    spur, slight = (at(0.6, helix_angle=angle) for angle in (0.0, 1e-9))
    for name in (
        "friction_power",
        "contact_pressure_max",
        "flash_max",
        "film_ratio_gf",
        "pitting_stress",
        "bulk_temperature",
    ):
        assert getattr(slight, name) == pytest.approx(getattr(spur, name), rel=1e-8), name


@pytest.mark.parametrize("fidelity", ["field", "fine"])
def test_at_half_an_overlap_all_follows_from_the_one_share(fidelity):
    """Loss by quadrature over X |s|, pressure, film and flash from their powers of X at a place."""
    half, whole = at(0.5, fidelity=fidelity), at(1.0, fidelity=fidelity)
    approach, recess = helical_pair.contact_ratios(PAIR)
    cuts = (-approach, recess - 1.0, 0.0, 1.0 - approach, recess)

    def share(s):
        return helical_pair.share(PAIR, 0.5 * FACE, s)

    moment = sum(
        quad(lambda s: abs(s) * share(s), *ends, epsrel=1e-13)[0] for ends in pairwise(cuts)
    )
    front = 2.0 * math.pi * (1 / 18 + 1 / 38) / math.cos(PAIR.base_helix)
    power = 14.0 * 0.5 * 500.0
    assert half.friction_power == pytest.approx(0.05 * front * moment * power, rel=1e-12)
    closed = helical_pair.loss_factor(PAIR, 0.5)
    assert half.friction_power == pytest.approx(0.05 * closed * power, rel=1e-12)
    # Contact starts where pressure, flash and film are extreme; two pairs bear it.
    more = share(-approach) * sum((approach, recess))
    alphas = [1.0 + 516.0 * (1.0 / r.bulk_temperature - 1.0 / 311.0) for r in (half, whole)]
    thinner = (half.viscosity / whole.viscosity) ** 0.7 * (alphas[0] / alphas[1]) ** 0.54
    assert half.film_thickness == pytest.approx(
        whole.film_thickness * more**-0.13 * thinner, rel=1e-9
    )
    edges = [share(s) ** 0.5 / math.sqrt(radius(s)) for s in np.linspace(-approach, recess, 20001)]
    wide = 1.0 / math.sqrt(sum((approach, recess)) * radius(-approach))
    ratio = half.contact_pressure_max / whole.contact_pressure_max
    assert ratio == pytest.approx(max(edges) / wide, rel=2e-4)


def radius(s):
    """Return the combined radius at a place of the path."""
    rho = helical_pair.path_of_contact(PAIR)[1] + s * PAIR.base_pitch
    return helical_pair.normal_radius(PAIR, rho)


def test_loss_and_pressures_move_evenly_with_the_overlap():
    """The loss factor and the pressure's square over that of single contact are straight."""
    overlaps = np.array([0.2, 0.4, 0.6, 0.8])
    runs = [at(x) for x in overlaps]
    alone = [max(helical_pair.single_contact_factors(PAIR, x * FACE)) for x in overlaps]
    for values in (
        [r.friction_power / x for r, x in zip(runs, overlaps, strict=True)],
        [(r.pitting_stress / z) ** 2 for r, z in zip(runs, alone, strict=True)],
    ):
        assert np.diff(values, 2) == pytest.approx(0.0, abs=1e-9 * values[0])


def test_with_many_pairs_pitting_counts_no_less_than_an_even_share():
    """The standard's contact ratio factor reaches zero at a contact ratio of 4."""
    flat = GearMeshParams(addendum=1.5, pinion_teeth=500, pressure_angle=0.2)
    par = prepare(flat, "field")
    assert par[L.D_CONTACT_RATIO] > 4.0
    even = prepare(replace(flat, helix_angle=0.3, face_width=1.0), "field")
    assert par[L.D_PITTING] > 0.0 and even[L.D_OVERLAP] > 1.0
    r = solve_gearmesh(flat, power=7500.0, speed=180.0)
    assert 0.0 < r.pitting_safety < 100.0


# Load shared by the stiffness of the pairs, with tip relief: limits, balances, a plain sum.

RIGID = GearMeshParams(
    gear_ratio=1.5,
    pinion_teeth=16,
    normal_module=4.5e-3,
    profile_shift_pinion=0.1817,
    profile_shift_gear=0.1715,
    working_centre_distance=0.0915,
    tip_diameter_pinion=82.46e-3,
    tip_diameter_gear=118.36e-3,
    face_width=0.014,
)
ELASTIC = replace(RIGID, load_sharing="elastic")
HELICAL = replace(
    ELASTIC,
    working_centre_distance=0.0,
    tip_diameter_pinion=0.0,
    tip_diameter_gear=0.0,
    helix_angle=0.2,
)
SPEED, ELASTIC_OIL, TORQUE = 200.0, 363.0, 183.4


def relieved(params=ELASTIC, amount=35e-6, length=3e-3, **changes):
    """Return the pair with the same relief on both gears."""
    return replace(
        params,
        tip_relief_pinion=amount,
        tip_relief_gear=amount,
        tip_relief_length_pinion=length,
        tip_relief_length_gear=length,
        **changes,
    )


def solved(params, torque=TORQUE):
    return solve_gearmesh(params, power=torque * SPEED, speed=SPEED, oil_temperature=ELASTIC_OIL)


def elastic_path(params, torque=TORQUE):
    par = shared(prepare(params, "field"), torque, np.zeros(L.NWORK))
    n = int(par[L.D_PLACES])
    return par, *(par[i : i + n] for i in (L.D_POSITION, L.D_PATH_LENGTH, L.D_PATH_SHARE))


def plain_loss_factor(params, torque, n=1_000_001):
    """Sum share times sliding at the middles of many short pieces; spur teeth."""
    par = prepare(params, "field")
    approach, recess, load = par[L.D_APPROACH], par[L.D_RECESS], torque * par[L.D_LINE]
    ends = np.linspace(-approach, recess, n)
    s = 0.5 * (ends[1:] + ends[:-1])
    stiffness, gap = [], []
    for k in range(-3, 4):
        at = s + k
        there = (at >= -approach) & (at <= recess)
        across = (2.0 * at - recess + approach) / (approach + recess)
        shape = 1.0 - (1.0 - params.stiffness_at_ends) * across**2
        stiffness.append(np.where(there, single_stiffness(par) * shape, 0.0))
        one, two = (at + approach) * pitch_of(par), (recess - at) * pitch_of(par)
        lift = params.tip_relief_gear * np.maximum(0.0, 1.0 - one / params.tip_relief_length_gear)
        lift += params.tip_relief_pinion * np.maximum(
            0.0, 1.0 - two / params.tip_relief_length_pinion
        )
        gap.append(np.where(there, lift, 1.0))
    stiffness, gap = np.array(stiffness), np.array(gap)
    carries = stiffness > 0.0
    for _ in range(6):
        pressed = load + (stiffness * gap * carries).sum(0)
        pressed /= (stiffness * carries).sum(0)
        carries = (stiffness > 0.0) & (gap < pressed)
    share = stiffness[3] * np.maximum(pressed - gap[3], 0.0) / load
    sliding = (share * np.abs(s)).mean() * (approach + recess)
    teeth, ratio = params.pinion_teeth, params.gear_ratio
    return 2.0 * math.pi * (1.0 + 1.0 / ratio) / teeth * sliding


def test_stiffness_is_that_of_the_standard_by_hand():
    """16 and 24 teeth: q' = 0.04723 + 0.009719 + 0.010746 - ... = 0.065330, c' = 0.8 x ... /q'."""
    x1, x2 = 0.1817, 0.1715
    q = 0.04723 + 0.15551 / 16 + 0.25791 / 24 - 0.00635 * x1 - 0.11654 * x1 / 16
    q += -0.00193 * x2 - 0.24188 * x2 / 24 + 0.00529 * x1**2 + 0.00182 * x2**2
    expected = 0.8 * (1.0 + 0.5 * (1.2 - 1.25)) / q * 205.0 / 206.0  # N/(mm um)
    assert single_stiffness(prepare(ELASTIC, "field")) == pytest.approx(1e9 * expected, rel=1e-12)


@pytest.mark.parametrize("face", [0.014, 0.2], ids=["overlap 0.2", "wide"])
@pytest.mark.parametrize("params", [ELASTIC, HELICAL], ids=["spur", "helical"])
def test_without_relief_and_equally_stiff_it_is_the_rigid_result(params, face):
    params = replace(params, stiffness_at_ends=1.0, face_width=face)
    elastic, rigid = solved(params), solved(replace(params, load_sharing="rigid"))
    for name in ("loss_factor", "friction_power", "flash_max", "contact_pressure_max"):
        assert getattr(elastic, name) == pytest.approx(getattr(rigid, name), rel=1e-9)


@pytest.mark.parametrize("torque", [1.0, 30.0, 183.4, 2000.0])
@pytest.mark.parametrize("face", [0.014, 0.2], ids=["overlap 0.2", "wide"])
@pytest.mark.parametrize("params", [ELASTIC, HELICAL], ids=["spur", "helical"])
def test_all_shares_of_elastic_teeth_are_the_load(params, face, torque):
    _, _, length, share = elastic_path(relieved(params, length=6e-3, face_width=face), torque)
    assert (share * length).sum() == pytest.approx(1.0, rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("amount", "length", "torque"),
    [(35e-6, 4e-3, 183.4), (10e-6, 6e-3, 183.4), (35e-6, 3e-3, 20.0), (35e-6, 3e-3, 2000.0)],
)
def test_loss_factor_is_the_sum_over_many_positions(amount, length, torque):
    params = relieved(amount=amount, length=length)
    expected = plain_loss_factor(params, torque)
    assert solved(params, torque).loss_factor == pytest.approx(expected, rel=1e-6)


def test_one_pair_is_alone_where_relief_exceeds_the_deflection():
    """But for the short stretch where the gaps of two pairs are equal."""
    _, _, length, share = elastic_path(relieved(length=9e-3), torque=0.01)
    assert length[(share > 1e-3) & (share < 1.0 - 1e-3)].sum() < 1e-3


def test_a_large_load_presses_the_relief_shut():
    free = solved(ELASTIC, 9e3).loss_factor
    off = [solved(relieved(amount=a), 9e3).loss_factor / free - 1.0 for a in (1e-6, 1e-7, 1e-8)]
    assert abs(off[2]) < 2e-5
    assert off[1] / off[2] == pytest.approx(10.0, rel=0.05)


def test_constant_friction_loses_friction_times_loss_factor_times_power():
    r = solved(relieved(friction_law="constant", constant_friction=0.04))
    expected = 0.04 * r.loss_factor * TORQUE * SPEED
    assert r.friction_power == pytest.approx(expected, rel=1e-13)


def outputs(par, inputs, state, dt):
    work, out, flags = np.zeros(L.NWORK), np.zeros(L.NOUT), np.zeros(L.NIOUT, np.int32)
    kept = state.copy()
    assert step(par, np.array(inputs), kept, work, out, flags, 0.0, dt) == 0
    return out, work, kept


@pytest.mark.parametrize("torque", [3.0, 20.0, 61.0, 183.4, 500.0])
@pytest.mark.parametrize("law", ["iso", "mixed"])
def test_derivative_follows_the_shares(law, torque):
    """Against central differences, in the middle of a profile, of all that is no integral."""
    par, none = prepare(relieved(friction_law=law), "field"), np.zeros(L.NSTATE)
    par[L.P_THERMAL_MODE] = 2.0
    _, _, state = outputs(par, [150.0, 190.0, 360.0], none, 1.0)
    inputs = np.array([torque, SPEED, ELASTIC_OIL])
    out, work, kept = outputs(par, inputs, state, 0.5)
    for k, h in enumerate((1e-5 * torque, 1e-3, 1e-3)):
        seed, change = np.eye(3)[k], np.zeros(L.NOUT)
        assert sens(par, inputs, kept, work, seed, change) == 0
        more, less = (outputs(par, inputs + s * h * seed, state, 0.5)[0] for s in (1.0, -1.0))
        expected = (more - less) / (2.0 * h)
        expected[[L.F_STORED, L.F_OIL_ENERGY]] = 0.0  # held in a derivative
        scale = np.abs(expected) + 1e-4 * np.abs(out) / inputs[k]
        assert (np.abs(change - expected) <= 2e-6 * scale).all()


def test_shares_fit_for_every_contact_ratio_below_three():
    high = replace(relieved(HELICAL, length=4e-3), pinion_teeth=60, gear_ratio=2.0, addendum=1.45)
    par, _, length, share = elastic_path(high)
    assert 2.0 < par[L.D_CONTACT_RATIO] < 3.0
    assert (share * length).sum() == pytest.approx(1.0, rel=1e-8)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"film_heat": "atan"}, "film_heat = 'loss'"),
        ({"tip_relief_pinion": 1e-5}, "a length above 0"),
        ({"tip_relief_gear": 1e-5, "tip_relief_length_gear": 0.05}, "the path of contact, 19.1"),
        (
            {"addendum": 1.5, "pinion_teeth": 200, "pressure_angle": 0.25},
            "contact ratios from 1 on and below 3",
        ),
    ],
)
def test_what_cannot_be_shared_is_refused(changes, words):
    plain = GearMeshParams(
        gear_ratio=1.5, pinion_teeth=16, normal_module=4.5e-3, load_sharing="elastic"
    )
    start = ELASTIC if "the path" in words else plain
    with pytest.raises(ParameterError, match=words):
        replace(start, **changes)


def test_single_contact_raises_the_pitting_stress_of_shifted_pairs():
    """Z_B = tan a_wt/sqrt((sqrt(d_a1^2/d_b1^2 - 1) - 2 pi/z1)(... - (eps - 1) 2 pi/z2))."""
    r, base = solved(RIGID), 4.5e-3 * math.cos(RIGID.pressure_angle)
    one = math.sqrt((82.46e-3 / (16 * base)) ** 2 - 1.0) - 2.0 * math.pi / 16
    two = math.sqrt((118.36e-3 / (24 * base)) ** 2 - 1.0)
    two -= (r.contact_ratio - 1.0) * 2.0 * math.pi / 24
    z_b = math.tan(r.working_pressure_angle) / math.sqrt(one * two)
    radius = r.pinion_diameter * r.gear_diameter / (4.0 * r.centre_distance)
    radius *= math.sin(r.working_pressure_angle)
    load = TORQUE / (0.5 * r.pinion_diameter * math.cos(r.working_pressure_angle) * 0.014)
    elastic = math.sqrt(load * 205e9 / (2.0 * math.pi * (1.0 - 0.09) * radius))
    z_eps = math.sqrt((4.0 - r.contact_ratio) / 3.0)
    assert z_b > 1.07
    assert r.pitting_stress == pytest.approx(z_b * z_eps * elastic, rel=1e-9)


# Helical teeth whose transverse contact ratio is below 1: their lines of contact never end.

LOW = GearMeshParams(**H951, **of_viscosity(46.23e-3, 75.0), permissible_film_ratio=0.1)
POINT = {"power": 31415.9, "speed": 157.08, "oil_temperature": 348.15}
PRINTED = [
    ("contact_ratio", 0.93, 0.005),
    ("overlap_ratio", 1.00, 0.005),
    ("loss_factor", 0.0688, 0.01),  # summed over the lines there
    ("mean_friction", 0.0415, 0.015),
    ("friction_power", 89.68, 0.01),
    ("contact_pressure_max", 1048.6e6, 0.002),
]


@pytest.mark.parametrize(("output", "printed", "within"), PRINTED)
def test_low_loss_gears_beside_an_open_program(output, printed, within):
    assert getattr(solve_gearmesh(LOW, **POINT), output) == pytest.approx(printed, rel=within)


def test_they_lose_less_than_ohlendorf_says():
    approach, recess = lines_path(LOW)
    ohlendorf = (
        math.pi * (1.0 / 38 + 1.0 / 57) * (1.0 - approach - recess + approach**2 + recess**2)
    )
    par = prepare(LOW, "field")
    assert ohlendorf / par[L.D_COS_BASE] == pytest.approx(0.0739, rel=2e-3)  # printed too
    assert par[L.D_LOSS] < 0.95 * ohlendorf / par[L.D_COS_BASE]


def lines_path(params):
    par = prepare(params, "field")
    return par[L.D_APPROACH], par[L.D_RECESS]


def summed(params, phases=800, width=800):
    """Return loss factor and largest share of the load: all lines on a grid, phase by phase."""
    approach, recess = lines_path(params)
    contact, overlap = approach + recess, solve_gearmesh(params, **POINT).overlap_ratio
    along = (np.arange(width) + 0.5) / width * overlap
    moment, most = 0.0, 0.0
    for phase in (np.arange(phases) + 0.5) / phases:
        length, arm = 0.0, 0.0
        for k in range(math.ceil(contact + overlap)):
            at = phase + k - along  # of the line k, from the start of contact
            inside = at[(at > 0.0) & (at < contact)]
            length += len(inside) / width
            arm += np.abs(inside - approach).sum() / width
        moment += arm / length / phases
        most = max(most, 1.0 / length)
    teeth = params.pinion_teeth, params.pinion_teeth * params.gear_ratio
    cos_base = prepare(params, "field")[L.D_COS_BASE]
    around = 2.0 * math.pi * (1.0 / teeth[0] + 1.0 / teeth[1]) / cos_base
    return around * moment, most


@pytest.mark.parametrize("width", [5e-3, 10e-3, 15e-3, 21.24e-3, 33e-3])
def test_loss_and_load_are_those_of_all_lines_on_a_grid(width):
    params = replace(LOW, face_width=width)
    par = prepare(params, "field")
    factor, most = summed(params)
    assert par[L.D_LOSS] == pytest.approx(factor, rel=2e-3)
    n = int(par[L.D_PLACES])
    shares = par[L.D_PATH_SHARE : L.D_PATH_SHARE + n]
    assert max(shares) == pytest.approx(most, rel=0.02)
    assert sum(par[L.D_PATH_LOSS : L.D_PATH_LOSS + n]) == pytest.approx(1.0, rel=1e-12)
    assert solve_gearmesh(params, **POINT).loss_factor == par[L.D_LOSS]


@pytest.mark.parametrize("width", [12e-3, 21.24e-3, 30e-3])
def test_nothing_jumps_at_a_contact_ratio_of_1(width):
    """By the tip of the gear, with overlaps below and above 1."""
    base = replace(LOW, face_width=width)

    def excess(tip):
        return sum(lines_path(replace(base, tip_diameter_gear=tip))) - 1.0

    low, high = H951["tip_diameter_gear"], H951["tip_diameter_gear"] + 0.6e-3
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0.0 else (low, middle)
    step = 1e-9
    below, above = (
        solve_gearmesh(replace(base, tip_diameter_gear=low + d), **POINT) for d in (-step, step)
    )
    assert below.contact_ratio < 1.0 < above.contact_ratio
    for name in (
        "loss_factor",
        "contact_pressure_max",
        "flash_max",
        "pitting_stress",
        "film_thickness",
        "film_ratio_gf",
    ):
        assert getattr(below, name) == pytest.approx(getattr(above, name), rel=1e-5), name


def test_safeties_come_with_one_warning_and_are_never_ok():
    r = solve_gearmesh(LOW, **POINT)
    assert r.status == Status.OUTSIDE_VERIFIED
    (line,) = [w for w in r.warnings if "outside" in w]
    assert "outside ISO 6336" in line and "all safeties" in line
    assert r.pitting_safety > 1.0 and r.micropitting_safety > 0.0
    wide = solve_gearmesh(replace(LOW, tip_diameter_gear=112.4e-3), **POINT)
    assert wide.contact_ratio > 1.0 and wide.status == Status.OK


def test_lines_that_end_are_refused_with_what_cures_it():
    for width in (1.2e-3, 1.5e-3):
        with pytest.raises(ParameterError, match="more face_width"):
            replace(LOW, face_width=width)
    assert replace(LOW, face_width=2e-3).face_width == 2e-3
    with pytest.raises(ParameterError, match="contact ratios from 1 on"):
        replace(LOW, load_sharing="elastic")
    with pytest.raises(ParameterError, match=r"contact ratio is 0\.8256, allowed: 1 and more$"):
        replace(LOW, helix_angle=0.0, tip_diameter_pinion=73.6e-3, tip_diameter_gear=107.6e-3)
