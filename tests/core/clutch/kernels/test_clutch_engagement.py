"""Film and heat of an engaging pack against an independent implicit solution (Radau, 1e-10)."""

import math

import numpy as np
import pytest
from closed_forms.heated_plate import insulated_plate_rise, semi_infinite_rise
from closed_forms.squeeze_film import squeeze_group, squeeze_time
from clutch_pack import Pack
from clutch_reference import Reference
from hypothesis import given
from hypothesis import strategies as st

from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.kernels.pack_friction import shear_thinned, sheared_share

H = 1e-3
PERMEABILITIES = [0.0, 1e-14, 1e-13, 1e-12, 4e-12]


STEEP = {"friction_temperature": "slope", "friction_temperature_slope": -1e-2}
CORNERS = {  # passed on the way from 24 to some 120 degC
    "friction_temperature": "points",
    **{"point_temperature_1": 303.15, "point_friction_1": 0.185},
    **{"point_temperature_2": 328.15, "point_friction_2": 0.140},
    **{"point_temperature_3": 353.15, "point_friction_3": 0.150},
}


@pytest.mark.parametrize(
    "changes",
    [
        *({"permeability": p} for p in PERMEABILITIES[1:3]),
        CORNERS,
        *(
            pytest.param(changes, marks=pytest.mark.slow)
            for changes in (STEEP, *({"permeability": p} for p in (0.0, *PERMEABILITIES[3:])))
        ),
    ],
    ids=str,
)
def test_a_pack_under_sudden_load_follows_the_tight_reference(changes):
    """Torque to 1e-5 and temperature to 5e-5 K at every millisecond; a step costs few substeps."""
    pack = Pack(**changes)
    reference = Reference(pack.params, lambda t: 5898.0, lambda t: 350.0)
    times = np.arange(301) * H
    film, temperature = reference.solve(times)
    substeps = 0
    for n in range(1, len(times)):
        assert pack.step(5898.0, 350.0, H) == 0
        exact = reference.torque(times[n], film[n], temperature[n])
        assert pack.out[k.O_TORQUE] == pytest.approx(exact, rel=1e-5)
        assert pack.out[k.O_TEMPERATURE] == pytest.approx(temperature[n], abs=5e-5)
        substeps += pack.work[k.W_SUBSTEPS] + pack.work[k.W_REFUSED]
    assert substeps < 1.2 * len(times)


def test_smooth_tight_faces_close_in_the_squeeze_time():
    """Roughness and contact out of the way: t = 3 pi eta G/(4 F) (1/h^2 - 1/h0^2)."""
    params = {"roughness": 1e-8, "permeability": 0.0, "initial_film": 8e-5}
    pack = Pack(**params)
    eta = 0.0
    for t_end in (0.01, 0.05):
        pack = Pack(**params)
        pack.step(2000.0, 0.0, t_end)
        eta, film = pack.out[k.O_VISCOSITY], pack.out[k.O_FILM]
        assert squeeze_time(2000.0, eta, 0.064, 0.085, 8e-5, film) == pytest.approx(t_end, rel=3e-6)


@pytest.mark.parametrize("inner", [0.001, 0.03, 0.064, 0.0849, 0.084999])
def test_the_squeeze_group_keeps_its_digits_in_a_narrow_ring(inner):
    import mpmath as mp

    from thrustwasher.tribology.flow_factors import squeeze_group as kernel_group

    mp.mp.dps = 50
    a, b = mp.mpf(inner) ** 2, mp.mpf(0.085) ** 2
    exact = b * b - a * a - 2 * (b - a) ** 2 / mp.log(b / a)
    assert kernel_group(inner, 0.085) == pytest.approx(float(exact), rel=1e-13)
    assert squeeze_group(0.064, 0.085) == pytest.approx(9.21157e-7, rel=1e-5)


@pytest.mark.parametrize("fidelity", ["stribeck", "field"])
def test_the_contact_rise_is_that_of_a_thick_body_at_first_and_of_a_plate_later(fidelity):
    """Constant flux q: 2 q sqrt(t/(pi k rho c)), later the closed form of an insulated plate."""
    pack = Pack(
        fidelity,
        contact_rise=True,
        heat_transfer=0.0,
        friction_law="constant",
        film_dynamics=False,
        steel_thickness=4e-3,
    )
    body = (50.0, 7850.0, 475.0)
    for n in range(1, 301):
        pack.step(6000.0, 100.0, H)
        flux = pack.out[k.O_HEAT_FLUX]
        rise = pack.out[k.O_TEMPERATURE] - 297.15
        plate = insulated_plate_rise(flux, n * H, 2e-3, *body)
        if n >= 4:  # eight modes resolve a plate of 4 mm from about half a millisecond on
            assert rise == pytest.approx(plate, rel=2e-3)
        if 4 <= n < 30:
            assert rise == pytest.approx(semi_infinite_rise(flux, n * H, *body), rel=3e-3)


