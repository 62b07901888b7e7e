"""The folder that the FMI cross-check asks an exporting tool for: FMUs with reference results."""

import tempfile
from collections.abc import Sequence
from pathlib import Path

from ..errors import ParameterError
from ..models._spec import ModelSpec
from . import archive
from .build import Note, build
from .interface import all_specs, find_spec
from .native_contents import chosen
from .reference import input_rows, reference_run, table
from .registry import package_version
from .xml_parts import default_experiment

TOOL = "thrustwasher"
MOST_OUTPUTS = 9  # with time ten columns, as the rules recommend
# Of models with more: what tells most.
SHOWN = {
    "ShiftTransmission": (
        "engine_speed", "output_speed", "ring_speed", "clutch_reaction", "brake_reaction",
        "clutch_heat", "washer_load", "mesh_load", "clutch_locked"),
}  # fmt: skip
MOST_BYTES = 1_000_000
TOLERANCE = 1e-6  # of the comparison; processors and C libraries differ by about 1e-13
DIGITS = 17  # full precision
FOLDERS = {2: {"linux64": "linux64", "win64": "win64"},
           3: {"x86_64-linux": "linux64", "x86_64-windows": "win64"}}  # fmt: skip
README = """# {name}

{help}.

Exported by {tool} {version}: `{tool} build {name} --fmi {fmi} --cross-check DIR`. FMI {fmi}.0
co-simulation; the FMU needs nothing but the C library of the operating system.

The experiment: {stop:g} s in steps of {step:g} s with the inputs of `{name}_in.csv`, linear between
its rows. `{name}_ref.csv` was computed by the same model in Python, without an FMU: the inputs of a
step are those at its beginning, a row holds the outputs at its time. Enumerations and Booleans are
numbers. {state}

Documentation, equations and licences: `documentation/index.html` inside the FMU.
"""
STATES = {
    "linux64": "Run on Linux, x86-64.",
    "win64": "Run on Linux under wine, not on Windows itself.",
}


def write_cross_check(
    models: Sequence[str] | None, out: Path, fmi: int = 2, note: Note | None = None
) -> list[Path]:
    """Write ``out/fmus/<fmi>.0/cs/<platform>/thrustwasher/<version>/<Model>/`` and return these.

    Parameters
    ----------
    models
        FMU names or keys; None: all.
    out
        The root, as of a clone of the cross-check's repository.
    fmi
        2, or 3 with the platform names of FMI 3 (the rules themselves end at 2).
    note
        Is called with one sentence before each step that takes time.
    """
    if fmi not in FOLDERS:
        raise ParameterError(f"fmi = {fmi!r}, allowed: 2 or 3")
    specs = [find_spec(model) for model in models] if models else all_specs()
    folders = {f: p for f, p in FOLDERS[fmi].items() if p in chosen(None, _silent)}
    written = []
    for spec in specs:
        with tempfile.TemporaryDirectory() as temporary:
            (fmu,) = build([spec.key], fmi=fmi, out=Path(temporary), note=note)
            files = {fmu.name: fmu.read_bytes(), **reference(spec)}
        for folder, platform in folders.items():
            place = out / "fmus" / f"{fmi}.0" / "cs" / folder / TOOL / package_version() / spec.name
            for name, content in {**files, "README.md": _readme(spec, fmi, platform)}.items():
                archive.write(place / name, content)
            written.append(place)
    return written


def _silent(sentence: str) -> None:
    """Say nothing."""


def reference(spec: ModelSpec) -> dict[str, bytes]:
    """Return ``_ref.csv``, ``_ref.opt`` and, with inputs, ``_in.csv`` of the experiment."""
    stop, step = default_experiment(spec)
    options = {"StartTime": 0.0, "StopTime": stop, "StepSize": step, "RelTol": TOLERANCE}
    names = [signal.name for signal in spec.outputs]
    shown = list(SHOWN.get(spec.name, names[:MOST_OUTPUTS]))
    columns = [0, *(1 + names.index(name) for name in shown)]
    rows = [[row[i] for i in columns] for row in reference_run(spec, rounded=False)]
    files = {
        f"{spec.name}_ref.csv": table(shown, rows, DIGITS),
        f"{spec.name}_ref.opt": "".join(f"{n}, {x!r}\n" for n, x in options.items()).encode(),
    }
    if spec.inputs:
        given = table([s.name for s in spec.inputs], input_rows(spec), DIGITS)
        files[f"{spec.name}_in.csv"] = given
    for name, content in files.items():
        if len(content) > MOST_BYTES:
            raise ParameterError(f"{name} has {len(content)} bytes, allowed: {MOST_BYTES}")
    return files


def _readme(spec: ModelSpec, fmi: int, platform: str) -> bytes:
    stop, step = default_experiment(spec)
    return README.format(
        name=spec.name, help=spec.help, tool=TOOL, version=package_version(), fmi=fmi, stop=stop,
        step=step, state=STATES[platform],
    ).encode()  # fmt: skip
