"""Drag of the open pack: full gaps at first, less once they pump more oil than they get."""

import math

import numpy as np
import pytest
from closed_forms.squeeze_film import pumped_flow
from clutch_pack import Pack

from thrustwasher import ClutchParams
from thrustwasher.clutch.kernels import layout as k

RPM = math.pi / 30.0


def drag(hub, drum=0.0, **changes):
    """Return the drag [N m] of the default pack, oil at 85 degC."""
    pack = Pack(made=ClutchParams, **changes)
    pack.step(0.0, hub - drum, 0.0, 358.15, drum)
    assert pack.out[k.O_CONTACT_TORQUE] == 0.0
    return pack.out[k.O_TORQUE]


def test_the_pumped_flow_is_that_of_the_radial_momentum_between_two_discs():
    """eta v'' = p' - rho r w(z)^2 by finite differences, p = 0 at both rims."""
    rho, eta, h, inner, outer = 850.0, 8.3e-3, 1.5e-4, 0.064, 0.085
    for hub, drum in ((364.0, 0.0), (200.0, 150.0), (300.0, -300.0), (100.0, 100.0)):
        n = 400
        z = np.arange(1, n) / n
        second = (
            np.diag(np.full(n - 2, 1.0), 1) + np.diag(np.full(n - 2, 1.0), -1) - 2.0 * np.eye(n - 1)
        ) * (n / h) ** 2
        pull = -rho * (drum + (hub - drum) * z) ** 2 / eta
        by_spin, by_pressure = (
            np.linalg.solve(second, right).sum() * h / n for right in (pull, np.ones(n - 1) / eta)
        )
        # Q = 2 pi r (r by_spin + p' by_pressure); the integral of p' over r vanishes
        ln, square = math.log(outer / inner), outer**2 - inner**2
        exact = math.pi * by_spin * square / ln
        assert by_pressure == pytest.approx(-(h**3) / (12.0 * eta), rel=1e-4)
        assert pumped_flow(rho, eta, (hub, drum), h, inner, outer) == pytest.approx(exact, rel=1e-4)


def test_drag_rises_with_speed_to_a_peak_and_falls_as_its_inverse():
    p = ClutchParams()
    eta = 8.285e-3
    slips = np.arange(2.0, 700.0, 2.0)
    found = np.array([drag(s, shear_heating=False) for s in slips])
    full = slips[1:4] * found[0] / slips[0]
    assert found[1:4] == pytest.approx(full, rel=1e-12)
    top = slips[np.argmax(found)]
    once = pumped_flow(850.0, eta, (1.0, 0.0), p.initial_film, p.inner_radius, p.outer_radius)
    assert top == pytest.approx(math.sqrt(p.oil_flow / p.faces / once), abs=2.0)
    assert 1000.0 < top / RPM < 1250.0 and 1.2 < found.max() < 1.3
    late = slips > 1.1 * top
    assert found[late] * slips[late] == pytest.approx(np.full(late.sum(), found[-1] * slips[-1]))


def test_what_counts_is_both_speeds_and_not_the_slip_alone():
    """The same slip on a faster pair pumps more; turning against each other pumps least."""
    at_rest, fast, against = drag(300.0), drag(500.0, 200.0), drag(150.0, -150.0)
    assert fast < at_rest < against
    assert drag(-300.0) == -at_rest  # whichever side stands still
    assert drag(0.0, -300.0) == pytest.approx(at_rest, rel=1e-14)


def test_a_pack_that_turns_as_one_drags_nothing():
    assert drag(400.0, 400.0) == 0.0
