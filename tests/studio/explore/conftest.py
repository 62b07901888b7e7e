"""Pages in one browser for all tests."""

from pathlib import Path

import pytest
from browser_pages import Seen
from pages import html


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pages")

    def file(model):
        path = folder / f"{model}.html"
        if not path.exists():
            path.write_text(html(model), "utf-8")
        return path

    return file


class Opened(Seen):
    """A page to explore."""

    def __init__(self, browser, path, address="", ready="html[data-settled]", **look):
        super().__init__(browser, f"{path.as_uri()}{address}", ready=ready, **look)

    def settled(self):
        """Wait until the numbers are those of a fresh solve again."""
        self.page.wait_for_timeout(250)
        self.page.wait_for_function("() => !page.busy && !page.setting && !page.waiting")
        count = self.number("html", "data-solved")
        for _ in range(100):
            self.page.wait_for_timeout(60)
            now = self.number("html", "data-solved")
            if now == count:
                return self
            count = now
        raise AssertionError("it never settles")

    def number(self, where, attribute="value"):
        return float(self.page.get_attribute(where, attribute))

    def figure(self, name):
        return self.number(f"#{name}")

    def put(self, name, value):
        self.page.fill(f"#in-{name}", str(value))
        return self.settled()


@pytest.fixture
def opened(browser, files):
    made = []

    def open_(page="washer", address="", **look):
        path = page if isinstance(page, Path) else files(page)
        made.append(Opened(browser, path, address, **look))
        return made[-1]

    yield open_
    for page in made:
        page.close()
