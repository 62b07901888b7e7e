"""The committed scripts and styles of pages are those of their sources, and stand alone."""

import hashlib
import json
import re

import pytest
from kernel_files import ROOT

from lab import structure
from thrustwasher.studio.report.bundles import FOLDER, bundle

TOOL = ROOT / "lab" / "pages"
RECORD = json.loads((FOLDER / "made_of.json").read_text("utf-8"))
AGAIN = "run: npm run --prefix lab/pages bundle"


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def digest_of_sources():
    """As ``digestOfSources`` in bundle.mjs."""
    found = {p.relative_to(FOLDER.parent).as_posix(): p for p in FOLDER.parent.rglob("*.[jc]s*")}
    found = {name: p for name, p in found.items() if p.suffix in (".js", ".css")}
    found = {name: p for name, p in found.items() if FOLDER not in p.parents}
    found |= {name: TOOL / name for name in ("bundle.mjs", "package-lock.json")}
    return digest("\0".join(f"{n}\n{found[n].read_text('utf-8')}" for n in sorted(found)))


def test_bundles_are_those_of_their_sources():
    assert digest_of_sources() == RECORD["sources"], AGAIN


def test_no_bundle_is_edited_left_over_or_missing():
    there = {p.name: digest(bundle(p.name)) for p in FOLDER.iterdir() if p.suffix != ".json"}
    assert there == RECORD["files"], AGAIN


@pytest.mark.parametrize("name", RECORD["files"])
def test_a_bundle_asks_for_nothing_and_can_stand_in_a_page(name):
    text = bundle(name)
    asks = r"""\bimport\s*[("'{*]|\brequire\(|@import|</script|</style|\beval\("""
    assert not re.search(asks, text)
    assert not re.search(r"url\((?!#|data:)", text)


def test_no_modules_of_the_pages_import_each_other_in_a_circle():
    web, graph = FOLDER.parent, {}
    for path in [p for p in web.rglob("*.js") if p.parent != FOLDER]:
        found = re.findall(
            r'(?m)^(?:import|export)\b[^;]*? from "(\.[^"]+)";', path.read_text("utf-8")
        )
        graph[path] = {(path.parent / name).resolve() for name in found}
    assert structure.circles(graph) == []
    assert sum(map(len, graph.values())) > 50
