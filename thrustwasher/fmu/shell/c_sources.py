"""The folder sources of an FMU: shell, tables and kernels as C99 that needs libm and nothing else.

The kernels are those of the libraries, written in C by wasm2c; the shell is the same. Names that
files share begin with the model's, so that several FMUs can be linked into one program.
"""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from ...model.registry import kernel_of
from ...native import digest, shipped
from ...native.compiling.portable import identity, portable
from ...native.files import Note
from ...templates import filled
from ..description.interface import Interface
from ..package.model_sources import source_folder
from . import c_tables
from .platform_libraries import table_alone

FOLDER, BUILD, NAMES = "sources", "buildDescription.xml", "names.h"
# Of the shell, for libraries alone: the dispatch to objects, that of the folder portable is taken;
# and where a library lies.
OF_LIBRARIES = ("dispatch.c", "library_file.c")
# Functions and tables as headers declare them, from the start of a line.
DECLARED = re.compile(r"^(?!static|typedef|return)\w[\w *]*?\b(\w+)\([^;{}]*\);", re.M)
TABLE = re.compile(r"^extern const \w+ (\w+)\[\];", re.M)


def is_shipped(kernel: str) -> bool:
    """Tell if the C of a kernel module is in the package and fresh."""
    return bool(shipped.portable(kernel, identity(kernel)))


def source_files(shown: Interface, fmi: int, note: Note, guid: str) -> dict[str, bytes]:
    """Return file name -> content of the folder sources, for one version of FMI.

    What part.bin says, ``guid`` among it, is compiled in, and the map of a model that has nothing
    else: these sources read no file, but for a washer's maps next to its solver.

    The C of the kernels is what is shipped; of a model without it is made now, which takes wasm2c
    and zig (EnvironmentProblem says so).
    """
    spec, other = shown.spec, f"fmi{min(c_tables.VERSIONS) + max(c_tables.VERSIONS) - fmi}"
    own = source_folder()
    found = {
        file.name: digest.read(file)
        for file in (*_c_files(own / "shell"), *_c_files(own / "portable"))
        if not file.name.startswith(other)
        and not (file.parent == own / "shell" and file.name in OF_LIBRARIES)
    }
    found |= {name: text.encode() for name, text in c_tables.sources(shown).items()}
    found |= kernel_in_c(spec.kernel, note)
    found[c_tables.PART_IN_C] = c_tables.part_in_c(shown, guid).encode()
    table = table_alone(spec)
    if table:
        found[c_tables.TABLE_IN_C] = c_tables.table_in_c(
            table, kernel_of(spec).TABLE["HEADER"]
        ).encode()
    found[NAMES] = _names(spec.name, found, bool(table)).encode()
    for name in found:
        if name.endswith(".c"):
            found[name] = f'#include "{NAMES}"\n'.encode() + found[name]
    if fmi == max(c_tables.VERSIONS):
        described = filled(
            Path(__file__).parent / f"{BUILD}.jinja", name=spec.name, files=compiled(found)
        )
        found[BUILD] = described
    return found


def compiled(files: Mapping[str, bytes]) -> Sequence[str]:
    """Return the names of the files that are compiled."""
    return sorted(name for name in files if name.endswith(".c"))


def kernel_in_c(kernel: str, note: Note) -> dict[str, bytes]:
    """Return module.c and module.h of a kernel module."""
    found = shipped.portable(kernel, identity(kernel))
    if found:
        return found
    note(f"the C sources of {shipped.short(kernel)} are not shipped: wasm2c writes them")
    return portable(kernel, (source_folder() / "portable" / "wasm.h").read_text("utf-8"), note)


def _c_files(folder: Path) -> list[Path]:
    return sorted(f for f in folder.iterdir() if f.suffix in (".c", ".h"))


def _names(model: str, files: Mapping[str, bytes], has_table: bool) -> str:
    """Return the header that puts the model's name in front of what the files share."""
    texts = [text.decode() for name, text in files.items() if name.endswith(".h")]
    shared = {name for text in texts for kind in (DECLARED, TABLE) for name in kind.findall(text)}
    return "\n".join(
        [
            "/* Generated: what the files share is named after the model. */",
            "#ifndef THRUSTWASHER_NAMES_H",
            "#define THRUSTWASHER_NAMES_H",
            "",
            *(
                f"#if !defined(FMI{fmi}_FUNCTION_PREFIX) "
                f"&& !defined(FMI{fmi}_OVERRIDE_FUNCTION_PREFIX)\n"
                f"#define FMI{fmi}_FUNCTION_PREFIX {model}_\n"
                "#endif"
                for fmi in c_tables.VERSIONS
            ),
            *(f"#define {name} {model}_{name}" for name in sorted(shared)),
            "",
            "#define PART_COMPILED_IN",
            *(["#define TABLE_COMPILED_IN"] if has_table else []),
            "",
            "#endif",
            "",
        ]
    )
