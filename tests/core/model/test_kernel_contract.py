"""What every kernel's step keeps to: its memory is the state alone, whatever happens.

A step that fails leaves the state as it was, to the bit, and so does one of no length; one that
succeeds holds numbers; what the work array holds does not matter.
"""

import math

import numpy as np
import pytest

from thrustwasher.errors import Status
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.prepare import filled
from thrustwasher.model.registry import all_specs, find_spec, kernel_of

SIZES = (0.0, 1e-320, 1e-30, 1.0, 1e6, 1e30, 1e150, 1e300, np.inf)
HOSTILE = [np.nan, *SIZES, *(-size for size in SIZES)]
HEATED = {"input_profile": "linear", "contact_rise": True}
WASHERS = [("washer", changes, "field") for changes in ({}, {"thermal_mode": "transient"})]
CASES = [
    ("clutch", {}, "field"),
    ("clutch", {"input_profile": "linear"}, "field"),
    ("clutch", HEATED, "field"),
    ("clutch", {"input_profile": "linear"}, "stribeck"),
    ("clutch", {"starts_pressed": True}, "stribeck"),
    ("clutch", {}, "closed"),
    ("clutch", {}, "fine"),
    ("clutch", HEATED, "fine"),
    ("gearmesh", {}, "fine"),
    ("gearmesh", {}, "field"),
    ("gearmesh", {"film_heat": "atan"}, "fine"),
    ("transmission", {}, "rigid"),
    ("transmission", {"torque_age": 2}, "rigid"),
    ("transmission", {"coupling": "torque"}, "rigid"),
]


def made(model, changes, fidelity):
    """Return kernel, spec and derived parameters."""
    spec = find_spec(model)
    k = kernel_of(spec)
    return k, spec, filled(spec, spec.params(**changes), fidelity, k.NPAR, k.derive)


def good_inputs(spec, rng):
    """Return inputs in their ranges, closer to their start than to the ends."""
    return np.array(
        [np.clip(s.start + rng.uniform(-1.0, 1.0) * s.nominal, s.low, s.high) for s in spec.inputs]
    )


@pytest.mark.parametrize(("model", "changes", "fidelity"), CASES)
@pytest.mark.slow
def test_what_fails_leaves_no_trace(model, changes, fidelity):
    rng = np.random.default_rng(7)
    k, spec, par = made(model, changes, fidelity)
    work, out, iout = np.zeros(k.NWORK), np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
    failures = set()
    for _ in range(25):
        state = np.zeros(k.NSTATE)
        for _ in range(int(rng.integers(0, 4))):
            assert k.step(par, good_inputs(spec, rng), state, work, out, iout, 0.0, 1e-3) == 0
        for _ in range(15):
            inp, time = good_inputs(spec, rng), [0.0, float(rng.choice([1e-3, 1e-3, 0.0]))]
            for place in rng.integers(0, len(inp) + 2, int(rng.integers(1, 3))).tolist():
                value = float(rng.choice(HOSTILE))
                if place < len(inp):
                    inp[place] = value
                else:
                    time[place - len(inp)] = value
            before = state.tobytes()
            status = k.step(par, inp, state, work, out, iout, *time)
            if status or time[1] == 0.0:
                assert state.tobytes() == before, (Status(status).name, inp, time)
            else:
                assert np.isfinite(state).all() and np.isfinite(out).all(), (inp, time)
            if status:
                failures.add(Status(status).name)
            assert status == 0 or status >= 10
    assert "BAD_INPUT" in failures


@pytest.mark.parametrize("rubbish", [np.nan, 1e300, -1.0])
@pytest.mark.parametrize(("model", "changes", "fidelity"), [*CASES, *WASHERS])
@pytest.mark.slow
def test_looks_and_what_work_holds_change_nothing(model, changes, fidelity, rubbish):
    rng = np.random.default_rng(3)
    k, spec, par = made(model, changes, fidelity)
    quiet, looked = np.zeros(k.NSTATE), np.zeros(k.NSTATE)
    work, other_work = np.zeros(k.NWORK), np.zeros(k.NWORK)

    def stepped(inp, state, work, dt):
        out, iout = np.full(k.NOUT, np.nan), np.full(k.NIOUT, -7, np.int32)
        status = k.step(par, inp, state, work, out, iout, 0.0, dt)
        return status, out.tobytes(), iout.tobytes(), state.tobytes()

    for _ in range(10):
        inp = good_inputs(spec, rng)
        before = looked.tobytes()
        for look in (good_inputs(spec, rng), inp):
            other_work[:] = rubbish
            assert stepped(look, looked, other_work, 0.0)[3] == before
        other_work[:] = rubbish
        assert stepped(inp, looked, other_work, 1e-3) == stepped(inp, quiet, work, 1e-3)


