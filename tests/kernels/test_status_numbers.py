"""Kernels import nothing from above and repeat status numbers; here they are compared."""

from thrustwasher.errors import Status
from thrustwasher.kernels import clutch_friction, gear_layout, status
from thrustwasher.models._spec import REGIMES


def test_status_numbers_are_those_of_the_enumeration():
    numbers = {name: value for name, value in vars(status).items() if name.isupper()}
    assert numbers == dict(Status.__members__)


def test_regimes_count_from_1_in_the_order_of_the_list():
    numbers = [getattr(clutch_friction, n.upper()) for n in REGIMES]
    assert numbers == [1, 2, 3, 4]
    mesh = [getattr(gear_layout, n.upper()) for n in REGIMES if n != "adhesive"]
    assert mesh == [1, 2, 3]
