"""The structure of the package, read from its imports: ``python -m lab.structure``.

Prints what each ring holds (core, studio, lab, and the tests of each), and what else is counted;
``--draw FILE.svg`` draws the folders in layers. Imports inside functions
and those for type checkers count like any other.
"""

from __future__ import annotations

import argparse
import ast
import re
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from statistics import median

from lab import shell_calls

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "thrustwasher"
STUDIO_NAME = "thrustwasher.studio"
RINGS = ("core", "studio", "lab")
SUFFIXES = (".py", ".toml", ".jinja", ".js", ".css", ".c", ".h")
FMI_HEADER = re.compile(r"fmi[23]\w*(Functions|FunctionTypes|TypesPlatform|PlatformTypes)\.h")
FORMAT_MARK = re.compile(r"#\s*fmt:\s*(skip|off|on)\b")
DOTTED = re.compile(r'"(\w+(?:\.\w+)+):\w+"')  # what could be imported by a name: "module:NAME"
LEAST_WIDTH, LINE_WIDTH = 0.075, 1e-5  # of a box, as shares of the picture; per line of code
HALF_HEIGHT = 0.22  # of a box, in layers
SPACE = 0.01  # between a box and an arrow that passes it
CORE, STUDIO = ("#e8f1f8", "#0072b2"), ("#fdf1d6", "#e69f00")  # of boxes: face, edge
ARROW = {"arrowstyle": "-|>", "color": "0.5", "lw": 0.9, "shrinkA": 0, "shrinkB": 0}


@cache
def modules() -> dict[str, Path]:
    """Return the package's modules: dotted name -> file."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
        found[name.removesuffix(".__init__")] = path
    return found


@cache
def tree_of(path: Path) -> ast.Module:
    """Return the syntax of a Python file."""
    return ast.parse(path.read_text("utf-8"))


def statements(within: ast.AST) -> Iterable[ast.AST]:
    """Yield all statements, however deep; in expressions there are none."""
    for name in ("body", "handlers", "orelse", "finalbody", "cases"):
        for one in getattr(within, name, ()):
            yield one
            yield from statements(one)


@cache
def imports() -> dict[str, set[str]]:
    """Return which modules of the package each one imports, wherever in the file it does so."""
    found: dict[str, set[str]] = {}
    for name, path in modules().items():
        package = name if path.name == "__init__.py" else name.rpartition(".")[0]
        targets = {t for node in statements(tree_of(path)) for t in _targets(node, package)}
        found[name] = (targets & modules().keys()) - {name}
    return found


def names_of_modules() -> dict[str, set[str]]:
    """Return the modules that sources name in strings, as "module:NAME": file -> modules."""
    found = {}
    for path in sources():
        named = {name for name in DOTTED.findall(path.read_text("utf-8")) if name in modules()}
        if named:
            found[path.relative_to(ROOT).as_posix()] = named
    return found


def _targets(node: ast.AST, package: str) -> Iterable[str]:
    """Return the modules that a statement imports, as far as names tell."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        above = package.split(".")[: len(package.split(".")) - node.level + 1]
        base = (
            ".".join([*above, *([node.module] if node.module else [])])
            if node.level
            else (node.module or "")
        )
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
    """Return the C files written by hand."""
    folders = (ROOT / "fmu_src", PACKAGE / "native")
    return sorted(
        path
        for folder in folders
        for end in ("*.c", "*.h")
        for path in folder.rglob(end)
        if "vendor" not in path.parts
    )


def sources() -> list[Path]:
    """Return all sources written by hand that a user gets: no vendored file, no bundle."""
    return sorted(
        path
        for folder in (PACKAGE, ROOT / "fmu_src")
        for path in folder.rglob("*")
        if path.suffix in SUFFIXES
        and not {"vendor", "bundle", "__pycache__"} & set(path.parts)
        and not FMI_HEADER.fullmatch(path.name)
    )


def test_sources() -> list[Path]:
    """Return the tests and what they share."""
    return sorted((ROOT / "tests").rglob("*.py"))


def rings() -> dict[str, list[Path]]:
    """Return the sources written by hand, ring by ring; those of the tests too."""
    studio, tests = PACKAGE / "studio", ROOT / "tests"
    own = sources()
    found = {
        "core": [path for path in own if not path.is_relative_to(studio)],
        "studio": [path for path in own if path.is_relative_to(studio)],
        "lab": _files_in(ROOT / "lab"),
    }
    found |= {f"tests/{name}": _files_in(tests / name) for name in ("core", "studio", "lab")}
    shared = [p for p in _files_in(tests) if not any(p in found[f"tests/{n}"] for n in RINGS)]
    return found | {"tests, shared": shared}


def _files_in(folder: Path) -> list[Path]:
    return sorted(
        path
        for path in folder.rglob("*")
        if path.suffix in SUFFIXES
        and not {"vendor", "__pycache__", "gathered", "node_modules", "bundle"} & set(path.parts)
        and not FMI_HEADER.fullmatch(path.name)
    )


