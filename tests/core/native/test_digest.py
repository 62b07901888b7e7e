"""What names a compilation: the code, and neither what is said about it nor where it lies."""

import json

import pytest

from thrustwasher.native import code, digest
from thrustwasher.native.entries import called, libraries, symbols

KERNEL = '''"""A kernel."""

from ..numerics.jit import kernel
from .layout import N_NODES, P_LOAD
import math


@kernel
def rise(p: float) -> float:
    """Return a rise [K]."""
    return math.sqrt(P_LOAD * p) + 2.0 * N_NODES
'''
SAME = {
    "comment": KERNEL.replace("@kernel", "# what is wanted\n@kernel"),
    "docstring of a function": KERNEL.replace("Return a rise [K].", "Return another rise [K]."),
    "no docstring": KERNEL.replace('    """Return a rise [K]."""\n', ""),
    "head": KERNEL.replace("A kernel.", "The only kernel."),
    "layout": KERNEL.replace("P_LOAD * p", "(P_LOAD\n    * p)"),
    "line ends": KERNEL.replace("\n", "\r\n"),
    "folder": KERNEL.replace("..numerics", "...numerics"),
    "order of imports": "import math\n" + KERNEL.replace("import math\n", ""),
}
OTHERS = {
    "number": KERNEL.replace("2.0", "3.0"),
    "type of a number": KERNEL.replace("2.0", "2"),
    "annotation": KERNEL.replace("p: float", "p: int"),
    "order of terms": KERNEL.replace("P_LOAD * p", "p * P_LOAD"),
    "brackets that count": KERNEL.replace("2.0 * N_NODES", "(2.0 * N_NODES) * 1.0"),
    "name imported": KERNEL.replace("P_LOAD", "P_SPEED"),
    "module imported": KERNEL.replace(".layout", ".places"),
    "name inside": KERNEL.replace("P_LOAD\n", "P_SPEED as P_LOAD\n"),
    "decorator": KERNEL.replace("@kernel\n", ""),
}


@pytest.mark.parametrize("text", SAME.values(), ids=SAME)
def test_what_is_for_readers_does_not_count(text):
    assert text != KERNEL
    assert code.parsed(text.encode()).digest == code.parsed(KERNEL.encode()).digest


@pytest.mark.parametrize("text", OTHERS.values(), ids=OTHERS)
def test_an_edit_of_any_code_counts(text):
    assert text != KERNEL
    assert code.parsed(text.encode()).digest != code.parsed(KERNEL.encode()).digest


LAYOUT, CONSTANTS = "N_NODES, P_LOAD = 3, 1.0\n", "P_LOAD = 1.0\nN_NODES = 3\n"


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Write a package of kernels; return its name."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def write(name, **files):
        home = tmp_path.joinpath(*name.split("."))
        home.mkdir(parents=True)
        for folder in home.relative_to(tmp_path).parents[::-1][1:]:
            (tmp_path / folder / "__init__.py").touch()
        (home / "__init__.py").touch()
        for file, text in files.items():
            (home / f"{file}.py").write_text(text)
        return f"{name}.step"

    return write


def test_modules_that_moved_together_have_the_same_digest(package):
    parts = {"step": "from .layout import P_LOAD\nTWICE = 2.0 * P_LOAD\n", "layout": LAYOUT}
    here, there = package("spring_a", **parts), package("models.spring_b.kernels", **parts)
    assert digest.digest(here) == digest.digest(there)


def test_what_is_imported_counts_by_its_code_and_who_imports_it(package):
    step = "from . import layout\nfrom .hot import layout as other\nX = layout.P_LOAD\n"
    cold = {"step": step, "layout": LAYOUT}
    kernels = [package("spring_c", **cold), package("spring_d", **cold)]
    hot = ("spring_c.hot", CONSTANTS), ("spring_d.hot", CONSTANTS.replace("3", "4"))
    for name, text in hot:
        package(name, layout=text)
    swapped = package("spring_e", step=step, layout=CONSTANTS)
    package("spring_e.hot", layout=LAYOUT)
    assert len({digest.digest(kernel) for kernel in (*kernels, swapped)}) == 3


@pytest.mark.parametrize("text", ["", "[]", "{", '{"a": 1}', "[" * 100_000])
def test_without_the_list_of_what_was_parsed_the_digests_are_the_same(text, monkeypatch, tmp_path):
    kernel, clear = "thrustwasher.command.kernels.step", (code.known, code._code_of, digest.digest)
    listed = digest.digest(kernel)
    monkeypatch.setattr(code, "KNOWN", tmp_path / "code.json")
    code.KNOWN.write_text(text)
    for known in clear:
        known.cache_clear()
    assert digest.digest(kernel) == listed
    for known in clear:
        known.cache_clear()


def test_the_list_of_what_was_parsed_is_right():
    listed = 0
    for path in digest.HERE.parent.rglob("*.py"):
        text = digest.read(path)
        if code.key(text) in code.known():
            made = code.parsed(text)
            assert code.known()[code.key(text)] == [made.digest, *made.imports], path
            listed += 1
    assert listed > 20
    assert json.loads(code.KNOWN.read_text("utf-8")) == code.known()


@pytest.mark.parametrize("library", libraries())
def test_every_function_of_a_library_has_a_name_of_its_own(library):
    assert len(set(symbols(library))) == len(called(library)) > 0
