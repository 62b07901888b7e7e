"""Documentation of an FMU: all a user must know, nothing from outside; a notice for each part."""

import re
import zipfile
from html.parser import HTMLParser

import needed
import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.util import read_csv
from lxml import etree
from markupsafe import escape
from toy.spec import SPEC as TOY

from thrustwasher.errors import EnvironmentProblem, Status
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.documentation.html_page import accuracy, page, slope
from thrustwasher.fmu.documentation.markup import markup
from thrustwasher.fmu.documentation.reference_results import FOLDER
from thrustwasher.fmu.package import licences as module
from thrustwasher.fmu.package.licences import PLACE, licences, listed_licences
from thrustwasher.fmu.package.model_sources import Order, model_folder, source_folder
from thrustwasher.ladder.error_table import load_tables
from thrustwasher.model.registry import all_specs, find_spec

QUICK = [TOY, find_spec("WetClutch"), find_spec("GearMesh"), find_spec("ShiftTransmission")]
each_spec = pytest.mark.parametrize("spec", QUICK, ids=lambda s: s.name)
VOID = {"meta", "img"}
SAID = {
    "license.txt": b"thrustwasher authors",
    "numba.txt": b"Anaconda",
    "llvmlite.txt": b"All rights reserved",
    "llvm.txt": b"LLVM Exceptions",
    "fmi-headers.txt": b"Modelica Association",
    "pythonfmu.txt": b"MIT",
}
BOTH = {"license.txt", "overview.txt"}
NATIVE = {*BOTH, "numba.txt", "llvmlite.txt", "llvm.txt", "fmi-headers.txt", "musl.txt"}
_pages = {}


def shown(spec, target="native"):
    if (spec.name, target) not in _pages:
        order = Order(target, 2, ("linux64", "win64"), print)
        folder = model_folder(spec, source_folder())
        _pages[spec.name, target] = page(interface(spec), folder, order, "1234abcd")
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
    for v in interface(spec).variables[1:]:
        assert f"<td>{v.name}</td>" in text
        if v.causality != "output" and v.type == "Real":
            assert f"<td>{v.low:g} .. {v.high:g}</td>" in text
    for status in Status:
        assert f"<td>{status.name}</td>" in text
    assert all(f"<td>{t.name}</td><td>{t.kind}</td>" in text for t in spec.terminals)
    for file, part, licence, _ in listed_licences("native", ("linux64", "win64")):
        assert f"<td>{file}</td><td>{escape(part)}</td><td>{licence}</td>" in text
    assert "1234abcd" in text


@each_spec
def test_what_was_run_and_what_was_not_is_said(spec):
    text = shown(spec)
    for words in (
        "under wine; not run on Windows",
        "linked, never run",
        "qemu",
        "Simulink, Dymola",
        "not signed",
        "libraries for linux64, win64",
    ):
        assert words in text
    assert "pip install thrustwasher==" in shown(spec, "python")
    assert "pip install" not in text


@pytest.mark.parametrize("spec", all_specs(), ids=lambda s: s.name)
def test_the_equations_and_their_source_are_there(spec):
    folder = model_folder(spec, source_folder())
    text = (folder / "readme.md").read_text("utf-8")
    assert "](curve.svg)" in text and 'src="data:image/svg+xml;base64,' in markup(text, folder)
    assert text.startswith(f"# {spec.name}\n")
    assert "Source" in text and "## Validity" in text and text.count("```") >= 4
    known = {v.name for other in all_specs() for v in interface(other).variables}
    options = {
        item
        for f in spec.params.__dataclass_fields__.values()
        for item in f.metadata.get("options", ())
    }
    named = set(re.findall(r"`([a-z_]+)`", text))
    assert named <= known | options | set(spec.fidelities)


@pytest.mark.parametrize("name", ["washer", "clutch", "gearmesh"])
def test_the_figures_of_accuracy_are_those_of_the_table(name):
    table = next(t for t in load_tables(name) if t.name == "default")
    known = [(r, c) for r in table.levels for c in r.charts]
    rows = accuracy(find_spec(name))
    assert [row[0] for row in rows] == [f"{r.fidelity} {c.name or ''}".strip() for r, c in known]
    assert [row[2] for row in rows] == [str(c.points) for _, c in known]
    for row, (level, chart) in zip(rows, known, strict=True):
        worst = level.worst_anywhere("friction_torque", chart)
        assert float(row[3].removesuffix(" %")) == pytest.approx(100.0 * worst, rel=0.05)
    assert f"<td>{rows[0][3]}</td>" in shown(find_spec(name)).replace("\n", "")


def test_the_stiffest_spring_of_a_clutch_is_at_zero_slip():
    clutch = find_spec("WetClutch")
    point = {"load": 5e3, "oil_temperature": 353.15, "drum_speed": 0.0}
    capacity = 168.0  # N.m, the pack's at this load
    assert slope(clutch, point | {"speed": 0.0}) == pytest.approx(capacity / 0.1, rel=0.05)
    assert 0.0 < slope(clutch, point | {"speed": 60.0}) < 1.0  # friction rises: harmless


