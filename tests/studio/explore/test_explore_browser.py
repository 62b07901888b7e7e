"""The pages in Chromium, opened from the disk: no errors, no requests, the numbers of Python."""

import json
import re
import shlex

import pytest
from browser_pages import Seen, faults
from pages import MODELS, about

from thrustwasher import (
    ClutchParams,
    TrainParams,
    WasherParams,
    cli,
    load_curve,
    oil,
    solve_train,
    solve_washer,
)
from thrustwasher.ladder.error_table import SAFETY, fresh_levels
from thrustwasher.model.part_file import find_part
from thrustwasher.studio.verification.reference_clutch import HELD, RISE, TIMES

pytestmark = pytest.mark.browser
SAME = 1e-10
LOOKS = {
    "light": {},
    "dark": {"color_scheme": "dark"},
    "narrow": {"viewport": {"width": 390, "height": 800}},
}
POINT = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}


def test_a_page_opens_with_the_numbers_of_python_and_fields_change_them(opened):
    page = opened()
    for point in (POINT, POINT | {"load": 500.0}, POINT | {"load": 500.0, "speed": 1200.0}):
        for name, value in point.items():
            if float(page.page.input_value(f"#in-{name}")) != value:
                page.put(name, value)
        wanted = solve_washer(WasherParams(), **point)
        for name in ("friction_torque", "temperature", "film_thickness", "oil_flow"):
            assert page.figure(name) == pytest.approx(getattr(wanted, name), rel=SAME)
        assert page.page.text_content("#branch") == wanted.branch


def test_the_address_is_the_state_and_comes_back(opened):
    page = opened(address="#load=400&speed=953&tilt=0.002&oil_temperature=310&roughness=4e-7")
    wanted = solve_washer(
        WasherParams(roughness=4e-7), load=400.0, speed=953.0, tilt=2e-3, oil_temperature=310.0
    )
    assert page.figure("friction_torque") == pytest.approx(wanted.friction_torque, rel=SAME)
    page.put("load", 450)
    assert "load=450&" in page.page.url and "roughness=4e-7" in page.page.url
    again = opened(address=page.page.url[page.page.url.index("#") :])
    assert again.figure("friction_torque") == page.figure("friction_torque")
    command = page.page.text_content("#as-command")
    assert command.startswith("thrustwasher washer --load 450 --speed 953 --tilt 0.002")
    assert "--set roughness=4e-7" in command


def test_units_are_switched_and_kept_in_the_address(opened):
    page = opened(address="#load=400&units=si")
    assert page.page.text_content("#temperature").endswith(" K")
    with page.page.expect_navigation():
        page.page.select_option("#units", "workshop")
    page.page.wait_for_selector("html[data-settled]")
    assert page.page.text_content("#temperature").endswith(" °C")
    assert "load=400" in page.page.url and page.page.url.endswith("units=workshop")


def test_a_named_oil_is_taken_with_its_law(opened):
    page = opened(address="#load=300&speed=545&tilt=0.002&oil_temperature=297.15")
    assert page.page.input_value("#oil") == ""
    page.page.select_option("#oil", "ISO VG 46")
    page.settled()
    params = WasherParams(**oil("ISO VG 46").parameters_for("washer"))
    wanted = solve_washer(params, **POINT)
    assert page.figure("friction_torque") == pytest.approx(wanted.friction_torque, rel=SAME)
    assert page.page.input_value("#oil") == "ISO VG 46"


VIEWS = {  # an address; what the command prints of the figures; the parameters in the part file
    "washer": (
        "#load=800&speed=545&tilt=0.002&oil_temperature=297.15&branch=contact&roughness=4e-7"
        "&conduction=all&oil_cooling=false",
        ("friction_torque", "temperature", "film_ratio"),
        {"roughness": 4e-7, "conduction": "all", "oil_cooling": False},
    ),
    "gearmesh": (
        "#power=20000&speed=200&oil_temperature=350&fidelity=field&pinion_teeth=23",
        ("friction_torque", "scuffing_safety", "surface_temperature"),
        {"pinion_teeth": 23},
    ),
    "losses": (
        "#input_speed=300&output_speed=120&tooth_force=1500&oil_temperature=350&planets=3",
        ("input_torque", "oil_heat", "churning_power"),
        {"planets": 3},
    ),
    "train": (
        "#torque=-120&speed=400&oil_temperature=330&meshes=1&shaft_2_bearing_1_position=0.01",
        ("loss", "efficiency", "bearing_life", "mesh_1_bulk_temperature"),
        {"meshes": 1, "shaft_2_bearing_1_position": 0.01},
    ),
    "clutch": (
        "#speed=150&oil_temperature=340&drum_speed=20&duration=0.4&fidelity=fine&faces=6"
        "&ramp=[0,3000,6000,6000,6000,6000,6000,6000,6000]",
        (),
        {"faces": 6},
    ),
}


