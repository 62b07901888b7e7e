"""Pages in Debian's Chromium: opened, watched for messages and requests, checked for access."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from pathlib import Path

import pytest

AXE = Path(__file__).parents[1] / "node_modules" / "axe-core" / "axe.min.js"
SERIOUS = ("serious", "critical")


def missing(what):
    """Skip where the machine has no browser; fail where all must hold."""
    (pytest.fail if os.environ.get("CI") else pytest.skip)(f"{what} is missing")


@contextmanager
def chromium():
    """Give a headless browser."""
    path = shutil.which("chromium")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("playwright")
    if path is None:
        missing("chromium")
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield browser
        browser.close()


@contextmanager
def opened(browser, path, *, init="", wide=1200, scheme="light", ready="#now:not(:empty)", **more):
    """Give the page of a file, once its scripts are done; nothing is said, nothing is fetched."""
    size = {"width": wide, "height": 900}
    context = browser.new_context(viewport=size, color_scheme=scheme, **more)
    page = context.new_page()
    said, asked = [], []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    if init:
        page.add_init_script(init)
    page.goto(path.as_uri())
    if ready:
        page.wait_for_selector(ready, state="attached")
    yield page
    context.close()
    outside = [one for one in asked if not one.startswith("blob:")]
    assert said == [] and outside == [path.as_uri()]


def faults(page):
    """Return the serious findings of an automated check of access."""
    if not AXE.is_file():
        missing("node_modules/axe-core (npm install --no-save axe-core)")
    page.evaluate("() => document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    page.wait_for_timeout(100)
    page.evaluate(AXE.read_text("utf-8"))
    found = page.evaluate("() => axe.run()")["violations"]
    return [(f["id"], f["nodes"][0]["html"][:200]) for f in found if f["impact"] in SERIOUS]
