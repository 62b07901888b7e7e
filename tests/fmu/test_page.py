"""The page inside an FMU: everything a user must know, nothing from outside."""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from toy.spec import SPEC as TOY

from thrustwasher.errors import Status
from thrustwasher.fmu.accuracy import CARDS
from thrustwasher.fmu.build import source_folder
from thrustwasher.fmu.common_contents import readme
from thrustwasher.fmu.curve import COURSES, SWEEPS
from thrustwasher.fmu.drawing import Line, drawing, ticks
from thrustwasher.fmu.identity import model_folder
from thrustwasher.fmu.interface import all_specs, find_spec, variables
from thrustwasher.fmu.markup import markup
from thrustwasher.fmu.page import page
from thrustwasher.fmu.wiring import slope

QUICK = [TOY, find_spec("WetClutch"), find_spec("GearMesh"), find_spec("ShiftTransmission")]
each_spec = pytest.mark.parametrize("spec", QUICK, ids=lambda s: s.name)
ACCURACY = Path(__file__).parents[2] / "docs" / "accuracy.md"
VOID = {"meta", "img", "rect", "path", "polyline"}
_pages = {}


def shown(spec, target="native"):
    if (spec.name, target) not in _pages:
        _pages[spec.name, target] = page(
            spec, target=target, fmi=2, guid="1234abcd", platforms=("linux64", "win64"),
            equations=readme(model_folder(spec, source_folder())),
        )  # fmt: skip
    return _pages[spec.name, target]


class Tags(HTMLParser):
    """Notes tags that are not closed, and everything that would be fetched or run."""

    def __init__(self):
        super().__init__()
        self.open, self.wrong, self.fetched = [], [], []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        places = [given.get(a, "") for a in ("src", "href")]
        self.fetched += [p for p in places if p and not p.startswith("data:")]
        self.fetched += [a for a in given if a.startswith("on")] + [tag] * (tag == "script")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in VOID and (not self.open or self.open.pop() != tag):
            self.wrong.append(tag)


@each_spec
@pytest.mark.parametrize("target", ["native", "python"])
def test_the_page_is_whole_and_asks_for_nothing(spec, target):
    tags = Tags()
    tags.feed(shown(spec, target))
    assert (tags.open, tags.wrong, tags.fetched) == ([], [], [])
    assert "http" not in shown(spec, target)


@each_spec
def test_every_variable_status_and_plug_is_named(spec):
    text = shown(spec)
    for v in variables(spec)[1:]:
        assert f"<td>{v.name}</td>" in text
        if v.causality != "output" and v.type == "Real":
            assert f"<td>{v.low:g} .. {v.high:g}</td>" in text
    for status in Status:
        assert f"<td>{status.name}</td>" in text
    assert all(f"<td>{t.name}</td><td>{t.kind}</td>" in text for t in spec.terminals)
    assert "1234abcd" in text and "<svg" in text and "<polyline" in text


@each_spec
def test_what_was_run_and_what_was_not_is_said(spec):
    text = shown(spec)
    for words in ("under wine; not run on Windows", "linked, never run", "qemu", "Simulink, Dymola",
                  "not signed", "libraries for linux64, win64"):  # fmt: skip
        assert words in text
    assert "pip install thrustwasher==" in shown(spec, "python")
    assert "pip install" not in text


@pytest.mark.parametrize("spec", all_specs(), ids=lambda s: s.name)
def test_the_equations_and_their_source_are_there(spec):
    text = readme(model_folder(spec, source_folder()))
    assert text.startswith(f"# {spec.name}\n")
    assert "Source" in text and "## Validity" in text and text.count("```") >= 4
    known = {v.name for other in all_specs() for v in variables(other)}
    options = {item for f in spec.params.__dataclass_fields__.values()
               for item in f.metadata.get("options", ())}  # fmt: skip
    named = set(re.findall(r"`([a-z_]+)`", text))
    assert named <= known | options


@pytest.mark.skipif(not ACCURACY.is_file(), reason="the documents are in the source tree only")
@pytest.mark.parametrize("name", [n for n in CARDS if n != "ShiftTransmission"])
def test_the_figures_of_the_card_stand_in_the_document(name):
    text = ACCURACY.read_text("utf-8")
    for row in CARDS[name]:
        for figure in row.worst.split(" / "):
            number = re.escape(figure.split()[0])  # in the document one unit may serve several
            assert re.search(rf"(?<![\d.]){number}(?![\d])", text), figure


def test_every_model_has_a_card_and_a_curve_of_its_own():
    names = {spec.name for spec in all_specs() if spec.course}
    assert names == set(CARDS) == set(SWEEPS) | set(COURSES)


def test_the_stiffest_spring_of_a_clutch_is_at_zero_slip():
    clutch = find_spec("WetClutch")
    point = {"load": 5e3, "oil_temperature": 353.15}
    capacity = 330.0  # N.m, the pack's at this load
    assert slope(clutch, point | {"speed": 0.0}) == pytest.approx(capacity / 0.1, rel=0.05)
    assert slope(clutch, point | {"speed": 60.0}) < 0.0  # friction falls: nothing cures it


def test_a_drawing_has_a_line_for_each_and_round_ticks():
    text = drawing("a & b", "x [m]", "y [1]", [Line("one", [0, 1], [1, 2]), Line("two", [0], [3])])
    assert text.count("<polyline") == 2 and "a &amp; b" in text
    assert ticks([0.0, 1000.0]) == [0, 200, 400, 600, 800, 1000]
    assert ticks([80.0, 100.0])[0] >= 80 and ticks([20.0, 100.0])[0] == 0.0
    assert len(ticks([5.0, 5.0])) >= 2


def test_markup_knows_headings_lists_code_and_paragraphs():
    text = "# T\n\nA `b<c` d\ne.\n\n- one\n  two\n- three\n\n```\nx < 1\n\ny\n```\n\nEnd."
    assert markup(text, level=2) == (
        "<h2>T</h2>\n<p>A <code>b&lt;c</code> d e.</p>\n<ul><li>one two</li><li>three</li></ul>\n"
        "<pre>x &lt; 1\n\ny</pre>\n<p>End.</p>"
    )
