"""The report of a shift in a browser: one cursor, one zoom, every signal, nothing from outside."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shift_stand_in
from browser_pages import faults, opened
from scatter_stand_in import study

from thrustwasher import WasherParams, solve_washer
from thrustwasher.shift.account.worst_moments import Moment, level_with_fields
from thrustwasher.studio.report.html import render
from thrustwasher.studio.report.shift import sequence_report, shift_report
from thrustwasher.studio.report.shift.shift_data import FIELDS

pytestmark = pytest.mark.browser
RECORD = shift_stand_in.record(mesh=True)
POINT = {"load": 300.0, "speed": 953.0, "tilt": 2e-3, "oil_temperature": 297.15}
POINT["far_face_temperature"] = 0.0
SHOWN = "document.querySelectorAll('.panel:not(.more)')"
SCALES = "() => page.state.panels.filter((p) => p.visible && p.plot).map((p) => p.plot.scales.x)"


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    def solve(record, time):
        return Moment(time, POINT, solve_washer(WasherParams(), **POINT), 1.5)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(shift_report, "solve_moment", solve)
        page = shift_report.shift_page(RECORD)
    path = tmp_path_factory.mktemp("page") / "report.html"
    path.write_text(render(page), "utf-8")
    return path


@pytest.fixture
def page(browser, report):
    with opened(browser, report) as found:
        to_plots(found)
        yield found


def to_plots(page):
    page.evaluate("() => document.getElementById('plots').scrollIntoView()")
    page.wait_for_selector(".u-over")


def settle(page):
    """Wait until what was requested is painted."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 30)))")


def value_of(page, signal):
    """Return what stands next to a signal, as a number."""
    cell = page.locator(f'th[title="{signal}"] + td').first
    return float(cell.text_content().replace("\N{MINUS SIGN}", "-"))


def test_the_cursor_is_the_same_in_all_plots_and_tells_the_values_there(page):
    plot = page.locator(".u-over").first
    plot.hover(position={"x": 200, "y": 60})
    settle(page)
    index = page.evaluate("page.state.index")
    assert 0 < index < 2500
    lines = page.evaluate(
        "() => page.state.panels.filter((p) => p.visible).map((p) => p.plot.cursor.left)"
    )
    assert len(lines) >= 2 and np.ptp(lines) < 1.0
    for name in ("transmission.engine_speed", "transmission.clutch_reaction"):
        assert value_of(page, name) == pytest.approx(RECORD.signals[name][index], rel=1e-4)
    assert page.locator("#now").text_content().startswith(f"{RECORD.time[index]:g} s, ")


def test_a_study_shades_its_bands_and_they_go_with_their_signal(browser, tmp_path, monkeypatch):
    monkeypatch.setattr(shift_report, "solve_moment", lambda record, time: None)
    path = tmp_path / "report.html"
    studied = shift_report.shift_page(replace(RECORD, scatter=study()))
    path.write_text(render(studied), "utf-8")
    with opened(browser, path) as page:
        to_plots(page)
        own = "page.state.panels.find((p) => p.given.title === 'Torques').plot"
        page.wait_for_function(f"() => {own}")
        high, low = page.evaluate(f"() => {own}.bands[0].series")
        top = page.evaluate(f"() => {own}.data[{high}].at(-1)")
        assert (top, page.evaluate(f"() => {own}.data[{low}].at(-1)")) == (240.0, 160.0)
        page.locator('th[title="clutch.torque_capacity"] input').uncheck()
        assert page.evaluate(f"() => {own}.series[{high}].show") is False
        assert faults(page) == []


def test_a_zoom_in_one_plot_zooms_all(page):
    plot = page.locator(".u-over").nth(1)
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"], steps=5)
    page.mouse.up()
    settle(page)
    scales = page.evaluate(SCALES)
    assert len(scales) >= 2
    for scale in scales:
        assert [scale["min"], scale["max"]] == pytest.approx([0.625, 1.25], abs=0.01)
    time, drawn = page.evaluate(
        """() => [page.state.time[page.state.index],
          page.state.panels.filter((p) => p.visible && p.plot)
            .map(({ plot }) => plot.posToVal(plot.cursor.left, "x"))]"""
    )
    assert drawn == pytest.approx([time] * len(drawn), abs=2e-3)
    plot.dblclick(position={"x": 10, "y": 80})
    settle(page)
    assert {(s["min"], s["max"]) for s in page.evaluate(SCALES)} == {(0.0, 2.5)}


