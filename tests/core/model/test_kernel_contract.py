"""What every kernel's step keeps to: its memory is the state alone, whatever happens.

A step that fails leaves the state as it was, to the bit, and so does one of no length; one that
succeeds holds numbers; what the work array holds does not matter.
"""

import numpy as np
import pytest
from sampling import sizes

from thrustwasher.errors import Status
from thrustwasher.model.prepare import filled
from thrustwasher.model.registry import find_spec, kernel_of

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


@sizes(5, 25)
@pytest.mark.parametrize(("model", "changes", "fidelity"), CASES)
@pytest.mark.slow
def test_what_fails_leaves_no_trace(model, changes, fidelity, n):
    rng = np.random.default_rng(7)
    k, spec, par = made(model, changes, fidelity)
    work, out, iout = np.zeros(k.NWORK), np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
    failures = set()
    for _ in range(n):
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
