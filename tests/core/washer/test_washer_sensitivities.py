"""Derivatives over the washer's parameters against differences of converged solutions and folds."""

from dataclasses import fields, replace
from functools import partial

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from thrustwasher import ParameterError, SolveError, WasherParams, load_curve, solve_washer
from thrustwasher.washer import sensitivities as s
from thrustwasher.washer.kernels.workspace import forget_factor

META = {f.name: f.metadata for f in fields(WasherParams)}
POINT = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
FOLDED = {"speed": 545.0, "tilt": 0.002}
STEP, FOLD_STEP = 3e-5, 2e-4  # relative
ROUNDING = 1e-3  # of an output: one that changes less, as the load at a full film, changes not


def converged(params, point, branch, start):
    """Return all that is differentiated, of a solution converged as far as it goes."""
    result = solve_washer(params, **point, branch=branch, start=start)
    here = s.Linearised(*result.solved())
    for _ in range(2):  # as far as rounding allows
        forget_factor(here.w)
        s.newton(here.w, here.pt, s.LOAD, here.pt.load, s.NO_FLOOR, 1e-14, 2.0)
    s.k.residuals_here(here.w, here.pt, np.zeros(4), np.zeros(here.f.temp.size))
    return np.array([*here.w.outputs, 0.0, *here.w.q[2:]])


def extrapolated(values, params, name, step):
    """Return p dF/dp from differences of ``values(parameters)``, and how far two steps differ."""
    p = getattr(params, name)

    def at(change):
        return values(replace(params, **{name: p * (1.0 + change)}))

    wide, narrow = ((at(h) - at(-h)) / (2.0 * h) for h in (step, 0.5 * step))
    return (4.0 * narrow - wide) / 3.0, np.abs(narrow - wide)


def movable(name, value, step):
    """Tell if a parameter can be changed both ways."""
    low, high = META[name]["min"], META[name]["max"]
    return value != 0.0 and low <= value * (1.0 - step) and value * (1.0 + step) <= high


def some_point(rng, branch):
    """Return random parameters and a point that is no nearer than 1 % to the end of its branch."""
    while True:
        changes = {
            name: getattr(WasherParams(), name) * rng.uniform(0.8, 1.25)
            for name in ("roughness", "viscosity_scale", "conductivity", "gear_thickness")
        }
        params = WasherParams(**changes)
        point = {"speed": rng.uniform(200.0, 1200.0), "tilt": rng.uniform(1e-3, 3e-3)}
        point["oil_temperature"] = rng.uniform(295.0, 370.0)
        load = rng.uniform(50.0, 1800.0)
        try:
            ends = [
                solve_washer(params, **point, load=share * load, branch=branch)
                for share in (0.99, 1.0, 1.01)
            ]
        except SolveError:
            continue
        if {end.branch for end in ends} == {branch}:
            return params, {**point, "load": load}, ends[1]


@pytest.mark.slow
@pytest.mark.parametrize("branch", ["film", "contact"])
def test_derivatives_are_those_of_converged_solutions(branch):
    rng, worst, compared, corners = np.random.default_rng(7), 0.0, 0, 0
    for _ in range(30):
        params, point, result = some_point(rng, branch)
        found = result.sensitivities()
        names = [m for m in found["friction_torque"] if movable(m, getattr(params, m), STEP)]
        rows = []
        for name in names:
            values = partial(converged, point=point, branch=branch, start=result)
            rows.append(extrapolated(values, params, name, STEP))
        for output, place in s.OUTPUTS.items():
            exact = np.array([getattr(params, name) * found[output][name] for name in names])
            there, doubt = np.array(rows)[:, :, place].T
            size = max(np.abs(exact).max(), ROUNDING * abs(getattr(result, output)))
            smooth = doubt <= 1e-7 * size  # a node's contact or film begins within the steps
            compared, corners = compared + smooth.size, corners + int((~smooth).sum())
            error = np.where(smooth, np.abs(exact - there), 0.0)
            worst = max(worst, error.max() / (size or 1.0))
            assert error.max() <= 1e-6 * size, (point, output, names[int(error.argmax())])
    assert corners <= 0.03 * compared
    print(f"{branch}: {worst:.1e}, {corners} of {compared} at corners")


