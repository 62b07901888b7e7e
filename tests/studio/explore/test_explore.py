"""``thrustwasher explore`` and the file it writes."""

import base64
import hashlib
import json
import math
import re
from dataclasses import asdict, fields
from pathlib import Path

import numpy as np
import pytest
from pages import MODELS, WEB, about, answers, html, node
from scipy.stats import qmc

from thrustwasher import (
    GearMeshParams,
    WasherParams,
    cli,
    load_part,
    solve_gearmesh,
    solve_train,
    solve_washer,
)
from thrustwasher.errors import ParameterError
from thrustwasher.gearmesh.kernels import layout as k
from thrustwasher.gearmesh.kernels.load_sharing import shared
from thrustwasher.gearmesh.solve import prepare
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.part_file import find_part, preset_file
from thrustwasher.model.registry import find_model, models_with_points
from thrustwasher.studio.explore.draws import DRAWS, draws_of, fixed_points
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


# How a part scatters, as its page is told: fixed draws that follow the values that are set.

POINT = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}
POINT |= {"far_face_temperature": 0.0}
NAMES = {f.name for f in fields(WasherParams)} | POINT.keys()
LOADS = [20.0 * 150.0 ** (i / 23) for i in range(24)]


def part(tmp_path, *lines, parameters=""):
    file = tmp_path / "mine.toml"
    head = 'model = "washer"\nname = "Mine"\n[parameters]\n'
    file.write_text(f"{head}{parameters}\n[scatter]\n" + "\n".join(lines))
    return find_part(str(file))


def changes(one):
    """Return all changes of a part's draws by name."""
    found = draws_of(one, POINT, NAMES, "load")
    return {c["name"]: c for s in found["sources"] for c in s["changes"]}


def applied(change, value, k):
    how, x = change["how"], change["values"][k]
    return {"times": value * x, "plus": value + x, "set": x}[how] if how != "set" else x


def test_the_points_are_one_in_each_32nd_of_every_axis():
    points = fixed_points(12)
    for axis in points.T:
        assert sorted((axis * DRAWS).astype(int)) == list(range(DRAWS))
    assert points.min() > 0.0 and points.max() < 1.0
    assert len(np.unique(points, axis=1).T) == 12


@pytest.mark.parametrize("n", [1, 64, 65])
def test_the_points_are_the_first_of_scipys_sequence(n):
    expected = qmc.Sobol(n, scramble=False).random(DRAWS) + 0.5 / DRAWS
    np.testing.assert_array_equal(fixed_points(n), expected)


def test_at_the_start_the_draws_are_those_of_the_part():
    washer = find_part("washer")
    told, known = about("washer")["scatter"], washer.scattered(inputs=POINT)
    assert [s["name"] for s in told["sources"]] == list(known.names)
    assert [s["law"] for s in told["sources"]] == [s.law.words() for s in known.sources]
    assert all(s["reason"] for s in told["sources"]) and told["draws"] == DRAWS
    rows = known.values(fixed_points(len(known.sources)))
    now = {**asdict(washer.params), **POINT}
    for source in told["sources"]:
        (change,) = source["changes"]
        for i, row in enumerate(rows):
            here = applied(change, now[change["name"]], i)
            assert here == pytest.approx(row[source["name"]], rel=1e-13)


@pytest.mark.parametrize(
    ("line", "name", "how"),
    [
        ('roughness = "10 %"', "roughness", "times"),
        ("tilt = { lognormal = 1.6 }", "tilt", "times"),
        ('oil_temperature = "3 K"', "oil_temperature", "plus"),
        ("heat_split = { uniform = [0.4, 0.6] }", "heat_split", "set"),
        ('conduction = { either = ["carrier", "all"] }', "conduction", "set"),
        ('load = { uniform = ["200 N", "400 N"] }', "load", "times"),
        ('load = "20 N"', "load", "plus"),
    ],
)
def test_a_law_says_whether_its_draws_follow_the_value(tmp_path, line, name, how):
    change = changes(part(tmp_path, line))[name]
    assert change["how"] == how and len(change["values"]) == DRAWS
    assert len(set(map(str, change["values"]))) > 1


