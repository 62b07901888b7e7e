"""Parameters of any model from measured outputs: found again, with honest intervals, or named."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom

from lab.benchmarks.calibration import RIGS, held
from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    SolveError,
    WasherParams,
    calibrate,
    load_part,
    run_sweep,
)
from thrustwasher.studio.calibration.measured import Measured
from thrustwasher.washer.fits import fold_loads

BY_MODEL = {rig.model: rig for rig in RIGS}
MESH = BY_MODEL["gearmesh"]


def rig_fit(rig, start=None, fit=None, outputs=None, **more):
    """Return the fit to the rig's exact values."""
    exact = {name: x for name, x in rig.exact().items() if name in (outputs or rig.outputs)}
    more |= {"errors": dict.fromkeys(exact, "2 %"), "fidelity": rig.fidelity}
    return calibrate(start or rig.start, {**rig.points, **exact}, fit=fit or rig.truth, **more)


def told(found):
    return {e.name for e in found.estimates if e.identifiable}


def values(found, names):
    return {name: getattr(found.params, name) for name in names}


@pytest.mark.parametrize("model", BY_MODEL)
def test_exact_data_give_the_parameters_back(model):
    rig = BY_MODEL[model]
    found = rig_fit(rig)
    assert values(found, rig.truth) == pytest.approx(rig.truth, rel=1e-5)
    assert told(found) == set(rig.truth)


@pytest.mark.slow
@pytest.mark.parametrize("model", BY_MODEL)
def test_95_percent_intervals_hold_the_truth_in_95_percent_of_experiments(model):
    """Between the 0.05 % and 99.95 % quantiles of the binomial distribution."""
    low, high = binom.interval(0.999, 100, 0.95)
    counts = held(BY_MODEL[model], 100)
    assert all(low <= count <= high for count in counts.values()), counts


def test_a_start_where_nothing_depends_on_a_parameter_is_left():
    """So small a decay speed has passed before the slowest of the points."""
    rig = BY_MODEL["clutch"]
    found = rig_fit(rig, replace(rig.start, decay_speed=1.4e-3))
    assert values(found, rig.truth) == pytest.approx(rig.truth, rel=1e-5)


def test_what_does_not_act_on_the_measured_output_is_named():
    fit = ("f0", "oil_density", "mean_roughness")
    found = rig_fit(MESH, fit=fit, outputs=["friction_torque"])
    assert "oil_density" not in told(found)
    assert found["oil_density"].reason == "no value says enough about oil_density"
    assert found.params.oil_density == MESH.start.oil_density
    assert found.singular_values[-1] == 0.0


def test_a_product_is_named_as_the_combination_that_is_told():
    """The ISO law knows viscosity and roughness by one product of powers alone."""
    found = rig_fit(MESH, outputs=["friction_torque"])
    assert told(found) == set() and len(found.confounded) == 1
    for name in MESH.truth:
        assert "apart: changed together by" in found[name].reason and name in found[name].reason


@pytest.mark.slow
def test_roughness_is_not_told_by_the_torque_of_a_full_film():
    rig = BY_MODEL["washer"]
    assert (run_sweep("washer", points=rig.points)["film_ratio"] > 6.0).all()
    found = rig_fit(rig, fit=("viscosity_scale", "roughness"))
    assert told(found) == {"viscosity_scale"}
    assert "roughness" in found["roughness"].reason
    limits = WasherParams.__dataclass_fields__["roughness"].metadata
    assert found["roughness"].interval == pytest.approx((limits["min"], limits["max"]))


def constant_mesh(friction=0.05):
    return GearMeshParams(friction_law="constant", constant_friction=friction)


POINTS = {"power": [2e3, 5e3, 9e3, 4e3], "speed": [180.0, 180.0, 180.0, -90.0]}
TORQUE = run_sweep("gearmesh", points=POINTS, params=constant_mesh())["friction_torque"]


def fitted(torque=TORQUE, **more):
    data = {**POINTS, "friction_torque": torque}
    return calibrate(constant_mesh(), data, fit="constant_friction", **more)


def test_differences_of_solutions_are_the_derivatives():
    slopes = fitted()._problem.slopes_of_curve
    assert slopes(np.array([0.05]))[:, 0] == pytest.approx(TORQUE / 0.05, rel=1e-9)
    edge = slopes(np.array([1.0]))[:, 0]
    assert edge == pytest.approx(TORQUE / 0.05, rel=1e-9)  # one-sided at the bound


def test_a_loss_test_fits_the_scale_of_the_law_of_friction():
    p = GearMeshParams()
    torque = run_sweep("gearmesh", points=POINTS, params=p)["friction_torque"]
    found = calibrate(p, {**POINTS, "friction_torque": 1.17 * torque}, fit="friction_scale")
    assert found.params.friction_scale == pytest.approx(1.17, rel=1e-6)


