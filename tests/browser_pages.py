"""Pages in Debian's Chromium: opened, watched for messages and requests, checked for access."""

from __future__ import annotations

import shutil
from contextlib import contextmanager
from pathlib import Path

from needed import missing

try:
    from playwright.sync_api import TimeoutError, sync_playwright
except ImportError:
    sync_playwright = None

AXE = Path(__file__).parents[1] / "lab" / "pages" / "node_modules" / "axe-core" / "axe.min.js"
SERIOUS = ("serious", "critical")


@contextmanager
def chromium():
    """Give a headless browser."""
    path = shutil.which("chromium")
    if sync_playwright is None:
        missing("playwright is missing")
    if path is None:
        missing("chromium is missing")
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield browser
        browser.close()


class Seen:
    """A page in a context of its own, with all that it said and requested."""

    def __init__(self, browser, address, *, init="", ready="", **look):
        self.address, self.context = address, browser.new_context(**look)
        if init:
            self.context.add_init_script(init)
        try:
            self._open(ready)
        except TimeoutError:
            # Where much more runs than there are cores, Chromium at times leaves a new page waiting
            # for its process until the time is up, two of a hundred; another page opens at once.
            self.page.close()
            self._open(ready)

    def _open(self, ready):
        self.said, self.asked = [], []
        self.page = self.context.new_page()
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(self.address)
        if ready:
            self.page.wait_for_selector(ready, state="attached")

    def close(self):
        """Close it; nothing was said, nothing was fetched but the page."""
        self.context.close()
        assert self.said == []
        own = self.address.split("#")[0]
        assert [u for u in self.asked if not u.startswith("blob:") and u.split("#")[0] != own] == []


@contextmanager
def opened(
    browser, path, *, wide=1200, scheme="light", ready="#now:not(:empty)", address="", **more
):
    """Give the page of a file, once its scripts are done."""
    size = {"width": wide, "height": 900}
    seen = Seen(
        browser,
        f"{path.as_uri()}{address}",
        ready=ready,
        viewport=size,
        color_scheme=scheme,
        **more,
    )
    yield seen.page
    seen.close()


def faults(page):
    """Return the serious findings of an automated check of access."""
    if not AXE.is_file():
        missing("lab/pages/node_modules/axe-core (npm ci --prefix lab/pages)")
    page.evaluate("() => document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    page.wait_for_timeout(100)
    page.evaluate(AXE.read_text("utf-8"))
    found = page.evaluate("() => axe.run()")["violations"]
    return [(f["id"], f["nodes"][0]["html"][:200]) for f in found if f["impact"] in SERIOUS]
