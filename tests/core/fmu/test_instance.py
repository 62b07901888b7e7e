"""One face for kernels and FMUs, native or Python, FMI 2 or 3: the same numbers and sentences."""

import math
import random

import numpy as np
import pytest
from toy import kernel
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError, SolveError, Status
from thrustwasher.fmu.stepper import DirectInstance, Instance

H = 1e-3
GOOD = list(TOY_START.values())
SETTINGS = {"discs": 4, "law": "dry", "fidelity": "fine", "dry": True, "inner_radius": 0.04}
NUMBERS = [0.04, 0.1, 100.0, 4.0, 1.0, 2.0, 2.0]  # of all parameters with these settings


@pytest.fixture(params=["kernels", "python", "fmi2", "fmi3"])
def make(request):
    """Return what makes an instance of the toy; it is closed in the end."""
    made = []

    def instance(**options):
        fmu = (
            None if request.param == "kernels" else request.getfixturevalue(f"{request.param}_toy")
        )
        made.append(Instance(fmu, **options) if fmu else DirectInstance(TOY, **options))
        return made[-1]

    yield instance
    for one in made:
        one.close()


@pytest.fixture
def instance(make):
    made = make()
    made.initialize(inputs=TOY_START)
    return made


def drawn(n, seed=1):
    rng = random.Random(seed)
    return [[rng.uniform(0, 8000), rng.uniform(-900, 900), rng.uniform(240, 470)] for _ in range(n)]


def run(instance, points, first=0):
    for i, point in enumerate(points, first):
        instance.set_inputs(point)
        instance.step(i * H, H)
    return instance.outputs()


class Bare:
    """The kernel called with plain arrays."""

    def __init__(self, parameters):
        self.par = np.array([*parameters, 0.0])
        self.state, self.work = np.zeros(kernel.NSTATE), np.zeros(kernel.NWORK)
        self.out, self.iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        assert kernel.derive(self.par) == 0

    def outputs(self, inputs, t, h):
        self.inp = np.array(inputs)
        rc = kernel.step(self.par, self.inp, self.state, self.work, self.out, self.iout, t, h)
        assert rc == 0
        return [*self.out.tolist(), *map(float, self.iout)]

    def slopes(self, seed):
        slopes = np.zeros(kernel.NOUT)
        assert kernel.sens(self.par, self.inp, self.state, self.work, np.array(seed), slopes) == 0
        return slopes.tolist()


def test_steps_are_those_of_the_kernel_to_the_bit(make):
    instance, bare = make(parameters=SETTINGS), Bare(NUMBERS)
    assert instance.input_names == [s.name for s in TOY.inputs]
    assert instance.output_names == [s.name for s in TOY.outputs]
    instance.initialize(0.5, TOY_START)
    assert instance.get([*SETTINGS, "time"]) == [4.0, 2.0, 2.0, 1.0, 0.04, 0.5]
    assert instance.outputs() == bare.outputs(GOOD, 0.5, 0.0)
    for i, point in enumerate(drawn(100)):
        instance.set_inputs(point)
        instance.step(0.5 + i * H, H)
        assert instance.outputs() == bare.outputs(point, 0.5 + i * H, H)
    assert instance.get(["regime", "energy"]) == [float(bare.iout[0]), bare.out[3]]
    assert instance.calls == 100
    assert min(instance.wall_time, instance.instantiate_time, instance.initialize_time) > 0.0


def test_derivatives_are_those_of_the_kernel_and_only_of_what_has_them(instance):
    unknowns, knowns = ["friction_torque", "film_ratio"], ["speed", "load"]
    if not instance.gives_derivatives:
        with pytest.raises(SolveError, match="erivative"):
            instance.directional_derivative(unknowns, knowns, [1.0, 0.0])
        return
    instance.step(0.0, H)
    before, bare = instance.outputs(), Bare([0.05, 0.1, 100.0, 2.0, 0.0, 1.0, 1.0])
    bare.outputs(GOOD, 0.0, 0.0)
    for seed in ([1.0, 0.0], [-3.0, 2.5]):
        slopes = bare.slopes([seed[1], seed[0], 0.0])
        assert instance.directional_derivative(unknowns, knowns, seed) == [slopes[0], slopes[4]]
    for names in (["speed"], ["friction_torque"]):  # an input is no unknown, nor the reverse
        with pytest.raises(ParameterError, match=names[0]):
            instance.directional_derivative(names, names, [1.0])
    with pytest.raises((ParameterError, ValueError)):
        instance.directional_derivative(unknowns, knowns, [1.0])
    assert instance.outputs() == before


def test_readings_never_change_what_follows(make):
    results = []
    for readings in (0, 3):
        instance = make()
        instance.initialize(inputs=TOY_START)
        for i, point in enumerate(drawn(50)):
            instance.set_inputs(point)
            for _ in range(readings):
                instance.outputs()
            instance.step(i * H, H)
        results.append(instance.outputs())
    assert results[0] == results[1]