def test_signals_are_switched_on_and_off(page):
    drawn = (
        "() => page.state.panels[0].plot.series.slice(1).filter((s) => s.show).map((s) => s.label)"
    )
    page.wait_for_function("() => page.state.panels[0].plot")
    assert "transmission.engine_speed" in page.evaluate(drawn)
    page.get_by_label("speed of engine and driven gear").first.uncheck()
    assert "transmission.engine_speed" not in page.evaluate(drawn)
    page.locator(".panel summary").first.click()
    page.get_by_label("clutch: slip speed").first.check()
    assert "clutch.speed" in page.evaluate(drawn)


def test_every_signal_of_the_run_has_its_value_at_the_cursor(page):
    page.evaluate("() => document.querySelectorAll('.panel details').forEach((d) => d.open = true)")
    settle(page)
    page.evaluate("page.moveTo(900)")
    page.evaluate("() => dispatchEvent(new Event('beforeprint'))")  # those out of sight as well
    rows = page.locator(".panel th[title]").evaluate_all("(all) => all.map((one) => one.title)")
    assert sorted(rows) == sorted(RECORD.signals)
    assert value_of(page, "clutch.temperature") == pytest.approx(
        RECORD.signals["clutch.temperature"][900] - 273.15, rel=1e-4
    )


def test_events_and_phases_are_buttons(page):
    page.get_by_role("button", name="2 0.25 s brake lets go of the ring").click()
    settle(page)
    assert page.evaluate("page.state.time[page.state.index]") == pytest.approx(0.25, abs=1e-6)
    assert page.locator('[aria-current="true"]').count() == 1
    page.get_by_role("button", name="torque phase").click()
    settle(page)
    view = page.evaluate("page.state.view")
    assert (view["min"], view["max"]) == pytest.approx((0.1, 0.25))
    line = page.evaluate("page.state.panels[0].plot.valToPos(0.25, 'x')")
    page.get_by_role("button", name="show all").click()
    settle(page)
    line = page.evaluate("page.state.panels[0].plot.valToPos(1.75, 'x')")
    page.locator(".u-over").first.click(position={"x": line + 3, "y": 90})
    settle(page)
    assert page.evaluate("page.state.time[page.state.index]") == pytest.approx(1.75, abs=1e-6)


def test_all_of_it_works_from_the_keyboard(page):
    page.locator("#time").focus()
    for key in ("ArrowRight", "ArrowRight", "+"):
        page.keyboard.press(key)
    settle(page)
    view = page.evaluate("page.state.view")
    assert page.evaluate("page.state.index") == 2
    assert view["max"] - view["min"] == pytest.approx(1.25)
    assert page.locator("#time").get_attribute("aria-valuetext") == "0.002 s, first gear"
    page.keyboard.press("0")
    settle(page)
    assert page.evaluate("page.state.view") == {"min": 0, "max": 2.5}


def test_every_plot_has_three_ticks_a_time_axis_and_room(page):
    page.evaluate("() => document.querySelectorAll('.panel').forEach((p) => p.scrollIntoView())")
    page.wait_for_timeout(1500)
    found = page.evaluate(
        """() => page.state.panels.filter(({plot}) => plot).map(({given, plot}) => ({
          title: given.title, time: plot.axes[0].label, high: plot.over.clientHeight,
          ticks: plot.axes[1]._values.filter((text) => text !== null && text !== "").length}))"""
    )
    assert len(found) > 5
    for one in found:
        assert one["ticks"] >= 3, one
        assert one["time"] == "time [s]" and one["high"] >= 110, one


def test_the_flow_picture_fits_a_narrow_page_and_has_its_words_in_a_list(browser, report):
    with opened(browser, report, wide=390) as page:
        to_plots(page)
        page.locator("#flow").scroll_into_view_if_needed()
        box = page.locator("#flow svg:visible").bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= 390
        assert page.locator("#flow svg:visible").count() == 1
        words = page.locator("#flow li").all_text_contents()
        assert any(text.startswith("work of the engine") for text in words)


