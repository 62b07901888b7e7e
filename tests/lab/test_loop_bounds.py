"""Every loop of the kernels is bounded, and it is said what comes out when the bound is reached."""

import ast
import importlib
import re

import numpy as np
import pytest
from kernel_files import ROOT, kernel_files

from lab.realtime.loop_bounds import bound_of, loops
from thrustwasher.model.registry import all_specs
from thrustwasher.washer.kernels.continuation import BUDGET
from thrustwasher.washer.kernels.map import map_layout as M
from thrustwasher.washer.kernels.map import map_search
from thrustwasher.washer.kernels.step import BUDGET_IN_TIME

PAGE = ROOT / "docs" / "real-time.md"
# Lengths that stand in the parameters: set once from them, no larger than the arrays behind.
LENGTHS = r"int\(par\[L\.D_(RINGS|PLACES|MODES)\]\)"


def kernels(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            names = {d.id for d in node.decorator_list if isinstance(d, ast.Name)}
            if names & {"kernel", "inlined"}:
                yield node


def ends_early(loop):
    """Tell if a loop may end before its range does."""
    for node in ast.iter_child_nodes(loop):
        inside = isinstance(node, ast.For | ast.While)
        if isinstance(node, ast.Break | ast.Return):
            return True
        if inside and any(isinstance(n, ast.Return) for n in ast.walk(node)):
            return True
        if not inside and ends_early(node):
            return True
    return False


def is_plain(loop):
    """Tell if a loop runs over a constant, or as often as was known when its instance began."""
    if isinstance(loop, ast.While) or ends_early(loop):
        return False
    text = re.sub(LENGTHS, "n", ast.unparse(loop.iter))
    if re.fullmatch(r"[A-Z_]+", text):  # a tuple
        return True
    text = re.sub(r"min\((\w+), ([\w\s.-]+)\)", r"\1", text)
    inside = re.fullmatch(r"range\((.*)\)", text)
    return bool(inside) and all(
        re.fullmatch(r"[\w\s.+*/-]+( if [\w\s.>]+ else \w+)?|\w+\.shape\[\d\]", part.strip())
        for part in inside[1].split(",")
    )


def head(loop):
    if isinstance(loop, ast.While):
        return f"while {ast.unparse(loop.test)}"
    return f"for {ast.unparse(loop.target)} in {ast.unparse(loop.iter)}"


def found_in(path):
    module = ".".join(path.relative_to(ROOT / "thrustwasher").with_suffix("").parts)
    for function in kernels(ast.parse(path.read_text("utf-8"))):
        for node in ast.walk(function):
            if isinstance(node, ast.For | ast.While) and not is_plain(node):
                yield module, function.name, head(node)


def test_the_list_has_every_loop_that_a_test_ends_and_no_other():
    there = {place for path in kernel_files() for place in found_in(path)}
    listed = {loop[:3] for loop in loops()}
    assert sorted(there - listed) == [], "add it, with its bound, to loop_bounds.toml"
    assert sorted(listed - there) == [], "is no more in the kernels"


def number(loop):
    """Return a bound that is a number, or made of constants of its module."""
    names = vars(importlib.import_module(f"thrustwasher.{loop.module}"))
    return eval(loop.most, {"__builtins__": {}}, dict(names))


def test_every_bound_is_a_number_or_a_length_of_arrays():
    lengths = ("unknowns", "size of the array", "number of parameters")
    for loop in loops():
        assert loop.most.startswith(lengths) or number(loop) >= 1, loop
        assert loop.then and "?" not in loop.then, loop
        limit = re.fullmatch(r"for .*range\((\w+)\)", loop.head)
        names = vars(importlib.import_module(f"thrustwasher.{loop.module}"))
        if limit and (limit[1] in names or limit[1].isdecimal()):  # else it is an argument
            assert loop.most == limit[1], loop


@pytest.mark.slow
def test_newtons_method_is_never_given_more_than_its_bound():
    most = next(int(x.most) for x in loops() if x.function == "newton")
    given = set()
    for path in kernel_files():
        tree = ast.parse(path.read_text("utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "newton":
                given |= constants_of(node.args[-1], tree)
    assert given and max(given) + 1 == most


def constants_of(argument, tree):
    """Return the numbers in an argument, or in what is assigned to it."""
    where = [argument]
    if isinstance(argument, ast.Name):
        assigned = (n for n in ast.walk(tree) if isinstance(n, ast.Assign))
        where = [n.value for n in assigned if getattr(n.targets[0], "id", "") == argument.id]
    found = {n.value for tree in where for n in ast.walk(tree) if isinstance(n, ast.Constant)}
    assert found, ast.unparse(argument)
    return found


def test_a_loop_that_is_missing_is_seen():
    code = """
@kernel
def solve(n: int, x: float) -> float:
    for _ in range(n):
        x += 1.0
    for _ in range(200):
        if x > 1.0:
            break
    while x < 2.0:
        x += 0.1
    for k in range(int(x)):
        x += k
    return x
"""
    loops_ = [n for n in ast.walk(ast.parse(code)) if isinstance(n, ast.For | ast.While)]
    assert [is_plain(n) for n in loops_] == [True, False, False, False]


def test_every_level_has_a_bound_in_words():
    for spec in all_specs():
        assert all(bound_of(spec.key, level) for level in spec.levels), spec.key


@pytest.mark.parametrize(
    ("model", "level", "function"),
    [
        ("clutch", "field", "integrate"),
        ("gearmesh", "field", "heated_flank"),
        ("transmission", "rigid", "run"),
        ("washer", "map", "find_between"),
    ],
)
def test_the_words_have_the_numbers_of_the_loops(model, level, function):
    (loop,) = (x for x in loops() if x.function == function)
    assert str(number(loop)) in re.findall(r"\d+", bound_of(model, level))


@pytest.mark.parametrize("level", ["field", "fine"])
def test_the_words_have_the_washers_budget(level):
    named = re.findall(r"\d+", bound_of("washer", level))
    assert [int(n) for n in named] == [BUDGET, BUDGET_IN_TIME]


def test_the_page_has_the_bound_of_every_step():
    page = PAGE.read_text("utf-8")
    bounds = {bound_of(spec.key, level) for spec in all_specs() for level in spec.levels}
    assert [bound for bound in bounds if f" | {bound} |" not in page] == []


@pytest.mark.parametrize("load", [0.05, 1.0, 20.0])
def test_a_look_up_that_only_halves_arrives_all_the_same(load, monkeypatch):
    """What comes out at the bound of a look-up is the place itself."""
    w = np.zeros(M.N_LOOK_UP)
    w[M.CURVES : M.CURVES + 4] = 0.0, -3.0, 0.0, 0.9  # the logarithm of the load, falling
    find = getattr(map_search.find_between, "py_func", map_search.find_between)
    given = (w, 4, M.THICK, 1.0, load, -1.0, 1.0, 0.0)
    by_newton = find(*given)
    monkeypatch.setattr(map_search, "HALVED_FROM", 0)
    assert find(*given) == pytest.approx(by_newton, abs=1e-11)
