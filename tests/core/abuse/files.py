"""Damaged files of every kind, each accepted with its right meaning or refused by name."""

import json
import math
import tomllib
import zipfile
from contextlib import closing, redirect_stderr, redirect_stdout
from dataclasses import fields
from importlib import resources
from io import StringIO
from pathlib import Path

import damage
import numpy as np
from calls import REFUSED, RIGHT, Wrong, say_if_wrong
from chart_records import cell, group, record, sample

from lab import chart
from thrustwasher import ParameterError, SolveError
from thrustwasher.cli import main
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.ladder.error_table import read_tables
from thrustwasher.shift import load_scene
from thrustwasher.storage.digests import DATA
from thrustwasher.storage.journal import Journal
from thrustwasher.studio.sweep.run_sweep import journal_of, run_sweep
from thrustwasher.washer.kernels.map import map_layout as L
from thrustwasher.washer.map import map_file
from thrustwasher.washer.map.map_plan import pieces_at

OVER = {"load": "10:200:10", "speed": "50:300:50"}


def command(*words):
    """Run a command in this process, one of the lab too; return status, output and messages."""
    out, said = StringIO(), StringIO()
    words = [str(w) for w in words]
    with redirect_stdout(out), redirect_stderr(said):
        status = chart.main(words[1:]) if words[0] == "chart" else main(words)
    return status, out.getvalue(), said.getvalue()


def one_line(error, name):
    """Return REFUSED if the refusal is one line that names the file."""
    text = str(error)
    if (
        "\n" in text.strip()
        or name not in text
        or not isinstance(error, ParameterError | SolveError | EnvironmentProblem)
    ):
        raise Wrong(f"refused without a name: {error!r}")
    return REFUSED


class Scenes:
    """Scene files: what is accepted has every number of the file in its place."""

    def __init__(self, folder):
        self.path = Path(folder) / "spoiled.toml"
        builtin = resources.files("thrustwasher.shift") / "scenes"
        self.texts = [f.read_bytes() for f in builtin.iterdir() if f.name.endswith(".toml")]

    def __call__(self, rng):
        data = rng.choice(self.texts)
        for _ in range(rng.choice([1, 1, 2])):
            data = damage.text(rng, data)
        self.path.write_bytes(data)
        try:
            scene = load_scene(self.path)
        except ParameterError as error:
            return one_line(error, "scene")
        table = tomllib.loads(data.decode())
        found = [k for k in ("step", "stop_time") if _differs(table.get(k), getattr(scene, k))]
        for name, part in scene.parts.items():
            found += [
                f"{name}.{f.name}"
                for f in fields(part.params)
                if _differs(table.get(name, {}).get(f.name), getattr(part.params, f.name))
            ]
        say_if_wrong(found, data)
        return RIGHT


def _differs(written, taken):
    """Tell if a bare number of the file is another one in the scene."""
    if isinstance(written, bool) or not isinstance(written, int | float):
        return False
    return float(written) != taken or not math.isfinite(taken)


class Cards:
    """Tables of errors: refused, or the tables that were written."""

    def __init__(self, folder):
        self.path = Path(folder) / "spoiled.json"
        whole = sorted((DATA / "error_tables").glob("*.json"))
        self.files = [(path.read_bytes(), read_tables(path)) for path in whole]

    def __call__(self, rng):
        data, tables = rng.choice(self.files)
        self.path.write_bytes(damage.text(rng, data))
        try:
            found = read_tables(self.path)
        except ParameterError as error:
            return one_line(error, "spoiled.json")
        say_if_wrong([] if found == tables else ["another table"], self.path.read_bytes())
        return RIGHT


class Maps:
    """Map files: refused, or the map that was written."""

    def __init__(self, folder):
        self.path = Path(folder) / "spoiled.twm"
        terms = [5.0] * L.N_PIECES
        at = pieces_at(terms, terms)
        data = np.zeros(L.DATA + int(at[-1]))
        data[L.KIND], data[L.SIZE] = L.MAGIC, len(data)
        data[L.TERMS : L.IDENTITY] = [*terms, *terms, *at]
        data[L.DATA :] = np.float32(np.linspace(-1.0, 3.0, int(at[-1])))
        self.metadata = {"kind": "washer map", "box": {"load": [1.0, 2.0]}}
        self.data, self.whole = data, map_file.pack(data, self.metadata)

    def __call__(self, rng):
        self.path.write_bytes(damage.bits(rng, self.whole))
        map_file._read.cache_clear()
        try:
            found = map_file.read_map(self.path)
        except ParameterError as error:
            return one_line(error, "spoiled.twm")
        same = np.array_equal(found.data, self.data) and found.metadata == self.metadata
        say_if_wrong([] if same else ["another map"])
        return RIGHT


