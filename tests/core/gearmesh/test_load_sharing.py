"""One load share X along the path: from spur teeth to those whose overlap is 1 without a jump."""

import math
from dataclasses import replace
from itertools import pairwise

import helical_pair
import numpy as np
import pytest
from helical_pair import Pair
from scipy.integrate import quad

from thrustwasher import GearMeshParams, solve_gearmesh
from thrustwasher.gearmesh.kernels import constants
from thrustwasher.gearmesh.kernels import layout as L
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
