"""The structure of the package, read from its imports: ``python benchmarks/structure.py``.

Prints what is counted; ``--draw FILE.svg`` draws the folders in layers, what imports above what is
imported. Imports inside functions and those for type checkers count like any other.
"""

from __future__ import annotations

import argparse
import ast
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "thrustwasher"
WIDTH = 3  # of an arrow at most


@cache
def modules() -> dict[str, Path]:
    """Return the package's modules: dotted name -> file."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
        found[name.removesuffix(".__init__")] = path
    return found


@cache
def imports() -> dict[str, set[str]]:
    """Return which modules of the package each one imports, wherever in the file it does so."""
    known = modules()
    found: dict[str, set[str]] = {name: set() for name in known}
    for name, path in known.items():
        package = name if path.name == "__init__.py" else name.rpartition(".")[0]
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            for target in _targets(node, package):
                if target in known and target != name:
                    found[name].add(target)
    return found


def _targets(node: ast.AST, package: str) -> Iterable[str]:
    """Return the modules that a statement imports, as far as names tell."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        above = package.split(".")[: len(package.split(".")) - node.level + 1]
        base = ".".join([*above, *([node.module] if node.module else [])]) if node.level else (
            node.module or ""
        )  # fmt: skip
        names = [f"{base}.{alias.name}" for alias in node.names]
        inside = [name for name in names if name in modules()]
        yield from inside
        if len(inside) < len(names):
            yield base


def circles(graph: Mapping[str, set[str]]) -> list[list[str]]:
    """Return the groups of modules that import each other, by Tarjan's method."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in sorted(graph[name]):
            if other not in index:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], index[other])
        if low[name] == index[name]:
            group = stack[stack.index(name) :]
            del stack[stack.index(name) :]
            if len(group) > 1:
                found.append(sorted(group))

    for name in graph:
        if name not in index:
            visit(name)
    return found


def folder_widths(top: Path = PACKAGE) -> Counter[str]:
    """Return the number of files in each folder of the package, or of another one."""
    found: Counter[str] = Counter()
    for path in top.rglob("*"):
        if path.is_file() and "__pycache__" not in path.parts:
            found[path.parent.relative_to(ROOT).as_posix()] += 1
    return found


def lines_of(paths: Iterable[Path]) -> int:
    """Return the number of lines of files."""
    return sum(len(path.read_text("utf-8").splitlines()) for path in paths)


def shell_sources() -> list[Path]:
    """Return the C files."""
    folders = (ROOT / "fmu_src", PACKAGE / "native")
    return sorted(
        path for folder in folders for end in ("*.c", "*.h") for path in folder.rglob(end)
    )


def repeated_stems() -> list[str]:
    """Return the names of modules that occur more than once."""
    stems = Counter(path.stem for path in modules().values() if path.stem != "__init__")
    return sorted(stem for stem, n in stems.items() if n > 1)


def room(module: str) -> str:
    """Return the folder below the package that a module belongs to; "" for those on top."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 and (PACKAGE / parts[1]).is_dir() else ""


def arrows() -> dict[tuple[str, str], int]:
    """Return how many imports go from one folder to another."""
    found: dict[tuple[str, str], int] = defaultdict(int)
    for name, others in imports().items():
        for other in others:
            pair = room(name), room(other)
            if pair[0] != pair[1] and all(pair):
                found[pair] += 1
    return dict(found)


def levels(pairs: Iterable[tuple[str, str]]) -> dict[str, int]:
    """Return the level of each folder: one above the highest of those it imports."""
    below: dict[str, set[str]] = defaultdict(set)
    for source, target in pairs:
        below[source].add(target)
        below.setdefault(target, set())
    found: dict[str, int] = {}

    def level(name: str) -> int:
        if name not in found:
            found[name] = 1 + max((level(other) for other in below[name]), default=-1)
        return found[name]

    for name in below:
        level(name)
    return found


def draw(path: Path) -> None:
    """Draw the folders in levels with their lines of code, and an arrow for each import."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "structure"
    from matplotlib.figure import Figure

    pairs = arrows()
    level = levels(pairs)
    sizes: Counter[str] = Counter()
    for name, file in modules().items():
        sizes[room(name)] += lines_of([file])
    rows: dict[int, list[str]] = defaultdict(list)
    for name in sorted(level):
        rows[level[name]].append(name)
    place = {
        name: ((k + 0.5) / len(row), float(y))
        for y, row in rows.items()
        for k, name in enumerate(row)
    }
    figure = Figure(figsize=(9.0, 1.0 + 0.85 * len(rows)), layout="constrained")
    axis = figure.add_subplot()
    for (source, target), n in pairs.items():
        (x0, y0), (x1, y1) = place[source], place[target]
        axis.annotate(
            "", (x1, y1 + 0.2), (x0, y0 - 0.2),
            arrowprops={"arrowstyle": "->", "color": "0.65", "lw": min(0.5 + n / 20.0, WIDTH)},
        )  # fmt: skip
    for name, (x, y) in place.items():
        axis.text(
            x, y, f"{name}\n{sizes[name] / 1000:.1f} k lines", ha="center", va="center", fontsize=9,
            bbox={"boxstyle": "round,pad=0.35", "fc": "white", "ec": "#0072b2"},
        )  # fmt: skip
    axis.set(xlim=(0.0, 1.0), ylim=(-0.6, len(rows) - 0.4))
    axis.axis("off")
    figure.savefig(path, metadata={"Date": None})


def main() -> None:
    """Print the counts, and draw if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draw", metavar="FILE", type=Path, help="draw the folders and imports")
    given = parser.parse_args()
    found = circles(imports())
    wide, n = folder_widths().most_common(1)[0]
    print(f"{len(modules())} files, {lines_of(modules().values())} lines of Python")
    print(f"{lines_of(shell_sources())} lines of C")
    print(f"widest folder: {wide}, {n} files")
    print(f"import circles: {len(found)}", *(" ".join(group) for group in found), sep="\n  ")
    print(f"names that occur twice: {len(repeated_stems())}: {' '.join(repeated_stems())}")
    if given.draw:
        draw(given.draw)


if __name__ == "__main__":
    main()
