"""The band that the scatter of inputs leaves, in Chromium: as in Python, cancelled, told."""

from functools import cache

import numpy as np
import pytest
from browser_pages import faults

from thrustwasher import engage_clutch, solve_gearmesh, solve_train, solve_washer
from thrustwasher.model.part_file import find_part
from thrustwasher.studio.explore.draws import DRAWS, fixed_points
from thrustwasher.studio.explore.page import page as page_of

pytestmark = pytest.mark.browser
START = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}
DONE, SAME = "html[data-scattered]", 1e-6
LOOKS = {
    "light": {},
    "dark": {"color_scheme": "dark"},
    "narrow": {"viewport": {"width": 390, "height": 800}},
}


@cache
def solved(at, speed=START["speed"]):
    """Return torque and branch of all draws at one load [N]."""
    washer, point = find_part("washer"), START | {"speed": speed}
    known = washer.scattered(inputs=point)
    found = []
    for row in known.values(fixed_points(len(known.sources))):
        params, drawn = washer.varied(row)
        load = at * drawn["load"] / point["load"]
        got = solve_washer(params, **{**point, **drawn, "load": load})
        found.append((got.friction_torque, got.branch == "contact"))
    return np.array(found)


def table(page, way="up"):
    """Return the rows of the band in numbers: load, 5, 50, 95 %, share of draws without a film."""
    rows = page.page.locator(f"#scatter-numbers tr[data-way={way}]").all()
    cells = [[d.get_attribute("value") for d in row.locator("data").all()] for row in rows]
    return np.array(cells, float)


def said(page):
    return page.page.text_content("#scatter-state")


def banded(page):
    page.page.wait_for_selector(DONE, state="attached")
    return page


@pytest.fixture
def own(opened, tmp_path):
    """Open the page of a washer with this scatter."""

    def open_(lines, address=""):
        file, path = tmp_path / "mine.toml", tmp_path / "mine.html"
        file.write_text(f'model = "washer"\nname = "Mine"\n[scatter]\n{lines}\n')
        path.write_text(page_of(find_part(str(file))), "utf-8")
        return opened(path, address)

    return open_


def test_median_and_band_are_those_of_the_same_draws_in_python(opened):
    page = opened()
    assert page.page.locator(".band").count() == 0
    page.page.check("#scatter")
    assert banded(page).page.locator(".band.scatter-one").count() == 1
    rows = table(page)
    assert len(rows) == 24 and f"{DRAWS} draws in " in said(page)
    for i in (6, 17):
        wanted = solved(rows[i, 0])
        quantiles = np.quantile(np.abs(wanted[:, 0]), [0.05, 0.5, 0.95])
        assert rows[i, 1:4] == pytest.approx(quantiles, rel=SAME)
        assert rows[i, 4] == wanted[:, 1].mean()
    assert 0.0 < rows[17, 4] < 1.0


def test_load_down_the_film_is_lost_at_lower_loads(opened):
    page = banded(opened(address="#scatter=true"))
    up, down = table(page), table(page, "down")
    same = up[np.isin(up[:, 0], down[:, 0])]
    assert len(down) >= 5 and np.all(down[:, 4] >= same[:, 4])
    assert np.any(down[:, 4] > same[:, 4] + 0.2)
    assert page.page.locator(".share").count() == 2


def test_a_new_point_takes_the_band_away_and_makes_its_own(opened):
    page = opened()
    page.page.check("#scatter")
    page.page.wait_for_selector(".band")
    page.page.fill("#in-speed", "800")
    assert page.page.get_attribute("html", "data-scattered") is None
    assert page.page.locator(".band:not(.stale)").count() == 0
    rows = table(banded(page.settled()))
    wanted = solved(rows[6, 0], speed=800.0)
    assert rows[6, 2] == pytest.approx(np.median(wanted[:, 0]), rel=SAME)


def test_another_load_keeps_the_band_and_tells_what_it_is_there(opened):
    page = banded(opened(address="#scatter=true"))
    before = table(page)
    page.put("load", 500)
    assert page.page.get_attribute("html", "data-scattered") is not None
    assert page.page.locator(".band.stale").count() == 0
    assert np.array_equal(table(page), before)
    assert said(page).startswith("At 500 N, load up: ")