class SweepJournals:
    """Journals of sweeps: the sweep is refused, or ends with the very table of a whole run."""

    def __init__(self, folder):
        self.out = Path(folder) / "spoiled.csv"
        run_sweep("gearmesh", OVER, out=self.out, workers=1)
        self.table = self.out.read_bytes()

        def stop(done, total):
            if done >= 60:
                raise KeyboardInterrupt

        try:
            run_sweep("gearmesh", OVER, out=self.out, workers=1, progress=stop)
        except KeyboardInterrupt:
            self.begun = journal_of(self.out).read_bytes()

    def __call__(self, rng):
        journal_of(self.out).write_bytes(damage.bits(rng, self.begun))
        self.out.unlink(missing_ok=True)
        try:
            run_sweep("gearmesh", OVER, out=self.out, workers=1)
        except ParameterError as error:
            return one_line(error, "spoiled.csv.journal")
        same = self.out.read_bytes() == self.table
        say_if_wrong([] if same else ["another table"])
        return RIGHT


class MapJournals:
    """Journals of maps: refused, or every line that counts as solved is the one that was solved."""

    def __init__(self, folder):
        self.path = Path(folder) / "spoiled.twm.journal"
        self.identity = {"parameters": "p", "box": "b", "fidelity": "fine", "kernels": "k"}
        self.lines = np.random.default_rng(1).normal(size=(12, 240))
        with closing(Journal(self.path, self.identity, "map")) as journal:
            for i in range(8):
                journal.append(i, self.lines[i : i + 1], np.zeros((1, 1), np.int32))
        self.begun = self.path.read_bytes()

    def __call__(self, rng):
        self.path.write_bytes(damage.bits(rng, self.begun))
        lines, flags = np.full_like(self.lines, np.nan), np.zeros((12, 1), np.int32)
        try:
            with closing(Journal(self.path, self.identity, "map")) as journal:
                done = journal.load(lines, flags)
        except ParameterError as error:
            return one_line(error, "spoiled.twm.journal")
        say_if_wrong([] if np.array_equal(lines[done], self.lines[done]) else ["other lines"])
        return RIGHT


class Calibrations:
    """Measured points: refused with file and line, or fitted with finite numbers."""

    def __init__(self, folder, data):
        self.path, self.whole = Path(folder) / "spoiled.csv", data

    def __call__(self, rng):
        self.path.write_bytes(damage.text(rng, self.whole))
        status, out, said = command("calibrate", self.path, "--json")
        lines = [x for x in said.splitlines() if not x.startswith("warning")]
        if status == 0:
            json.loads(out, parse_constant=_no_number)
            return RIGHT
        say_if_wrong(
            []
            if status in (2, 3) and len(lines) == 1 and "defect" not in said
            else ["no named refusal"],
            status,
            said,
        )
        return REFUSED


def _no_number(text):
    raise Wrong(f"{text} with status 0")


class Charts:
    """Records of charts: refused, or drawn as they were measured."""

    def __init__(self, folder, record, seal=True, draw=True):
        from thrustwasher.storage.digests import sealed

        self.draw = draw
        self.path, self.out = Path(folder) / "spoiled.json", Path(folder) / "drawn"
        self.record, self.seal = record, seal
        text = json.dumps(sealed(record) if seal else record, indent=1)
        self.whole = text.encode()

    def __call__(self, rng):
        self.path.write_bytes(damage.text(rng, self.whole))
        if not self.draw:
            return self.read()
        status, _, said = command("chart", "--draw", self.path, "--out", self.out)
        if status == 0:
            drawn = json.loads((self.out / "chart.json").read_text("utf-8"))
            drawn.pop("check", None)
            same = not self._is_sealed() or drawn == self.record
            say_if_wrong([] if same else ["another record"])
            return RIGHT
        one = status == 2 and said.count("\n") == 1 and "spoiled.json" in said
        say_if_wrong([] if one and "defect" not in said else ["no named refusal"], status, said)
        return REFUSED

    def read(self):
        from lab.chart import _read

        try:
            found = _read(str(self.path))
        except ParameterError as error:
            return one_line(error, "spoiled.json")
        sealed = found.pop("check", None) is not None
        say_if_wrong([] if found == self.record or not sealed else ["another record"])
        return RIGHT

    def _is_sealed(self):
        """Tell if the spoiled file still has its checksum: one without is taken as it is."""
        return self.seal and b'"check"' in self.path.read_bytes()


class Archives:
    """FMU files: refused by name, or whole; what is inside is the importer's to check."""

    def __init__(self, folder, fmu):
        self.path, self.whole = Path(folder) / "Spoiled.fmu", Path(fmu).read_bytes()
        with zipfile.ZipFile(fmu) as archive:
            self.files = {n: archive.read(n) for n in archive.namelist()}

    def __call__(self, rng):
        from thrustwasher.fmu.running.loading import unpack

        self.path.write_bytes(damage.bits(rng, self.whole))
        try:
            folder = unpack(self.path)
        except (ParameterError, EnvironmentProblem) as error:
            return one_line(error, "Spoiled.fmu")
        found = {
            str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()
        }
        other = [n for n, data in found.items() if self.files.get(n, data) != data]
        say_if_wrong([f"{n} is another" for n in other])
        return RIGHT


def chart_record():
    """Return a small record, as ``python -m lab.chart`` measures it."""
    failed = {"n_failed": 1, "failures": {"b": "SINGULAR"}}
    samples = [sample("closed", 1e-6, 0.5), sample("field", 2e-4, 2e-3, **failed)]
    return record("clutch", samples, [group([cell()])])
