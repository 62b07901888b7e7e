"""The documents hold together: links, names, commands and the README's first result."""

import contextlib
import importlib
import importlib.util
import io
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
DOCS = ROOT / "docs"
PAGES = [README, ROOT / "CHANGELOG.md", *sorted(DOCS.rglob("*.md"))]
# Written by commands, or drafts and history that name what is not there (any more).
NAMES_UNCHECKED = {"CHANGELOG.md", "adding-a-model.md", "stability.md", "faults.md"}
each_page = pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))


def prose(page):
    """Return the text without code blocks."""
    return re.sub(r"(?ms)^```.*?^```", "", page.read_text("utf-8"))


@cache
def anchors(page):
    """Return the anchors that GitHub makes of a page's headings."""
    heads = re.findall(r"(?m)^#+ +(.*)$", prose(page))
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def links(page):
    return [link for link in re.findall(r"\]\(([^)\s]+)\)", prose(page)) if "://" not in link]


@each_page
def test_links_lead_somewhere(page):
    broken = []
    for link in links(page):
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        if not target.exists() or (anchor and anchor not in anchors(target)):
            broken.append(link)
    assert broken == []


def test_the_index_lists_every_page():
    listed = {(DOCS / link.partition("#")[0]).resolve() for link in links(DOCS / "index.md")}
    assert [p for p in DOCS.rglob("*.md") if p not in listed and p.name != "index.md"] == []


def is_there(dotted):
    """Return whether a module has this name, or a module has this attribute."""
    with contextlib.suppress(ModuleNotFoundError):
        if importlib.util.find_spec(dotted):
            return True
    module, _, name = dotted.rpartition(".")
    return bool(module) and hasattr(importlib.import_module(module), name)


@each_page
def test_modules_and_files_that_are_named_exist(page):
    if page.name in NAMES_UNCHECKED:
        return
    text = page.read_text("utf-8")
    dotted = set(re.findall(r"\bthrustwasher(?:\.[A-Za-z_]\w*)+", text))
    dotted = {d for d in dotted if not re.search(r"\.(dev|io|org|md)\b", d)}
    files = set(re.findall(r"\b(?:benchmarks|tests|examples|docs|fmu_src)/[\w/.-]*\w", text))
    assert sorted(d for d in dotted if not is_there(d)) == []
    assert sorted(f for f in files if not (ROOT / f).exists()) == []


def test_the_readme_is_short_and_begins_with_its_two_commands():
    text = README.read_text("utf-8")
    assert len(text.split()) <= 900
    first, second = re.findall(r"(?ms)^```(\w+)\n(.*?)^```", text)[:2]
    assert [first, second] == [
        ("sh", 'python -m pip install -e ".[test]" && python -m thrustwasher shift\n'),
        ("sh", 'python -m pip install -e ".[test]" && python -m pytest\n'),
    ]


def test_the_readmes_first_result_is_what_comes_out():
    blocks = dict(re.findall(r"(?ms)^```(python|text)\n(.*?)^```", README.read_text("utf-8")))
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(blocks["python"], {})
    assert out.getvalue() == blocks["text"]
