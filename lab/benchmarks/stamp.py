"""Tie tables of errors to the kernels as they are now: ``python -m lab.benchmarks.stamp``.

For a change of the kernels' sources that moves no number: files renamed or split, comments, a
function next to the others. The errors stay as they were measured; the tests of the shipped tables
solve points of each again. After any other change measure anew:
``python -m lab.verify``.
"""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from thrustwasher.ladder.error_table import ErrorTable, read_tables, sources_of, write_tables
from thrustwasher.storage.digests import DATA


def stamped(table: ErrorTable) -> ErrorTable:
    """Return a table tied to today's kernels."""
    levels = [
        replace(r, sources=sources_of(table.model, r.fidelity, r.files)) for r in table.levels
    ]
    return replace(table, levels=tuple(levels))


def main(arguments: Sequence[str]) -> int:
    """Stamp the tables of a folder, the package's if none is named."""
    if len(arguments) > 1:
        print("usage: python -m lab.benchmarks.stamp [FOLDER]", file=sys.stderr)
        return 2
    changed, known = 0, 0
    for path in sorted((Path(arguments[0]) if arguments else DATA / "error_tables").glob("*.json")):
        old = read_tables(path)
        new = [stamped(table) for table in old]
        write_tables(new, path)
        changed += sum(a != b for a, b in zip(old, new, strict=True))
        known += len(old)
    print(f"{changed} of {known} tables stamped")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
