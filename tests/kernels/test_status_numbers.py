"""Kernels import nothing from above and repeat status numbers; here they are compared."""

import pytest

from thrustwasher.errors import Status
from thrustwasher.kernels import (
    clutch_friction,
    clutch_layout,
    gear_layout,
    transmission_layout,
)
from thrustwasher.models._spec import REGIMES


@pytest.mark.parametrize("module", [clutch_layout, gear_layout, transmission_layout])
def test_status_numbers_are_those_of_the_enumeration(module):
    found = [n for n in Status.__members__ if hasattr(module, n)]
    assert {"OK", "NOT_FINITE", "BAD_INPUT"} <= set(found)
    assert all(getattr(module, n) == Status[n] for n in found)


def test_regimes_count_from_1_in_the_order_of_the_list():
    numbers = [getattr(clutch_friction, n.upper()) for n in REGIMES]
    assert numbers == [1, 2, 3, 4]
    mesh = [getattr(gear_layout, n.upper()) for n in REGIMES if n != "adhesive"]
    assert mesh == [1, 2, 3]
