"""The clutch's step: the common contract of kernels, its heat and its energy."""

from dataclasses import fields

import numpy as np
import pytest
from clutch_pack import Pack
from hypothesis import given
from hypothesis import strategies as st

from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.kernels.pack_friction import ADHESIVE, BOUNDARY, FILM, MIXED
from thrustwasher.clutch.parameters import SPEC, ClutchParams
from thrustwasher.errors import Status


def test_the_arrays_are_laid_out_as_the_lists_say():
    names = [n[2:].lower() for n in vars(k) if n.startswith("P_")]
    assert names == [f.name for f in fields(ClutchParams)] + ["fidelity"]
    assert k.N_PARAM == len(names) and k.NINP == len(SPEC.inputs)
    reals = [s for s in SPEC.outputs if s.kind == "real"]
    assert (k.NOUT, k.NIOUT) == (len(reals), len(SPEC.outputs) - len(reals))


@pytest.mark.parametrize("fidelity", SPEC.rungs)
def test_dt_0_leaves_the_state_to_the_bit(fidelity):
    pack = Pack(fidelity)
    for dt in (1e-3, 0.0, 1e-3):
        before = pack.state.copy()
        assert pack.step(5000.0, 80.0, dt) == 0
        assert (pack.state.tobytes() == before.tobytes()) == (dt == 0.0)


def test_reading_outputs_between_steps_changes_nothing():
    quiet, curious = Pack("stribeck"), Pack("stribeck")
    for i in range(50):
        load, slip = 5000.0 * i / 50, 300.0 - 6.0 * i
        quiet.step(load, slip, 1e-3)
        curious.step(load, slip, 1e-3)
        curious.step(100.0, 7.0, 0.0)
        curious.step(load, slip, 0.0)
    assert quiet.state.tobytes() == curious.state.tobytes()


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
        pack = Pack("closed", speed_smoothing=1e-3, input_course="linear")
        for i in range(n + 1):
            pack.step(5000.0, 100.0 * (1.0 - (i / n) ** 2), 1.0 / n)
        exact = pack.out[k.O_CAPACITY] * 100.0 * 2.0 / 3.0
        errors.append(abs(pack.out[k.O_ENERGY] - exact))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([2.0, 2.0], abs=0.1)


def test_heat_never_comes_back():
    pack, last = Pack("stribeck"), 0.0
    rng = np.random.default_rng(5)
    for _ in range(300):
        pack.step(rng.uniform(0, 9000), rng.choice([0.0, rng.uniform(-300, 300)]), 1e-3)
        assert pack.out[k.O_ENERGY] >= last
        last = pack.out[k.O_ENERGY]


@given(st.floats(0.0, 1e6), st.floats(-5000.0, 5000.0), st.floats(240.0, 470.0))
def test_friction_is_passive_odd_and_below_capacity(load, slip, oil):
    pack = Pack("stribeck")
    assert pack.step(load, slip, 1e-3, oil) == 0
    torque = pack.out[k.O_TORQUE]
    assert pack.out[k.O_POWER] >= 0.0 and torque * slip >= 0.0
    assert abs(torque) <= pack.out[k.O_CAPACITY] and np.isfinite(pack.out).all()
    mirror = Pack("stribeck")
    mirror.step(load, -slip, 1e-3, oil)
    assert mirror.out[k.O_TORQUE] == -torque


def test_an_interface_above_523_k_is_said():
    pack = Pack("stribeck")
    for _ in range(200):
        assert pack.step(9000.0, 300.0, 0.05) == 0
    assert pack.out[k.O_TEMPERATURE] > 523.0 and pack.iout[k.IO_STATUS] == Status.HOT
