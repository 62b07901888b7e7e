"""Masters gone wild (hostile.py): random calls in any order never end the process or give NaN."""

import pytest

from thrustwasher.fmu.interface import all_specs

CALLS = {"ThrustWasher": 200}


@pytest.mark.parametrize("name", [spec.name for spec in all_specs()])
@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.abuse)])
def test_random_calls_neither_crash_nor_give_nan(name, seed, natives, run_child):
    calls = CALLS.get(name, 2000)
    said = run_child("import hostile; hostile.main()", natives[name], seed, calls).splitlines()[-1]
    good, refused = map(int, said.split())
    assert good + refused == calls
    assert min(good, refused) > calls // 20  # sane and insane calls both occur
