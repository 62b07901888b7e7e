"""Reference results inside an FMU: a user runs the default experiment and compares."""

from pathlib import Path

import numpy as np

from ...model.spec import ModelSpec, Signal
from ...templates import filled
from ..description.interface import interface
from ..running.direct_instance import DirectInstance

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
ROWS = 100  # of the results, about: a row for each step would be half of the FMU
Rows = list[list[float]]


def reference_files(spec: ModelSpec) -> dict[str, bytes]:
    """Run the default experiment with the model's kernels and return the files that tell of it.

    The inputs of a step are those of ``<Model>_in.csv`` at its beginning, linear between the rows;
    a row of ``<Model>_out.csv`` holds the outputs at its time, the end of a step; about a hundred
    rows are kept. Written are what processors agree on: nine digits, and 0 for less than a
    millionth of the nominal value.
    """
    rows = reference_run(spec)
    kept = rows[:: max(1, len(rows) // ROWS)]
    what = "of the default experiment"
    listed: list[tuple[str, str, str, tuple[Signal, ...], Rows]] = [
        ("out", "result", f"outputs {what}, at the ends of some of its steps", spec.outputs, kept)
    ]
    if spec.profile:
        words = f"inputs {what}, linear between the rows"
        listed.insert(0, ("in", "testcase", words, spec.inputs, input_rows(spec)))
    related, files = [], {}
    for ending, role, meaning, signals, shown in listed:
        name = f"{spec.name}_{ending}.csv"
        related.append((name, role, meaning))
        files[name] = table([signal.name for signal in signals], shown)
    manifest = Path(__file__).with_name("fmi-ls-manifest.xml.jinja")
    files["fmi-ls-manifest.xml"] = filled(manifest, related=related)
    return {f"{FOLDER}/{name}": content for name, content in files.items()}


def input_rows(spec: ModelSpec) -> Rows:
    """Return rows of time and all inputs, linear between; one row where no input moves."""
    starts = [signal.start or 0.0 for signal in spec.inputs]
    return [list(row) for row in spec.profile] or [[0.0, *starts]]


def reference_run(spec: ModelSpec) -> Rows:
    """Return rows of time and all outputs over the default experiment."""
    stop, h = interface(spec).experiment
    profile = np.array(input_rows(spec))
    times = h * np.arange(round(stop / h) + 1)
    columns = [np.interp(times, profile[:, 0], values) for values in profile.T[1:]]
    points = np.reshape(columns, (len(columns), len(times))).T.tolist()
    with DirectInstance(spec) as model:
        model.initialize(0.0, dict(zip(model.input_names, points[0], strict=True)))
        rows = [[0.0, *_rounded(spec, model.outputs())]]
        for i, point in enumerate(points[:-1]):
            model.set_inputs(point)
            model.step(i * h, h)
            rows.append([(i + 1) * h, *_rounded(spec, model.outputs())])
    return rows


def _rounded(spec: ModelSpec, values: list[float]) -> list[float]:
    pairs = zip(spec.outputs, values, strict=True)
    return [0.0 if abs(x) < 1e-6 * (signal.nominal or 0.0) else x for signal, x in pairs]


def table(names: list[str], rows: Rows) -> bytes:
    """Return comma-separated values, time first."""
    head = ",".join(f'"{name}"' for name in ("time", *names))
    lines = [",".join(f"{x:.9g}" for x in row) for row in rows]
    return "\n".join([head, *lines, ""]).encode()