def test_one_factorisation_serves_all_parameters(monkeypatch):
    counts = {"newton": 0, "factor": 0, "residuals": 0}

    def counted(name, function):
        def call(*arguments):
            counts[name] += 1
            return function(*arguments)

        return call

    result = solve_washer(WasherParams(), **POINT)
    monkeypatch.setattr(s, "newton", counted("newton", s.newton))
    monkeypatch.setattr(s.k, "factor_for_parameters", counted("factor", s.k.factor_for_parameters))
    monkeypatch.setattr(s.k, "residuals_here", counted("residuals", s.k.residuals_here))
    found = result.sensitivities()
    count = len(found["friction_torque"])
    assert counts["newton"] == counts["factor"] == 1
    assert count > 25 and counts["residuals"] <= 2.2 * count


def test_unknown_names_choices_and_what_a_rule_holds_are_no_parameters():
    result = solve_washer(WasherParams(), **POINT)
    with pytest.raises(ParameterError, match="outputs: 'friction_torqe', did you mean friction_to"):
        result.sensitivities(["friction_torqe"])
    assert result.params.oil_cooling and result.params.film_heat_fraction == 1.0
    assert "film_heat_fraction" not in result.sensitivities()["temperature"]
    with pytest.raises(
        ParameterError, match=r"film_heat_fraction = 0\.99.*, allowed: 1 with oil_c"
    ):
        result.sensitivities(None, ["film_heat_fraction"])
    for name in ("friction_law", "friction_scale_of_none"):
        with pytest.raises(ParameterError, match=f"parameters: '{name}', "):
            result.sensitivities(None, [name])
    with pytest.raises(ParameterError, match="'map' is a table, without derivatives"):
        solve_washer(WasherParams(), **POINT, fidelity="map").sensitivities()


def test_per_percent_is_a_hundredth_of_the_parameter_times_its_derivative():
    result = solve_washer(WasherParams(), **POINT)
    slope = result.sensitivities(["temperature"], ["roughness"])
    change = result.sensitivities(["temperature"], ["roughness"], per_percent=True)
    hundredth = 0.01 * result.params.roughness
    assert change == {"temperature": {"roughness": hundredth * slope["temperature"]["roughness"]}}


def fold_load(params, point, number):
    """Return the maximum or minimum load next to a fold, from solutions at film thicknesses
    alone."""
    curve = load_curve(params, **point)
    fold = curve.folds[number]
    start, below = curve.around(fold)
    here = s.Linearised(*start)
    ends, sign = [], 1.0 if fold.kind == "film_regained" else -1.0
    for p in (below, start):
        here.take(p.state)
        ends.append(s.smooth_film(here.w))

    centre, reach = 0.5 * sum(ends), 0.5 * (ends[1] - ends[0])
    for width in (reach, 1e-5 * reach):  # from the middle, where places have the most digits

        def load(beside, centre=centre):
            here.to_film(centre + beside)
            return sign * here.pt.load

        options = {"xatol": 1e-7 * width}
        found = minimize_scalar(load, bounds=(-width, width), method="bounded", options=options)
        centre += float(found.x)
    return sign * float(found.fun)


@pytest.mark.slow
def test_the_loads_at_which_the_film_is_lost_and_regained_follow_the_parameters():
    rng, errors = np.random.default_rng(3), []
    names = ["outer_radius", "roughness", "viscosity_constant", "friction_pressure_min"]
    for k in range(10):
        params, point = WasherParams(), FOLDED
        if k:
            params = WasherParams(roughness=0.73e-6 * rng.uniform(0.9, 1.2))
            point = {"speed": rng.uniform(450.0, 900.0), "tilt": rng.uniform(1.5e-3, 2.5e-3)}
        curve = load_curve(params, **point)
        for number, fold in enumerate(curve.folds):
            found = curve.fold_sensitivities(names)[number]
            for name in names:
                loads = partial(fold_load, point=point, number=number)
                slope, _ = extrapolated(loads, params, name, FOLD_STEP)
                size = max(fold.load, abs(slope))
                errors.append(abs(getattr(params, name) * found[name] - slope) / size)
                assert errors[-1] <= 5e-5, (point, fold, name)  # a corner within the steps
    assert np.mean(np.array(errors) <= 1e-5) >= 0.9
    print(f"folds: {max(errors):.1e}, {sum(e > 1e-5 for e in errors)} of {len(errors)} above 1e-5")
