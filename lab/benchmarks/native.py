"""Native FMUs in a C host: instantiation, steps, and what the protocol takes of them; medians.

``python -m lab.benchmarks.native [MODEL ...]``; all models by default. Needs Linux and gcc.
The protocol's share is timed on a library with the model's own tables and a step that does nothing.
"""

import argparse
import subprocess
import tempfile
from importlib import metadata
from pathlib import Path

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.shell import c_tables
from thrustwasher.fmu.shell.platform_libraries import headers as fmi_headers
from thrustwasher.fmu.shell.platform_libraries import library, sources
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.model.spec import ModelSpec
from thrustwasher.native import link
from thrustwasher.native.targets import PLATFORMS

GUID = "benchmark"
STEPS = {"washer": 20, "clutch": 2000, "gearmesh": 1000, "transmission": 2000}
EMPTY_STEPS = 100_000
EMPTY = """#include "kernel.h"
int tw_derive(double *par) { (void)par; return 0; }
int tw_rule(const double *par) { (void)par; return 0; }
int tw_step(double *par, double *inp, double *state, double *work, double *out, int32_t *iout,
            double t, double dt) {
    (void)par, (void)inp, (void)state, (void)work, (void)out, (void)iout, (void)t, (void)dt;
    return 0;
}
int tw_sens(double *par, double *inp, double *state, double *work, double *seed, double *dout) {
    (void)par, (void)inp, (void)state, (void)work, (void)seed, (void)dout;
    return 0;
}
"""


def headers() -> Path:
    return Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"


def empty_library(spec: ModelSpec) -> bytes:
    """Return a library of the shell with this model's tables and a step that does nothing."""
    files: dict[str, str | bytes] = {**sources(spec), **fmi_headers(), "empty.c": EMPTY}
    del files["dispatch.c"]  # that calls the kernels
    return link.shared_library(files, platform=PLATFORMS["linux64"], name="empty")


def timed(program: Path, made: Path, spec: ModelSpec, n: int) -> tuple[float, float, int]:
    """Return seconds to instantiate and initialize, seconds a step, and how often it failed."""
    found = interface(spec).variables
    starts = [v.start or 0.0 for v in found if v.causality == "input"]
    point = spec.profile[1][1:] if spec.profile else starts  # a point of the reference run
    inputs = [v.reference for v in found if v.causality == "input"]
    outputs = [v.reference for v in found if v.causality == "output" and v.type == "Real"]
    words = [len(inputs), *(x for pair in zip(inputs, point, strict=True) for x in pair)]
    words += [len(outputs), *outputs]
    done = subprocess.run(
        [program, made, GUID, str(n)],
        input=" ".join(map(str, words)),
        env={},
        cwd=made.parent,
        check=True,
        capture_output=True,
        text=True,
    )
    birth, step, bad = done.stdout.split()
    return float(birth), float(step), int(bad)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("models", nargs="*", help="models to time (default: all)")
    names = parser.parse_args().models
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        program = folder / "native"
        source = Path(__file__).with_suffix(".c")
        subprocess.run(
            ["gcc", "-std=gnu99", "-O2", "-I", headers(), source, "-o", program, "-ldl"], check=True
        )
        print(f"{'model':18}{'make + init [ms]':>18}{'step [us]':>12}{'protocol [us]':>15}")
        for spec in [find_spec(name) for name in names] or all_specs():
            made = folder / f"{spec.name}.so"
            (folder / c_tables.PART).write_bytes(c_tables.part_file(interface(spec), GUID))
            made.write_bytes(library(spec, platform="linux64"))
            birth, step, bad = timed(program, made, spec, STEPS.get(spec.key, 2000))
            made.write_bytes(empty_library(spec))
            _, protocol, _ = timed(program, made, spec, EMPTY_STEPS)
            print(
                f"{spec.name:18}{1e3 * birth:18.3f}{1e6 * step:12.3f}{1e6 * protocol:15.4f}"
                + (f"  {bad} failures" if bad else "")
            )


if __name__ == "__main__":
    main()
