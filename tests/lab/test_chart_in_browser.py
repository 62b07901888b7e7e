"""The chart's page in a browser: words behind every mark and every cell, nothing from outside."""

import numpy as np
import pytest
from browser_pages import faults, opened
from test_chart import GROUP, drawn, record  # noqa: F401 (fixtures)

pytestmark = pytest.mark.browser
MARKS = "#chart-washer use[role=img]"


@pytest.fixture
def page(browser, drawn):  # noqa: F811
    with opened(browser, drawn / "chart.html", ready="html.js") as found:
        yield found


def test_a_mark_under_the_pointer_tells_way_error_worst_case_and_command(page):
    marks = page.locator(MARKS)
    assert marks.count() == 4  # of those that have an error and a cost
    field = page.locator(MARKS + '[aria-label^="fidelity levels: field"]')
    field.scroll_into_view_if_needed()
    box = field.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2 + 5, box["y"] + box["height"] / 2)
    tip = page.locator("[role=tooltip]")
    lines = tip.locator("div").all_text_contents()
    assert lines[0] == "fidelity levels: field" and lines[1].startswith(
        "field: 10 x 32 graded nodes"
    )
    assert lines[2] == "friction_torque: worst 0.2 %, rms 0.08 %"
    assert "worst case: a < b" in lines
    point = "--load 300 --speed 545 --tilt 0.002 --oil-temperature 297.15"
    assert lines[-1] == f"command: thrustwasher washer {point} --fidelity field"
    page.keyboard.press("Escape")
    assert tip.is_hidden()


def test_marks_are_reached_by_tab_and_arrows(page):
    page.locator(MARKS + "[tabindex='0']").focus()
    first = page.evaluate("document.activeElement.getAttribute('aria-label')")
    page.keyboard.press("ArrowRight")
    second = page.evaluate("document.activeElement.getAttribute('aria-label')")
    assert first != second and page.locator("[role=tooltip]").is_visible()
    assert page.locator(MARKS + "[tabindex='0']").count() == 1


def test_every_cell_of_the_map_has_its_words(page):
    cells = page.locator("#map td button")
    assert cells.count() == 4
    lie = page.get_by_role("button", name="LIES -20 %")
    lie.focus()
    tip = page.locator("[role=tooltip]").text_content()
    assert "bad, a" in tip and "silently wrong" in tip and "load off" in tip
    heads = page.locator("#map th").all_text_contents()
    assert heads == [*GROUP["hazards"], *GROUP["methods"]]


def test_names_of_marks_do_not_lie_on_each_other(page):
    boxes = page.evaluate(
        """() => [...document.querySelectorAll("#chart-washer svg text")].map((one) => {
          const { x, y, width, height } = one.getBoundingClientRect();
          return [x, y, x + width, y + height];
        })"""
    )
    boxes = np.array(boxes)
    assert len(boxes) > 10
    for i, a in enumerate(boxes):
        for b in boxes[:i]:
            across = min(a[2], b[2]) - max(a[0], b[0])
            down = min(a[3], b[3]) - max(a[1], b[1])
            assert across < 1.0 or down < 2.0


@pytest.mark.parametrize(
    ("wide", "scheme"), [(1200, "light"), (1200, "dark"), (380, "light"), (380, "dark")]
)
def test_nothing_serious_bars_access(browser, drawn, wide, scheme):  # noqa: F811
    look = {"wide": wide, "scheme": scheme}
    with opened(browser, drawn / "chart.html", ready="html.js", **look) as page:
        assert page.evaluate("document.documentElement.scrollWidth") <= wide
        assert faults(page) == []


def test_without_scripts_drawings_and_tables_stay(browser, drawn):  # noqa: F811
    words = {"ready": "", "java_script_enabled": False}
    with opened(browser, drawn / "chart.html", **words) as page:
        assert page.locator("#chart-washer svg").is_visible()
        page.get_by_text("All cells").click()
        assert page.get_by_text("SINGULAR: no way").is_visible()
