"""What is handed on is short on paper: at most six A4 pages."""

import re
from pathlib import Path

import pytest
from scatter_stand_in import study

from thrustwasher import propagate
from thrustwasher.studio.report.html import render
from thrustwasher.studio.report.reducer_report import reducer_page
from thrustwasher.studio.report.scatter import scatter_page
from thrustwasher.train.train_file import load_train

SCENE = Path(__file__).parents[3] / "examples" / "ev-reducer.toml"
POINT = {"torque": 150.0, "speed": 500.0, "oil_temperature": 353.15}
MOST = 6
pytestmark = pytest.mark.browser


def pages(browser, page, folder):
    """Return how many A4 pages a page takes on paper."""
    path = folder / "page.html"
    path.write_text(render(page), "utf-8")
    opened = browser.new_page()
    opened.goto(path.as_uri())
    paper = opened.pdf(format="A4")
    opened.close()
    return len(re.findall(rb"/Type /Page\b", paper))


def test_a_study(browser, tmp_path):
    assert 1 <= pages(browser, scatter_page(study()), tmp_path) <= MOST


@pytest.mark.slow
def test_a_reducer_with_all_of_its_figures(browser, tmp_path):
    found = propagate(SCENE, at=POINT, runs=64, indices=True, workers=1)
    assert 1 <= pages(browser, scatter_page(found), tmp_path) <= MOST
    report = reducer_page(load_train(SCENE), [POINT], study=found)
    assert 1 <= pages(browser, report, tmp_path) <= MOST