@pytest.mark.parametrize(("model", "changes", "fidelity"), [*CASES, WASHERS[0]])
def test_derivatives_are_linear_in_their_direction_and_refuse_what_is_no_number(
    model, changes, fidelity
):
    rng = np.random.default_rng(11)
    k, spec, par = made(model, changes, fidelity)
    state, work = np.zeros(k.NSTATE), np.zeros(k.NWORK)
    out, iout = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
    inp, seed = good_inputs(spec, rng), rng.standard_normal(k.NINP)
    assert k.step(par, inp, state, work, out, iout, 0.0, 0.0) == 0

    def along(direction):
        dout = np.zeros(k.NOUT)
        return k.sens(par, inp, state, work, direction, dout), dout

    parts = np.array([x * along(row)[1] for x, row in zip(seed, np.eye(k.NINP), strict=True)])
    status, whole = along(seed)
    assert status == Status.OK
    assert (np.abs(whole - parts.sum(0)) <= 1e-7 * np.abs(parts).sum(0) + 1e-15).all()
    seed[:] = np.nan
    assert Status(along(seed)[0]).is_failure


# Kernels that take rates of their inputs: straight through the step, shown at its end.

CLUTCH = {"load": 3000.0, "speed": 80.0, "oil_temperature": 340.0, "drum_speed": 40.0}
TORQUES = {"clutch_torque": 60.0, "washer_torque": 0.2, "mesh_torque": 0.1}
TORQUES |= {"engine_torque_input": 150.0, "load_torque_input": 20.0, "shift_command": 0.3}
PRESSED = TORQUES | {"clutch_pressure": 2e5, "brake_pressure": 1e5}
FREE = {"initial_drum_speed": 40.0}  # the brake slips
RATES_CASES = [
    ("clutch", {"starts_pressed": True}, "field", CLUTCH, [-4e4, -300.0, 5.0, 100.0]),
    ("clutch", {}, "fine", CLUTCH, [-4e4, -300.0, 5.0, 100.0]),
    ("clutch", {}, "stribeck", CLUTCH, [-4e4, -300.0, 5.0, 100.0]),
    ("transmission", FREE, "rigid", TORQUES, [900.0, 0.0, 1.0, 1.0, 2.0, 0.0, 0.0, -900.0, 500.0]),
    ("transmission", FREE | {"coupling": "torque"}, "rigid", TORQUES, [900.0, 0.0, 0.0, 0.0, 2.0]),
    (
        "transmission",
        FREE | {"actuation": "pressure", "torque_age": 1},
        "rigid",
        PRESSED,
        [900.0, 0.0, 1.0, 1.0, 0.0, 4e6, -5e5, -900.0],
    ),
]
each = pytest.mark.parametrize(("model", "changes", "level", "start", "rates"), RATES_CASES)
H = 0.01


class Unit:
    """A kernel with its arrays and time."""

    def __init__(self, model, changes, level, start):
        self.spec = find_spec(model)
        self.k = k = kernel_of(self.spec)
        self.par = filled(self.spec, self.spec.params(**changes), level, k.NPAR, k.derive)
        self.state, self.work = np.zeros(k.NSTATE), np.full(k.NWORK, np.nan)
        self.out, self.iout = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
        self.inputs = np.array([start.get(s.name, s.start) for s in self.spec.inputs])
        self.t = 0.0
        self.step(1e-3)

    def step(self, dt, rates=None):
        """Step with rates, without any, or (dt = 0) look; then the inputs are those at the end."""
        more = np.zeros(self.k.NINP)
        more[: len(rates or [])] = rates or []
        inp = self.inputs if rates is None else np.concatenate([self.inputs, more])
        work = self.state, self.work, self.out, self.iout
        status = self.k.step(self.par, inp, *work, self.t, dt)
        if status == 0:
            self.t += dt
            self.inputs = self.inputs + more * dt
        return status

    def shown(self):
        return self.out.tobytes() + self.iout.tobytes() + self.state.tobytes()


