"""The clutch's step: the common contract of kernels, its heat and its energy."""

import numpy as np
import pytest
from clutch_pack import Pack

from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.kernels.pack_friction import ADHESIVE, BOUNDARY, FILM, MIXED
from thrustwasher.errors import Status


def test_capacity_is_faces_times_friction_times_load_times_radius():
    pack = Pack(
        "stribeck", effective_radius=0.1, friction_law="constant", constant_friction=0.3, faces=5
    )
    pack.step(1000.0, 20.0, 0.0)
    assert pack.out[k.O_CAPACITY] == pytest.approx(5 * 0.3 * 1000.0 * 0.1, rel=1e-15)


def test_default_pack_holds_389_n_m_at_rest_and_resists_less_at_speed():
    pack = Pack("stribeck")
    pack.step(5898.0, 0.0, 0.0)
    assert pack.out[k.O_CAPACITY] == pytest.approx(389.2, abs=0.1)
    assert pack.out[k.O_TORQUE] == 0.0 and pack.iout[k.IO_REGIME] == ADHESIVE
    pack.step(5898.0, 350.0, 0.0)
    assert pack.out[k.O_CAPACITY] < 0.35 * 389.2 and pack.iout[k.IO_REGIME] == BOUNDARY


def test_regimes_follow_the_film():
    pack = Pack("stribeck")
    regimes = []
    for load in (0.0, 12.0, 200.0, 6000.0):
        pack.step(load, 100.0, 0.0)
        regimes.append(int(pack.iout[k.IO_REGIME]))
    assert regimes == [FILM, MIXED, MIXED, BOUNDARY]


def test_constant_slip_heats_as_the_closed_form_says_whatever_the_step():
    """Inputs that do not change are integrated exactly: 1 step = 10 steps."""
    ends = []
    for n in (1, 10):
        pack = Pack("stribeck")
        for _ in range(n):
            pack.step(5898.0, 100.0, 0.5 / n)
        power = pack.out[k.O_POWER]
        assert pack.out[k.O_ENERGY] == pytest.approx(power * 0.5, rel=1e-12)
        ends.append(pack.out[k.O_TEMPERATURE])
    area = pack.par[k.D_AREA]
    capacity, cooling = 7850.0 * 475.0 * area * 1e-3, 1000.0 * area
    exact = 297.15 + power / 8 / cooling * (1.0 - np.exp(-cooling * 0.5 / capacity))
    assert ends == pytest.approx([exact, exact], rel=1e-12)


def test_energy_of_a_falling_slip_converges_with_the_square_of_the_step():
    """Constant torque, slip 100 -> 0 in 1 s: E = T 100/2; read one step after the end."""
    errors = []
    for n in (20, 40, 80):
        pack = Pack("closed", speed_smoothing=1e-3, input_profile="linear")
        for i in range(n + 1):
            pack.step(5000.0, 100.0 * (1.0 - (i / n) ** 2), 1.0 / n)
        exact = pack.out[k.O_CAPACITY] * 100.0 * 2.0 / 3.0
        errors.append(abs(pack.out[k.O_ENERGY] - exact))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([2.0, 2.0], abs=0.1)


def test_an_interface_above_523_k_is_said_and_one_above_600_degc_an_extrapolation():
    pack = Pack("stribeck")
    for _ in range(200):
        assert pack.step(9000.0, 300.0, 0.05) == 0
        temperature = pack.out[k.O_TEMPERATURE]
        beyond = Status.EXTRAPOLATED if temperature > 873.15 else Status.HOT
        assert pack.iout[k.IO_STATUS] == (beyond if temperature > 523.0 else Status.OK)
    assert temperature > 900.0
