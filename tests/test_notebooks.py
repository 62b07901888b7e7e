"""The notebooks run from top to bottom, are kept without outputs and say what comes out."""

import json
import re
from pathlib import Path

import needed
import pytest

NOTEBOOKS = sorted((Path(__file__).parents[1] / "examples" / "notebooks").glob("*.ipynb"))
SAID = {  # among what each one prints
    "1_washer": "0.2582 N m at a film ratio of 20.8",
    "2_own_part": "Python at 300 N: 0.08754 N m",
    "3_calibrate": "stick_speed    not determined",
    "4_shift": "as it is   locks at 0.8365 s",
    "5_scatter": "locks at 0.837 s",
}
each = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def cells(path, kind):
    return [c for c in json.loads(path.read_text("utf-8"))["cells"] if c["cell_type"] == kind]


def test_there_is_one_for_every_job():
    assert [path.stem for path in NOTEBOOKS] == list(SAID)


@each
def test_it_is_kept_without_outputs(path):
    code = cells(path, "code")
    assert [c["outputs"] for c in code] == [[]] * len(code)
    assert {c["execution_count"] for c in code} == {None}


@each
def test_it_begins_with_a_title_and_explains_itself(path):
    text = ["".join(c["source"]) for c in cells(path, "markdown")]
    assert text[0].startswith("# ") and len(text) >= 5
    code = ["".join(c["source"]) for c in cells(path, "code")]
    assert max(len(c.splitlines()) for c in code) <= 25


@each
def test_links_lead_somewhere(path):
    text = "".join("".join(c["source"]) for c in cells(path, "markdown"))
    links = re.findall(r"\]\(([^)\s#]+)", text)
    assert [link for link in links if not (path.parent / link).exists()] == []


@pytest.mark.slow
@each
def test_it_runs(path):
    client, nbformat = needed.package("nbclient"), needed.package("nbformat")
    needed.package("ipykernel"), needed.package("pandas")
    book = nbformat.read(path, as_version=4)
    where = {"metadata": {"path": str(path.parent)}}
    client.NotebookClient(book, timeout=600, kernel_name="python3", resources=where).execute()
    outputs = [o for c in book.cells if c.cell_type == "code" for o in c.outputs]
    printed = "".join(o.text for o in outputs if o.output_type == "stream" and o.name == "stdout")
    assert SAID[path.stem] in printed
    shown = {kind for o in outputs if "data" in o for kind in o.data}
    assert {"text/html", "image/png"} <= shown
