"""The documents hold together: links, names, commands and the README's first result."""

import contextlib
import importlib
import io
import re
import tomllib
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

from lab import structure, tables
from thrustwasher.model.registry import all_specs

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "thrustwasher"
README = ROOT / "README.md"
DOCS = ROOT / "docs"
PAGES = [README, ROOT / "CHANGELOG.md", *sorted(DOCS.rglob("*.md"))]
# History, and a made-up model.
NAMES_UNCHECKED = {"CHANGELOG.md", "adding-a-model.md", "migration.md"}
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
    files = set(re.findall(r"\b(?:lab|tests|examples|docs|fmu_src)/[\w/.-]*\w", text))
    assert sorted(d for d in dotted if not is_there(d)) == []
    assert sorted(f for f in files if not (ROOT / f).exists()) == []
    first = "|".join(p.name for p in PACKAGE.iterdir() if p.is_dir())
    inside = set(re.findall(rf"`((?:thrustwasher/)?(?:{first})/[\w/.]*)`", text))
    inside |= set(re.findall(r"`(\w+\.py)`", text)) - {"build_fmu.py", "__init__.py"}
    places = (PACKAGE, PACKAGE.parent)
    assert [f for f in inside if not any((p / f).exists() for p in places)] == []


def test_the_layers_on_the_page_are_those_that_are_checked():
    page = (DOCS / "architecture.md").read_text("utf-8")
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    rows = next(c["layers"] for c in tool["contracts"] if c["type"] == "layers")
    assert "\n".join(rows).replace("thrustwasher.", "") + "\n```" in page
    folders = {p.parent.name for p in PACKAGE.glob("*/__init__.py")}
    assert {f for f in folders if f"\n  {f}/ " not in page} == set()
    steps = re.findall(r"(?m)^\d+\. `([\w/]+\.(?:py|c|toml))`", page)
    assert len(steps) == len(set(steps)) == 20


def test_commands_of_the_lab_that_any_text_names_are_there():
    texts = [p for end in ("md", "py", "toml") for p in (ROOT / "lab").rglob(f"*.{end}")]
    found = {
        name.rstrip(".")
        for path in [*PAGES, *texts]
        for name in re.findall(r"python -m (lab\.[a-z0-9_.]+)", path.read_text("utf-8"))
    }
    missing = [name for name in found if find_spec(name) is None]
    assert len(found) > 20 and not missing, missing


@pytest.mark.slow
def test_the_picture_is_what_the_imports_say():
    told = structure.arrows_in_words()
    picture = (DOCS / "images" / "architecture.svg").read_text("utf-8")
    assert told in picture, "python -m lab.structure --draw docs/images/architecture.svg"


def test_the_readme_is_short_and_begins_with_its_two_commands():
    text = README.read_text("utf-8")
    assert len(text.split()) <= 700
    first, second = re.findall(r"(?ms)^```(\w+)\n(.*?)^```", text)[:2]
    assert [first, second] == [
        ("sh", "python -m pip install -e . && python -m thrustwasher shift\n"),
        ("sh", 'python -m pip install -e ".[test]" && python -m pytest\n'),
    ]


@pytest.mark.parametrize("page", [README, DOCS / "fmu.md"], ids=["README", "fmu"])
def test_the_tables_of_fmus_have_all_that_are_built(page):
    table = re.search(r"(?s)\| FMU \| .*?\n\n", page.read_text("utf-8"))[0]
    listed = re.findall(r"(?m)^\| `(\w+)` \|", table)
    assert set(listed) - {"CommandSource"} == {spec.name for spec in all_specs()}


def test_the_table_of_hosts_is_of_all_fmus():
    page = (DOCS / "fmu" / "hosts.md").read_text("utf-8")
    counts = set(map(int, re.findall(r"\| (\d+) FMUs \|", page)))
    assert counts <= {len(all_specs()), len(all_specs()) + 1}  # checkers: CommandSource too


def test_extras_that_the_docs_name_are_those_there_are():
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = list(tool["optional-dependencies"])
    told = re.search(r"(?s)## Install\n(.*?)(?:\n## |\Z)", README.read_text("utf-8"))[1]
    assert re.findall(r"`(\w+)`", told.partition("Extras add:")[2]) == extras
    for page in (README, *DOCS.rglob("*.md"), ROOT / ".ci" / "run"):
        for names in re.findall(r"(?:thrustwasher|\.)\[(\w+(?:,\w+)*)\]", page.read_text("utf-8")):
            assert set(names.split(",")) <= set(extras), page


def test_the_readmes_first_result_is_what_comes_out():
    blocks = dict(re.findall(r"(?ms)^```(python|text)\n(.*?)^```", README.read_text("utf-8")))
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(blocks["python"], {})
    assert out.getvalue() == blocks["text"]


@pytest.mark.parametrize("name", [n for n in tables.MADE if n != "mesh-jumps"])  # the mesh's tests
@pytest.mark.slow
def test_what_a_page_tells_is_what_comes_out(name):
    """Else: python -m lab.tables NAME."""
    told = [t for page in tables.PAGES for n, t in tables.blocks(page).items() if n == name]
    assert told == [tables.MADE[name]()]


def test_every_block_of_a_page_is_made():
    assert {n for page in tables.PAGES for n in tables.blocks(page)} == set(tables.MADE)


def test_an_entry_of_the_changelog_is_short():
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    entries = re.findall(r"(?ms)^- (.*?)(?=^- |^#|^$|\Z)", text)
    assert entries and [e for e in entries if len(" ".join(e.split())) > 200] == []
    assert [line for line in text.splitlines() if line.startswith("|")] == []
