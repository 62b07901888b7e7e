"""Derivatives over parameters of the models that need no mesh, and what is told of them."""

import pickle
from dataclasses import fields, replace
from functools import partial

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    LossesParams,
    ParameterError,
    solve_clutch,
    solve_gearmesh,
    solve_losses,
)
from thrustwasher.model.sensitivity import varied_parameters

STEPS = (3e-4, 3e-5)  # relative, of differences of fourth order
RANGES = {
    "clutch": {"load": (500.0, 10000.0), "speed": (1.0, 6.0), "oil_temperature": (300.0, 370.0)},
    "gearmesh": {"power": (1e3, 2e4), "speed": (50.0, 500.0), "oil_temperature": (300.0, 370.0)},
    "losses": {"input_speed": (50.0, 500.0), "tooth_force": (100.0, 3000.0)},
}
SOLVED = {
    "clutch": (solve_clutch, ClutchParams(friction_temperature="slope")),
    "gearmesh": (solve_gearmesh, GearMeshParams()),
    "losses": (solve_losses, LossesParams()),
}


def of_fourth_order(values, x, step):
    near = values(x * (1.0 + step)) - values(x * (1.0 - step))
    far = values(x * (1.0 + 2.0 * step)) - values(x * (1.0 - 2.0 * step))
    return (8.0 * near - far) / (12.0 * step)


@pytest.mark.parametrize("model", SOLVED)
@pytest.mark.slow
def test_derivatives_are_those_of_wider_differences_of_fourth_order(model):
    (solve, params), rng, worst = SOLVED[model], np.random.default_rng(5), 0.0
    metas, all_of_them, left_out = {f.name: f.metadata for f in fields(params)}, 0, 0
    for _ in range(100):
        point = {name: rng.uniform(*ends) for name, ends in RANGES[model].items()}
        found = solve(params, **point).sensitivities()
        names = [
            name
            for name in next(iter(found.values()))
            if metas[name]["min"] <= getattr(params, name) * (1.0 - 2.0 * STEPS[0])
            and getattr(params, name) * (1.0 + 2.0 * STEPS[0]) <= metas[name]["max"]
        ]
        assert len(names) > 10

        def at(name, value, point=point, outputs=tuple(found)):
            result = solve(replace(params, **{name: value}), **point)
            return np.array([getattr(result, output) for output in outputs])

        wide, narrow = (
            np.transpose(
                [of_fourth_order(partial(at, name), getattr(params, name), h) for name in names]
            )
            for h in STEPS
        )
        exact = np.array([[getattr(params, n) * row[n] for n in names] for row in found.values()])
        sizes = np.abs(exact).max(axis=1, keepdims=True)
        sizes[sizes == 0.0] = 1.0
        smooth = np.abs(wide - narrow) <= 1e-6 * sizes  # no corner of a law is within the steps
        all_of_them, left_out = all_of_them + smooth.size, left_out + int((~smooth).sum())
        error = np.where(smooth, np.abs(exact - wide) / sizes, 0.0)
        worst = max(worst, error.max())
        assert error.max() <= 1e-6, (point, names[int(error.max(axis=0).argmax())])
    assert left_out <= 0.01 * all_of_them
    print(f"{model}: {worst:.1e}, {left_out} of {all_of_them} left out")


def test_a_value_at_the_end_of_its_range_is_looked_at_from_inside():
    place = {"power": 7500.0, "speed": 180.0}
    result = solve_gearmesh(GearMeshParams(), **place)
    inside = solve_gearmesh(GearMeshParams(face_load_factor=1.0001), **place)
    slope = result.sensitivities(["root_stress"], ["face_load_factor"])["root_stress"]
    rise = 1e4 * (inside.root_stress - result.root_stress)
    assert slope["face_load_factor"] == pytest.approx(rise, rel=1e-3) and rise > 0.0


def test_counts_and_values_from_elsewhere_are_no_parameters_and_are_refused_by_name():
    result = solve_clutch(ClutchParams(), load=9000.0, speed=2.0)
    found = result.sensitivities(["temperature"])["temperature"]
    assert result._request.params.effective_radius == 0.0  # from the faces
    assert not {"faces", "friction_data", "effective_radius"} & found.keys()
    for name in ("faces", "effective_radius"):
        with pytest.raises(ParameterError, match=f"parameters: '{name}', .*allowed: .*roughness"):
            result.sensitivities(parameters=[name])
    with pytest.raises(ParameterError, match="outputs: 'temperatur', did you mean temperature"):
        result.sensitivities(["temperatur"])
    given = replace(result._request.params, effective_radius=0.06)
    assert "effective_radius" in [v.name for v in varied_parameters(given, None)]


def test_what_does_not_change_has_no_derivative_at_all():
    found = solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0).sensitivities()
    row = found["centre_distance"]
    assert row["centre_distance"] == pytest.approx(1.0, rel=1e-9)
    assert row["face_load_factor"] == row["load_share"] == row["viscosity_b"] == 0.0


def test_a_result_can_be_kept_and_differentiated_later():
    result = solve_losses(LossesParams(), input_speed=200.0)
    kept = pickle.loads(pickle.dumps(result))
    assert kept == result and kept.sensitivities() == result.sensitivities()
    assert "_request" not in result.as_dict()
