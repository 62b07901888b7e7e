"""The page of a scene in Chromium: profiles dragged, the address, the saved file, access."""

import re

import pytest
from browser_pages import Seen, faults
from scene_pages import html, nominal, python_figures

from thrustwasher.shift import load_scene
from thrustwasher.studio.explore.scene_data import started
from thrustwasher.studio.explore.scene_page import scene_page

pytestmark = pytest.mark.browser
LOOKS = {
    "light": {},
    "dark": {"color_scheme": "dark"},
    "narrow": {"viewport": {"width": 390, "height": 800}},
}
KISS = "clutch_pressure=0.1:0,0.11:60000,0.2:60000,0.4:320000,0.79:341000,0.865:346000,0.935:720000"
RUN = "html[data-run]"


@pytest.fixture
def opened(browser, tmp_path):
    made = []

    def open_(name="planetary", address="", ready=RUN, **look):
        path = tmp_path / f"{name}.html"
        path.write_text(html(name), "utf-8")
        made.append(Seen(browser, f"{path.as_uri()}{address}", ready=ready, **look))
        return made[-1].page

    yield open_
    for page in made:
        page.close()


def figure(page, name):
    return float(page.get_attribute(f"#{name}", "value"))


def on_own_level(page):
    """Wait until the washers are solved on their own level."""
    page.wait_for_function("() => document.querySelector('#washer_level').value === 'field'")
    return page


def test_it_opens_with_the_figures_of_python_on_the_washers_own_level(opened):
    page = on_own_level(opened())
    for name, value in started(nominal("planetary")).items():
        assert figure(page, name) == pytest.approx(value, rel=1e-9, abs=1e-9)
    assert figure(page, "run_count") >= 2


def test_a_point_is_dragged_and_the_figures_follow(opened):
    page = opened()
    before, runs = figure(page, "lock_time"), figure(page, "run_count")
    box = page.locator(".handle").nth(2).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(10):
        page.mouse.move(x + k, y - 3 * k)
    page.mouse.up()
    page.wait_for_function(f"() => Number(document.querySelector('#run_count').value) > {runs}")
    page.wait_for_function("() => location.hash.startsWith('#clutch_pressure=')")
    assert figure(page, "lock_time") != before
    lock = nominal("planetary").figures["lock_time"]
    assert page.text_content("#a-lock_time").startswith(f"A {1e3 * lock:.1f} ms")
    page.click("#reset")
    page.wait_for_function("() => location.hash === ''")
    on_own_level(page)
    assert figure(page, "lock_time") == pytest.approx(lock, abs=1e-8)


def test_a_point_moves_by_keys(opened):
    page = opened()
    page.locator(".handle").nth(1).press("ArrowUp")
    page.wait_for_function("() => location.hash.startsWith('#clutch_pressure=')")
    assert page.evaluate("document.activeElement.getAttribute('class')").startswith("handle")


def test_the_saved_scene_gives_the_lock_up_of_the_page(opened, tmp_path):
    page = on_own_level(opened(address=f"#{KISS}"))
    with page.expect_download() as download:
        page.click("#save")
    path = tmp_path / "tuned.toml"
    download.value.save_as(path)
    wanted = python_figures(path, [])
    for name in ("lock_time", "slip_energy", "peak_jerk"):
        assert figure(page, name) == pytest.approx(wanted[name], rel=1e-9)
    assert path.read_text("utf-8").splitlines()[1] == 'base = "planetary"'


def test_a_scene_of_ones_own_is_saved_whole(browser, tmp_path):
    path, page = tmp_path / "own.toml", tmp_path / "page.html"
    lines = ['base = "planetary"', 'oil_temperature = "60 degC"', "[pressure.clutch]"]
    path.write_text("\n".join([*lines, "scale = 1.05", "[sump]", ""]), "utf-8")
    page.write_text(scene_page(load_scene(str(path))), "utf-8")
    seen = Seen(browser, page.as_uri(), ready=RUN)
    seen.page.click("#save")
    assert "shift --scene own-tuned.toml" in seen.page.text_content("#as-command")
    saved = tmp_path / "tuned.toml"
    saved.write_text(seen.page.text_content("#as-scene"), "utf-8")
    seen.close()
    one, other = load_scene(str(path)), load_scene(str(saved))
    assert {n: p.params for n, p in other.parts.items()} == {
        n: p.params for n, p in one.parts.items()
    }


def test_a_is_pinned_and_comes_back_with_the_address(opened):
    page = opened(address=f"#{KISS}")
    lock = figure(page, "lock_time")
    page.click("#pin")
    page.wait_for_function("() => location.hash.includes('a.clutch_pressure')")
    page.click("#reset")
    page.wait_for_function("() => !location.hash.startsWith('#clutch_pressure')")
    address = page.evaluate("location.hash")
    again = opened(address=address)
    again.wait_for_function("() => document.querySelector('#a-lock_time').textContent !== ''")
    assert again.text_content("#a-lock_time").startswith(f"A {1e3 * lock:.1f} ms")


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("#clutch_pressure=abc", "clutch_pressure = abc, allowed: pairs time:value"),
        ("#clutch_pressure=0.2:0,0.1:5", "time of point 2 = 0.1 s, allowed: after point 1"),
        ("#engine_torque=0:1e9", "point 1 = 1000000000 N.m, allowed"),
        ("#brake_pressure=0:-5", "point 1 = -5 Pa, allowed"),
        ("#brake_pressure=" + ",".join(f"{k}:1" for k in range(11)), "11 points, allowed: 1 .. 10"),
        ("#nonsense=1", "nonsense is nothing that this page knows"),
        ("#%E0%A4%A", "is nothing that this page knows"),
        ("#units=furlongs", "units = furlongs, allowed: mixed, si, workshop"),
        ("#scatter=maybe", "scatter = maybe, allowed: true or false"),
        ("#clutch_pressure=<img src=x onerror=alert(1)>", "allowed: pairs time:value"),
    ],
)
def test_what_the_address_cannot_say_is_told_and_the_rest_stays(opened, address, words):
    page = opened(address=address)
    assert words in page.text_content("#state")
    lock = nominal("planetary").figures["lock_time"]
    assert figure(page, "lock_time") == pytest.approx(lock, abs=1e-5)


