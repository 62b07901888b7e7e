"""Check or renew golden records: ``python -m lab.golden {--check,--write} [NAME ..] [--why TEXT]``.

Without a name all of them; the whole run takes less than two minutes of processor time.
"""

import argparse
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from lab.golden.cases import RECORDED, Values
from lab.golden.record import FOLDER, Difference, Record, differences, read, versions, write

MOST_SHOWN = 40  # differences of one record
Recorded = Mapping[str, tuple[str, Callable[[], Values]]]


def check(names: Iterable[str], recorded: Recorded, folder: Path = FOLDER) -> list[Difference]:
    """Compute names anew and return where they differ from what is kept; each is told."""
    found: list[Difference] = []
    for name in names:
        kept = read(name, folder)
        now, seconds = _computed(name, recorded)
        own = differences(name, kept, now)
        print(f"{name}: {len(kept.values)} values, {len(own)} differ ({seconds:.0f} s)", flush=True)
        print(*own[:MOST_SHOWN], sep="\n", end="\n" if own else "")
        if len(own) > MOST_SHOWN:
            print(f"{name}: and {len(own) - MOST_SHOWN} more")
        if own and kept.kind == "numbers" and kept.made_with != now.made_with:
            print(f"{name}: made with {dict(kept.made_with)}, now {dict(now.made_with)}")
        found += own
    return found


def renew(names: Iterable[str], why: str, recorded: Recorded, folder: Path = FOLDER) -> list[str]:
    """Compute names anew and write those that moved, with the reason; return their names."""
    moved = []
    for name in names:
        now, _ = _computed(name, recorded)
        there = (folder / f"{name}.json").exists()
        own = differences(name, read(name, folder), now) if there else []
        if own or not there:
            write(name, now._replace(why=why), folder)
            moved.append(name)
        print(f"{name}: {f'{len(own)} values moved' if there else 'new'}", flush=True)
    return moved


def _computed(name: str, recorded: Recorded) -> tuple[Record, float]:
    kind, compute = recorded[name]
    began = time.process_time()
    values = compute()
    return Record(kind, values, made_with=versions()), time.process_time() - began


def main(argv: Sequence[str] | None = None) -> int:
    """Return 0, or 1 if something differs from its record."""
    parser = argparse.ArgumentParser("python -m lab.golden", description=__doc__.split("\n")[0])
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true", help="compute and compare")
    what.add_argument("--write", action="store_true", help="renew those that moved")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(RECORDED)}")
    parser.add_argument("--why", metavar="TEXT", help="the reason, kept with what is renewed")
    options = parser.parse_args(argv)
    if unknown := [name for name in options.names if name not in RECORDED]:
        parser.error(f"NAME = {unknown[0]}, allowed: {', '.join(RECORDED)}")
    names = options.names or list(RECORDED)
    if options.check:
        return 1 if check(names, RECORDED) else 0
    if not options.why:
        parser.error("--why is missing: the reason why numbers moved")
    renew(names, options.why, RECORDED)
    return 0


if __name__ == "__main__":
    sys.exit(main())
