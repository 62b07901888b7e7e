"""The files that a public forge reads: citation, contributing, issue templates, CI."""

import re
from pathlib import Path

import pytest

import thrustwasher

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(
    not (ROOT / "CITATION.cff").is_file(), reason="these files are in the source tree only"
)
REQUIRED = {"cff-version", "message", "title", "authors", "version", "license", "references"}


def test_the_citation_is_of_this_version():
    text = (ROOT / "CITATION.cff").read_text("utf-8")
    assert re.findall(r"(?m)^version: (\S+)$", text) == [thrustwasher.__version__]


def test_the_citation_has_what_its_format_requires_and_the_three_papers():
    yaml = pytest.importorskip("yaml")
    found = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert found.keys() >= REQUIRED and found["cff-version"] == "1.2.0"
    assert [author["name"] for author in found["authors"]] == ["thrustwasher developers"]
    names = [tuple(a["family-names"] for a in r["authors"]) for r in found["references"]]
    assert names == [("Jackson", "Green"), ("Wang", "Wei", "Wu"), ("Atan",)]
    for reference in found["references"]:
        assert reference.keys() >= {"type", "title", "authors", "year"}


def test_ci_of_the_forge_is_the_script_and_takes_no_secrets():
    text = (ROOT / ".github" / "workflows" / "ci.yml").read_text("utf-8")
    assert "run: .ci/run" in text and "secrets" not in text
    yaml = pytest.importorskip("yaml")
    assert yaml.safe_load(text)["jobs"]["run"]["runs-on"] == "ubuntu-latest"


@pytest.mark.parametrize("name", ["bug", "wrong_figure", "question"])
def test_issue_templates_have_a_head(name):
    text = (ROOT / ".github" / "ISSUE_TEMPLATE" / f"{name}.md").read_text("utf-8")
    assert re.match(r"---\nname: .+\nabout: .+\nlabels: .+\n---\n", text)