@pytest.mark.parametrize("model", MODELS)
def test_command_lines_and_part_file_reproduce_what_is_seen(opened, model, tmp_path, capsys):
    address, names, changed = VIEWS[model]
    page = opened(model, address)
    command = shlex.split(page.page.text_content("#as-command"))
    assert command[0] == "thrustwasher" and cli.main([*command[1:], "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    space = {"print": lambda *_: None}
    exec(page.page.text_content("#as-python"), space)
    for name in names:
        assert printed[name] == pytest.approx(page.figure(name), rel=1e-8)
        assert getattr(space["result"], name) == pytest.approx(page.figure(name), rel=1e-8)
    if model == "clutch":
        most = max(space["result"].friction_torque, key=abs)
        hottest = {max(printed["temperature"]), space["result"].temperature.max()}
        assert page.figure("friction_torque_max") == pytest.approx(most, rel=1e-9)
        assert len(hottest) == 1 or max(hottest) == pytest.approx(min(hottest), rel=1e-12)
        assert page.figure("temperature_max") == pytest.approx(max(hottest), rel=1e-9)
    file = tmp_path / "mine.toml"
    file.write_text(page.page.text_content("#as-part"), "utf-8")
    part = find_part(str(file))
    assert part.spec.key == model and {n: getattr(part.params, n) for n in changed} == changed
    assert part.params == type(part.params)(**changed)
    assert part.fidelity == page.page.input_value("#fidelity")


def test_the_point_is_dragged_over_the_fold_and_comes_back_on_the_other_branch(opened):
    page = opened()
    page.page.wait_for_selector("#film_lost_load")
    folds = {f.kind: f.load for f in load_curve(WasherParams(), speed=545.0, tilt=2e-3).folds}
    for kind, load in folds.items():
        assert page.figure(f"{kind}_load") == pytest.approx(load, rel=1e-8)
    plot = page.page.locator("svg").first
    plot.scroll_into_view_if_needed()
    box, handle = plot.bounding_box(), plot.locator(".handle").bounding_box()
    y = handle["y"] + handle["height"] / 2
    page.page.mouse.move(handle["x"] + 8, y)
    page.page.mouse.down()
    seen = []
    for share in (0.6, 0.7, 0.9, 0.75, 0.7):
        page.page.mouse.move(box["x"] + 62 + share * (box["width"] - 74), y, steps=8)
        branch = page.settled().page.text_content("#branch")
        seen.append((float(page.page.input_value("#in-load")), branch))
    page.page.mouse.up()
    assert page.settled().page.get_attribute("#state", "class") != "problem"
    assert all(b == "contact" for load, b in seen if load > folds["film_lost"] * 1.02)
    assert all(b == "film" for load, b in seen[:2] if load < folds["film_lost"])
    between = [b for load, b in seen[3:] if folds["film_regained"] < load < folds["film_lost"]]
    assert between and set(between) == {"contact"}, seen
    assert "branch=contact" in page.page.url


@pytest.mark.parametrize("bad", ["300000", "", "1e999", "NaN", "<b>"])
def test_a_bad_value_is_marked_with_its_range_and_the_last_good_result_stays(opened, bad):
    page = opened()
    before = page.figure("friction_torque")
    page.put("load", bad)
    assert page.page.get_attribute("#in-load", "aria-invalid") == "true"
    assert page.page.text_content("#in-load-error").endswith("allowed: 1 .. 200000 N")
    assert page.figure("friction_torque") == before
    page.put("load", 310)
    assert page.page.get_attribute("#in-load", "aria-invalid") == "false"
    assert page.figure("friction_torque") != before


def test_parameters_that_contradict_each_other_are_told(opened):
    page = opened()
    before = page.figure("friction_torque")
    page.page.click("text=All other parameters")
    page.put("gear_inner_radius", 0.03)
    said = page.page.text_content("#state")
    assert said.startswith("gear_inner_radius = 0.03 m, allowed: between inner_radius 0.0111")
    assert page.figure("friction_torque") == before
    page.put("gear_inner_radius", 0.015)
    assert page.figure("friction_torque") != before


def test_a_branch_that_is_not_there_is_told_in_words(opened):
    page = opened(address="#load=300&branch=contact")
    assert "The contact branch has no solution here" in page.page.text_content("#state")


def looks_still(page):
    """Assert that the figures of the start are there, and no empty axes."""
    assert not page.is_visible("#views") and not page.is_visible("#controls")
    figures = page.locator("#figures data").all_text_contents()
    assert len(figures) >= 6 and all(figures)


WITHOUT = {
    "webassembly": {"init": "delete globalThis.WebAssembly"},
    "scripts": {"java_script_enabled": False},
}


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("look", WITHOUT.values(), ids=WITHOUT)
def test_a_browser_without_it_shows_the_values_of_the_start(opened, model, look):
    page = opened(model, ready="", **look).page
    looks_still(page)
    said = page.text_content("#state")
    error = "not verified" if model in ("losses", "train") else "at most"  # without tables
    assert f"Fidelity level {about(model)['level']}; verified error of the torque: {error}" in said
    assert "of the start: " in said
    assert ("has no WebAssembly" in said) is ("init" in look)
    if "init" in look:
        assert page.evaluate("document.documentElement.scrollWidth") <= page.viewport_size["width"]
        assert faults(page) == []


def test_kernels_that_cannot_run_leave_the_still_version(browser, files, tmp_path):
    path = tmp_path / "broken.html"
    text = files("gearmesh").read_text("utf-8")
    path.write_text(re.sub(r'(id="module">)[^<]*', r"\g<1>AGFzbQ==", text), "utf-8")
    page = Seen(browser, path.as_uri(), ready="#state.problem")
    assert page.page.text_content("#state").startswith("This browser cannot run the kernels: ")
    looks_still(page.page)
    page.close()


def test_the_washers_four_discs_have_colours_scales_and_units(opened):
    page = opened(address="#load=700&branch=contact").settled().page
    for disc, unit in zip(page.locator(".disc").all(), ("m", "Pa", "Pa", "°C"), strict=True):
        ends = disc.locator(".ends span").all_text_contents()
        assert ends[0] != ends[1] and ends[1].endswith(unit)
        label = disc.locator("[role=img]").get_attribute("aria-label")
        assert label.endswith(f"from {ends[0]} to {ends[1]}")
        for canvas in disc.locator("canvas").all():
            colours = canvas.evaluate(
                """(one) => new Set(new Uint32Array(one.getContext("2d")
                .getImageData(0, 0, one.width, one.height).data.buffer)).size"""
            )
            assert colours > 50


@pytest.mark.parametrize("level", ["field", "fine"])
def test_the_clutch_says_the_error_of_its_cards_engagement(opened, level):
    at = {"load": 4000.0, "speed": 200.0, "oil_temperature": 330.0}
    ramp = "[0,1000,4000,4000,4000,4000,4000,4000,4000]"
    address = f"#speed=200&oil_temperature=330&fidelity={level}&ramp={ramp}"
    box = {name: (value, value) for name, value in at.items()}
    known = fresh_levels("clutch", ClutchParams())[level]
    error = 100 * SAFETY * known.worst("friction_torque", box, "engagement")
    said = opened("clutch", address).page.text_content("#state")
    assert f"(load up in {RISE} s, slip down from {HELD} to {TIMES[-1]} s, drum at rest" in said
    assert float(re.search(r"at most ([\d.]+) %$", said)[1]) == pytest.approx(error, rel=0.06)
    outside = opened("clutch", "#speed=550").page.text_content("#state")
    words = "no error is verified at this point; outside the verified range: speed 550 rad/s ("
    assert words in outside


ADDRESSES = [
    ("#load=abc", "The address: load = abc: a number is required, in N or kN or MN or "),
    ("#load=1e9", "The address: load = 1e9 N, allowed: 1 .. 200000 N. "),
    ("#load=300&load=-1", "The address: load = -1 N, allowed"),
    ("#weight=3", "The address: weight is nothing that this page knows. "),
    ("#__proto__=3&constructor=1", "The address: __proto__ is nothing that this page knows; cons"),
    ("#fidelity=constructor", "The address: fidelity = constructor, allowed: field or fine. "),
    ("#branch=<script>window.hit=1</script>", "The address: branch = <script>window.hit=1</scri"),
    ("#load=%E0%A4%A", "The address: load = %E0%A4%A: a number is required"),
    ("#<img src=x onerror=window.hit=1>", "The address: %3Cimg%20src is nothing that this page"),
    ("#conduction=toString", "The address: conduction = toString, allowed: "),
    ("#oil_cooling=perhaps", "The address: oil_cooling = perhaps, allowed: true or false. "),
    ("#&&=&=3&", "The address:  is nothing that this page knows. "),
]


@pytest.mark.parametrize(("address", "words"), ADDRESSES, ids=[a for a, _ in ADDRESSES])
def test_an_address_that_cannot_be_taken_is_told_and_harmless(opened, address, words):
    page = opened(address=address, ready="#state.problem")
    assert page.page.text_content("#state").startswith(words)
    assert page.page.evaluate("window.hit") is None and page.page.locator("img[src=x]").count() == 0
    wanted = solve_washer(WasherParams(), **POINT)
    assert page.figure("friction_torque") == pytest.approx(wanted.friction_torque, rel=SAME)
    if address.startswith("#load") and "load=300&" not in address:
        assert page.page.get_attribute("#in-load", "aria-invalid") == "true"
    page.put("load", 300)  # and the page goes on
    assert page.page.get_attribute("#in-load", "aria-invalid") == "false"


def test_a_point_without_a_solution_is_told_and_the_last_result_stays(opened):
    page = opened("gearmesh")
    before = page.figure("friction_torque")
    page.put("speed", 0)
    said = page.page.text_content("#state")
    words = "speed = 0 rad/s, allowed: from 0.00075 rad/s on for power = 7500 W; the figures"
    assert said.startswith(f"{words} are those of power 7.5 kW, speed 180 rad/s")
    assert page.figure("friction_torque") == before and page.page.is_visible("#views")
    page.put("speed", 200)
    assert page.figure("friction_torque") != before
    assert "verified error" in page.page.text_content("#state")


def test_a_ramp_is_drawn_and_the_engagement_follows(opened):
    page = opened("clutch")
    before = page.figure("energy")
    command = page.page.text_content("#as-command")
    assert command.startswith("thrustwasher engage --load 5000 --ramp 0.125 --duration 0.5")
    handle = page.page.locator("svg .handle").nth(8)
    handle.focus()
    for _ in range(5):
        page.page.keyboard.press("ArrowDown")
    page.settled()
    assert "ramp=" in page.page.url
    assert page.page.text_content("#as-command").startswith("The command knows straight ramps")
    space = {"print": lambda *_: None}
    exec(page.page.text_content("#as-python"), space)
    most = max(space["result"].friction_torque, key=abs)
    assert page.figure("friction_torque_max") == pytest.approx(most, rel=1e-9)
    assert before != page.figure("energy")


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_nothing_bars_access_nothing_is_too_wide_and_all_fields_have_names(opened, model, look):
    page = opened(model, **look).page
    page.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    assert page.evaluate("document.documentElement.scrollWidth") <= page.viewport_size["width"]
    for field in page.locator("input, select, button").all():
        name = field.get_attribute("id")
        label = page.locator(f"label[for='{name}']").count()
        assert field.get_attribute("aria-label") or label or field.text_content(), name
    assert faults(page) == []


def test_a_wrong_ramp_is_told_and_back_to_the_start_takes_everything_back(opened):
    said = opened("clutch", "#ramp=[1,2").page.text_content("#state")
    assert said.startswith("The address: ramp, allowed: 9 loads in brackets, numbers 0 .. ")
    page = opened("clutch", "#speed=50&duration=1&faces=6&ramp=[0,1,2,3,4,5,6,7,8]")
    assert page.page.input_value("#in-faces") == "6" and "ramp=%5B0%2C1" in page.page.url
    page.page.click("#reset")
    page.settled()
    assert page.page.input_value("#in-faces") == "4" and page.page.input_value("#in-speed") == "100"
    assert "ramp=%5B0%2C2500" in page.page.url


def test_bars_of_a_train_follow_its_sliders_and_limits_are_told(opened):
    page = opened("train", "#torque=150&speed=500&oil_temperature=353.15")
    assert "below 1" not in page.page.text_content("#state")
    page.page.locator("#in-torque-slider").fill("0")  # -400 N m
    page.settled()
    wanted = solve_train(TrainParams(), torque=-400.0, speed=500.0)
    assert page.page.text_content("#flow") == wanted.flow == "output to input"
    drawn = page.page.locator("svg.bars rect").all()
    width = {r.get_attribute("data-source"): float(r.get_attribute("width")) for r in drawn}
    loss = {"mesh 1": wanted.mesh_1_loss, "mesh 2": wanted.mesh_2_loss, "seals": wanted.seal_loss}
    loss["churning gears"] = wanted.churning_loss
    for i in (1, 2, 3):
        ends = [getattr(wanted, f"shaft_{i}_bearing_{k}_loss") for k in (1, 2)]
        loss[f"bearings of shaft {i}"] = sum(ends)
    assert sum(loss.values()) == pytest.approx(wanted.loss)
    longest = max(width.values())
    for source, value in loss.items():
        assert width[source] / longest == pytest.approx(value / max(loss.values()), rel=1e-6)
    assert page.page.locator("#bearings tbody tr").count() == 6
    page.put("torque", 450)
    safety = solve_train(TrainParams(), torque=450.0, speed=500.0).pitting_safety
    assert f"pitting_safety {safety:.4g}, below 1; " in page.page.text_content("#state")