def test_markup_knows_headings_lists_code_and_paragraphs():
    text = "# T\n\nA `b<c` d\ne.\n\n- one\n  two\n- three\n\n```\nx < 1\n\ny\n```\n\nEnd."
    assert markup(text, source_folder(), level=2) == (
        "<h2>T</h2>\n<p>A <code>b&lt;c</code> d e.</p>\n<ul><li>one two</li><li>three</li></ul>\n"
        "<pre>x &lt; 1\n\ny</pre>\n<p>End.</p>"
    )


@pytest.mark.parametrize(
    ("target", "platforms", "names"),
    [
        ("python", (), {*BOTH, "pythonfmu.txt"}),
        ("native", ("linux64",), NATIVE),
        ("native", ("linux64", "win64"), {*NATIVE, "mingw-w64.txt"}),
    ],
)
def test_the_notices_of_a_target_are_these(target, platforms, names):
    if "win64" in platforms:
        needed.package("ziglang")
    found = {
        path.removeprefix(f"{PLACE}/"): text for path, text in licences(target, platforms).items()
    }
    assert found.keys() - {"zig.txt"} == names
    assert all(len(text.strip()) > 200 for text in found.values())
    for name in found.keys() & SAID.keys():
        assert SAID[name] in found[name], name
    for name in found.keys() - {"overview.txt"}:
        assert name.encode() in found["overview.txt"]


def test_the_notice_of_the_headers_is_that_of_a_bsd_licence():
    notice = licences("native")[f"{PLACE}/fmi-headers.txt"].decode()
    assert notice.startswith("Copyright") and notice.endswith("POSSIBILITY OF SUCH DAMAGE.\n")
    assert "Redistributions in binary form must reproduce the above copyright notice" in notice


def test_a_missing_notice_stops_the_build(monkeypatch):
    monkeypatch.setattr(module.metadata, "files", lambda package: [])
    with pytest.raises(EnvironmentProblem, match="install numba again"):
        licences("native")


# Reference results: FMPy with the files in the FMU gets what the files say.

NAMES = [spec.name for spec in all_specs()]
each_model = pytest.mark.parametrize("name", NAMES)


def unzipped(fmu, folder):
    with zipfile.ZipFile(fmu) as zipped:
        zipped.extractall(folder)
    return folder / FOLDER


def simulated(fmu, **options):
    names = [
        v.name for v in read_model_description(str(fmu)).modelVariables if v.causality == "output"
    ]
    return simulate_fmu(str(fmu), output=names, **options)


@each_model
def test_the_inputs_of_the_reference_run_move_and_no_status_warns(name, fmus, tmp_path):
    folder = unzipped(fmus[name], tmp_path)
    inputs, outputs = (read_csv(folder / f"{name}_{end}.csv") for end in ("in", "out"))
    stop, _ = interface(find_spec(name)).experiment
    assert inputs.dtype.names[1:] == tuple(s.name for s in find_spec(name).inputs)
    assert any(np.ptp(inputs[n]) > 0 for n in inputs.dtype.names[1:])
    assert (inputs["time"][0], inputs["time"][-1]) == (0.0, stop)
    assert (outputs["time"][0], outputs["time"][-1]) == (0.0, pytest.approx(stop))
    deaf = {Status.UNANSWERED} if name == "WetClutch" else set()  # its slip is prescribed
    assert set(outputs["solver_status"]) == {0, *deaf}


@each_model
def test_the_manifest_names_the_files(name, fmus, tmp_path):
    folder = unzipped(fmus[name], tmp_path)
    root = etree.parse(folder / "fmi-ls-manifest.xml").getroot()
    assert root.tag == "fmiReferences"
    space = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert root.get(f"{space}fmi-ls-name") == folder.name
    named = {e.get("source"): e.get("role") for e in root}
    assert named == {f"{name}_in.csv": "testcase", f"{name}_out.csv": "result"}
    assert {p.name for p in folder.iterdir()} == {*named, "fmi-ls-manifest.xml"}


@each_model
@pytest.mark.parametrize("step", [None, 1e-4, 0.1])
@pytest.mark.slow
def test_fmpy_simulates_with_any_step_and_gets_numbers(name, step, fmus, tmp_path):
    options = {} if step is None else {"output_interval": step, "stop_time": max(0.02, 3 * step)}
    if name not in ("ThrustWasher", "OilSump"):  # these cost little and end within seconds
        options.pop("stop_time", None)
    folder = unzipped(fmus[name], tmp_path)
    for driven in ({}, {"input": read_csv(folder / f"{name}_in.csv")}):
        found = simulated(fmus[name], **driven, **options)
        assert len(found) > 3
        for column in found.dtype.names:
            assert np.isfinite(found[column]).all(), column
        assert (found["solver_status"] < 10).all()
