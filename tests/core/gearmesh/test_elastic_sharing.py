"""Load shared by the stiffness of the pairs, with tip relief: limits, balances, a plain sum."""

import math
from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.kernels.load_sharing import pitch_of, shared, single_stiffness
from thrustwasher.gearmesh.kernels.step import sens, step
from thrustwasher.gearmesh.solve import prepare

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
SPEED, OIL, TORQUE = 200.0, 363.0, 183.4


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
    return solve_gearmesh(params, power=torque * SPEED, speed=SPEED, oil_temperature=OIL)


def path(params, torque=TORQUE):
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
def test_all_shares_together_are_the_load(params, face, torque):
    _, _, length, share = path(relieved(params, length=6e-3, face_width=face), torque)
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
    _, _, length, share = path(relieved(length=9e-3), torque=0.01)
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
    inputs = np.array([torque, SPEED, OIL])
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
    par, _, length, share = path(high)
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
