"""``thrustwasher explore`` and the file it writes."""

import base64
import hashlib
import json
import re
from dataclasses import fields
from pathlib import Path

import pytest
from pages import MODELS, WEB, about, html

from thrustwasher import WasherParams, cli, load_part, solve_train, solve_washer
from thrustwasher.errors import ParameterError
from thrustwasher.model.part_file import find_part, preset_file
from thrustwasher.model.registry import find_model, models_with_points
from thrustwasher.studio.explore.page import VIEWS, page
from thrustwasher.studio.report.bundles import bundle

LARGEST = 1_500_000  # bytes of a page
each = pytest.mark.parametrize("model", MODELS)


def test_the_command_writes_a_page(tmp_path, capsys):
    out = tmp_path / "gears.html"
    assert cli.main(["explore", "GearMesh", "--out", str(out)]) == 0
    assert capsys.readouterr().out.startswith(f"{out}: 0.")
    assert out.read_text("utf-8").startswith("<!DOCTYPE html>")
    assert [p.name for p in tmp_path.iterdir()] == ["gears.html"]


@each
def test_a_page_is_small_and_takes_nothing_from_outside(model):
    text = html(model)
    assert len(text.encode()) <= LARGEST
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', text)[1].replace("&#39;", "'")
    assert policy.startswith("default-src 'none';") and "http" not in policy
    assert "unsafe-inline" not in policy and "'unsafe-eval'" not in policy
    for tag in ("script", "style"):
        found = re.search(rf"(?s)<{tag}>(.*?)</{tag}>", text)
        digest = base64.b64encode(hashlib.sha256(found[1].encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    head = text.split("<script")[0]
    assert re.findall(r"""(?:src|href)=["'](?!data:|[\w./-]+\.md)""", head) == []


@each
def test_units_ranges_and_texts_are_those_of_the_interface(model):
    spec, told = find_model(model).spec, about(model)
    listed = [(f["name"], f["unit"], f["min"], f["max"], f["help"]) for f in told["parameters"]]
    assert listed == [
        (f.name, *(f.metadata[k] for k in ("unit", "min", "max", "help")))
        for f in fields(spec.params)
    ]
    names = {s.name: s for s in spec.inputs}
    for given in told["inputs"]:
        if given["name"] in names:
            s = names[given["name"]]
            assert (given["unit"], given["help"], given["max"]) == (s.unit, s.help, s.high)
    view = VIEWS[model]
    assert {*view.main} <= {f.name for f in fields(spec.params)}
    assert {*view.figures} <= told["outputs"].keys()
    assert told["worker"]["functions"].keys() == {*view.worker.calls}
    assert (WEB / "models" / f"{view.worker.script}.js").exists()
    assert bundle(f"{view.page}.js") and view.worker.source()


def test_a_page_of_a_part_begins_with_its_values_inside_its_box(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(
        'model = "washer"\nname = "Mine"\n[parameters]\nroughness = "0.4 um"\n'
        '[box]\nload = ["50 N", "200 N"]\n'
    )
    text = page(find_part(str(file)))
    told = json.loads(re.search(r'(?s)id="about">(.*?)</script>', text)[1])
    assert told["given"]["roughness"] == 4e-7 and told["inputs"][0]["value"] == 200.0
    wanted = solve_washer(WasherParams(roughness=4e-7), load=200.0, speed=545.0, tilt=2e-3)
    assert f'<data id="friction_torque" value="{wanted.friction_torque!r}">' in text


def test_a_page_holds_its_equations_and_names_the_other_pages():
    text = html("washer")
    assert "<h3>Film</h3>" in text and "average Reynolds equation" in text
    assert "thrustwasher explore gearmesh" in text and "thrustwasher explore clutch" in text
    assert "<a " not in text


@pytest.mark.parametrize("named", ["ev-reducer", "mine.toml"])
def test_a_gear_train_is_explored_by_name_or_file(named, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = preset_file(find_model("train").spec, "ev-reducer")
    Path("mine.toml").write_text(scene.read_text("utf-8"), "utf-8")
    assert cli.main(["explore", named, "--out", "train.html"]) == 0
    text = Path("train.html").read_text("utf-8")
    wanted = solve_train(load_part(scene).params, torque=150.0, speed=300.0)
    assert f'<data id="loss" value="{wanted.loss!r}">' in text
    assert '<data id="flow" value="input to output">' in text


def test_models_with_a_page_are_those_with_a_command():
    assert VIEWS.keys() == models_with_points().keys()


def test_a_model_without_a_page_is_refused():
    with pytest.raises(ParameterError, match="'sump' has no page to explore"):
        page(find_part("sump"))