def lines_by_suffix(paths: Iterable[Path]) -> Counter[str]:
    """Return the lines of files by suffix, Python as formatted."""
    found: Counter[str] = Counter()
    paths = list(paths)
    for path in paths:
        if path.suffix != ".py":
            found[path.suffix] += lines_of([path])
    found[".py"] = lines_of_texts(formatted(tuple(p for p in paths if p.suffix == ".py")))
    return found


def upward() -> list[tuple[str, str]]:
    """Return the imports that lead from the core to the studio, next to the public names."""
    return [
        (name, other)
        for name, others in imports().items()
        for other in sorted(others)
        if other.startswith(STUDIO_NAME)
        and not name.startswith(STUDIO_NAME)
        and name != PACKAGE.name
    ]


@cache
def formatted(paths: tuple[Path, ...]) -> dict[Path, str]:
    """Return Python files as ``ruff format`` lays them out everywhere: path -> text.

    Marks that keep it from doing so ("fmt: skip") are taken out first. FileNotFoundError: no ruff.
    """
    with tempfile.TemporaryDirectory() as name:
        copies = {path: Path(name, f"{i}.py") for i, path in enumerate(paths)}
        for path, copy in copies.items():
            copy.write_text(FORMAT_MARK.sub("", path.read_text("utf-8")), "utf-8")
        ruff = [sys.executable, "-m", "ruff", "format", "--quiet", "--no-cache", name]
        ruff += ["--config", str(ROOT / "pyproject.toml")]
        done = subprocess.run(ruff, capture_output=True, text=True)
        if done.returncode:
            raise FileNotFoundError(done.stderr.strip())
        return {path: copy.read_text("utf-8") for path, copy in copies.items()}


def python_sources() -> tuple[Path, ...]:
    """Return those of the sources that are Python."""
    return tuple(path for path in sources() if path.suffix == ".py")


def source_lines() -> Counter[str]:
    """Return the lines of the sources by suffix, Python as formatted."""
    return lines_by_suffix(sources())


def lines_of_texts(texts: Mapping[Path, str]) -> int:
    """Return the number of lines of all texts."""
    return sum(len(text.splitlines()) for text in texts.values())


def format_marks(paths: Iterable[Path]) -> int:
    """Return how often files keep the formatter from its work."""
    return sum(len(FORMAT_MARK.findall(path.read_text("utf-8"))) for path in paths)


def function_lengths(texts: Mapping[Path, str]) -> Counter[str]:
    """Return the lines of all functions without their docstrings, "file:name" -> lines."""
    found: Counter[str] = Counter()
    for path, text in texts.items():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                first = node.body[0]
                words = ast.get_docstring(node, clean=False) is not None
                said = first.end_lineno - first.lineno + 1 if words else 0
                name = f"{path.relative_to(ROOT).as_posix()}:{node.name}"
                found[name] = max(found[name], node.end_lineno - node.lineno + 1 - said)
    return found


def repeated_stems() -> list[str]:
    """Return the names of modules that occur more than once."""
    stems = Counter(path.stem for path in modules().values() if path.stem != "__init__")
    return sorted(stem for stem, n in stems.items() if n > 1)


def room(module: str) -> str:
    """Return the folder below the package that a module belongs to; "" for those on top."""
    parts = module.split(".")
    deep = 3 if parts[1:2] == ["studio"] else 2  # its folders are rooms, not it
    folder = parts[1:deep]
    is_folder = len(parts) >= deep and PACKAGE.joinpath(*folder, "__init__.py").is_file()
    return ".".join(folder) if is_folder else ""


def arrows() -> dict[tuple[str, str], int]:
    """Return how many imports go from one folder to another."""
    found: dict[tuple[str, str], int] = defaultdict(int)
    for name, others in imports().items():
        for other in others:
            pair = room(name), room(other)
            if pair[0] != pair[1] and all(pair):
                found[pair] += 1
    return dict(found)


def layers() -> list[list[str]]:
    """Return the folders from top to bottom, as the contract for imports in pyproject has them."""
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]
    rows = next(c["layers"] for c in tool["importlinter"]["contracts"] if c["type"] == "layers")
    return [re.findall(r"thrustwasher\.([\w.]+)", row) for row in rows]


