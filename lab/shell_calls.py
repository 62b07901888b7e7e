"""Which C file of the shell calls which: ``python -m lab.shell_calls``.

A file calls another one if it names, before a bracket, a function that is defined there and is not
static; a macro of a header stands for what it names. Of two files of one name (the two sides that
dispatch to kernels) an FMU has one: they count as one.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "fmu_src"
NO_CODE = re.compile(r'/\*.*?\*/|"(?:\\.|[^"\\\n])*"|^#\s*(?:include|error)[^\n]*', re.S | re.M)
DEFINED = re.compile(r"^(static )?\b(?!typedef)\w[\w \t*]*?\b(\w+)\([^;{}]*\)\s*\{", re.M)
CALLED = re.compile(r"\b(\w+)\(")
MACRO = re.compile(r"^#\s*define (\w+)\(.*\n?", re.M)


def code(path: Path) -> str:
    """Return a C file without comments, texts and includes, continued lines as one."""
    return NO_CODE.sub(" ", path.read_text("utf-8").replace("\\\n", " "))


def called(text: str, macros: Mapping[str, str]) -> set[str]:
    """Return the names before brackets, those within macros too."""
    names = set(CALLED.findall(text))
    return names.union(*(called(macros[n], {}) for n in names & macros.keys()))


def calls(files: Iterable[Path]) -> dict[str, dict[str, set[str]]]:
    """Return the functions that a file takes from others: file -> other file -> names."""
    texts: dict[str, str] = defaultdict(str)
    macros: dict[str, str] = {}
    for path in sorted(files):
        text = code(path)
        if path.suffix == ".h":
            macros |= {m[1]: m[0].partition(")")[2] for m in MACRO.finditer(text)}
        else:
            texts[path.stem] += text
    own = {stem: DEFINED.findall(text) for stem, text in texts.items()}
    home = {n: stem for stem, names in own.items() for static, n in names if not static}
    found: dict[str, dict[str, set[str]]] = {stem: defaultdict(set) for stem in texts}
    for stem, text in texts.items():
        for name in (called(text, macros) & home.keys()) - {n for _, n in own[stem]}:
            found[stem][home[name]].add(name)
    return found


def graph(files: Iterable[Path]) -> dict[str, set[str]]:
    """Return which files each one calls, by stem."""
    return {stem: set(others) for stem, others in calls(files).items()}


def main() -> None:
    """Print the calls; ``structure.py`` finds circles in them."""
    for stem, others in calls(FOLDER.rglob("*.[ch]")).items():
        for other, names in sorted(others.items()):
            print(f"{stem} -> {other}: {' '.join(sorted(names))}")


if __name__ == "__main__":
    main()