def test_a_load_of_even_chances_scales_the_loads_that_the_page_goes_over(tmp_path):
    values = changes(part(tmp_path, 'load = { uniform = ["150 N", "450 N"] }'))["load"]["values"]
    assert 0.5 < min(values) < 0.55 and 1.45 < max(values) < 1.5


def test_a_value_taken_from_another_one_scatters_about_that(tmp_path):
    change = changes(part(tmp_path, 'roughness_washer = "10 %"'))["roughness_washer"]
    assert change["how"] == "times" and change["at_zero"] == "roughness"
    own = changes(part(tmp_path, 'heat_split = "10 %"'))["heat_split"]
    assert own["at_zero"] == 0.0


def test_a_parameter_of_an_earlier_form_scatters_as_those_in_its_place(tmp_path):
    found = changes(part(tmp_path, 'friction_constant = "10 %"'))
    assert found and found.keys() <= NAMES and "friction_constant" not in found
    assert {c["how"] for c in found.values()} == {"set"}


def test_a_part_that_gives_no_scatter_has_no_draws(tmp_path):
    assert draws_of(part(tmp_path), POINT, NAMES, "load") is None


@node
@pytest.mark.slow
def test_a_draw_of_the_worker_is_what_python_solves_load_by_load():
    washer = find_part("washer")
    known = washer.scattered(inputs=POINT)
    rows = [known.values(fixed_points(len(known.sources)))[k] for k in (4, 31)]
    fallen = []
    for row in rows:
        params, drawn = washer.varied(row)
        inputs = {**POINT, **drawn}
        loads = [load * inputs["load"] / POINT["load"] for load in LOADS]
        task = ["draw", as_numbers(params), "field", list(inputs.values()), loads]
        (got,), _ = answers("washer", [task])
        for load, here in zip(loads, got["up"], strict=True):
            wanted = solve_washer(params, **{**inputs, "load": load})
            assert here["branch"] == wanted.branch
            assert here["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-5)
            assert here["temperature_max"] == pytest.approx(wanted.temperature_max, rel=1e-5)
        down = {i: o for i, o in enumerate(got["down"]) if o}
        fallen.append(len(down))
        assert all(got["up"][i]["branch"] == "film" for i in down)
        for i, here in down.items():
            wanted = solve_washer(params, **{**inputs, "load": loads[i]}, branch="contact")
            assert here["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-5)
    assert fallen[0] > 0 and fallen[1] == 0  # with folds and without


@node
def test_a_draw_that_breaks_a_rule_says_which():
    numbers = as_numbers(WasherParams())
    at = [f.name for f in fields(WasherParams)].index("gear_inner_radius")
    with pytest.raises(ParameterError):
        WasherParams(gear_inner_radius=0.03)
    numbers[at] = 0.03
    (got,), _ = answers("washer", [["draw", numbers, "field", list(POINT.values()), LOADS]])
    assert about("washer")["rules"][got["broken"] - 1].startswith("gear_inner_radius")


# The gear mesh's page draws teeth and path of contact, with places and shares of Python.

TEETH_POINT = {"power": 2e4, "speed": 200.0, "oil_temperature": 350.0}
FZG_C = {
    "pinion_teeth": 16,
    "gear_ratio": 1.5,
    "normal_module": 4.5e-3,
    "face_width": 0.014,
    "profile_shift_pinion": 0.1817,
    "profile_shift_gear": 0.1715,
    "tip_diameter_pinion": 0.08246,
    "tip_diameter_gear": 0.11836,
}
RELIEF = {
    "load_sharing": "elastic",
    "tip_relief_pinion": 35e-6,
    "tip_relief_gear": 35e-6,
    "tip_relief_length_pinion": 3e-3,
    "tip_relief_length_gear": 3e-3,
}
PAIRS = {
    "standard": {},
    "shifted, relieved": FZG_C | RELIEF,
    "ring": {"internal": True, "gear_ratio": 3.0, "addendum_gear": 0.8},
    "ring, shifted": {"internal": True, "gear_ratio": 3.0, "profile_shift_pinion": 0.4},
    "long teeth": {"pinion_teeth": 60, "addendum": 1.3, "load_sharing": "elastic"},
    "helical": {"helix_angle": 0.2, "face_width": 0.02},
}
pairs = pytest.mark.parametrize("changed", PAIRS.values(), ids=PAIRS)


def opened_with(opened, changed):
    given = "&".join(f"{n}={str(v).lower()}" for n, v in (TEETH_POINT | changed).items())
    return opened("gearmesh", f"#{given}")


def points_of(page):
    """Return the points A to E as drawn [m] from the pitch point."""
    found = page.page.locator("svg.teeth [data-point]").all()
    at = [[float(p.get_attribute(f"data-{axis}")) for axis in "xy"] for p in found]
    return dict(zip((p.get_attribute("data-point") for p in found), np.array(at), strict=True))


@pytest.mark.browser
@pairs
def test_the_path_drawn_has_pythons_contact_ratio_and_ends_on_the_tip_circles(opened, changed):
    params = GearMeshParams(**changed)
    wanted, drawn = solve_gearmesh(params, **TEETH_POINT), points_of(opened_with(opened, changed))
    base = wanted.pinion_diameter * math.cos(wanted.working_pressure_angle)
    pitch = math.pi * base / params.pinion_teeth
    length = np.linalg.norm(drawn["E"] - drawn["A"])
    assert length / pitch == pytest.approx(wanted.contact_ratio, rel=1e-9)
    assert drawn["C"] == pytest.approx([0.0, 0.0])
    for first, second in ("BE", "AD"):
        assert np.linalg.norm(drawn[second] - drawn[first]) == pytest.approx(pitch, rel=1e-9)
    above = -1.0 if params.internal else 1.0
    for end, gear, side in (("E", "pinion", -1.0), ("A", "gear", above)):
        axis = [0.0, side * getattr(wanted, f"{gear}_diameter") / 2.0]
        tip = getattr(wanted, f"{gear}_tip_diameter") / 2.0
        assert np.linalg.norm(drawn[end] - axis) == pytest.approx(tip, rel=1e-9)


@pytest.mark.browser
@pairs
def test_flanks_drawn_touch_in_the_pairs_in_contact(opened, changed):
    page = opened_with(opened, changed).page
    far = page.evaluate(
        """() => [...document.querySelectorAll("svg.teeth .touch")].flatMap((dot) => {
        const [x, y] = [Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))];
        return [...document.querySelectorAll("svg.teeth .flank")].map((flank) => {
          const edge = flank.getAttribute("d").slice(1).split("L");
          const points = edge.map((p) => p.split(",").map(Number));
          return Math.min(...points.slice(1).map(([u, v], k) => {
            const [a, b] = points[k], l = (u - a) ** 2 + (v - b) ** 2 || 1;
            const t = Math.min(1, Math.max(0, ((x - a) * (u - a) + (y - b) * (v - b)) / l));
            return Math.hypot(x - a - t * (u - a), y - b - t * (v - b));
          }));
        });
      })"""
    )
    assert len(far) >= 2 and max(far) < 0.8  # pixels


@pytest.mark.browser
@pytest.mark.parametrize("changed", [{}, FZG_C | RELIEF, PAIRS["long teeth"]])
def test_shares_told_sum_to_1_wherever_the_gears_are_rolled(opened, changed):
    page = opened_with(opened, changed).page
    seen = set()
    for rolled in np.linspace(0.0, 1.0, 12):
        page.locator("#roll").fill(str(rolled))
        shares = [float(s.get_attribute("value")) for s in page.locator(".pairs data").all()]
        assert len(shares) == page.locator("svg.teeth .touch").count()
        assert sum(shares) == pytest.approx(1.0, abs=1e-9)
        seen.add(len(shares))
    assert seen == ({2, 3} if changed.get("addendum") else {1, 2})


@node
@pairs
def test_shares_sliding_and_loss_of_the_worker_are_those_of_python(changed):
    params = GearMeshParams(**changed)
    (got,), _ = answers("gearmesh", [["solve", list(TEETH_POINT.values())]], params=params)
    wanted = solve_gearmesh(params, **TEETH_POINT)
    assert got["outputs"]["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-10)
    torque = TEETH_POINT["power"] / TEETH_POINT["speed"]
    par = shared(prepare(params, "field"), torque, np.zeros(k.NWORK))
    n = int(par[k.D_PLACES])
    for key, first in (("position", k.D_POSITION), ("share", k.D_PATH_SHARE)):
        assert got["path"][key] == pytest.approx(par[first : first + n], rel=1e-9, abs=1e-11)
    pitch = math.pi * wanted.pinion_diameter * math.cos(wanted.working_pressure_angle)
    pitch *= (1.0 + (-1.0 if params.internal else 1.0) / params.gear_ratio) / params.pinion_teeth
    sliding = pitch * TEETH_POINT["speed"] * par[k.D_POSITION : k.D_POSITION + n]
    assert got["path"]["sliding"] == pytest.approx(sliding, rel=1e-9, abs=1e-9)


REFUSED = [
    ("profile_shift_pinion", 1.6, "allowed: less, or smaller tip diameters: a tooth is pointed"),
    ("pinion_teeth", 8, "(with so few the gear's tips cut below the pinion's involute"),
    ("addendum", 0.35, "(contact ratio 1 and more"),
]


@pytest.mark.browser
@pytest.mark.parametrize(("name", "bad", "words"), REFUSED)
def test_a_geometry_that_the_kernel_refuses_says_why_and_the_last_one_stays(
    opened, name, bad, words
):
    page = opened("gearmesh")
    before = points_of(page)
    page.put(name, bad)
    said = page.page.text_content("#state")
    assert said.startswith(f"{name} = {bad}, ") and words in said
    assert page.page.get_attribute("#results", "class") == "stale"
    assert points_of(page)["E"] == pytest.approx(before["E"])
    page.put("profile_shift_pinion", 0.2)
    page.put(name, {"profile_shift_pinion": 0.2, "pinion_teeth": 22, "addendum": 0.95}[name])
    assert points_of(page)["E"] != pytest.approx(before["E"])


@pytest.mark.browser
def test_lines_along_the_path_have_no_kinks_within_a_piece(opened):
    """The Hertz pressure from A to B falls ever less steeply, by small turns."""
    panel = opened("gearmesh").page.locator("#views .panel", has_text="Hertz pressure")
    text = panel.locator("polyline.line").first.get_attribute("points")
    x, y = np.array([p.split(",") for p in text.split()], float).T
    first = slice(0, int(np.argmax(np.diff(x) == 0.0)))  # to the jump at B
    turns = np.diff(np.arctan2(np.diff(y[first]), np.diff(x[first])))
    assert len(x[first]) > 20 and np.abs(turns).max() < np.radians(5.0)
    assert np.all(np.diff(y[first]) > 0.0)  # drawn downwards


@pytest.mark.browser
def test_the_shift_slider_moves_the_teeth(opened):
    page = opened("gearmesh")
    page.page.locator("#in-profile_shift_pinion-slider").fill("650")
    page.settled()
    shift = float(page.page.input_value("#in-profile_shift_pinion"))
    wanted = solve_gearmesh(
        GearMeshParams(profile_shift_pinion=shift), power=7500.0, speed=180.0
    ).contact_ratio
    assert shift == pytest.approx(0.3) and page.figure("contact_ratio") == pytest.approx(wanted)


@pytest.mark.browser
def test_without_anything_along_the_path_only_the_teeth_are_drawn(opened):
    page = opened("gearmesh", "#film_heat=atan").page
    assert page.locator("#views .panel").first.is_visible()
    assert page.locator("#views .panel").nth(1).is_hidden()
    assert "nothing along the path" in page.text_content(".pairs")


@pytest.mark.browser
def test_tips_that_reach_into_the_root_are_told(opened):
    said = opened_with(opened, {"addendum": 1.3, "pinion_teeth": 60}).page.text_content(".pairs")
    module = 2.0 * 0.254 / (60 * 3.0)
    assert f"Tips reach {1e6 * 0.05 * module:.4g} µm below the other gear's root circle" in said