def not_implied(pairs: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return the arrows that no chain of others stands for."""
    below: dict[str, set[str]] = defaultdict(set)
    for source, target in pairs:
        below[source].add(target)

    def reached(name: str) -> set[str]:
        return {name}.union(*(reached(other) for other in below.get(name, ())))

    return [
        (source, target)
        for source, targets in sorted(below.items())
        for target in sorted(targets)
        if not any(target in reached(other) for other in targets - {target})
    ]


def arrows_in_words() -> str:
    """Return the arrows of the picture as text, which stands in it: "cli to study"."""
    return ", ".join(f"{source} to {target}" for source, target in not_implied(arrows()))


def _way(
    begin: tuple[float, float], end: tuple[float, float], gaps: list[list[tuple[float, float]]]
) -> list[tuple[float, float]]:
    """Return the points of an arrow, one in each layer: it passes between boxes."""
    found = [begin]
    for y in range(int(begin[1]) - 1, int(end[1]), -1):
        x0, y0 = found[-1]
        straight = x0 + (end[0] - x0) * (y0 - y) / (y0 - end[1])
        free = [(a + SPACE, b - SPACE) for a, b in gaps[y] if b - a > 2.0 * SPACE]
        found.append(
            (
                min((min(max(straight, a), b) for a, b in free), key=lambda x: abs(x - straight)),
                float(y),
            )
        )
    return [*found, end]


def draw(path: Path) -> None:
    """Draw the folders in their layers, as wide as they have lines, with arrows for imports."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams |= {"svg.hashsalt": "structure", "svg.fonttype": "none"}
    from matplotlib.figure import Figure
    from matplotlib.patches import FancyBboxPatch

    sizes: Counter[str] = Counter()
    for name, file in modules().items():
        sizes[room(name)] += lines_of([file])
    rows = [[name for name in row if sizes[name]] for row in layers()]
    rows = [row for row in rows if row]
    figure = Figure(figsize=(9.0, 1.05 * len(rows)), layout="constrained")
    axis = figure.add_subplot()
    place: dict[str, tuple[float, float]] = {}
    gaps: list[list[tuple[float, float]]] = [[] for _ in rows]  # between the boxes of a layer
    for y, row in zip(range(len(rows) - 1, -1, -1), rows, strict=True):
        wide = {name: LEAST_WIDTH + LINE_WIDTH * sizes[name] for name in row}
        gap = (1.0 - sum(wide.values())) / (len(row) + 1)
        x = gap
        for name in row:
            place[name] = (x + 0.5 * wide[name], float(y))
            face, edge = STUDIO if name.startswith("studio.") else CORE
            axis.add_patch(
                FancyBboxPatch(
                    (x, y - HALF_HEIGHT),
                    wide[name],
                    2.0 * HALF_HEIGHT,
                    facecolor=face,
                    boxstyle="round,pad=0,rounding_size=0.012",
                    edgecolor=edge,
                    mutation_aspect=9.0,
                )
            )
            told = f"{name.removeprefix('studio.')}\n{sizes[name] / 1000:.1f} k lines"
            axis.text(*place[name], told, ha="center", va="center", fontsize=9)
            gaps[y].append((x - gap, x))
            x += wide[name] + gap
        gaps[y].append((x - gap, x))
    for source, target in not_implied(arrows()):
        way = [
            point
            for x, y in _way(place[source], place[target], gaps)
            for point in ((x, y + HALF_HEIGHT), (x, y - HALF_HEIGHT))
        ][1:-1]
        axis.plot(*zip(*way, strict=True), color="0.5", lw=0.9, solid_joinstyle="round")
        axis.annotate("", way[-1], way[-2], arrowprops=ARROW)
    axis.set(xlim=(0.0, 1.0), ylim=(-0.4, len(rows) - 0.6))
    axis.axis("off")
    figure.savefig(path, metadata={"Date": None, "Description": arrows_in_words()})


def main() -> None:
    """Print the counts, and draw if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draw", metavar="FILE", type=Path, help="draw the folders and imports")
    given = parser.parse_args()
    found = circles(imports())
    wide, n = folder_widths().most_common(1)[0]
    lengths = function_lengths(formatted(python_sources()))
    long, length = lengths.most_common(1)[0]
    for ring, paths in rings().items():
        lines = lines_by_suffix(paths)
        kinds = ", ".join(f"{count} {suffix[1:]}" for suffix, count in lines.most_common())
        print(f"{ring:13} {len(paths):4} files {lines.total():6} lines as formatted: {kinds}")
    print(f"imports from core to studio: {len(upward())}")
    print(f"median function, as formatted: {median(lengths.values()):g} lines")
    print(f"longest function, as formatted: {length} lines, {long}")
    print(f"marks for the formatter: {format_marks(python_sources())}")
    print(f"widest folder: {wide}, {n} files")
    print(f"import circles: {len(found)}", *(" ".join(group) for group in found), sep="\n  ")
    in_c = circles(shell_calls.graph(shell_sources()))
    print(f"circles of calls in C: {len(in_c)}", *(" ".join(group) for group in in_c), sep="\n  ")
    print(f"files that name modules in strings: {len(names_of_modules())}")
    print(f"names that occur twice: {len(repeated_stems())}: {' '.join(repeated_stems())}")
    if given.draw:
        draw(given.draw)


if __name__ == "__main__":
    main()
