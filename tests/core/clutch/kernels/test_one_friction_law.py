"""One law of friction for the whole pack: the oil's shear is in it and is not added once more."""

import math

import numpy as np
import pytest
from clutch_pack import Pack, plain
from clutch_reference import Reference

from thrustwasher import ClutchParams, engage_clutch, solve_clutch
from thrustwasher.clutch.kernels import layout as k

H = 1e-3


def average(pressure, oil, **changes):
    """Return the harmonic mean of the total friction over 0 .. 3000 rpm, as a braking rig gives."""
    p = ClutchParams.preset("paper", **changes)
    load = pressure * p.lining_area / p.faces
    par = Pack("field", made=lambda: p)
    slowness = []
    for rpm in np.linspace(0.0, 3000.0, 3001):
        par.state[:] = 0.0
        par.par[k.P_STARTS_PRESSED] = 1.0
        par.step(load, rpm * math.pi / 30.0, 0.0, oil)
        slowness.append(p.faces * load * p.friction_radius / par.out[k.O_CAPACITY])
    return 1.0 / np.trapezoid(slowness, dx=1.0 / 3000.0)


@pytest.mark.parametrize(("pressure", "oil"), [(0.5e6, 353.15), (1.5e6, 353.15), (0.5e6, 297.15)])
def test_the_settled_sample_has_the_friction_that_was_measured_whatever_pressure_and_oil(
    pressure, oil
):
    assert average(pressure, oil) == pytest.approx(0.052996, abs=5e-6)


def test_shear_fades_as_the_asperities_take_the_load_and_the_sum_has_no_jump():
    pack = Pack()
    torque = []
    for _ in range(400):
        pack.step(5898.0, 100.0, H)
        torque.append(pack.out[k.O_TORQUE])
    settled = solve_clutch(plain(), load=5898.0, speed=100.0, fidelity="stribeck")
    assert pack.out[k.O_VISCOUS_TORQUE] < 1e-3 * pack.out[k.O_CONTACT_TORQUE]
    assert torque[-1] == pytest.approx(abs(settled.contact_torque), rel=1e-3)


@pytest.mark.parametrize("oil", [297.15, 353.15])
@pytest.mark.slow
def test_the_default_pack_follows_the_tight_reference(oil):
    """Grooves, table, starved and self-heated oil: 0.1 % and 0.1 K are asked for at 1 ms."""
    params, times = ClutchParams(), np.arange(301) * H

    def load(t):
        return 6000.0 * (1.0 - math.exp(-t / 0.05))

    def slip(t):
        return 300.0 * (1.0 - t / 0.32)

    reference = Reference(params, load, slip, oil)
    film, temperature = reference.solve(times)
    exact = np.array([reference.torque(*p) for p in zip(times, film, temperature, strict=True)])
    found = engage_clutch(
        params,
        time=times,
        load=[load(t) for t in times],
        speed=[slip(t) for t in times],
        oil_temperature=oil,
    )
    counts = exact > 0.05 * exact.max()  # the force is straight between its samples
    assert found.friction_torque[counts] == pytest.approx(exact[counts], rel=1e-3)
    assert found.temperature == pytest.approx(temperature, abs=0.02)


@pytest.mark.parametrize("data", ["total", "boundary"])
def test_one_sudden_load_on_the_default_pack_is_integrated_to_six_digits(data):
    pack = Pack(made=ClutchParams, friction_data=data, contact_rise=False)
    reference = Reference(pack.params, lambda t: 6000.0, lambda t: 250.0, 330.0, drum=100.0)
    times = np.arange(61) * H
    film, temperature = reference.solve(times)
    for n in range(1, len(times)):
        assert pack.step(6000.0, 250.0, H, 330.0, drum=100.0) == 0
        exact = reference.torque(times[n], film[n], temperature[n])
        assert pack.out[k.O_TORQUE] == pytest.approx(exact, rel=2e-6)
        assert pack.out[k.O_TEMPERATURE] == pytest.approx(temperature[n], abs=1e-5)
