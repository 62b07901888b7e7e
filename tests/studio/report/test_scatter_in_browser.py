"""The page of a study in a browser: for everyone, on every screen."""

import pytest
from browser_pages import Seen, faults
from scatter_stand_in import study

from thrustwasher.studio.report.html import render
from thrustwasher.studio.report.scatter import scatter_page

pytestmark = pytest.mark.browser


@pytest.mark.parametrize(("wide", "scheme"), [(1200, "light"), (1200, "dark"), (390, "light")])
def test_nothing_serious_bars_access_and_nothing_is_wider_than_the_screen(
    browser, tmp_path, wide, scheme
):
    path = tmp_path / "scatter.html"
    path.write_text(render(scatter_page(study())), "utf-8")
    size = {"width": wide, "height": 900}
    seen = Seen(browser, path.as_uri(), viewport=size, color_scheme=scheme)
    assert seen.page.evaluate("document.documentElement.scrollWidth") <= wide
    assert faults(seen.page) == []
    seen.close()
