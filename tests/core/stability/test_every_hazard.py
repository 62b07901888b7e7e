"""Each file here is about one way to fail, and says which.

Hazard: a test without its reason is weakened by the next one whom it hinders.
Formula: a file's docstring names the hazard, the formula behind it and the cure, in this order.
Cure: a file that does not is named here.
"""

import ast
from pathlib import Path

import pytest

LEFT_OUT = {f"pytest.mark.{name}" for name in ("slow", "abuse", "platforms", "fmi3")}
FILES = sorted(Path(__file__).parent.rglob("test_*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_file_names_its_hazard_the_formula_and_the_cure(path):
    said = ast.get_docstring(ast.parse(path.read_text("utf-8"))) or ""
    places = [said.find(f"\n{word}: ") for word in ("Hazard", "Formula", "Cure")]
    assert 0 < places[0] < places[1] < places[2]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_hazard_is_met_in_the_default_run(path):
    """Marks are on single tests here, never on a file."""
    text = path.read_text("utf-8")
    tests = [
        node
        for node in ast.parse(text).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    ]
    assert "\npytestmark" not in text
    assert any(LEFT_OUT.isdisjoint(map(ast.unparse, t.decorator_list)) for t in tests)