def test_profiles_without_a_shift_run_or_say_why(opened):
    page = opened(address="#clutch_pressure=0:0&engine_torque=0:90000")
    text = page.text_content("#state")
    assert page.get_attribute("#state", "class") == "problem"
    assert re.search(r"No run with these profiles: \w+ at t = ", text)


def test_fields_take_numbers_with_units_and_refuse_others(opened):
    page = opened()
    page.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    page.fill("#clutch_pressure-2-value", "0.6 bar")
    page.press("#clutch_pressure-2-value", "Tab")
    page.wait_for_function("() => location.hash.includes('0.11:60000')")
    page.fill("#clutch_pressure-2-value", "much")
    page.press("#clutch_pressure-2-value", "Tab")
    assert "clutch_pressure = much: a number is required" in page.text_content(
        "#error-clutch_pressure"
    )


def test_a_band_of_the_draws_is_shown_on_demand(opened):
    page = opened()
    page.check("#scatter")
    page.wait_for_selector("#scatter-state[data-done]", timeout=60_000)
    assert "5 to 95 % of 32 draws" in page.text_content("#scatter-state")
    assert page.locator(".band").count() == 2
    assert page.evaluate("location.hash") == "#scatter=true"


def test_units_are_switched_and_kept_with_the_profiles(opened):
    page = opened(address=f"#{KISS}")
    with page.expect_navigation():
        page.select_option("#units", "workshop")
    page.wait_for_selector(RUN)
    assert page.evaluate("location.hash") == f"#{KISS}&units=workshop"
    assert "[rpm]" in page.locator("#views svg").first.text_content()
    assert "[bar]" in page.locator("#editor svg").first.text_content()


def test_a_command_scene_has_its_ramp(opened):
    page = opened("msl", address="#shift_command=2:0,2.2:1")
    assert "shift.duration" not in page.text_content("#state")
    assert figure(page, "lock_time") > started(nominal("msl"))["lock_time"]
    assert "duration = 0.2" in page.text_content("#as-scene")


@pytest.mark.parametrize("look", LOOKS)
def test_everyone_can_use_it_and_nothing_scrolls_sideways(opened, look):
    page = on_own_level(opened(**LOOKS[look]))
    assert faults(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_every_plot_has_at_least_three_ticks(opened):
    page = on_own_level(opened())
    ticks = page.evaluate(
        """() => [...document.querySelectorAll('#layout svg')].map((svg) =>
          [...svg.querySelectorAll('text.tick')].filter((t) =>
            t.getAttribute('text-anchor') === 'end').length)"""
    )
    assert len(ticks) >= 7 and min(ticks) >= 3


def test_results_stay_in_view_on_a_narrow_screen(opened):
    page = opened(**LOOKS["narrow"])
    page.locator("#engine_torque-1-value").evaluate("(field) => field.scrollIntoView()")
    page.evaluate("scrollTo(0, 900)")
    box = page.locator("#lock_time").bounding_box()
    assert 0 <= box["y"] < 200


def test_without_webassembly_the_start_is_shown(browser, tmp_path):
    path = tmp_path / "page.html"
    path.write_text(scene_page(load_scene("msl")), "utf-8")
    seen = Seen(browser, path.as_uri(), init="delete window.WebAssembly")
    assert "has no WebAssembly" in seen.page.text_content("#state")
    assert figure(seen.page, "lock_time") > 2.0
    seen.close()


TIE_UP = "0.1:0,0.11:40000,0.2:40000,0.422:561000,0.79:341000,0.865:346000,0.935:720000"


def test_the_warnings_are_those_of_the_run_that_is_displayed(opened):
    page = on_own_level(opened(address=f"#clutch_pressure={TIE_UP}"))
    head = page.text_content("#warnings-head")
    assert head == "Warnings of this run: 1"
    assert page.text_content("#warnings li").startswith("Tie-up: from ")
    assert "Checked only by thrustwasher shift: the error" in page.text_content("#warnings")
    page.click("#reset")
    page.wait_for_function(
        "() => document.querySelector('#warnings-head').textContent.endsWith(': none')"
    )
    assert page.locator("#warnings li").count() == 0


def test_a_run_that_fails_has_the_warnings_of_no_other(opened):
    address = "#clutch_pressure=0:0&brake_pressure=0:0"
    page = opened(address=address)
    assert "no pack held" in page.text_content("#state")
    assert "look at the pressures of both packs" in page.text_content("#state")
    assert page.locator("#warnings li").count() == 0
