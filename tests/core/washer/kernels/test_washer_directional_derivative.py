"""Directional derivatives of the washer against differences of solutions converged to rounding."""

import numpy as np
import pytest

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.part_file import preset_part
from thrustwasher.model.prepare import filled
from thrustwasher.numerics.status import OK, SINGULAR
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels import step as k
from thrustwasher.washer.kernels.heat import set_steady
from thrustwasher.washer.kernels.newton import LOAD, NO_FLOOR, newton
from thrustwasher.washer.kernels.outputs import outputs_at
from thrustwasher.washer.kernels.regime_and_status import point_of
from thrustwasher.washer.kernels.workspace import fields_of, forget_factor, model_of, workspace_of
from thrustwasher.washer.parameters import SPEC, WasherParams

STEPS = (1e-3, 1e-3, 2e-3)  # of load, speed, tilt, relative


def inputs(*given):
    """Return inputs or a direction; the far face of the gear is at 0, as the oil, if left out."""
    return np.array([*given, 0.0][: k.NINP], float)


class Washer:
    """Arrays of one washer; every solution is converged as far as rounding allows."""

    def __init__(self, **changes):
        self.par = filled(SPEC, WasherParams(**changes), "field", k.NPAR, k.derive).copy()
        self.state, self.work = np.zeros(k.NSTATE), np.zeros(k.NWORK)
        self.out, self.iout = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)

    def step(self, inp):
        self.inp = inputs(*inp)
        return k.step(self.par, self.inp, self.state, self.work, self.out, self.iout, 0.0, 1e-3)

    def polish(self, inp, keep_factor=False):
        """Converge the solution in ``work`` at ``inp``; return the real outputs."""
        w, pt = workspace_of(self.par, self.work), point_of(self.par, inputs(*inp))
        f = fields_of(w)
        set_steady(model_of(w), pt, f)
        factor = [a.copy() for a in (f.tag, f.factor, f.following)]
        for _ in range(3):
            forget_factor(w)
            newton(w, pt, LOAD, pt.load, NO_FLOOR, 1e-14, 2.0)
        if keep_factor:
            f.tag[:], f.factor[:], f.following[:] = factor
        outputs_at(w, pt)
        return w.outputs[: k.NOUT].copy()

    def differences(self, inp):
        """Return central differences over each input, extrapolated twice."""
        kept, found = self.work.copy(), []
        for i in range(inp.size):
            step = STEPS[i] * abs(inp[i]) if i < 3 else 0.5
            d1, d2, d3 = (self._slope(kept, inp, i, h) for h in (step, step / 2, step / 4))
            found.append((16 * (4 * d3 - d2) / 3 - (4 * d2 - d1) / 3) / 15)
        self.work[:] = kept
        return found

    def _slope(self, kept, inp, i, h):
        ends = []
        for change in (h, -h):
            moved = np.array(inp, float)
            moved[i] += change
            self.work[:] = kept
            ends.append(self.polish(moved))
        return (ends[0] - ends[1]) / (2 * h)

    def sens(self, inp, seed):
        dout = np.full(k.NOUT, np.nan)
        return k.sens(self.par, inputs(*inp), self.state, self.work, inputs(*seed), dout), dout


POINTS = {
    "thick film": (172.0, -1131.7, 0.002, 296.0),
    "film": (466.0, 698.0, 0.0014, 315.0),
    "mixed": (407.0, 1197.0, 0.0009, 396.0),
    "mixed, no fold near": (251.0, -448.8, 0.0017, 383.0),
    "boundary": (1155.0, -456.5, 0.0024, 368.0),
}


OTHER = (600.0, 700.0, 0.0012, 320.0)
WARM = (*OTHER, 330.0)  # the gear's far face too
NONE = {}
HERE, BEFORE = (), ((1.06, 1.02), (1.03, 0.99), (0.98, 1.005))  # by steps of some percent
CASES = [  # parameters, point, where factors are made, what is allowed
    *(
        pytest.param(
            NONE, POINTS[name], (HERE, BEFORE), 1e-6, marks=[pytest.mark.slow] if many else []
        )
        for name, many in zip(POINTS, (True, False, False, True, False), strict=True)
    ),
    # where the asperities' heat runs away over the rim, differences are no better
    (NONE, (1722.0, 926.0, 0.0022, 319.0), (HERE, BEFORE), 2e-5),
    *(
        (changes, OTHER, (HERE,), 5e-6)
        for changes in (
            {"heat_split": 0.7},
            {"friction_law": "constant"},
            {"conduction": "rotating"},
            {"cavity_shear": "liquid"},
            {"oil_supply_temperature": 330.0},
            preset_part(SPEC, "paper").parameters,
            {"gear_far_face": "insulated"},
        )
    ),
    ({"gear_far_face": "bulk"}, WARM, (HERE,), 5e-6),
    ({"gear_far_face": "bulk", "oil_cooling": False, "conduction": "all"}, WARM, (HERE,), 5e-6),
]


