"""Pages between and without solutions, quantities with units, what is said of a point."""

import pytest
from pages import MODELS, about

from thrustwasher import GearMeshParams, ParameterError, WasherParams, solve_washer
from thrustwasher.units import UNITS, parse_quantity
from thrustwasher.washer.washer_result import SLIPS

pytestmark = pytest.mark.browser
HERE = {"load": 211.677, "speed": -56.977, "tilt": 0.0025374, "oil_temperature": 300.207}
NOWHERE = {"load": 9192.4, "speed": 242.19, "tilt": 0.00928, "oil_temperature": 287.03}
WIDE = "&outer_radius=0.056&roughness=2.2e-07"  # a washer that is not solved there
NONE = "\N{EN DASH}"
NO_TILT = {"load": 100.0, "speed": 545.0, "tilt": 0.0, "oil_temperature": 297.15}


def address(point):
    return "#" + "&".join(f"{name}={value}" for name, value in point.items())


def said(page):
    return page.page.text_content("#state")


def test_the_error_that_is_shown_is_that_of_the_card_at_each_point(opened):
    page, point = opened(address=address(HERE)), dict(HERE)
    for name, value in {"load": 300.0, "speed": 545.0, "tilt": 2e-3}.items():
        branch = page.page.text_content("#branch")
        wanted = solve_washer(WasherParams(), **point, branch=branch)._by_table()
        assert page.figure("error_estimate") == pytest.approx(wanted, rel=1e-12)
        point[name] = value
        page.put(name, value)
    page.page.click("text=All other parameters")
    page.put("roughness", 4.1e-7)
    assert page.page.get_attribute("#error_estimate", "value") == ""
    assert page.page.text_content("#error_estimate") == "not verified here"
    assert "no error is verified for these parameters" in said(page)


def test_without_a_solution_from_the_start_there_are_no_figures_and_no_views(opened):
    page = opened(address=address(NOWHERE) + WIDE, ready="#state.problem")
    assert said(page).startswith("No solution: not converged") and "no figures yet" in said(page)
    figures = page.page.locator("dl data")
    assert set(figures.all_text_contents()) == {NONE}
    assert {f.get_attribute("value") for f in figures.all()} == {""}
    assert not page.page.locator("#views svg").first.is_visible()
    assert page.page.is_visible("text=Without a solution at these inputs")
    assert page.page.text_content("#as-command").startswith("thrustwasher washer --load 9192.4")
    page.page.click("#reset")
    page.settled()
    assert page.page.locator("#views svg").first.is_visible()
    assert page.page.get_attribute("#results", "class") == ""


def test_figures_of_other_inputs_are_grey_and_named_while_solving_and_after(opened):
    page = opened(address=address(HERE) + WIDE)
    before = page.figure("friction_torque")
    slow = {n: v for n, v in NOWHERE.items() if n != "load"}
    for name, value in slow.items():
        page.page.fill(f"#in-{name}", str(value))
    page.page.fill("#in-load", "9192.4")
    # answers to inputs that have changed meanwhile may come in between
    page.page.wait_for_selector("#state:has-text('; the figures are those of load ')")
    page.page.wait_for_selector("#results.stale", state="attached")
    page.page.wait_for_selector("#state:has-text('No solution')", timeout=60_000)
    assert "; the figures are those of load " in said(page)
    shade = "(one) => getComputedStyle(one).opacity"
    assert float(page.page.locator("#friction_torque").evaluate(shade)) < 0.6
    assert page.figure("friction_torque") > 0.0 != before


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("load", "0.3 kN"),
        ("speed", "-3e3 1/min"),
        ("oil_temperature", "24 °C"),
        ("tilt", "0.1 deg"),
    ],
)
def test_a_field_takes_what_the_command_line_takes(opened, name, text):
    page = opened()
    page.put(name, text)
    unit = next(f["unit"] for f in about("washer")["inputs"] if f["name"] == name)
    page.page.locator(f"#in-{name}").blur()
    shown = float(page.page.input_value(f"#in-{name}"))
    assert shown == pytest.approx(parse_quantity(text, unit, name), rel=1e-14)
    assert f"{name}=" in page.page.url and page.page.text_content(f"#in-{name}-error") == ""
    assert about("washer")["scales"] == UNITS


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("load", "300 kN", "load = 300 kN, allowed: 0.001 .. 200 kN"),
        ("oil_temperature", "300 degC", "oil_temperature = 300 °C, allowed: -40 .. 200 °C"),
        ("load", "", "load: a number is missing; allowed: 1 .. 200000 N"),
        (
            "load",
            "1,5",
            "load = 1,5: a decimal point is required, no comma; allowed: 1 .. 200000 N",
        ),
    ],
)
def test_what_is_wrong_with_a_quantity_is_said_in_its_own_unit(opened, name, text, words):
    page = opened()
    page.put(name, text)
    assert page.page.text_content(f"#in-{name}-error") == words


def test_a_washer_that_slips_on_the_gear_is_told_as_by_the_command(opened):
    page = opened(address=address(NO_TILT))
    assert said(page).startswith(SLIPS.format(solve_washer(WasherParams(), **NO_TILT).stick_margin))


def test_at_rest_nothing_is_drawn_where_a_logarithm_has_no_place(opened):
    page = opened(address="#speed=0").settled()
    assert page.figure("friction_torque") == 0.0
    assert page.page.locator("#views circle").count() == 0


def test_a_point_outside_the_verified_range_is_told(opened):
    page = opened(address="#load=5000&speed=1500&tilt=0.006&oil_temperature=400")
    words = "outside the verified range: load 5 kN (20 N .. 1.85 kN), speed 1500 rad/s (50 rad/s .."
    assert words in said(page) and page.page.get_attribute("#state", "class") == "problem"


def test_too_few_teeth_are_refused_with_the_number_that_python_names(opened):
    with pytest.raises(ParameterError) as refused:
        GearMeshParams(pinion_teeth=12)
    words = str(refused.value).split(" (with")[0].split(", or profile_shift")[0]
    page = opened("gearmesh", "#pinion_teeth=12", ready="#state.problem")
    assert said(page).startswith(words)


@pytest.mark.parametrize("model", MODELS)
def test_each_view_has_a_link_to_its_part_of_the_equations(opened, model):
    page = opened(model, viewport={"width": 380, "height": 800}).page
    links = page.locator("#views h3 a")
    assert links.count() == page.locator("#views h3").count() >= 3
    for link in links.all():
        link.click()
        part = link.get_attribute("data-part")
        assert page.evaluate("document.activeElement.textContent") == part
    assert page.locator("#theory").get_attribute("open") is not None
    assert page.evaluate("document.documentElement.scrollWidth") <= 380


def test_an_address_gives_the_same_figures_whatever_was_open_before(opened):
    film = "#load=800&speed=545&tilt=0.002&oil_temperature=297.15"
    page = opened(address=film)
    torque = page.figure("friction_torque")
    assert page.page.text_content("#branch") == "film"
    page.page.evaluate("location.hash = '#load=2900&speed=545&tilt=0.002&oil_temperature=297.15'")
    assert page.settled().page.text_content("#branch") == "contact"
    page.page.evaluate(f"location.hash = '{film}'")
    assert page.settled().figure("friction_torque") == torque
    assert "branch" not in page.page.text_content("#as-command")