def test_clutch_and_transmission_take_rates_of_all_their_inputs():
    taking = {s.key: kernel_of(s).NRATES for s in all_specs() if hasattr(kernel_of(s), "NRATES")}
    assert taking == {key: kernel_of(find_spec(key)).NINP for key in ("clutch", "transmission")}


@each
def test_rates_of_zero_are_none_to_the_bit(model, changes, level, start, rates):
    one, other = (Unit(model, changes, level, start) for _ in range(2))
    for dt in (H, 0.0, 1e-3):
        assert one.step(dt) == other.step(dt, [0.0]) == Status.OK
        assert one.shown() == other.shown()


@each
def test_what_a_step_shows_belongs_to_the_inputs_at_its_end(model, changes, level, start, rates):
    unit = Unit(model, changes, level, start)
    assert unit.step(H, rates) == Status.OK
    stepped, flags = unit.out.copy(), unit.iout.copy()
    assert unit.step(0.0) == Status.OK
    assert unit.out == pytest.approx(stepped, rel=1e-12, abs=1e-12)
    assert (unit.iout == flags).all()


@each
def test_a_straight_profile_may_be_cut_anywhere(model, changes, level, start, rates):
    whole, cut, held = (Unit(model, changes, level, start) for _ in range(3))
    assert whole.step(H, rates) == Status.OK
    for share in (0.25, 0.35, 0.4):
        assert cut.step(share * H, rates) == Status.OK
    assert held.step(H) == Status.OK
    reals = [s.name for s in whole.spec.outputs if s.kind == "real"]
    # of the last step alone, or a small difference of large numbers
    for name in {"oil_heat", "oil_energy", "advised_step"}.intersection(reals):
        k = reals.index(name)
        whole.out[k] = held.out[k] = cut.out[k]
    gap, moved = np.abs(whole.out - cut.out), np.abs(held.out - cut.out)
    assert (gap <= 0.02 * moved + 2e-4 * np.abs(cut.out) + 1e-9).all()


@each
@pytest.mark.parametrize("rate", [math.nan, math.inf, -1e300])
def test_a_rate_that_is_no_good_leaves_no_trace(model, changes, level, start, rates, rate):
    unit = Unit(model, changes, level, start)
    before = unit.state.tobytes()
    place = 0 if model == "clutch" else 4  # load, command: both have a range
    assert unit.step(H, [0.0] * place + [rate]) == Status.BAD_INPUT
    assert unit.state.tobytes() == before


def profile(t):
    """Return load [N] and slip [rad/s] of a clutch, smooth in time."""
    return 3000.0 - 2000.0 * math.cos(9.0 * t), 60.0 + 60.0 * math.cos(6.0 * t)


def energy(level, n, moving):
    """Return the heat [J] of a clutch over 0.2 s in n steps."""
    unit, h = (
        DirectInstance(find_spec("clutch"), parameters={"fidelity": level, "holding": "off"}),
        0.2 / n,
    )
    unit.initialize(0.0, dict(zip(["load", "speed"], profile(0.0), strict=True)))
    for i in range(n):
        now, ahead = profile(i * h), profile((i + 1) * h)
        unit.set_inputs(now)
        if moving:
            unit.set_rates([(b - a) / h for a, b in zip(now, ahead, strict=True)])
        unit.step(i * h, h)
    return unit.get(["energy"])[0]


@pytest.mark.parametrize("level", ["closed", "stribeck", "field"])
def test_with_rates_the_error_falls_with_the_square_of_the_step(level):
    true = energy(level, 4000, True)
    for moving, low, high in ((False, 0.5, 1.2), (True, 1.7, 4.0)):
        errors = [abs(energy(level, n, moving) - true) for n in (20, 80)]
        assert low < math.log(errors[0] / errors[1]) / math.log(4.0) < high


# What an instance of a model keeps in memory, counted from the sizes of its kernel.

LIMIT = 64 * 1024  # bytes


@pytest.mark.parametrize(
    "model",
    ["WetClutch", "GearMesh", "ShiftTransmission", "OilSump", "DrivelineLosses", "CommandSource"],
)
def test_the_arrays_of_an_instance_leave_a_third_of_64_kb_to_the_shell(model):
    """Parameters, inputs, work, outputs and memory, the latter two also as before a step."""
    kernel = kernel_of(find_spec(model))
    kept_twice = kernel.NSTATE + kernel.NOUT + kernel.NIOUT
    doubles = kernel.NPAR + kernel.NINP + kernel.NWORK + 2 * kept_twice
    assert 8 * doubles <= 2 * LIMIT // 3