def test_the_flow_picture_holds_the_energy_balance(page):
    page.evaluate("page.moveTo(2500)")
    settle(page)
    told = page.locator("#flow svg").first.get_attribute("aria-label")
    heat = f"{RECORD.energy['clutch'] / 1e3:.2f} kJ"
    assert told.startswith("Energy: work of the engine") and heat in told


def test_the_cursor_runs_over_the_friction_curve_as_over_all_plots(page):
    curve = page.locator("#slip .u-over")
    curve.scroll_into_view_if_needed()
    wide = curve.bounding_box()["width"]
    curve.hover(position={"x": 0.5 * wide, "y": 50})
    settle(page)
    index = page.evaluate("page.state.index")
    slip = RECORD.signals["clutch.speed"]
    assert slip[index] == pytest.approx(0.5 * slip[0], rel=0.02)


SOLVE = """window.asked = [];
window.solveAt = async (inputs) => {
  window.asked.push(inputs);
  if (inputs.speed < 1) throw new Error("it stands still");
  const angle = Array.from({ length: 8 }, (_, j) => (j * Math.PI) / 4);
  const field = (f) => angle.flatMap((a) => [1, 2].map((r) => f(r, a)));
  const gap = field((r, a) => r + Math.cos(a));
  return { film_ratio: 7.25, radius: [1, 2], angle, film_thickness: gap };
};"""


def test_another_script_solves_the_washer_at_the_cursor(browser, report):
    with opened(browser, report, init=SOLVE) as page:
        page.get_by_role("button", name="at the cursor").click()
        page.evaluate("page.moveTo(700)")
        page.wait_for_selector("text=Solved here at 0.7 s: film ratio 7.25, in the run it was")
        asked = page.evaluate("window.asked.at(-1)")
        for name in ("load", "speed", "tilt", "oil_temperature"):
            assert asked[name] == pytest.approx(RECORD.signals[f"washer.{name}"][700], rel=1e-6)
        assert page.locator("#discs figure").count() == 1
        page.evaluate("page.moveTo(2500)")
        page.wait_for_selector("text=No solution at 2.5 s: it stands still. The last one stays.")
        assert page.locator("#discs figure").count() == 1


def test_the_page_solves_the_washer_as_python_does(page):
    washer = RECORD.part("washer")
    wanted = solve_washer(washer.params(), **POINT, fidelity=level_with_fields(washer))
    got = page.evaluate("(point) => solveAt(point, 5)", POINT)
    assert got["film_ratio"] == pytest.approx(wanted.film_ratio, rel=1e-10)
    for name in FIELDS:
        there = getattr(wanted.fields(), name)
        here = np.reshape(got[name], there.T.shape).T
        np.testing.assert_allclose(here, there, atol=1e-8 * np.abs(there).max())


def test_the_washer_stays_on_the_branch_that_the_run_was_on(page):
    params, point = RECORD.part("washer").params(), POINT | {"load": 225.0}
    found = {b: solve_washer(params, **point, branch=b).film_ratio for b in ("film", "contact")}
    for ratio in found.values():
        got = page.evaluate("([point, ratio]) => solveAt(point, ratio)", [point, ratio])
        assert got["film_ratio"] == pytest.approx(ratio, rel=1e-8)
    assert found["film"] > 1.2 * found["contact"]


def test_the_washers_worst_moment_is_drawn_as_discs(page):
    page.locator("#discs").scroll_into_view_if_needed()
    page.wait_for_selector("#discs canvas")
    assert page.locator("#discs figure").count() == 4
    page.get_by_role("button", name="hottest moment").click()
    ratio = solve_washer(WasherParams(), **POINT).film_ratio
    page.wait_for_selector(f"text=film ratio {ratio:.5g}, in the run it was 1.5.")


