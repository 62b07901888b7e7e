"""The report of a reducer: one for its three commands, on a few pages, in the file's names."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.contour import ContourSet

from thrustwasher import propagate
from thrustwasher.cli import main
from thrustwasher.studio.report.html import render
from thrustwasher.studio.report.model_plots.reducer_plots import loss_map_figure
from thrustwasher.studio.report.reducer_report import reducer_page
from thrustwasher.train.solve import solve_train
from thrustwasher.train.train_file import load_train
from thrustwasher.train.train_map import train_map

SCENE = Path(__file__).parents[3] / "examples" / "ev-reducer.toml"
POINT = {"torque": 150.0, "speed": 500.0, "oil_temperature": 353.15}


@pytest.fixture(scope="module")
def page():
    study = propagate(SCENE, at=POINT, runs=64, indices=False, workers=1)
    return reducer_page(load_train(SCENE), [POINT], study=study)


def rows(page, anchor, table=0):
    section = next(s for s in page.sections if s.anchor == anchor)
    return {row[0]: row[1:] for row in section.tables[table].rows}


def test_figures_are_those_of_the_solver_with_the_files_names(page):
    r = solve_train(load_train(SCENE).part.params, **POINT)
    assert rows(page, "losses", 1)["first"][0].startswith(f"{r.mesh_1_loss:.3g} W (")
    assert rows(page, "safeties")["second"][0].startswith(f"{r.mesh_2_pitting_safety:.3g} (")
    assert rows(page, "lives")["rotor.bearing_1"][0] == f"{r.shaft_1_bearing_1_life / 3600.0:.0f}"
    assert page.cards[0].value == f"{100.0 * (1.0 - r.efficiency):.3g} %"
    assert not re.search(r"mesh_\d|shaft_\d", render(page))


def test_a_life_lies_inside_its_band(page):
    life, band = rows(page, "lives")["rotor.bearing_1"]
    low, high = map(float, band.split(" .. "))
    assert low < float(life) < high


def test_the_losses_by_source_add_up(page):
    shares = [row[0] for row in rows(page, "losses").values()]
    whole = sum(float(re.search(r"\(([\d.]+) %", text)[1]) for text in shares)
    assert whole == pytest.approx(100.0, abs=0.2)


def test_what_limits_is_sorted_and_the_least_is_said(page):
    section = next(s for s in page.sections if s.anchor == "limits")
    margins = [float(row[2]) for row in section.tables[0].rows]
    assert margins == sorted(margins)
    assert section.tables[0].rows[0][0] in page.summary[0]


def test_lines_of_equal_loss_have_numbers_and_the_last_tick_is_whole():
    scene = load_train(SCENE)
    speed = np.linspace(0.0, 1256.6370614359173, 34)[1:]
    found = train_map(scene, np.linspace(10.0, 200.0, 33), speed)
    axis = loss_map_figure(found, [(150.0, 500.0)]).axes[0]
    written = {text.get_text() for text in axis.texts}
    assert {"100", "200", "500", "1000", "2000"} <= written
    (lines,) = (c for c in axis.collections if isinstance(c, ContourSet))
    assert {f"{level:g}" for level in lines.levels} <= written
    assert axis.get_xlim()[1] == 12000.0 and 12000.0 in axis.get_xticks()


@pytest.mark.parametrize(
    "words",
    [
        ["train", "--part", str(SCENE), "--torque", "150", "--speed", "500"],
        pytest.param(
            ["efficiency", str(SCENE), "--over", "torque=50,150", "--over", "speed=200,500"],
            marks=pytest.mark.slow,
        ),
    ],
)
def test_commands_write_it_as_one_file(words, tmp_path, capsys):
    file = tmp_path / "report.html"
    assert main([*words, "--report", str(file)]) == 0
    text = file.read_text("utf-8")
    assert "Two-stage reducer of an electric car" in text and "<img" not in text
    assert f"wrote {file}" in capsys.readouterr().err


@pytest.mark.slow
def test_a_search_shows_what_it_has_changed_in_degrees_as_given(tmp_path, capsys):
    file = tmp_path / "report.html"
    words = ["optimise", str(SCENE), "--vary", "first.helix_angle=20 deg:24 deg", "--minimise"]
    more = ["loss", "--workers", "1", "--out", str(tmp_path / "out"), "--report", str(file)]
    assert main([*words, *more]) == 0
    text = file.read_text("utf-8")
    assert "first.helix_angle" in text and "22°" in text and "mrad" not in text
    assert "first.helix_angle = 24°" in capsys.readouterr().out


def test_only_gear_trains_have_one(tmp_path, capsys):
    words = ["efficiency", "planetary", "--report", str(tmp_path / "report.html")]
    assert main(words) == 2
    assert "allowed: of a gear train" in capsys.readouterr().err


def test_a_warning_alone_is_said_whole_and_once(page):
    one, two = (
        render(replace(page, warnings=texts)) for texts in (["w" * 200], ["w" * 200, "further"])
    )
    assert one.count("w" * 200) == 1 and 'href="#warnings"' not in one
    assert two.count("w" * 200) == 1 and 'href="#warnings"' in two


def test_a_train_without_limits_of_root_stress_has_a_report_too(tmp_path):
    text = re.sub(r'root_limit = "430 MPa"\n', "", SCENE.read_text("utf-8"))
    (tmp_path / "mine.toml").write_text(text, "utf-8")
    found = reducer_page(load_train(tmp_path / "mine.toml"), [POINT])
    assert rows(found, "safeties")["second"][1] == "no limit given"
    assert "minimum root safety" not in {card.name for card in found.cards}
    one = text.replace("angle = ", 'root_limit = "430 MPa"\nangle = ', 1)
    (tmp_path / "one.toml").write_text(one, "utf-8")
    found = reducer_page(load_train(tmp_path / "one.toml"), [POINT])
    assert float(rows(found, "safeties")["first"][1]) > 0.0
    assert rows(found, "safeties")["second"][1] == "no limit given"
