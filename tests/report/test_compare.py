"""``shift --compare``: what can be laid over each other, and what is refused in one line."""

import json
import re
from dataclasses import replace

import pytest
import shift_stand_in

from thrustwasher import cli
from thrustwasher.model.registry import find_spec
from thrustwasher.report.shift.shift_data import VERSION, page_data, run_data
from thrustwasher.report.shift.shift_record import Part

RECORD = shift_stand_in.record(mesh=True)
MARK = '<script type="application/json" id="data">{}</script>'


def report(folder, record=RECORD, **more):
    """Write a report's folder with what a comparison reads of it."""
    folder.mkdir()
    told = json.dumps(page_data([run_data(record, {}) | more]))
    (folder / "report.html").write_text(MARK.format(told), "utf-8")
    (folder / "overview.png").write_bytes(b"\x89PNG")
    return folder


def compared(*words, out):
    return cli.main(["shift", "--compare", *map(str, words), "--out", str(out)])


def test_a_report_beside_itself_differs_nowhere(tmp_path, capsys):
    one = report(tmp_path / "one")
    assert compared(one, one, out=tmp_path / "both") == 0
    text = (tmp_path / "both" / "compare.html").read_text("utf-8")
    rows = re.findall(r"<tr><td>(.*?)</td>.*?<td class=\"number\">([^<]*)</td></tr>", text)
    assert len(rows) > 3 and all(more.startswith("0") for _, more in rows)
    assert 'id="slip"' in text
    said = capsys.readouterr().err.splitlines()
    assert said and all(line.startswith(("warning: A: ", "warning: B: ")) for line in said)


def test_runs_of_other_models_and_lengths_are_laid_over_each_other(tmp_path):
    other = shift_stand_in.record(washer=False)
    signals = {name: values[:2200] for name, values in other.signals.items()}
    short = replace(other, time=other.time[:2200], signals=signals)
    folders = report(tmp_path / "one"), report(tmp_path / "two", short)
    assert compared(*folders, out=tmp_path / "both") == 0
    assert compared(*reversed(folders), out=tmp_path / "back") == 0


def data(**more):
    return MARK.format(json.dumps({"version": VERSION, "runs": [{"title": "x"}], **more}))


REFUSED = {
    "no data": "<html></html>",
    "a list": MARK.format("[1]"),
    "cut": MARK.format('{"version"'),
    "deep": MARK.format("[" * 100_000),
    "an older version": data(version=VERSION - 1),
    "two runs": data(runs=[{}, {}]),
    "a run without its signals": data(),
}


@pytest.mark.parametrize("text", REFUSED.values(), ids=REFUSED)
def test_a_folder_that_is_no_report_of_this_version_is_refused_in_a_line(text, tmp_path, capsys):
    bad = tmp_path / "bad"
    bad.mkdir()
    (bad / "report.html").write_text(text, "utf-8")
    good = report(tmp_path / "good")
    assert compared(good, bad, out=tmp_path / "out") == 2
    err = capsys.readouterr().err
    said = f"{bad / 'report.html'}: is no report of one shift by this version, run it again\n"
    assert err.endswith(said) and err.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_it_is_said_what_is_compared_and_which_parameters_differ(tmp_path):
    clutch = Part("clutch", find_spec("clutch"), {"faces": 6, "fidelity": "stribeck"})
    parts = [clutch if part.name == "clutch" else part for part in RECORD.parts]
    other = replace(RECORD, step=5e-4, parts=parts)
    folders = report(tmp_path / "one"), report(tmp_path / "two", other)
    assert compared(*folders, out=tmp_path / "both") == 0
    text = (tmp_path / "both" / "compare.html").read_text("utf-8")
    rows = re.findall(r"<tr><td>(.*?)</td><td>(.*?)</td><td>(.*?)</td></tr>", text)
    told = {name: (a, b) for name, a, b in rows}
    assert told["from"] == tuple(f"folder {folder}" for folder in folders)
    assert told["communication step"] == ("1 ms", "500 µs")
    assert told["master"] == ("gauss-seidel",) * 2 and told["scene"][0].startswith("stand-in: ")
    assert "clutch stribeck" in told["rungs"][1]
    differ = {name: pair for name, pair in told.items() if name.startswith("clutch: ")}
    assert [pair[1] for pair in differ.values()] == ["6"]


def test_a_report_of_several_shifts_and_one_without_its_picture_are_refused(tmp_path, capsys):
    good, many = report(tmp_path / "good"), report(tmp_path / "many", shifts=24)
    assert compared(good, many, out=tmp_path / "out") == 2
    assert capsys.readouterr().err.endswith("report.html: has several shifts, allowed: one\n")
    (good / "overview.png").unlink()
    assert compared(good, good, out=tmp_path / "out") == 2
    assert capsys.readouterr().err.endswith("good: overview.png: No such file or directory\n")
    assert not (tmp_path / "out").exists()


def test_what_a_folder_holds_stays_when_a_comparison_is_put_beside_it(tmp_path):
    good = report(tmp_path / "good")
    before = (good / "report.html").read_bytes()
    assert compared(good, good, out=good) == 0
    assert sorted(p.name for p in good.iterdir()) == ["compare.html", "overview.png", "report.html"]
    assert (good / "report.html").read_bytes() == before