def test_without_scripts_there_are_the_tables_and_one_picture(browser, report):
    with opened(browser, report, ready="", java_script_enabled=False) as page:
        assert page.locator("img").count() == 1 and page.locator("img").is_visible()
        page.locator("#key-figures > summary").click()
        assert page.locator("#key-figures td").first.is_visible()
        for chapter in page.locator("details.chapter:not(#key-figures) > summary").all():
            chapter.click()
        for head in page.get_by_role("heading", level=2).all():  # none without a body
            if not head.is_visible():
                continue
            assert (
                head.locator("xpath=ancestor::*[@id][1]")
                .locator("p, table, img, details")
                .first.is_visible()
            )
        assert page.get_by_role("heading", name="Friction of the clutch").count() == 0
        assert not page.locator(".widget").first.is_visible()


def test_on_paper_are_the_plots_and_the_key_figures(page):
    page.emulate_media(media="print", color_scheme="dark")
    page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
    drawn = page.locator(".panel:not(.more) .u-wrap").count()
    assert drawn == page.evaluate(f"() => {SHOWN}.length")
    assert not page.locator(".bar").is_visible()
    assert page.locator("#key-figures td").first.is_visible()
    assert not page.locator("#parameters td").first.is_visible()
    assert (
        page.evaluate("() => getComputedStyle(document.body).backgroundColor")
        == "rgb(255, 255, 255)"
    )


def test_the_first_screen_has_the_picture_and_the_page_is_short(page):
    page.set_viewport_size({"width": 1300, "height": 900})
    chart = page.locator("#hero canvas").first.bounding_box()
    assert chart["y"] + page.evaluate("scrollY") < 350
    assert page.locator(".card").count() == 6
    assert page.evaluate("document.documentElement.scrollHeight") <= 7000


def test_it_prints_on_two_to_four_pages(page, tmp_path):
    pages = re.findall(rb"/Type\s*/Page[^s]", page.pdf(format="A4"))
    assert 2 <= len(pages) <= 4


def test_the_units_are_switched_and_kept_in_the_address(browser, report):
    with opened(browser, report) as page:
        page.wait_for_selector("#hero .u-over")
        settle(page)
        before = value_of(page, "transmission.engine_speed")
        with page.expect_navigation():
            page.select_option("#units", "workshop")
        page.wait_for_selector("#hero .u-over")
        assert page.evaluate("location.hash") == "#units=workshop"
        settle(page)
        rpm = value_of(page, "transmission.engine_speed")
        assert rpm == pytest.approx(before * 30.0 / np.pi, rel=1e-4)
        assert page.locator('.card[data-figure="peak_clutch_temperature"] b').count() <= 1
        with page.expect_navigation():
            page.select_option("#units", "si")
        page.wait_for_selector("#hero .u-over")
        page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
        assert value_of(page, "clutch.temperature") == pytest.approx(
            RECORD.signals["clutch.temperature"][0], rel=1e-4
        )


def test_cursor_zoom_and_signals_are_in_the_address_and_come_back(browser, report):
    with opened(browser, report) as page:
        page.wait_for_function("() => page.state.panels[0].plot")
        page.evaluate("page.zoom(0.5, 1.5); page.moveTo(700)")
        page.get_by_label("speed of engine and driven gear").first.uncheck()
        page.wait_for_function("() => document.documentElement.dataset.state?.includes('off=')")
        address = page.evaluate("location.hash")
    assert address == "#t=0.7&from=0.5&to=1.5&off=transmission.engine_speed"
    with opened(browser, report, address=address) as page:
        settle(page)
        assert page.evaluate("page.state.index") == 700
        assert page.evaluate("page.state.view") == {"min": 0.5, "max": 1.5}
        assert not page.locator('input[data-signal="transmission.engine_speed"]').is_checked()


def test_an_address_without_sense_changes_nothing(browser, report):
    with opened(browser, report, address="#t=abc&from=3&to=1&off=nothing&%E0%A4%A=1") as page:
        settle(page)
        assert page.evaluate("page.state.view") == {"min": 0, "max": 2.5}
        assert page.evaluate("page.state.index") == 0


def test_signals_and_plots_are_taken_along(page):
    with page.expect_download() as download:
        page.get_by_role("button", name="save all signals as CSV").click()
    lines = Path(download.value.path()).read_text("utf-8").splitlines()
    assert lines[0].startswith("time [s],") and len(lines) == 2502
    with page.expect_download() as download:
        page.get_by_role("button", name="save Speeds as SVG").click()
    ET.parse(download.value.path())
    with page.expect_download() as download:
        page.get_by_role("button", name="save Speeds as PNG").click()
    assert Path(download.value.path()).read_bytes().startswith(b"\x89PNG")