@pytest.mark.parametrize(("changes", "point", "ways", "allowed"), CASES)
def test_derivatives_agree_with_differences_of_converged_solutions(changes, point, ways, allowed):
    """With the factor made at the point, and with one made in steps before it, as in a run."""
    inp, expected = np.array(point), None
    for shares in ways:
        washer = Washer(**changes)
        for share in shares:
            assert washer.step(inp * [*share, 1.0, 1.0]) == OK
        assert washer.step(inp) == OK
        washer.polish(inp, keep_factor=True)
        expected = expected or washer.differences(inp)
        scale = np.abs(washer.work[L.AT_OUTPUTS :][: k.NOUT])
        for i, seed in enumerate(np.eye(inp.size)):
            status, dout = washer.sens(inp, seed)
            assert status == OK
            # a slope counts as nothing where 1 % of the input would not move 1e-5 of the output
            floor = np.maximum(1e-3 * scale / abs(inp[i]), 1e-300)  # none for sums over time
            error = np.abs(dout - expected[i]) / np.maximum(np.abs(expected[i]), floor)
            assert error.max() < allowed, (SPEC.outputs[int(error.argmax())].name, i, shares)


def test_a_derivative_leaves_the_next_step_as_it_was():
    inp = np.array(POINTS["mixed"])
    one, two = Washer(), Washer()
    for washer in (one, two):
        washer.step(inp * [1.02, 1.0, 1.0, 1.0])
        washer.step(inp)
    for seed in np.eye(4):
        assert two.sens(inp, seed)[0] == OK
    for washer in (one, two):
        washer.step(inp * [0.99, 1.0, 1.0, 1.0])
    assert np.array_equal(one.out, two.out)
    assert np.array_equal(one.state, two.state)


@pytest.mark.slow
def test_at_a_fold_there_is_no_derivative():
    washer = Washer()
    speed, tilt, oil = 545.0, 0.002, 297.15
    low, high = 800.0, 1100.0  # the film is lost between
    for _ in range(30):
        load = 0.5 * (low + high)
        trial = Washer()
        trial.step((load, speed, tilt, oil))
        low, high = (low, load) if trial.iout[L.IO_DISTRESS] else (load, high)
    washer.step((low, speed, tilt, oil))
    near = washer.sens((low, speed, tilt, oil), np.array([1.0, 0.0, 0.0, 0.0]))
    away = Washer()
    away.step((0.9 * low, speed, tilt, oil))
    clear = away.sens((0.9 * low, speed, tilt, oil), np.array([1.0, 0.0, 0.0, 0.0]))
    assert clear[0] == OK
    assert near[0] == SINGULAR or abs(near[1][2]) > 100.0 * abs(clear[1][2])


def test_held_inputs_have_no_derivative():
    washer, inp = Washer(), np.array((0.5, 300.0, 0.0, 300.0))
    assert washer.step(inp) == OK
    for i in (0, 2):
        status, dout = washer.sens(inp, np.eye(4)[i])
        assert status == OK
        assert not dout.any()


def test_at_rest_with_contact_the_torque_has_no_slope_over_the_speed():
    washer, inp = Washer(), np.array((500.0, 0.0, 0.002, 300.0))
    assert washer.step(inp) == OK
    assert washer.sens(inp, np.array([0.0, 1.0, 0.0, 0.0]))[0] == SINGULAR
    assert washer.sens(inp, np.array([1.0, 0.0, 0.0, 0.0]))[0] == OK


@pytest.mark.parametrize("load", [300.0, 1500.0], ids=["film", "contact"])
def test_differences_of_outputs_as_they_are_read_scatter_less_than_is_said(load):
    """Torque and rise at changed speeds lie within 5e-6 of a smooth curve through them."""
    speed, oil = 545.0, 297.15
    with DirectInstance(SPEC) as washer:
        washer.initialize(0.0, {"load": load, "speed": speed, "tilt": 2e-3})
        washer.step(0.0, 0.02)
        places = [washer.output_names.index(n) for n in ("friction_torque", "temperature")]
        changes, rows = np.linspace(-1e-4, 1e-4, 11), []
        for change in changes:
            washer.set_inputs([load, speed * (1.0 + change), 2e-3, oil, 0.0])
            rows.append([washer.outputs()[place] for place in places])
        slopes = washer.directional_derivative(["friction_torque", "temperature"], ["speed"], [1.0])
    sizes = np.array(rows[0]) - [0.0, oil]
    for values, slope, size in zip(np.transpose(rows), slopes, sizes, strict=True):
        line = np.polynomial.Polynomial.fit(changes, values, 1)
        assert np.abs(values - line(changes)).max() < 5e-6 * size
        error = line.deriv()(0.0) - slope * speed
        assert abs(error) < 0.05 * size