def test_rates_move_inputs_through_the_next_step_where_the_fmu_takes_them(instance, request):
    rates = [1e4, -100.0, 5.0]
    if request.node.callspec.params["make"] in ("python", "fmi3"):
        with pytest.raises((ParameterError, SolveError)):
            instance.set_rates(rates)
        return
    with pytest.raises(ParameterError, match="load: rate of change = inf N/s"):
        instance.set_rates([math.inf])
    bare = Bare([0.05, 0.1, 100.0, 2.0, 0.0, 1.0, 1.0])
    middle, end = (
        [x + share * H * r for x, r in zip(GOOD, rates, strict=True)] for share in (0.5, 1)
    )
    bare.outputs(middle, 0.0, H)
    instance.set_rates(rates)
    state = instance.get_state()
    for _ in range(2):
        instance.set_state(state)
        instance.step(0.0, H)
        assert instance.get(instance.input_names) == end
        assert instance.outputs() == bare.outputs(end, H, 0.0)
    assert run(instance, [end], 1) == bare.outputs(end, H, H)


def test_reset_gives_a_fresh_run_with_the_same_parameters_and_others_are_not_touched(make):
    instance, other = make(parameters={"discs": 5}), make(parameters={"discs": 9})
    other.initialize(inputs=TOY_START)
    before, results = other.outputs(), []
    for _ in range(3):
        instance.initialize(inputs=TOY_START)
        results.append(run(instance, drawn(10)))
        instance.reset()
    instance.close()
    assert results[0] == results[1] == results[2] and other.outputs() == before


WRONG_INPUTS = [
    ([500.0, 20.0, 24.0], "oil_temperature = 24 K is outside 233.15 .. 473.15 K; .*297.15 K"),
    ([-1.0, 20.0, 300.0], "load = -1 N is outside 0 .. 10000 N"),
    ([500.0, math.nan, 300.0], "speed = nan rad/s is outside -1000 .. 1000 rad/s"),
    ([math.inf, 20.0, 300.0], "load = inf N"),
]


@pytest.mark.parametrize(("values", "message"), WRONG_INPUTS)
def test_a_wrong_input_is_refused_and_a_good_one_cures_it(values, message, instance):
    with pytest.raises(ParameterError, match=message):
        instance.set_inputs(values)
    assert instance.get(list(TOY_START)) == GOOD  # nothing of the call is taken over
    assert instance.get(["solver_status"]) == [Status.BAD_INPUT]
    with pytest.raises((SolveError, ParameterError), match=message):
        instance.step(0.0, H)
    instance.set_inputs(GOOD)
    assert instance.get(["solver_status"]) == [Status.OK]
    instance.step(0.0, H)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"disc": 2}, "did you mean discs"),
        ({"law": "wet"}, "allowed: viscous, dry"),
        ({"discs": 50}, "discs = 50 is outside 1 .. 20"),
        ({"inner_radius": 2e7}, r"inner_radius = 2e\+07 m is outside 1e-06 .. 1e\+07 m"),
        ({"inner_radius": 0.2}, r"inner_radius = 0.2 m, allowed: below outer_radius \(0.1 m\)"),
    ],
)
def test_wrong_parameters_are_refused_by_name(given, message, make):
    with pytest.raises(ParameterError, match=message):
        make(parameters=given).initialize(inputs=TOY_START)


@pytest.mark.parametrize(
    ("values", "status"),
    [([9500.0, 20.0, 310.0], Status.MAX_ITERATIONS), ([1.0, 777.0, 310.0], Status.NOT_FINITE)],
)
def test_a_failed_step_says_why_and_changes_nothing_but_the_status(values, status, instance):
    instance.step(0.0, H)
    before = instance.outputs()
    instance.set_inputs(values)
    for call in (lambda: instance.step(H, H), instance.outputs, instance.outputs):
        with pytest.raises(SolveError) as raised:
            call()
        for part in ("ToyClutch", f"load = {values[0]:g} N", "t = 0.001 s", status.name):
            assert part in str(raised.value)
        assert "\n" not in str(raised.value) and status.advice in str(raised.value)
    assert instance.get(["solver_status"]) == [status]
    instance.set_inputs(GOOD)
    assert instance.outputs() == before
    clean = DirectInstance(TOY)
    clean.initialize(inputs=TOY_START)
    assert run(instance, [GOOD], 1) == run(clean, [GOOD, GOOD])


@pytest.mark.parametrize("h", [0.0, -1e-3, math.nan, math.inf])
def test_a_step_must_be_finite_and_forward(h, instance):
    with pytest.raises(ParameterError, match="allowed: finite, step > 0"):
        instance.step(0.0, h)
    instance.step(0.0, H)