def test_the_estimate_of_a_factor_is_the_weighted_mean():
    """One factor on all values: least squares has a closed form."""
    shift, error = np.array([0.01, -0.02, 0.03, 0.01]), np.array([0.01, 0.02, 0.01, 0.03])
    estimate = fitted(TORQUE * (1.0 + shift), friction_torque_error=error)["constant_friction"]
    weight = (TORQUE / error) ** 2
    wanted = 0.05 * (1.0 + (weight * shift).sum() / weight.sum())
    assert estimate.value == pytest.approx(wanted, rel=1e-7)
    assert estimate.standard_error == pytest.approx(0.05 / np.sqrt(weight.sum()), rel=1e-5)
    half = 1.959964 * estimate.standard_error
    assert estimate.interval == pytest.approx((wanted - half, wanted + half), rel=1e-6)
    alike = {"friction_torque": "20 mN.m"}
    again = fitted(TORQUE * (1.0 + shift), errors=alike, profile=True)["constant_friction"]
    assert again.profile_interval == pytest.approx(again.interval, rel=1e-3)


def test_a_narrower_bound_holds_and_outputs_that_the_fit_misses_are_a_warning():
    narrow, errors = {"constant_friction": (0.0, 0.05)}, {"friction_torque": "2 %"}
    found = fitted(1.6 * TORQUE, bounds=narrow, errors=errors)
    stop = "at its upper bound 0.05: the points pull beyond it"
    assert found.params.constant_friction == 0.05 and stop in found["constant_friction"].reason
    assert "The model misses the points by more than they scatter (rms" in found.warnings[0]
    assert f"constant_friction is {stop}" in found.warnings[0]
    assert "% of the mean friction_torque" in found.warnings[1]
    assert str(found).startswith(f"WARNING. {found.warnings[0]}")
    assert fitted(1.6 * TORQUE, errors=errors).warnings == ()


def test_points_may_have_parameters_of_their_own():
    """Two packs of different size, one friction."""
    points = {"load": [1e3, 2e3, 1e3, 2e3], "speed": [5.0] * 4, "faces": [4, 4, 8, 8]}
    truth = ClutchParams(friction_law="constant", constant_friction=0.1)
    torque = run_sweep("clutch", points=points, params=truth)["friction_torque"]
    data = {**points, "friction_torque": torque}
    start = ClutchParams(friction_law="constant")
    found = calibrate(start, data, fit="constant_friction", at={"oil_temperature": 297.15})
    assert found.params.constant_friction == pytest.approx(0.1, rel=1e-7)


@pytest.mark.slow
def test_folds_tell_how_well_the_far_faces_are_cooled():
    truth = WasherParams(carrier_thickness=7e-3)
    point = {"speed": 545.0, "tilt": 2e-3, "oil_temperature": 300.0}
    loads = fold_loads(truth, point, "field")
    data = {name: [value, value] for name, value in point.items()} | {
        "load": [None, 200.0],
        "friction_torque": [None, 0.13],
        "film_loss_load": [loads["film_loss_load"], None],
        "film_regain_load": [loads["film_regain_load"], None],
    }
    errors = {"film_loss_load": 1.0, "film_regain_load": 1.0, "friction_torque": 1e3}
    found = calibrate(WasherParams(), data, fit="carrier_thickness", errors=errors)
    assert found.params.carrier_thickness == pytest.approx(7e-3, rel=1e-4)
    assert "1 film_loss_load" in str(found)


def test_a_part_is_where_the_fit_starts(tmp_path):
    path = tmp_path / "mesh.toml"
    path.write_text(
        'model = "gearmesh"\nname = "Mine"\nfidelity = "fine"\n[parameters]\n'
        'friction_law = "constant"\nface_width = "30 mm"\n'
    )
    data = {**POINTS, "friction_torque": TORQUE}
    found = calibrate(load_part(path), data, fit="constant_friction")
    assert found.params.face_width == 0.03 and found.points.plan.fidelity == "fine"


GOOD = {**POINTS, "friction_torque": [0.1, 0.2, 0.3, -0.2]}


