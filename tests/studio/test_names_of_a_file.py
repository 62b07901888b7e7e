"""What a file names has that name everywhere: varied, scattered, fitted, in columns and figures."""

from pathlib import Path

import pytest

from thrustwasher import calibrate, load_part, optimise, propagate, run_sweep
from thrustwasher.train.solve import solve_train

SCENE = Path(__file__).parents[2] / "examples" / "ev-reducer.toml"
POINT = {"torque": 150.0, "speed": 500.0}
FLAT = ("mesh_1_", "mesh_2_", "shaft_")


def test_a_study_names_sources_figures_and_columns_as_the_file():
    found = propagate(SCENE, at=POINT, runs=8, indices=False)
    assert "second.gear_immersion" in [line.name for line in found.sources]
    assert found.figures["second.loss"].help.startswith("second: tooth friction")
    names = [*found.figures, *found.sample, *(line.name for line in found.sources)]
    assert not [name for name in names if name.startswith(FLAT)]


def test_a_search_takes_both_names_and_answers_with_those_of_the_file():
    found = [
        optimise(
            SCENE,
            vary={f"{mesh}normal_module": (1.5e-3, 2.5e-3)},
            minimise="loss",
            limits=[f"{mesh}pitting_safety>=1"],
            at=POINT,
            workers=1,
        )
        for mesh in ("first.", "mesh_1_")
    ]
    assert found[0].best.values == found[1].best.values
    assert [*found[0].best.values] == ["first.normal_module"]
    assert "first.pitting_safety" in found[0].best.figures
    assert not [name for name in found[0].best.figures if name.startswith(FLAT)]


def test_a_fit_takes_both_names_and_answers_with_those_of_the_file():
    part = load_part(SCENE)
    torque = [50.0, 100.0, 200.0]
    truth, _ = part.varied({"first.mean_roughness": 5e-7})
    loss = [solve_train(truth, torque=x, speed=500.0).mesh_1_loss for x in torque]
    for loss_name, name in (
        ("first.loss", "first.mean_roughness"),
        ("mesh_1_loss", "mesh_1_mean_roughness"),
    ):
        data = {"torque": torque, "speed": 500.0, loss_name: loss}
        found = calibrate(part, data, fit=[name])
        assert found["first.mean_roughness"].value == pytest.approx(5e-7, rel=1e-6)
        assert found.params.mesh_1_mean_roughness == found["first.mean_roughness"].value


def test_a_sweep_shows_what_was_varied_by_the_name_of_the_file():
    table = run_sweep(load_part(SCENE), {"first.normal_module": [2e-3, 2.2e-3]}, at=POINT)
    assert table.axes() == ["first.normal_module"]
    assert "first.loss" in table.outputs() and table.units["first.loss"] == "W"
    assert not [name for name in table.columns if name.startswith(FLAT[:2])]
