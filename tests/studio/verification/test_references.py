"""Reference values: they agree with every other route within what they say they may be off by."""

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    WasherParams,
    engage_clutch,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.cli import main
from thrustwasher.ladder import error_table
from thrustwasher.ladder.choose import choose
from thrustwasher.model.registry import spec_of
from thrustwasher.studio.verification.cases import own_case
from thrustwasher.studio.verification.measure_errors import measure_part
from thrustwasher.studio.verification.reference_clutch import reference_clutch, reference_engagement
from thrustwasher.studio.verification.reference_gearmesh import reference_gearmesh
from thrustwasher.studio.verification.reference_washer import reference_washer

POINT = {"load": 300.0, "speed": 953.0, "tilt": 2e-3}


def test_the_washers_reference_holds_the_converged_torque():
    """0.232072 +- 2e-6 N m came from meshes up to 129 x 512."""
    paper = WasherParams.preset("paper")
    found = reference_washer(paper, **POINT)
    off = found.uncertainty["friction_torque"]
    assert off < 2e-5
    assert found.values["friction_torque"] == pytest.approx(0.2320718, abs=off + 2e-6)
    fine = solve_washer(paper, **POINT, fidelity="fine")
    assert found.values["friction_torque"] == pytest.approx(fine.friction_torque, rel=1e-3)
    found = reference_washer(WasherParams(), **POINT)
    assert found.uncertainty["friction_torque"] < 1e-4
    fine = solve_washer(WasherParams(), **POINT, fidelity="fine")
    assert found.values["friction_torque"] == pytest.approx(fine.friction_torque, rel=1e-3)


def test_the_clutchs_reference_lies_where_rings_converge_to():
    at = {"load": 5e3, "speed": 10.0, "oil_temperature": 353.15}
    found = reference_clutch(ClutchParams(), **at)
    fine = solve_clutch(ClutchParams(), **at, fidelity="fine")
    torque, off = found.values["friction_torque"], found.uncertainty["friction_torque"]
    assert off < 1e-3 * torque
    assert abs(fine.friction_torque - torque) < 20.0 * off
    field = solve_clutch(ClutchParams(), **at)
    assert abs(fine.friction_torque - torque) < 0.1 * abs(field.friction_torque - torque)


def test_another_integrator_confirms_an_engagement():
    time = np.linspace(0.0, 0.2, 5)
    profile = {
        "time": time,
        "load": 5e3 * np.minimum(time / 0.1, 1.0),
        "speed": 100.0 - 200.0 * time,
    }
    params = ClutchParams(starts_pressed=True)
    found = reference_engagement(params, **profile, oil_temperature=350.0)
    fine = engage_clutch(params, **profile, oil_temperature=350.0, fidelity="fine")
    torque = found.values["friction_torque"]
    assert fine.friction_torque[-1] == pytest.approx(torque, rel=3e-4)
    assert fine.energy[-1] == pytest.approx(found.values["energy"], rel=3e-4)
    with pytest.raises(ParameterError, match="contact_rise = True"):
        reference_engagement(ClutchParams(contact_rise=True), **profile)


@pytest.mark.parametrize("preset", ["paper", None])
@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"friction_law": "iso"},
        {"load_share": 0.4},
        {"friction_law": "li-seireg"},
        {"gear_ratio": 5.0, "pinion_teeth": 30},
    ],
)
def test_the_gears_quadrature_confirms_the_level_fine(changes, preset):
    params = GearMeshParams.preset(preset or "paper", **changes)
    if preset is None:
        params = GearMeshParams(
            helix_angle=0.2, sigma_rms=1e-7, **{"friction_law": "mixed", **changes}
        )
    found = reference_gearmesh(params, power=7500.0, speed=180.0)
    fine = solve_gearmesh(params, power=7500.0, speed=180.0, fidelity="fine")
    assert fine.friction_torque == pytest.approx(found.values["friction_torque"], rel=2e-4)
    assert fine.asperity_temperature == pytest.approx(found.values["temperature"], rel=1e-4)
    assert fine.film_thickness == pytest.approx(found.values["film_thickness"], rel=1e-3)


@pytest.mark.parametrize(
    "solve",
    [
        lambda f: solve_washer(WasherParams(), **POINT, fidelity=f),
        lambda f: solve_clutch(ClutchParams(), load=1.0, speed=1.0, fidelity=f),
        lambda f: solve_gearmesh(GearMeshParams(), power=1.0, speed=1.0, fidelity=f),
    ],
)
def test_a_reference_asked_for_as_a_level_says_where_it_is(solve):
    with pytest.raises(ParameterError, match=r"call thrustwasher\.studio\.verification\.reference"):
        solve("reference")


# Table and map of a part of your own: made on request, kept by the digest of parameters.

SPEC = spec_of("washer")
OWN = WasherParams(roughness=5.1e-7)
BOX = {
    "load": (200.0, 400.0),
    "speed": (520.0, 540.0),
    "tilt": (0.002, 0.002),
    "oil_temperature": (297.15, 297.15),
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        error_table.forget()
        yield measure_part(SPEC, OWN, BOX, points=12, workers=1)
    error_table.forget()


@pytest.mark.slow
def test_every_level_is_measured_and_kept_in_the_users_cache(made):
    assert [level.fidelity for level in made.levels] == ["map", "field", "fine"]
    assert [made.stale(level) for level in made.levels] == [None] * 3
    (file,) = error_table.own_folder().iterdir()
    assert file.name == f"washer-{made.name}.json" and error_table.read_tables(file) == (made,)


@pytest.mark.slow
def test_choose_takes_the_map_with_its_measured_error(made):
    choice = choose("washer", BOX, tol=0.01, params=OWN, n_calls=1e6)
    assert choice.fidelity == "map" and choice.is_verified and 0.0 < choice.error <= 0.01


@pytest.mark.parametrize(
    ("box", "points", "said"),
    [({"load": (1, 2.1e5)}, 60, "load"), ({"tilt": (0.002, 0.001)}, 60, "tilt"), ({}, 3, "points")],
)
def test_a_box_outside_the_models_range_is_refused(box, points, said):
    with pytest.raises(ParameterError, match=said):
        own_case(SPEC, OWN, box, points)


def test_a_box_of_light_loads_begins_where_the_model_does():
    assert own_case(SPEC, OWN, {"load": (0.0, 140.0)}, 60).box["load"].min == 1.0


def test_a_part_without_levels_to_choose_from_has_no_table(tmp_path, capsys):
    file = tmp_path / "sump.toml"
    file.write_text('model = "sump"\nname = "Sump"\n')
    assert main(["fidelity", str(file)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