def test_a_link_opens_its_folded_chapter(page):
    page.locator('nav a[href="#trust"]').click()
    page.wait_for_selector("#trust p", state="visible")


def test_the_policy_lets_nothing_be_fetched(browser, report):
    context = browser.new_context()
    page = context.new_page()
    page.goto(report.as_uri())
    refused = page.evaluate(
        """() => new Promise((done) => {
          addEventListener("securitypolicyviolation", (e) => done(e.violatedDirective));
          fetch("http://127.0.0.1:9/").catch(() => 0);
        })"""
    )
    context.close()
    assert refused == "connect-src"


@pytest.mark.parametrize(("wide", "scheme"), [(1200, "light"), (1200, "dark"), (360, "light")])
def test_nothing_serious_bars_access_and_nothing_is_wider_than_the_screen(
    browser, report, wide, scheme
):
    with opened(browser, report, wide=wide, scheme=scheme) as page:
        to_plots(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= wide
        text = page.locator("#flow text:visible").last
        text.scroll_into_view_if_needed()
        assert text.bounding_box()["height"] > 9
        assert faults(page) == []


def test_without_webassembly_plots_cursor_and_zoom_stay_and_the_discs_say_why(browser, report):
    with opened(browser, report, init="delete globalThis.WebAssembly") as page:
        to_plots(page)
        page.locator(".u-over").first.hover(position={"x": 200, "y": 60})
        page.get_by_role("button", name="zoom in", exact=True).click()
        settle(page)
        assert page.evaluate("page.state.index") > 0
        assert page.evaluate("page.state.view.max - page.state.view.min") == pytest.approx(1.25)
        assert "has no WebAssembly" in page.locator("#discs").text_content()
        assert page.get_by_role("button", name="at the cursor").count() == 0
        page.locator("#discs").scroll_into_view_if_needed()
        page.wait_for_selector("#discs canvas")  # solved when the report was written
        assert page.locator("#discs figure").count() == 4


@pytest.fixture(scope="module")
def cycle(tmp_path_factory):
    """A report of two shifts."""
    figures = [f._replace(value=11.75) if f.name == "lock_time" else f for f in RECORD.key_figures]
    later = replace(RECORD, time=RECORD.time + 10.0, key_figures=figures)
    time = np.concatenate((RECORD.time, later.time))
    signals = {name: np.concatenate((v, v)) for name, v in RECORD.signals.items()}
    for pack in ("clutch", "brake"):
        signals.setdefault(f"{pack}.temperature", np.full(len(time), 300.0))
    oil = np.linspace(300.0, 310.0, len(time))
    sequence = SimpleNamespace(shifts=[(0.0, "up"), (10.0, "down")])
    scene = SimpleNamespace(sequence=sequence, title="Two shifts")
    result = SimpleNamespace(shifts=[RECORD, later], time=time, signals=signals, scene=scene)
    vars(result).update(
        oil_temperature=oil, messages=[], warnings=(), step_errors={}, wall_time=1.0
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sequence_report, "record_of", lambda record: record)
        page = sequence_report.sequence_page(result)
    path = tmp_path_factory.mktemp("cycle") / "report.html"
    path.write_text(render(page), "utf-8")
    return path


def test_several_shifts_have_one_time_and_each_is_a_button(browser, cycle):
    with opened(browser, cycle) as page:
        to_plots(page)
        event = page.get_by_role("button", name="2 down locks")
        assert not event.is_visible()
        page.get_by_label("shift", exact=True).select_option(index=2)
        settle(page)
        assert event.is_visible()
        assert page.locator(".happened li:visible").count() == 2
        view = page.evaluate("page.state.view")
        assert (view["min"], view["max"]) == pytest.approx((10.0, 12.5))
        assert page.locator("#now").text_content() == "10 s, 2 down"
        assert page.locator("#profile tbody tr").count() > 2
        page.get_by_role("button", name="at the cursor").click()
        page.wait_for_selector("#discs figure", timeout=10_000)
        assert page.locator("#discs figure").count() == 4
        assert faults(page) == []
