"""Each file here is about one way to fail, and says which.

Hazard: a test without its reason is weakened by the next one whom it hinders.
Formula: a file's docstring names the hazard, the formula behind it and the cure, in this order.
Cure: a file that does not is named here.
"""

import ast
from pathlib import Path

import pytest

FILES = sorted(Path(__file__).parent.glob("test_*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_file_names_its_hazard_the_formula_and_the_cure(path):
    said = ast.get_docstring(ast.parse(path.read_text("utf-8"))) or ""
    places = [said.find(f"\n{word}: ") for word in ("Hazard", "Formula", "Cure")]
    assert 0 < places[0] < places[1] < places[2]
