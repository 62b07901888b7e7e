"""Write the places of parameters and outputs into the kernels: ``python -m lab.places [--check]``.

Kernels see no dataclass: what is compiled are numbers. Their names follow from the fields of the
model's parameters and from its outputs, and stand between ``# places: PREFIX of WHAT`` and ``# end
of places`` in ``kernels/layout.py``, of a small model ``kernels/step.py``. Run it after a parameter
or an output was added; a test compares.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import fields
from pathlib import Path

from thrustwasher.model.registry import HELPERS, MODELS, find_model
from thrustwasher.model.spec import ModelSpec

ROOT = Path(__file__).parents[1]
SECTION = re.compile(r"(# places: (\w+) of (\w+)\n)(.*?)(# end of places\n)", re.DOTALL)
WIDTH = 100


def names_of(spec: ModelSpec, prefix: str, what: str) -> list[str]:
    """Return the names of all places; the last one is how many there are."""
    if what == "parameters":
        own, end = [*(f.name for f in fields(spec.params)), "fidelity"], "N_PARAM"
    else:
        own, end = list(spec.real_outputs), "NOUT"
    return [*(prefix + name.upper() for name in own), end]


def lines_of(names: Sequence[str]) -> Iterator[str]:
    """Yield assignments of 0, 1, .. to names, as many in a line as fit.

    Of a numbered row the first has a name, the others follow.
    """
    first, end = 0, len(names)
    while first < end:
        last = first + 1
        while last < end and _is_named(names[last]) and _fits(names, first, last + 1):
            last += 1
        yield _line(names, first, last)
        first = next((k for k in range(last, end) if _is_named(names[k])), end)


def _is_named(name: str) -> bool:
    return not re.search(r"_([2-9]|\d\d+)$", name)


def _fits(names: Sequence[str], first: int, last: int) -> bool:
    return len(_line(names, first, last)) <= WIDTH


def _line(names: Sequence[str], first: int, last: int) -> str:
    value = f"range({first}, {last})" if last > first + 1 else str(first)
    return f"{', '.join(names[first:last])} = {value}"


def written(text: str, spec: ModelSpec) -> str:
    """Return a module's text with the places of a model in its sections."""

    def section(match: re.Match[str]) -> str:
        head, prefix, what, _, end = match.groups()
        return head + "".join(f"{line}\n" for line in lines_of(names_of(spec, prefix, what))) + end

    return SECTION.sub(section, text)


def modules() -> Iterator[tuple[Path, ModelSpec]]:
    """Yield the module with the places of each model, and what the model takes and gives."""
    for key, home in (MODELS | HELPERS).items():
        folder = ROOT / home.replace(".", "/") / "kernels"
        path = folder / "layout.py"
        yield path if path.exists() else folder / "step.py", find_model(key).spec


def main(arguments: Sequence[str]) -> int:
    """Write what is stale, or with ``--check`` say what would be written."""
    stale = 0
    for path, spec in modules():
        old = path.read_text("utf-8")
        if (new := written(old, spec)) != old:
            stale += 1
            print(path.relative_to(ROOT))
            if arguments != ["--check"]:
                path.write_text(new, "utf-8")
    return stale if arguments == ["--check"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