def test_the_switch_is_a_key_away_and_stands_in_the_address(opened):
    page = opened()
    page.page.focus("#scatter")
    page.page.keyboard.press("Space")
    assert banded(page).page.url.endswith("&scatter=true")
    page.page.keyboard.press("Space")
    page.page.wait_for_url(lambda url: "scatter" not in url)  # written a moment later
    assert said(page) == ""
    assert page.page.locator(".band").count() == 0
    assert not page.page.is_visible("#scatter-numbers")


def test_what_scatters_is_listed_with_law_and_source(opened):
    page = opened().page
    page.click("text=inputs with a scatter")
    known = find_part("washer").scattered().sources
    for row, source in zip(page.locator(".scatter tbody tr").all(), known, strict=True):
        words = [source.place.name, source.law.words(), source.reason]
        assert row.locator("th, td").all_text_contents() == words
    told = page.text_content(".scatter details p")
    assert "the error of the mesh is another one" in told


def test_draws_that_the_rules_refuse_are_counted_and_told(own):
    page = own('gear_inner_radius = "20 %"')
    page.page.check("#scatter")
    words = said(banded(page))
    assert f" of {DRAWS} draws failed and do not count: gear_inner_radius = " in words
    assert len(table(page)) == 24


def test_a_part_without_scatter_says_so(own):
    page = own("", "#scatter=true")
    assert page.page.is_disabled("#scatter") and not page.page.is_checked("#scatter")
    assert "This part has no [scatter]" in page.page.text_content(".scatter")
    assert "scatter = true, allowed: false" in page.page.text_content("#state")


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_the_band_bars_no_access_and_is_not_too_wide(opened, look):
    page = banded(opened(address="#scatter=true", **look)).page
    assert faults(page) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= page.viewport_size["width"]
    assert page.get_by_role("switch", name="scatter").is_checked()


def gearmesh_draws():
    """Return the hottest flank and the safety against scuffing of all draws at the start."""
    gears, power, speed = find_part("gearmesh"), 7500.0, 180.0
    known = gears.scattered(inputs={"load": power / speed, "oil_temperature": 299.85})
    for row in known.values(fixed_points(len(known.sources))):
        params, drawn = gears.varied(row)
        oil = drawn["oil_temperature"]
        got = solve_gearmesh(params, power=drawn["load"] * speed, speed=speed, oil_temperature=oil)
        yield got.surface_temperature, got.scuffing_safety


def clutch_draws():
    """Return the largest torque and the highest temperature of all draws of the start."""
    clutch, time = find_part("clutch"), np.linspace(0.0, 0.5, 249)
    known = clutch.scattered(inputs={"load": 5000.0, "oil_temperature": 353.15, "speed": 100.0})
    for row in known.values(fixed_points(len(known.sources))):
        params, drawn = clutch.varied(row)
        got = engage_clutch(
            params,
            time=time,
            load=drawn["load"] * np.minimum(time / 0.125, 1.0),
            speed=100.0 * (1.0 - time / 0.5),
            oil_temperature=drawn["oil_temperature"],
        )
        yield abs(got.friction_torque).max(), got.temperature.max()


def train_draws():
    """Return loss and efficiency of all draws of the start."""
    train, point = find_part("train"), {"torque": 150.0, "speed": 300.0, "oil_temperature": 353.15}
    known = train.scattered(inputs=point)
    for row in known.values(fixed_points(len(known.sources))):
        params, drawn = train.varied(row)
        got = solve_train(params, **{**point, **drawn})
        yield got.loss, got.efficiency


OTHERS = {
    "train": (train_draws, ("loss", "efficiency")),
    "gearmesh": (gearmesh_draws, ("surface_temperature", "scuffing_safety")),
    "clutch": (clutch_draws, ("friction_torque_max", "temperature_max")),
}


@pytest.mark.parametrize("model", OTHERS)
def test_the_other_pages_have_bands_over_the_same_draws_as_python(opened, model):
    draws, names = OTHERS[model]
    page = opened(model)
    page.page.check("#scatter")
    assert banded(page).page.locator(".band").count() == (1 if model == "train" else 2)
    found = page.page.evaluate(
        "(names) => page.VIEW.scatter.sound.map((r) => names.map((name) => r.outputs[name]))", names
    )
    np.testing.assert_allclose(found, list(draws()), rtol=SAME)
    assert said(page).startswith("5 to 95 % of the draws: ")
