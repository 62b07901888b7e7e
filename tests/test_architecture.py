"""The house stays in order: sizes are listed and do not grow, every status is used."""

import ast
import re
from pathlib import Path

from thrustwasher import cli
from thrustwasher.cli._models import MODELS
from thrustwasher.errors import Status

PACKAGE = Path(cli.__file__).parents[1]
FILE_LINES, FUNCTION_LINES, KERNEL_LINES = 400, 50, 120

# What is over the guidance today, in lines. A number may fall, never rise; a new entry needs a
# reason beside it.
LONG_FILES: dict[str, int] = {}
LONG_FUNCTIONS: dict[str, int] = {}


def sources():
    return sorted(PACKAGE.rglob("*.py"))


def long_files():
    lengths = {str(p.relative_to(PACKAGE)): len(p.read_text("utf-8").splitlines())
               for p in sources()}  # fmt: skip
    return {name: n for name, n in lengths.items() if n > FILE_LINES}


def long_functions():
    found = {}
    for path in sources():
        limit = KERNEL_LINES if path.parent.name == "kernels" else FUNCTION_LINES
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                n = lines_of(node)
                if n > limit:
                    found[f"{path.relative_to(PACKAGE)}:{node.name}"] = n
    return found


def lines_of(function):
    """Return the length without the docstring: words are not counted."""
    first = function.body[0]
    words = 0
    if isinstance(first, ast.Expr) and isinstance(getattr(first.value, "value", None), str):
        words = first.end_lineno - first.lineno + 1
    return function.end_lineno - function.lineno + 1 - words


def test_no_file_grows_beyond_the_guidance():
    assert {name: n for name, n in long_files().items() if n > LONG_FILES.get(name, 0)} == {}


def test_no_function_grows_beyond_the_guidance():
    over = long_functions()
    assert {name: n for name, n in over.items() if n > LONG_FUNCTIONS.get(name, 0)} == {}


def test_every_status_is_used_somewhere():
    text = "\n".join(p.read_text("utf-8") for p in sources() if p.name != "errors.py")
    unused = [s.name for s in Status if not re.search(rf"\b{s.name}\b", text)]
    assert unused == []


def test_every_status_gives_advice():
    assert [s.name for s in Status if not s.advice] == []


def test_a_command_is_one_file_or_the_record_of_a_model():
    files = {p.stem for p in (PACKAGE / "cli").glob("[a-z]*.py")}
    assert files.isdisjoint(MODELS)
    assert files | set(MODELS) == set(cli.COMMANDS)


def test_kernels_import_numbers_only():
    allowed = {"numpy", "numba", "math", "hashlib", "os", "shutil", "tempfile", "collections",
               "functools", "pathlib", "typing", "__future__"}  # fmt: skip
    for path in sorted((PACKAGE / "kernels").glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module or ""]
            elif isinstance(node, ast.ImportFrom):
                outside = node.level > 1 and path.name != "_jit.py"  # loads what is compiled
                assert not outside, f"{path.name} reaches out of the kernels"
            assert [n for n in names if n.split(".")[0] not in allowed] == [], path.name