def test_the_plate_without_contact_rise_is_its_mean():
    warm, hot = Pack(film_dynamics=False), Pack(film_dynamics=False, contact_rise=True)
    for pack in (warm, hot):
        for _ in range(20):
            pack.step(6000.0, 100.0, H)
    assert hot.state[k.S_HEAT] == pytest.approx(warm.state[k.S_HEAT], rel=1e-12)
    assert hot.out[k.O_TEMPERATURE] > warm.out[k.O_TEMPERATURE] + 1.0


@pytest.mark.parametrize("nahme", [1e-9, 1e-5, 0.3, 8.0, 300.0])
def test_self_heated_shear_solves_its_energy_balance(nahme):
    """Rise w in the gap, w'' = -Na s^2 e^w, w = 0 at both faces; speeds match: s int e^w = 1."""
    from scipy.integrate import solve_bvp

    def rates(z, y, p):
        heat = np.exp(y[0])
        return np.array([y[1], -nahme * p[0] ** 2 * heat, p[0] * heat])

    def ends(a, b, p):
        return np.array([a[0], a[2], b[0], b[2] - 1.0])

    z = np.linspace(0.0, 1.0, 41)
    guess = np.array([0.0 * z, 0.0 * z, z])
    found = solve_bvp(
        rates, ends, z, guess, p=[shear_thinned(nahme)[0]], tol=1e-10, max_nodes=10**5
    )
    assert found.success
    assert shear_thinned(nahme)[0] == pytest.approx(found.p[0], rel=1e-8)


@pytest.mark.parametrize(
    "change",
    [
        {"roughness": 1e-7},
        {"roughness": 1e-6},
        {"asperity_density": 1e5},
        {"asperity_density": 2e7},
        {"contact_modulus": 1e5},
    ],
)
def test_faces_pressed_into_each_other_shear_no_oil(change):
    """Mean planes overlap: what oil is left fades out instead of exploding as 1/h_T."""
    pack = Pack(**change)
    for load in (6000.0, 6e4, 1e6, 0.0):
        for _ in range(50):
            assert pack.step(load, 100.0, 0.02) == 0
        dry = 8 * 0.11 * load * pack.par[k.D_RADIUS]
        assert pack.out[k.O_VISCOUS_TORQUE] <= max(30.0, dry)
    assert pack.out[k.O_FILM] == pytest.approx(8.8e-5, rel=1e-3)


def test_oil_shear_is_the_published_one_down_to_touching_mean_planes_and_fades_smoothly_below():
    cdf = {u: 0.5 * math.erfc(-u / math.sqrt(2.0)) for u in (1e-9, 0.0, -1e-6, -1.0, -6.0)}
    assert sheared_share(cdf[1e-9], 1e-9) == (1.0, 0.0) == sheared_share(cdf[0.0], 0.0)
    value, slope = sheared_share(cdf[-1e-6], -1e-6)
    assert value == pytest.approx(1.0, abs=1e-11) and abs(slope) < 1e-5
    value, slope = sheared_share(cdf[-1.0], -1.0)
    up, down = (
        sheared_share(0.5 * math.erfc(-u / math.sqrt(2.0)), u)[0]
        for u in (-1.0 + 1e-6, -1.0 - 1e-6)
    )
    assert slope == pytest.approx((up - down) / 2e-6 / value, rel=1e-6)
    assert sheared_share(cdf[-6.0], -6.0)[0] == pytest.approx(12.0 * cdf[-6.0] ** 2, rel=1e-6)


POINTS = st.tuples(
    st.sampled_from([0.0, 5.0, 9.8, 9.9, 5898.0, 1e6]) | st.floats(0.0, 2e4),
    st.sampled_from([0.0, 1e-9, -350.0, 5000.0, -5000.0]) | st.floats(-500.0, 500.0),
    st.floats(233.2, 473.1),
    st.sampled_from([1e-6, 1e-3, 0.1, 10.0, 1e4]),
)


@given(
    st.lists(POINTS, min_size=1, max_size=6),
    st.sampled_from(PERMEABILITIES),
    st.sampled_from(["held", "linear"]),
    st.booleans(),
)
def test_no_profile_of_inputs_breaks_the_pack(points, permeability, profile, rise):
    """Any load, slip, oil and step in the allowed ranges: a finite, passive answer."""
    pack = Pack(permeability=permeability, input_profile=profile, contact_rise=rise)
    heat = 0.0
    for load, slip, oil, dt in points:
        assert pack.step(load, slip, dt, oil) == 0
        assert np.isfinite(pack.out).all() and np.isfinite(pack.state).all()
        assert pack.out[k.O_TORQUE] * slip >= 0.0
        assert pack.out[k.O_CAPACITY] >= abs(pack.out[k.O_TORQUE]) * (1.0 - 1e-12)
        assert pack.out[k.O_ENERGY] >= heat
        heat = pack.out[k.O_ENERGY]
