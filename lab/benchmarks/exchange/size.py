"""Size of FMUs with and without model exchange, linux64 alone: a table in Markdown.

python lab/benchmarks/exchange/size.py [UNIT ...]

Both libraries are compiled and linked from nothing, one without the kernels' entries for model
exchange and with the shell's tables of a unit that has none. The FMU is the built one with either
library, packed as ZIP packs it.
"""

import argparse
import importlib
import os
import subprocess
import sys
import tempfile
import zipfile
import zlib
from dataclasses import replace
from pathlib import Path

from thrustwasher.fmu.fmu_cache import fmu_paths
from thrustwasher.fmu.shell import platform_libraries as libraries
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.native import library as own
from thrustwasher.native import shipped
from thrustwasher.native.compiling import emit, lower

OWN = "_WITHOUT"  # in the environment of the process that compiles


def emitted(name, file):
    """Write the bitcode of a kernel module, without model exchange if the environment says so."""
    from thrustwasher.native.compiling import callbacks

    every = callbacks.entries
    if os.environ[OWN] == "1":
        callbacks.EXCHANGE_ABI.clear()
        callbacks.entries = lambda kernel: [e for e in every(kernel) if "_exchange" not in e.symbol]
    Path(file).write_bytes(emit.module(importlib.import_module(name)).as_bitcode())


def library(spec, without):
    """Return the library of a unit for this machine's platform."""
    platform = libraries.local_platform(spec.kernel)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "module.bc"
        given = emit.environment(f"{folder}/numba") | {OWN: str(int(without))}
        given["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
        order = [sys.executable, __file__, "--emit", spec.kernel, str(file)]
        subprocess.run(order, env=given, check=True, capture_output=True)
        bitcode = file.read_bytes()
    name = shipped.short(spec.kernel)
    code = {
        (platform.name, level.name): lower.object_code(bitcode, platform, level, name)
        for level in platform.levels
    }
    libraries.objects = lambda kernel, platforms, note: code
    bare = replace(spec, exchange=None) if without else spec
    every = own.symbols
    own.symbols = lambda kernel: [n for n in every(kernel) if "_exchange" not in n or not without]
    try:
        return libraries.linked(bare, platform, libraries.local_linker())
    finally:
        own.symbols = every


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("units", nargs="*")
    parser.add_argument("--emit", nargs=2, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.emit:
        emitted(*given.emit)
        return
    chosen = [s for s in all_specs(helpers=True) if s.exchange]
    chosen = [find_spec(u) for u in given.units] or chosen
    print("| FMU | library, kB | FMU, kB | more, % |\n|---|---|---|---|")
    for spec in chosen:
        both = [library(spec, without) for without in (True, False)]
        with zipfile.ZipFile(fmu_paths([spec.name], "native")[spec.name]) as archive:
            about = archive.infolist()
        rest = sum(i.compress_size for i in about if not i.filename.endswith(".so"))
        sizes = [rest + len(zlib.compress(b)) for b in both]
        cells = [
            f"`{spec.name}`",
            ", ".join(f"{len(b) / 1e3:.0f}" for b in both),
            ", ".join(f"{s / 1e3:.0f}" for s in sizes),
            ", ".join(f"{100.0 * (b / a - 1.0):.1f}" for a, b in (map(len, both), sizes)),
        ]
        print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