NAME = "constant_friction"
WRONG = [  # columns; other arguments; what is said
    ({"friction_torque": [0.1, np.nan, 0.3, 0.1]}, {}, "friction_torque: point 2 is nan"),
    ({"speed": [1.0, 2.0, np.nan, 1.0]}, {}, "speed = nan"),
    ({"speed": [1.0, None, 1.0, 1.0]}, {}, "speed: point 2 has none"),
    ({"speed": [1.0]}, {}, "one length for all"),
    ({"friction_torque": np.ones((4, 2))}, {}, "friction_torque: point 1 is array"),
    ({"speed": 5e4}, {}, "point 1: speed = 50000.0 rad/s, allowed"),
    ({"frction_torque": [1.0] * 4}, {}, "did you mean friction_torque"),
    ({"friction_torque": [None] * 4}, {}, "no measured output"),
    ({"friction_torque_error": [1.0, 0.0, 1.0, 1.0]}, {}, "point 2 is 0.0, allowed: above 0"),
    ({"film_thickness": [1e-6] * 4}, {}, "friction_torque_error is missing"),
    ({"friction_torque": [0.1, *[None] * 3]}, {"fit": (NAME, "f0")}, "1 value for 2 parameters"),
    ({}, {"fit": ()}, "fit names nothing"),
    ({}, {"fit": "constant_fricton"}, "did you mean constant_friction"),
    ({}, {"fit": "friction_law"}, "allowed: real parameters"),
    ({}, {"fit": "bulk_conductance"}, "is 0, which stands for another value"),
    ({"f0": [0.1] * 4}, {"fit": "f0"}, "fit = 'f0': is a column of the data, allowed: one"),
    ({}, {"bounds": {"f0": (0.0, 1.0)}}, "bounds of f0: allowed: of constant_friction"),
    ({}, {"bounds": {NAME: (0.1, 1.5)}}, "allowed: low < high in 0 .. 1"),
    ({}, {"errors": {"temperature": 1.0}}, "error of temperature: allowed: of a measured"),
    ({}, {"errors": {"friction_torque": "2 s"}}, "error of friction_torque"),
    ({}, {"confidence": 95}, "confidence = 95, allowed: above 0 and below 1"),
    ({}, {"fit": ("f0", "f0")}, "fit names f0 twice"),
    ({}, {"friction": 1.0}, "column friction: is no input, parameter or output"),
    ({}, {"fidelity": "exact"}, "fidelity = 'exact'"),
    ({}, {"data": None}, "data: no measured output, allowed: "),
    ({}, {"part": 1.0}, "part: float"),
]


@pytest.mark.parametrize(("changes", "more", "message"), WRONG)
def test_wrong_input_is_named(changes, more, message):
    with pytest.raises(ParameterError, match=message):
        calibrate(**{"part": constant_mesh(), "data": {**GOOD, **changes}, "fit": NAME, **more})


NO_FOLD = {"speed": 136.0, "tilt": 2e-3, "film_loss_load": 900.0}
TWO = {"load": [200.0, 300.0], "speed": 953.0, "friction_torque": [0.2, 0.25]}
OTHER = {"load": 200.0, "friction_torque": 0.2}


@pytest.mark.parametrize(
    ("data", "more", "message"),
    [
        (NO_FOLD, {"fidelity": "field"}, r"point 1 \(load 300, speed 136.* no such fold"),
        (TWO, {"fit": "roughness"}, r"fit = 'roughness': next to 5.15e-07 .* fidelity level 'map'"),
        (OTHER, {"at": {"roughness": 4.321e-7}}, "no map was made for these parameters"),
    ],
)
def test_points_without_a_solution_and_levels_of_no_use_are_named(data, more, message):
    """A map is for one roughness: that a changed one has no solution tells nothing of it."""
    with pytest.raises((SolveError, ParameterError), match=message):
        calibrate("washer", data, **{"fit": "heat_split", "fidelity": "map", **more})


def test_an_output_that_is_not_finite_is_named(monkeypatch):
    """No point is known where a model has one; so the solution is replaced."""
    monkeypatch.setattr(Measured, "computed", lambda self, changes: (np.array([1.0, np.inf]), {}))
    data = {"power": [1e3, 2e3], "speed": [100.0] * 2, "friction_torque": [2.0, 2.0]}
    with pytest.raises(ParameterError, match=r"point 2 .* is inf, allowed: finite outputs"):
        calibrate("gearmesh", data, fit="f0")


@pytest.mark.slow
def test_a_washers_derivatives_are_exact_and_save_its_solves(monkeypatch):
    rig, solved = BY_MODEL["washer"], []
    monkeypatch.setattr(Measured, "computed", counting(Measured.computed, solved))
    exact = rig_fit(rig)
    place = exact._best
    slopes = exact._problem.slopes_of_curve(place)
    few = len(solved)
    monkeypatch.setattr(Measured, "slopes", lambda *_: None)
    found = rig_fit(rig)
    assert slopes == pytest.approx(found._problem.slopes_of_curve(place), rel=1e-4)
    assert values(exact, rig.truth) == pytest.approx(values(found, rig.truth), rel=1e-9)
    assert few <= 0.4 * (len(solved) - few)


def counting(function, calls):
    """Return a method that notes each call."""

    def noted(*arguments):
        calls.append(arguments)
        return function(*arguments)

    return noted