def test_a_step_too_short_for_the_spacing_of_time_moves_nothing(instance):
    """The spacing of doubles at 0.5 s is 2^-53 s; half of it leaves the time where it is."""
    instance.step(0.0, 0.5)
    before = instance.outputs()
    instance.step(0.5, 5e-17)
    assert instance.outputs() == before
    instance.step(0.5, 1.2e-16)


def test_an_output_is_solved_at_most_once_per_change(monkeypatch):
    direct = DirectInstance(TOY)
    direct.initialize(inputs=TOY_START)
    solved, solve = [], direct.core._solve
    monkeypatch.setattr(direct.core, "_solve", lambda h: (solved.append(h), solve(h))[1])
    for inputs in (GOOD, [3.0, 2.0, 300.0], [3.0, 2.0, 300.0]):  # the first is no change
        direct.set_inputs(inputs)
        direct.outputs()
        direct.outputs()
    direct.step(0.0, H)
    direct.outputs()
    assert solved == [0.0, H]


def test_the_start_time_is_kept_and_steps_may_vary(make):
    instance = make()
    instance.initialize(5.0, TOY_START)
    for t, h in ((5.0, 1e-3), (5.001, 4e-3), (7.0, 1e-3)):
        instance.step(t, h)
    assert instance.get(["time"]) == [7.001]
    warnings = getattr(instance, "warnings", ["the host's time counts"])
    assert len(warnings) == 1 and "the host's time counts" in warnings[0]


def test_a_state_repeats_the_run_and_travels_as_bytes(make):
    instance, other = make(), make()
    for one in (instance, other):
        one.initialize(inputs=TOY_START)
    run(instance, drawn(20))
    instance.set_inputs([1.0, 2.0, 300.0])  # not read yet
    state = instance.get_state()
    data = instance.serialize(state)
    expected = run(instance, drawn(20, 2), 20)
    for _ in range(2):
        instance.set_state(state)
        assert instance.get(["load", "speed", "time"]) == [1.0, 2.0, 19 * H + H]
        assert run(instance, drawn(20, 2), 20) == expected
    instance.free_state(state)
    again = other.deserialize(data)
    assert other.serialize(again) == data
    other.set_state(again)
    assert run(other, drawn(20, 2), 20) == expected
    other.free_state(again)


def test_a_refused_value_is_still_missing_in_a_state_that_is_set_again(instance):
    with pytest.raises(ParameterError):
        instance.set_inputs([500.0, math.nan, 300.0])
    state = instance.get_state()
    data = instance.serialize(state)
    run(instance, [GOOD])
    for kept in (state, instance.deserialize(data)):
        instance.set_state(kept)
        with pytest.raises((SolveError, ParameterError), match="was refused before"):
            instance.step(0.0, H)
        run(instance, [GOOD])
        instance.free_state(kept)


SPOILED = {
    "empty": lambda data: b"",
    "short": lambda data: data[:40],
    "truncated": lambda data: data[:-1],
    "longer": lambda data: data + b"0",
    "flipped": lambda data: data[:90] + bytes([data[90] ^ 1]) + data[91:],
    "text": lambda data: b"{}" * 200,
}


@pytest.mark.parametrize("spoil", SPOILED.values(), ids=SPOILED)
def test_damaged_bytes_are_refused_and_the_run_goes_on(spoil, instance):
    state = instance.get_state()
    data, before = spoil(instance.serialize(state)), instance.outputs()
    with pytest.raises((ParameterError, SolveError), match="FMU state"):
        instance.set_state(instance.deserialize(data))
    instance.free_state(state)
    assert instance.outputs()[:-1] == before[:-1]  # the last is solver_status
    instance.step(0.0, H)


def test_what_an_instance_does_not_know_is_refused_by_name(fmi2_toy):
    with pytest.raises(ParameterError, match=r"discs = 2.5, allowed: a whole number"):
        Instance(fmi2_toy, parameters={"discs": 2.5})
    with Instance(fmi2_toy) as fmu:
        with pytest.raises(ParameterError, match="inputs = 1 values, allowed: 3"):
            fmu.set_inputs([1.0])
        with pytest.raises(ParameterError, match="logStatusWarning"):
            fmu.log(categories=["logChatter"])


@pytest.mark.parametrize("kind", ["python", "fmi2", "fmi3"])
def test_warnings_are_kept_once_and_notes_when_asked_for(kind, request):
    with Instance(request.getfixturevalue(f"{kind}_toy"), parameters={"heat_capacity": 1.0}) as fmu:
        fmu.initialize(inputs={"load": 8000.0, "speed": 900.0, "oil_temperature": 300.0})
        for i in range(3):
            fmu.step(i * H, H)
        assert fmu.get(["solver_status", "hot"]) == [Status.HOT, 1.0]
        assert len(fmu.warnings) == 1 and Status.HOT.advice in fmu.warnings[0]
        assert fmu.notes == []
        fmu.log(categories=["logNonlinearSystems"])
        fmu.step(3 * H, H)
        assert [note.category for note in fmu.notes] == ["logNonlinearSystems"]
